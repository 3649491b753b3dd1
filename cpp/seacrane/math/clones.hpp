#pragma once

/// The core is compiled for any processor. GCC compiles a loop over whole vectors again for those that are
/// named, and chooses when the program starts; all that it calls is within it. None of them fuses products
/// and sums ("avx512f": with -ffp-contract=off, cpp/CMakeLists.txt), so that all give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && defined(__gnu_linux__) && \
    !defined(__AVX2__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SEACRANE_CLONES(...) __attribute__((target_clones(__VA_ARGS__, "default"), flatten))
#else
#define SEACRANE_CLONES(...)
#endif
