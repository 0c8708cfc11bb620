// Decompositions of matrices of double: Eigen's, compiled in this library alone, which takes seconds wherever it is
// done. Whoever calls these needs <Eigen/Core> only. Results are as good as doubles give them, and prove nothing.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace gamut {

/// A v = λ v, one column a pair.
struct EigenPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

/// Nothing where the iteration does not end.
std::optional<EigenPairs> eigenPairsOf(const Eigen::MatrixXd& a);
Eigen::VectorXcd eigenvaluesOf(const Eigen::MatrixXd& a);
/// Orthonormal, of a symmetric A, of which the lower triangle is read; by ascending eigenvalues.
Eigen::MatrixXd symmetricEigenvectorsOf(const Eigen::MatrixXd& a);

/// K v = λ M v of symmetric matrices, M positive definite; ascending, VᵀMV = 1.
struct PencilPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

PencilPairs pencilPairsOf(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);
Eigen::VectorXd pencilValuesOf(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

/// Descending.
Eigen::VectorXd singularValuesOf(const Eigen::MatrixXd& a);
/// All, square: of A = U Σ Vᵀ the matrices U and V.
Eigen::MatrixXd leftSingularVectorsOf(const Eigen::MatrixXd& a);
Eigen::MatrixXd rightSingularVectorsOf(const Eigen::MatrixXd& a);

/// By partial pivoting, of square matrices that are far from singular.
Eigen::MatrixXd solved(const Eigen::MatrixXd& a, const Eigen::MatrixXd& right);
double determinantOf(const Eigen::MatrixXd& a);

/// By full pivoting: P A Q = L U.
bool isInvertible(const Eigen::MatrixXd& a);
Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& a);
Eigen::MatrixXd safelySolved(const Eigen::MatrixXd& a, const Eigen::MatrixXd& right);
Eigen::MatrixXd kernelOf(const Eigen::MatrixXd& a);
/// Q: by how much its columns are to be solved for first.
Eigen::VectorXi columnOrderOf(const Eigen::MatrixXd& a);

/// The x of least length for which |A x − b| is least; what is below `nothing` of the greatest pivot is taken for zero.
Eigen::VectorXd leastSquares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b, double nothing);
/// Of a symmetric A that is positive definite but for roundings: A x = b.
Eigen::VectorXd symmetricSolved(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Q of A = Q R, its first columns.
Eigen::MatrixXd orthogonalFactorOf(const Eigen::MatrixXd& a, Eigen::Index columns);

/// A P = Q R with columns by descending length of what is left of them.
struct PivotedFactor {
  Eigen::MatrixXd q;      // square
  Eigen::VectorXi order;  // of columns
};

PivotedFactor pivotedFactorOf(const Eigen::MatrixXd& a);

/// L of A = L Lᵀ, lower; nothing unless A is positive definite.
std::optional<Eigen::MatrixXd> choleskyFactorOf(const Eigen::MatrixXd& a);
/// L X = B of a lower triangle.
Eigen::MatrixXd lowerSolved(const Eigen::MatrixXd& l, const Eigen::MatrixXd& right);

}  // namespace gamut
