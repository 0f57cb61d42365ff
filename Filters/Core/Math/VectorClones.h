#ifndef Haptics_VectorClones_h
#define Haptics_VectorClones_h

/// Marks a function whose loops are compiled twice on x86-64, for AVX2 and for every machine; the
/// loader picks by the processor. Both give the same bits: the order of operations is the source's,
/// and multiply-adds are not contracted. Sanitizers' runtimes are not ready yet when the loader
/// picks, and other architectures have one set of vector instructions: there it means nothing.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__) &&                 \
  !defined(__SANITIZE_THREAD__) && !defined(__clang__) && defined(__GNUC__)
#define HAPTICS_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define HAPTICS_VECTOR_CLONES
#endif

/// What such a function calls has to become part of it, or stays compiled for every machine.
#if defined(__GNUC__)
#define HAPTICS_ALWAYS_INLINE __attribute__((always_inline)) inline
#else
#define HAPTICS_ALWAYS_INLINE inline
#endif

#endif
