// Sine and cosine of one double or of a whole array, with the same bits for both on every machine: the values do not
// depend on the C library, on the vector unit or on a value's place in the array. While doubles are rounded to nearest,
// both have errors < 1.25 ulp for every finite argument, proved in sine_cosine_kernel.hpp up to |x| = 2^20; beyond, and
// for the few arguments too close to a multiple of pi/2, MPFR gives the nearest double.
#pragma once

#include <span>

#include "scalars/elementary/vector_unit.hpp"

namespace gamut {

struct SineCosine {
  double sine, cosine;
};

/// Both functions of x; NaN for an infinity or a NaN.
SineCosine sineCosine(double x);

/// sine[i] = sin x[i], cosine[i] = cos x[i]. The spans have one length (std::invalid_argument otherwise); a result may
/// overwrite x.
void sineCosine(std::span<const double> x, std::span<double> sine, std::span<double> cosine);
void sine(std::span<const double> x, std::span<double> sine);
void cosine(std::span<const double> x, std::span<double> cosine);

/// As above on a given unit of usableUnits(): all give the same bits.
void sineCosine(VectorUnit unit, std::span<const double> x, std::span<double> sine, std::span<double> cosine);

}  // namespace gamut
