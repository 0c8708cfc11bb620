// Sums and products of small vectors and matrices, for mechanics/algebra.cpp and any_scalar.hpp. Products sum as
// Eigen's.
#pragma once

#include "mechanics/algebra.hpp"

namespace gamut {

template <class S>
Vector3<S> operator+(const Vector3<S>& a, const Vector3<S>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <class S>
Vector3<S> operator-(const Vector3<S>& a, const Vector3<S>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class S>
Vector3<S> operator-(const Vector3<S>& a) {
  return {-a[0], -a[1], -a[2]};
}

template <class S>
Vector3<S> operator*(const Vector3<S>& a, const S& factor) {
  return {a[0] * factor, a[1] * factor, a[2] * factor};
}

template <class S>
Vector3<S> operator*(const S& factor, const Vector3<S>& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

template <class S>
Vector3<S>& operator+=(Vector3<S>& sum, const Vector3<S>& a) {
  return sum = sum + a;
}

template <class S>
Vector3<S>& operator-=(Vector3<S>& rest, const Vector3<S>& a) {
  return rest = rest - a;
}

template <class S>
Matrix3<S> operator+(const Matrix3<S>& a, const Matrix3<S>& b) {
  return a.Eigen::template MatrixBase<Matrix3<S>>::operator+(b);
}

template <class S>
Matrix3<S> operator-(const Matrix3<S>& a, const Matrix3<S>& b) {
  return a.Eigen::template MatrixBase<Matrix3<S>>::operator-(b);
}

template <class S>
Vector3<S> operator*(const Matrix3<S>& a, const Vector3<S>& b) {
  return a.lazyProduct(b);
}

template <class S>
Vector3<S> operator*(const Eigen::Transpose<Matrix3<S>>& a, const Vector3<S>& b) {
  return a.lazyProduct(b);
}

template <class S>
Vector3<S> operator*(const Eigen::Transpose<const Matrix3<S>>& a, const Vector3<S>& b) {
  return a.lazyProduct(b);
}

template <class S>
Matrix3<S> operator*(const Matrix3<S>& a, const Matrix3<S>& b) {
  return a.lazyProduct(b);
}

template <class S>
Matrix3<S> operator*(const Eigen::Transpose<Matrix3<S>>& a, const Matrix3<S>& b) {
  return a.lazyProduct(b);
}

template <class S>
Matrix3<S> operator*(const Eigen::Transpose<const Matrix3<S>>& a, const Matrix3<S>& b) {
  return a.lazyProduct(b);
}

}  // namespace gamut
