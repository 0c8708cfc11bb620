// A damped mode about rest: (F_0 + s F_1 + s² F_2) φ = 0 and cᵀ φ = 1, in real and imaginary parts
// w = [Re φ; Im φ; Re s; Im s].
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "mechanics/rest_rows.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

/// s of all modes and of what does not oscillate, by their size. Throws UnfitPart where not all joints move a mass.
std::vector<std::complex<double>> eigenvaluesOf(const RestRows& rows, const LinearRows<double>& at);

/// One of each pair.
std::vector<std::complex<double>> modesAmong(const std::vector<std::complex<double>>& eigenvalues);

struct DampedMode {
  /// Near s.
  DampedMode(const RestRows& rows, const LinearRows<double>& at, int number, std::complex<double> s);

  int number;                   ///< 0 the slowest
  std::vector<double> nominal;  ///< w
  std::vector<double> dual;     ///< Re c, Im c
  std::vector<double> unit;     ///< of what is left open of each: about as large as they are

  template <class S>
  std::vector<S> rowsOf(const LinearRows<S>& at, std::span<const S> w) const;
  /// Of these the derivatives by w, row by row.
  template <class S>
  std::vector<S> slopesOf(const LinearRows<S>& at, std::span<const S> w) const;
  /// Newton's steps from w on, written down.
  std::vector<Recorded> rooted(const LinearRows<Recorded>& at, std::vector<Recorded> w) const;
};

}  // namespace gamut
