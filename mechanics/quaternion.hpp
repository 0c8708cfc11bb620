// Unit quaternions e = (w, x, y, z) as orientations, of numbers of any kind (W. R. Hamilton's product; A. A. Shabana,
// Dynamics of Multibody Systems, section 2.7, as Euler parameters): a vector with components x' in K' has components
// A(e) x' in K.
#pragma once

#include <array>
#include <cstddef>

namespace gamut {

template <class T>
using Quaternion = std::array<T, 4>;

/// a ∘ b: first the rotation a, then b, in the frame that a leads to: A(a ∘ b) = A(a) A(b).
template <class T>
Quaternion<T> product(const Quaternion<T>& a, const Quaternion<T>& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] + a[2] * b[0] + a[3] * b[1] - a[1] * b[3], a[0] * b[3] + a[3] * b[0] + a[1] * b[2] - a[2] * b[1]};
}

}  // namespace gamut
