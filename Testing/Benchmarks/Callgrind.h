// Callgrind's requests; nothing where valgrind is not installed.
#ifndef Haptics_Callgrind_h
#define Haptics_Callgrind_h

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_ZERO_STATS
#define CALLGRIND_DUMP_STATS_AT(name)
#endif

#endif
