// What is computed in doubles of a mechanism near rest.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "mechanics/rest_rows.hpp"

namespace gamut {

/// Row by row as a matrix.
inline Eigen::MatrixXd squareMatrix(const std::vector<double>& entries, int size) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(entries.data(), size,
                                                                                                  size);
}

/// A square matrix free of units: each row by its greatest entry, then each column.
struct ScaledMatrix {
  explicit ScaledMatrix(const Eigen::MatrixXd& m);
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  Eigen::MatrixXd inverse() const;

  Eigen::MatrixXd matrix;
  Eigen::VectorXd row, column;
};

/// The mechanism's motion with what its loops hold taken out: a basis Z of the tangents, and −Zᵀ F Z of its
/// coordinates.
struct ReducedMotion {
  ReducedMotion(const RestRows& of, const LinearRows<double>& at);
  ReducedMotion(const RestRows& of, const Eigen::MatrixXd& f0, const Eigen::MatrixXd& f1, const Eigen::MatrixXd& f2);
  bool isSymmetric() const;

  Eigen::MatrixXd tangents, stiffness, damping, mass;
};

/// Throws UnfitPart: there are no modes.
[[noreturn]] void refuseMassless(const RestRows& rows);

/// A power of 2 about as large as the largest of so many numbers.
double unitOf(std::span<const double> numbers);

/// v + share · step
std::vector<double> stepped(std::vector<double> v, const Eigen::VectorXd& step, double share = 1);

}  // namespace gamut
