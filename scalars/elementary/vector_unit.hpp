// The processor's vector unit, for kernels that are written once for a vector of any length: the same elementary
// operations on 2, 4 or 8 doubles at once. No unit fuses a product with a sum, so every unit gives the same bits.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>

#define GAMUT_INLINE inline __attribute__((always_inline))
// A function so marked may use that unit; it is called only where `usableUnits` names the unit.
#if defined(__x86_64__)
#define GAMUT_AVX2 __attribute__((target("avx2")))
#define GAMUT_AVX512 __attribute__((target("avx512f,avx512dq")))
#else
#define GAMUT_AVX2
#define GAMUT_AVX512
#endif

namespace gamut {

enum class VectorUnit { baseline, avx2, avx512 };

/// The units that this machine has, the widest last.
std::span<const VectorUnit> usableUnits();

/// "baseline", "AVX2", "AVX-512".
const char* nameOf(VectorUnit unit);

namespace detail {

typedef double Vector2 __attribute__((vector_size(16)));
typedef double Vector4 __attribute__((vector_size(32)));
typedef double Vector8 __attribute__((vector_size(64)));

/// For V, one double or a vector: unsigned integers of V's length, and V as it lies in an array of doubles.
template <class V>
struct Layout;
template <>
struct Layout<double> {
  using Bits = std::uint64_t;
};
template <>
struct Layout<Vector2> {
  typedef std::uint64_t Bits __attribute__((vector_size(16)));
  typedef double InArray __attribute__((vector_size(16), aligned(8), may_alias));
};
template <>
struct Layout<Vector4> {
  typedef std::uint64_t Bits __attribute__((vector_size(32)));
  typedef double InArray __attribute__((vector_size(32), aligned(8), may_alias));
};
template <>
struct Layout<Vector8> {
  typedef std::uint64_t Bits __attribute__((vector_size(64)));
  typedef double InArray __attribute__((vector_size(64), aligned(8), may_alias));
};
template <class V>
using BitsOf = typename Layout<V>::Bits;

/// Doubles in a V.
template <class V>
constexpr int lanes = static_cast<int>(sizeof(V) / sizeof(double));

/// to = the object representation of from.
template <class To, class From>
GAMUT_INLINE void reinterpret(To& to, const From& from) {
  if constexpr (std::is_same_v<To, double> || std::is_same_v<From, double>)
    to = std::bit_cast<To>(from);
  else
    to = reinterpret_cast<To>(from);  // of vectors: their bits
}

// Not by memcpy: before it knows the function's unit, the compiler would cut it into pieces of 16 bytes.
template <class V>
GAMUT_INLINE void load(V& to, const double* from) {
  to = *reinterpret_cast<const typename Layout<V>::InArray*>(from);
}

template <class V>
GAMUT_INLINE void store(double* to, const V& from) {
  *reinterpret_cast<typename Layout<V>::InArray*>(to) = from;
}

}  // namespace detail
}  // namespace gamut
