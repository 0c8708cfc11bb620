// Vectors by the numbers that programs, states and monomials count by.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace gamut {

/// A vector whose index may be an int, which is not negative.
template <class T>
class ByNumber : public std::vector<T> {
 public:
  using std::vector<T>::vector;
  using std::vector<T>::operator[];
  ByNumber() = default;
  ByNumber(std::vector<T> values) : std::vector<T>(std::move(values)) {}  // NOLINT(google-explicit-constructor): is one

  T& operator[](int number) { return (*this)[static_cast<std::size_t>(number)]; }
  const T& operator[](int number) const { return (*this)[static_cast<std::size_t>(number)]; }
};

}  // namespace gamut
