// By unit accelerations, as the equations of motion are found.
#include "mechanics/equations/loop_rows.hpp"
#include "scalars/algebra/decompositions.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace gamut {
namespace {

double leastSingularValue(const Eigen::MatrixXd& matrix) {
  return matrix.allFinite() ? singularValuesOf(matrix).minCoeff() : 0.0;
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
  tangents.bottomRows(m) = -solved(jacobian.rightCols(m), jacobian.leftCols(f));
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

namespace {

/// J of the columns of coordinates, in units in which the greatest entry of each row is 1, and angles and displacements
/// move rows alike; empty where it is no numbers, or none but zeros.
struct ScaledRows {
  Eigen::MatrixXd jacobian;
  std::vector<const Mechanism::JointCoordinate*> coordinates;  // of speeds; null of those without
  Eigen::VectorXd units;                                       // by which columns were divided
};

ScaledRows scaledRows(const Mechanism& mechanism, System<double>& system) {
  constexpr double least = 1e-6;  // of the greatest entry of all: of a row that may be taken for one of its own
  ScaledRows rows{jacobianOfLoops(system), {}, {}};
  Eigen::MatrixXd& jacobian = rows.jacobian;
  const Eigen::Index n = jacobian.cols(), m = jacobian.rows();
  const auto dependents = static_cast<Eigen::Index>(mechanism.dependents().size());
  const double all = jacobian.allFinite() && m > 0 ? jacobian.cwiseAbs().maxCoeff() : 0.0;
  if (!(all > 0)) return {};
  const std::vector<std::string> states = mechanism.stateNames();
  for (Eigen::Index j = 0; j < n - dependents; ++j)
    rows.coordinates.push_back(mechanism.coordinateWith(states[mechanism.positions() + static_cast<std::size_t>(j)]));
  for (const std::string& name : mechanism.dependents()) rows.coordinates.push_back(mechanism.coordinateWith(name));
  for (Eigen::Index i = 0; i < m; ++i) {
    const double own = jacobian.row(i).cwiseAbs().maxCoeff();
    jacobian.row(i) /= own > least * all ? own : all;
  }
  double ofAngles = 0, ofDisplacements = 0;
  const auto unitOf = [&](Eigen::Index j) -> double& {
    const Mechanism::JointCoordinate* of = rows.coordinates[static_cast<std::size_t>(j)];
    return of != nullptr && of->kind != Coordinate::angle ? ofDisplacements : ofAngles;
  };
  for (Eigen::Index j = 0; j < n; ++j) unitOf(j) = std::max(unitOf(j), jacobian.col(j).norm());
  rows.units = Eigen::VectorXd::Ones(n);
  for (Eigen::Index j = 0; j < n; ++j)
    if (unitOf(j) > 0) jacobian.col(j) /= rows.units[j] = unitOf(j);
  return rows;
}

}  // namespace

std::vector<std::string> loopsAlike(const Mechanism& mechanism, System<double>& system) {
  constexpr double some = 0.1;  // of the greatest number
  const Eigen::MatrixXd jacobian = jacobianOfLoops(system);
  if (jacobian.rows() == 0 || !jacobian.allFinite()) return {};
  const Eigen::VectorXd numbers = leftSingularVectorsOf(jacobian).col(jacobian.rows() - 1).cwiseAbs();
  std::vector<std::string> names;
  Eigen::Index first = 0;
  for (const Mechanism::Closed& loop : mechanism.loops()) {
    const Eigen::Index count = std::min(static_cast<Eigen::Index>(loop.by.size()), jacobian.rows() - first);
    if (count > 0 && numbers.segment(first, count).maxCoeff() > some * numbers.maxCoeff())
      names.push_back(loop.element);
    first += count;
  }
  return names;
}

LoopGrip gripOfLoops(const Mechanism& mechanism, System<double>& system) {
  constexpr double nothing = 1e-7;  // of a row's greatest entry
  const auto [jacobian, coordinates, units] = scaledRows(mechanism, system);
  if (coordinates.empty()) return {0.0, {}, 0.0, {}};
  const Eigen::Index n = jacobian.cols(), m = jacobian.rows();
  Eigen::MatrixXd rest = jacobian, best(m, m);
  std::vector<char> isTaken(static_cast<std::size_t>(n), 0);
  for (Eigen::Index k = 0; k < m; ++k) {
    Eigen::Index pivot = -1;
    for (Eigen::Index j = 0; j < n; ++j) {
      const Mechanism::JointCoordinate* of = coordinates[static_cast<std::size_t>(j)];
      if (of == nullptr || mechanism.isStruck(of->name) || isTaken[static_cast<std::size_t>(j)] != 0) continue;
      if (pivot < 0 || rest.col(j).norm() > rest.col(pivot).norm()) pivot = j;
    }
    if (pivot < 0 || !(rest.col(pivot).norm() > nothing)) return {0.0, {}, 0.0, {}};
    isTaken[static_cast<std::size_t>(pivot)] = 1;
    best.col(k) = jacobian.col(pivot);
    const Eigen::VectorXd direction = rest.col(pivot).normalized();
    rest -= direction * (direction.transpose() * rest);
  }
  LoopGrip grip{leastSingularValue(jacobian.rightCols(m)) / leastSingularValue(best), {}, 0.0, {}};
  const Eigen::MatrixXd unscaled = jacobianOfLoops(system);
  const Eigen::VectorXd all = singularValuesOf(unscaled);
  grip.firmness = all.minCoeff() / all.maxCoeff();
  for (std::size_t j = 0; j < isTaken.size(); ++j)
    if (isTaken[j] != 0) grip.best.push_back(coordinates[j]->name);
  grip.determinant = determinantOf(unscaled.rightCols(m));
  constexpr double some = 0.1;  // of the most that one moves
  const Eigen::MatrixXd dependents = (unscaled * units.cwiseInverse().asDiagonal()).rightCols(m);
  const Eigen::VectorXd loose = rightSingularVectorsOf(dependents).col(m - 1).cwiseAbs();
  for (Eigen::Index i = 0; i < m; ++i)
    if (loose[i] > some * loose.maxCoeff()) grip.loose.push_back(mechanism.dependents()[static_cast<std::size_t>(i)]);
  return grip;
}

NearestClosing nearestClosing(System<double>& system, std::vector<double> at,
                              const std::function<void(const std::vector<double>&)>& place) {
  constexpr int most = 100;
  constexpr double first = 1e-3, farthest = 1e12, enough = 1e-14;  // of damping; of what a step gains
  const auto m = static_cast<Eigen::Index>(at.size());
  const auto rowsAt = [&](const std::vector<double>& positions) {
    place(positions);
    const std::vector<double> rows = system.residuals();
    return Eigen::VectorXd(Eigen::VectorXd::Map(rows.data(), static_cast<Eigen::Index>(rows.size())));
  };
  Eigen::VectorXd rows = rowsAt(at);
  double damping = first;
  for (int i = 0; i < most && damping < farthest && rows.squaredNorm() > 0; ++i) {
    const Eigen::MatrixXd jacobian = jacobianOfLoops(system).rightCols(m);
    if (!jacobian.allFinite() || !rows.allFinite()) break;
    const Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    const Eigen::VectorXd gradient = jacobian.transpose() * rows;
    bool isBetter = false;
    for (; !isBetter && damping < farthest; damping *= isBetter ? 0.1 : 10) {
      Eigen::MatrixXd damped = normal;
      damped.diagonal().array() += damping * std::max(normal.diagonal().maxCoeff(), 0x1p-1000);
      const Eigen::VectorXd step = symmetricSolved(damped, gradient);
      std::vector<double> next = at;
      for (Eigen::Index k = 0; k < m; ++k) next[static_cast<std::size_t>(k)] -= step[k];
      const Eigen::VectorXd rest = rowsAt(next);
      isBetter = rest.squaredNorm() < (1 - enough) * rows.squaredNorm();
      if (!isBetter) continue;
      at = std::move(next);
      rows = rest;
    }
    place(at);
  }
  return {std::move(at), {rows.begin(), rows.end()}};
}

/// By orthogonalisation: rows of constraints without redundant ones first, then whichever is farthest from the others.
RowChoice rowsToLeaveOut(const Mechanism& mechanism, System<double>& system,
                         const std::vector<std::size_t>& redundant) {
  constexpr double nothing = 1e-7;  // of a row's greatest entry
  Eigen::MatrixXd rest = scaledRows(mechanism, system).jacobian;
  std::vector<std::size_t> of, place, toKeep;  // of each row, its constraint and its number there; of each constraint
  std::size_t number = 0;
  for (const Constraint<double>* constraint : system.chain().constraints()) {
    const std::size_t rows = constraint->residuals().size();
    for (std::size_t i = 0; i < rows; ++i) {
      of.push_back(number);
      place.push_back(i);
    }
    toKeep.push_back(rows - redundant[number++]);
  }
  RowChoice choice{std::vector<std::vector<std::size_t>>(redundant.size()), std::vector<std::size_t>(redundant.size()),
                   static_cast<std::size_t>(rest.rows()) == of.size()};
  if (!choice.isEnough) return choice;
  std::vector<char> isKept(of.size(), 0);
  const auto keep = [&](std::size_t row) {
    isKept[row] = 1;
    --toKeep[of[row]];
    const double size = rest.row(static_cast<Eigen::Index>(row)).norm();
    if (!(size > nothing)) {
      choice.isEnough = false;
      return;
    }
    const Eigen::RowVectorXd direction = rest.row(static_cast<Eigen::Index>(row)) / size;
    rest -= (rest * direction.transpose()) * direction;
  };
  for (std::size_t row = 0; row < of.size(); ++row)
    if (redundant[of[row]] == 0) keep(row);
  for (;;) {
    std::optional<std::size_t> farthest;
    for (std::size_t row = 0; row < of.size(); ++row) {
      if (isKept[row] != 0 || toKeep[of[row]] == 0) continue;
      const auto size = [&](std::size_t i) { return rest.row(static_cast<Eigen::Index>(i)).norm(); };
      if (!farthest || size(row) > size(*farthest)) farthest = row;
    }
    if (!farthest) break;
    keep(*farthest);
  }
  for (std::size_t row = 0; row < of.size(); ++row) {
    if (isKept[row] != 0) continue;
    choice.leftOut[of[row]].push_back(place[row]);
    if (rest.row(static_cast<Eigen::Index>(row)).norm() > nothing) ++choice.others[of[row]];
  }
  return choice;
}

/// By elimination of the rows, loop by loop: what is open of later loops is what dependent coordinates of earlier ones
/// do not close.
DependentsOf firmDependents(const Mechanism& mechanism, System<double>& system, const std::set<std::string>& given) {
  constexpr double firm = 0.1, nothing = 1e-7;
  auto [rows, coordinates, units] = scaledRows(mechanism, system);
  std::map<std::string, std::size_t> order;  // as coordinates stand
  for (const Mechanism::JointCoordinate& coordinate : mechanism.coordinates())
    order.emplace(coordinate.name, order.size());
  const auto mayFollow = [&](const Mechanism::JointCoordinate* of) {
    return of != nullptr && !mechanism.isStruck(of->name) && !given.contains(of->name) && !given.contains(of->rate) &&
           mechanism.startsWithoutRate(*of);
  };
  std::vector<char> isTaken(coordinates.size(), 0);
  DependentsOf choice;
  Eigen::Index first = 0;
  for (const Mechanism::Closed& loop : mechanism.loops()) {
    const auto count = static_cast<Eigen::Index>(loop.by.size());
    std::vector<std::string> chosen;
    for (Eigen::Index k = 0; k < count && !coordinates.empty(); ++k) {
      auto open = rows.middleRows(first, count);
      std::vector<std::size_t> candidates;
      for (std::size_t j = 0; j < coordinates.size(); ++j)
        if (isTaken[j] == 0 &&
            (loop.isChosen
                 ? mayFollow(coordinates[j])
                 : std::ranges::find(loop.by, coordinates[j] == nullptr ? std::string() : coordinates[j]->name) !=
                       loop.by.end()))
          candidates.push_back(j);
      const auto firmness = [&](std::size_t j) { return open.col(static_cast<Eigen::Index>(j)).norm(); };
      double most = 0;
      for (const std::size_t j : candidates) most = std::max(most, firmness(j));
      std::erase_if(candidates, [&](std::size_t j) { return !(firmness(j) >= firm * most && firmness(j) > nothing); });
      if (candidates.empty()) return {};
      const std::size_t pivot =
          *std::ranges::max_element(candidates, {}, [&](std::size_t j) { return order.at(coordinates[j]->name); });
      isTaken[pivot] = 1;
      chosen.push_back(coordinates[pivot]->name);
      // Rotates the loop's rows so that the pivot moves one of them alone, and takes it out of those of later loops.
      const auto column = static_cast<Eigen::Index>(pivot);
      const Eigen::VectorXd direction = open.col(column).normalized();
      const Eigen::RowVectorXd row = direction.transpose() * open;
      open -= direction * row;
      for (Eigen::Index i = first + count; i < rows.rows(); ++i) rows.row(i) -= row * (rows(i, column) / row[column]);
    }
    if (static_cast<Eigen::Index>(chosen.size()) != count) return {};
    std::ranges::sort(chosen, {}, [&](const std::string& name) { return order.at(name); });
    if (loop.isChosen) choice.emplace(loop.element, std::move(chosen));
    first += count;
  }
  return choice;
}

}  // namespace gamut
