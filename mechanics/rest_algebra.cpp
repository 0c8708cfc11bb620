#include "mechanics/rest_algebra.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/description/refusal.hpp"
#include "scalars/algebra/decompositions.hpp"

namespace gamut {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

ScaledMatrix::ScaledMatrix(const Matrix& m) : matrix(m) {
  row = m.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double x) { return x > 0 ? 1 / x : 1.0; });
  matrix = row.asDiagonal() * matrix;
  column = matrix.cwiseAbs().colwise().maxCoeff().transpose().unaryExpr([](double x) { return x > 0 ? 1 / x : 1.0; });
  matrix = matrix * column.asDiagonal();
}

Vector ScaledMatrix::solve(const Vector& right) const {
  return column.asDiagonal() * safelySolved(matrix, row.asDiagonal() * right);
}

Matrix ScaledMatrix::inverse() const { return column.asDiagonal() * inverseOf(matrix) * row.asDiagonal(); }

ReducedMotion::ReducedMotion(const RestRows& of, const LinearRows<double>& at)
    : ReducedMotion(of, squareMatrix(at.byPosition, of.size), squareMatrix(at.byRate, of.size),
                    squareMatrix(at.byAcceleration, of.size)) {}

ReducedMotion::ReducedMotion(const RestRows& of, const Matrix& f0, const Matrix& f1, const Matrix& f2) {
  const int n = of.coordinates;
  tangents = Matrix::Identity(n, n);
  if (of.loops > 0) {
    const Matrix kernel = kernelOf(f0.block(f0.rows() - of.loops, 0, of.loops, n));
    tangents = orthogonalFactorOf(kernel, kernel.cols());
  }
  const auto along = [&](const Matrix& f) { return Matrix(-tangents.transpose() * f.topLeftCorner(n, n) * tangents); };
  stiffness = along(f0);
  damping = along(f1);
  mass = along(f2);
}

bool ReducedMotion::isSymmetric() const {
  return (stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * stiffness.cwiseAbs().maxCoeff();
}

void refuseMassless(const RestRows& rows) {
  throw UnfitPart(rows.names.front(), "not all joints move a mass, so that there are no modes",
                  "a mass that every joint moves");
}

double unitOf(std::span<const double> numbers) {
  double largest = 0;
  for (const double each : numbers) largest = std::max(largest, std::abs(each));
  return largest > 0 ? std::exp2(std::round(std::log2(largest))) : 1.0;
}

std::vector<double> stepped(std::vector<double> v, const Vector& step, double share) {
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += share * step[static_cast<Eigen::Index>(i)];
  return v;
}

}  // namespace gamut
