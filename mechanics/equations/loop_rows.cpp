// By unit accelerations, as the equations of motion are found.
#include "mechanics/equations/loop_rows.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>

namespace gamut {
namespace {

double leastSingularValue(const Eigen::MatrixXd& matrix) {
  return matrix.allFinite() ? matrix.jacobiSvd().singularValues().minCoeff() : 0.0;
}

}  // namespace

Eigen::MatrixXd jacobianOfLoops(System<double>& system) {
  const int n = system.degreesOfFreedom();
  Eigen::MatrixXd jacobian(static_cast<Eigen::Index>(system.residuals().size()), n);
  for (int j = 0; j < n; ++j) {
    std::vector<double> unit(static_cast<std::size_t>(n), 0.0);
    unit[static_cast<std::size_t>(j)] = 1;
    system.setAccelerations(unit);
    system.doMotion(MotionLevel::acceleration);
    Eigen::Index i = 0;
    for (const Constraint<double>* constraint : system.chain().constraints())
      for (const double row : constraint->accelerations(MotionLevel::acceleration)) jacobian(i++, j) = row;
  }
  return jacobian;
}

Eigen::MatrixXd inertiaAlongLoops(System<double>& system) {
  const Eigen::Index n = system.degreesOfFreedom(), m = static_cast<Eigen::Index>(system.dependents()), f = n - m;
  const Eigen::MatrixXd inertia = system.inertiaMatrix(), jacobian = jacobianOfLoops(system);
  Eigen::MatrixXd tangents = Eigen::MatrixXd::Identity(n, f);
  tangents.bottomRows(m) = -jacobian.rightCols(m).partialPivLu().solve(jacobian.leftCols(f));
  Eigen::MatrixXd felt = tangents.transpose() * inertia * tangents;
  const Eigen::MatrixXd terms = tangents.cwiseAbs().transpose() * inertia.cwiseAbs() * tangents.cwiseAbs();
  constexpr double rounding = 1e-13;
  for (Eigen::Index j = 0; j < f; ++j)
    if (felt(j, j) < rounding * terms(j, j)) {
      felt.row(j).setZero();
      felt.col(j).setZero();
    }
  return felt;
}

LoopGrip gripOfLoops(const Mechanism& mechanism, System<double>& system) {
  constexpr double nothing = 1e-7;  // of a row's greatest entry
  constexpr double least = 1e-6;    // of the greatest entry of all: of a row that may be taken for one of its own
  Eigen::MatrixXd jacobian = jacobianOfLoops(system);
  const Eigen::Index n = jacobian.cols(), m = jacobian.rows();
  if (!jacobian.allFinite()) return {0.0, {}};
  std::vector<const Mechanism::JointCoordinate*> coordinates;  // of speeds; null of those without
  const std::vector<std::string> states = mechanism.stateNames();
  for (Eigen::Index j = 0; j < n - m; ++j)
    coordinates.push_back(mechanism.coordinateWith(states[mechanism.positions() + static_cast<std::size_t>(j)]));
  for (const std::string& name : mechanism.dependents()) coordinates.push_back(mechanism.coordinateWith(name));

  const double all = jacobian.cwiseAbs().maxCoeff();
  if (!(all > 0)) return {0.0, {}};
  for (Eigen::Index i = 0; i < m; ++i) {
    const double own = jacobian.row(i).cwiseAbs().maxCoeff();
    jacobian.row(i) /= own > least * all ? own : all;
  }
  double ofAngles = 0, ofDisplacements = 0;
  const auto unitOf = [&](Eigen::Index j) -> double& {
    const Mechanism::JointCoordinate* of = coordinates[static_cast<std::size_t>(j)];
    return of != nullptr && of->kind != Coordinate::angle ? ofDisplacements : ofAngles;
  };
  for (Eigen::Index j = 0; j < n; ++j) unitOf(j) = std::max(unitOf(j), jacobian.col(j).norm());
  for (Eigen::Index j = 0; j < n; ++j)
    if (unitOf(j) > 0) jacobian.col(j) /= unitOf(j);

  Eigen::MatrixXd rest = jacobian, best(m, m);
  std::vector<char> isTaken(static_cast<std::size_t>(n), 0);
  for (Eigen::Index k = 0; k < m; ++k) {
    Eigen::Index pivot = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Mechanism::JointCoordinate* of = coordinates[static_cast<std::size_t>(j)];
      if (of == nullptr || mechanism.isStruck(of->name) || isTaken[static_cast<std::size_t>(j)] != 0) continue;
      if (pivot < 0 || rest.col(j).norm() > rest.col(pivot).norm()) pivot = j;
    }
    if (pivot < 0 || !(rest.col(pivot).norm() > nothing)) return {0.0, {}};
    isTaken[static_cast<std::size_t>(pivot)] = 1;
    best.col(k) = jacobian.col(pivot);
    const Eigen::VectorXd direction = rest.col(pivot).normalized();
    rest -= direction * (direction.transpose() * rest);
  }
  LoopGrip grip{leastSingularValue(jacobian.rightCols(m)) / leastSingularValue(best), {}};
  for (std::size_t j = 0; j < isTaken.size(); ++j)
    if (isTaken[j] != 0) grip.best.push_back(coordinates[j]->name);
  return grip;
}

}  // namespace gamut
