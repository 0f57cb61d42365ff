#ifndef Haptics_DefaultSignals_h
#define Haptics_DefaultSignals_h

#include <csignal>
#include <initializer_list>

/// A shell has programs in its background ignore SIGINT and SIGQUIT, and nohup SIGHUP; what they
/// start inherits that. Tests of what signals do begin as a program in a terminal does.
inline const bool areSignalsDefault = []
{
  for (const int signal : { SIGINT, SIGQUIT, SIGHUP })
  {
    std::signal(signal, SIG_DFL);
  }
  return true;
}();

#endif
