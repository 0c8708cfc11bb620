#include "scalars/algebra/decompositions.hpp"

#include <Eigen/Dense>

namespace gamut {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

std::optional<EigenPairs> eigenPairsOf(const Matrix& a) {
  const Eigen::EigenSolver<Matrix> solver(a);
  if (solver.info() != Eigen::Success) return {};
  return EigenPairs{solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvaluesOf(const Matrix& a) { return Eigen::EigenSolver<Matrix>(a, false).eigenvalues(); }

Matrix symmetricEigenvectorsOf(const Matrix& a) { return Eigen::SelfAdjointEigenSolver<Matrix>(a).eigenvectors(); }

PencilPairs pencilPairsOf(const Matrix& k, const Matrix& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(k, m);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Vector pencilValuesOf(const Matrix& k, const Matrix& m) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(k, m, Eigen::EigenvaluesOnly).eigenvalues();
}

Vector singularValuesOf(const Matrix& a) { return a.jacobiSvd().singularValues(); }

Matrix leftSingularVectorsOf(const Matrix& a) { return Eigen::JacobiSVD<Matrix>(a, Eigen::ComputeFullU).matrixU(); }

Matrix rightSingularVectorsOf(const Matrix& a) { return Eigen::JacobiSVD<Matrix>(a, Eigen::ComputeFullV).matrixV(); }

Matrix solved(const Matrix& a, const Matrix& right) { return a.partialPivLu().solve(right); }

double determinantOf(const Matrix& a) { return a.partialPivLu().determinant(); }

bool isInvertible(const Matrix& a) { return a.fullPivLu().isInvertible(); }

Matrix inverseOf(const Matrix& a) { return a.fullPivLu().inverse(); }

Matrix safelySolved(const Matrix& a, const Matrix& right) { return a.fullPivLu().solve(right); }

Matrix kernelOf(const Matrix& a) { return a.fullPivLu().kernel(); }

Eigen::VectorXi columnOrderOf(const Matrix& a) { return a.fullPivLu().permutationQ().indices(); }

Vector leastSquares(const Matrix& a, const Vector& b, double nothing) {
  Eigen::CompleteOrthogonalDecomposition<Matrix> decomposed;
  decomposed.setThreshold(nothing);
  decomposed.compute(a);
  return decomposed.solve(b);
}

Vector symmetricSolved(const Matrix& a, const Vector& b) { return a.ldlt().solve(b); }

Matrix orthogonalFactorOf(const Matrix& a, Eigen::Index columns) {
  return Eigen::HouseholderQR<Matrix>(a).householderQ() * Matrix::Identity(a.rows(), columns);
}

PivotedFactor pivotedFactorOf(const Matrix& a) {
  const Eigen::ColPivHouseholderQR<Matrix> qr(a);
  return {qr.householderQ(), qr.colsPermutation().indices()};
}

std::optional<Matrix> choleskyFactorOf(const Matrix& a) {
  const Eigen::LLT<Matrix> factor(a);
  if (factor.info() != Eigen::Success) return {};
  return Matrix(factor.matrixL());
}

Matrix lowerSolved(const Matrix& l, const Matrix& right) { return l.triangularView<Eigen::Lower>().solve(right); }

}  // namespace gamut
