#pragma once

#include "processor.hpp"

#if defined(__x86_64__) && defined(__GNUC__)

__attribute__((target("avx"))) inline void zero_upper_halves() { __builtin_ia32_vzeroupper(); }

/// Clears the upper halves of the vector registers. OpenBLAS's complex matrix product leaves them in use,
/// and every call of the mathematical library then takes some twenty times as long, until someone does this.
inline void clear_vector_state() {
  if (Processor::here().avx) zero_upper_halves();
}

#else

inline void clear_vector_state() {}

#endif
