// One clone of a function for AVX-512, one for FMA3, one for the baseline, chosen when the program starts.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define GAMUT_CLONES __attribute__((target_clones("avx512f", "fma", "default")))
#else
#define GAMUT_CLONES
#endif
#define GAMUT_INLINE inline __attribute__((always_inline))
