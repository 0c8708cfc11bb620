// Eigen's decompositions of matrices of double, compiled once, in this library: whoever includes this instead of
// <Eigen/Dense> calls them as ever and need not compile them again.
#pragma once

#include <Eigen/Dense>

/// Members that are no templates, and those that are for plain matrices.
#define GAMUT_DECOMPOSITIONS(KEYWORD)                                                                     \
  KEYWORD template class Eigen::LLT<Eigen::MatrixXd>;                                                     \
  KEYWORD template class Eigen::FullPivLU<Eigen::MatrixXd>;                                               \
  KEYWORD template class Eigen::PartialPivLU<Eigen::MatrixXd>;                                            \
  KEYWORD template class Eigen::HouseholderQR<Eigen::MatrixXd>;                                           \
  KEYWORD template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;                                     \
  KEYWORD template class Eigen::JacobiSVD<Eigen::MatrixXd>;                                               \
  KEYWORD template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;                                  \
  KEYWORD template class Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>;                       \
  KEYWORD template class Eigen::EigenSolver<Eigen::MatrixXd>;                                             \
  KEYWORD template Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(                     \
      const Eigen::EigenBase<Eigen::MatrixXd>&);                                                          \
  KEYWORD template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&                                        \
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::EigenBase<Eigen::MatrixXd>&, int); \
  KEYWORD template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(     \
      const Eigen::EigenBase<Eigen::MatrixXd>&, bool);

GAMUT_DECOMPOSITIONS(extern)
