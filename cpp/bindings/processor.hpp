#pragma once

#if defined(__x86_64__) && defined(__GNUC__)
#include <cpuid.h>
#endif

/// Instructions that the processor has and whose registers the system keeps, asked of the processor itself.
/// What __builtin_cpu_supports() knows is filled in by the compiler's run time, and not every compiler's has
/// it.
struct Processor {
  bool avx = false, avx2 = false, avx512 = false;  // avx2: with fma; avx512: f, dq and vl

  static const Processor& here() {
    static const Processor found = read();
    return found;
  }

 private:
  static Processor read() {
    Processor out;
#if defined(__x86_64__) && defined(__GNUC__)
    unsigned a = 0, b = 0, c = 0, d = 0, low = 0, high = 0;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & bit_OSXSAVE)) return out;
    const bool fma = c & bit_FMA;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    constexpr unsigned halves = 0x06, wide = 0xe6;  // registers that the system keeps: of AVX, of AVX-512
    out.avx = (c & bit_AVX) && (low & halves) == halves;
    if (!out.avx || !__get_cpuid_count(7, 0, &a, &b, &c, &d)) return out;
    out.avx2 = fma && (b & bit_AVX2);
    constexpr unsigned all = bit_AVX512F | bit_AVX512DQ | bit_AVX512VL;
    out.avx512 = out.avx2 && (low & wide) == wide && (b & all) == all;
#endif
    return out;
  }
};
