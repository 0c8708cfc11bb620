// Asks the processor, once, which vector units it has.
#include "scalars/elementary/vector_unit.hpp"

namespace gamut {

std::span<const VectorUnit> usableUnits() {
  static constexpr VectorUnit units[] = {VectorUnit::baseline, VectorUnit::avx2, VectorUnit::avx512};
  static const std::size_t count = [] {
    std::size_t usable = 1;
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2")) {
      usable = 2;
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) usable = 3;
    }
#endif
    return usable;
  }();
  return {units, count};
}

const char* nameOf(VectorUnit unit) {
  switch (unit) {
    case VectorUnit::avx2:
      return "AVX2";
    case VectorUnit::avx512:
      return "AVX-512";
    case VectorUnit::baseline:
      break;
  }
  return "baseline";
}

}  // namespace gamut
