#pragma once

/// The core is compiled for any processor; loops over whole vectors, which are long where runs go side by
/// side, GCC compiles again for registers of four doubles, and chooses when the program starts. That form has
/// no fused products and sums, so that both give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__AVX2__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEACRANE_WIDE_LOOP __attribute__((target_clones("avx2", "default"), flatten))
#else
#define SEACRANE_WIDE_LOOP
#endif
