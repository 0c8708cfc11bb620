#include "mechanics/rest_position.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mechanics/description/refusal.hpp"
#include "mechanics/rest_algebra.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/algebra/linear_system.hpp"

namespace gamut {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

bool isFinite(const Vector& v) { return v.array().isFinite().all(); }

}  // namespace

std::vector<double> settled(const RestRows& of, std::vector<double> v, std::span<const double> parameters) {
  constexpr int most = 500;
  constexpr double mostTurn = 0.3, enough = 1e-13;  // rad a step; of a step, where Newton's own converge
  double resistance = -1;
  for (int i = 0; i < most; ++i) {
    const LinearRows<double> at = of.at<double>(v, parameters);
    const Matrix f0 = squareMatrix(at.byPosition, of.size);
    Matrix resisted = Matrix::Zero(of.size, of.size);
    resisted.topLeftCorner(of.coordinates, of.coordinates) =
        -squareMatrix(at.byAcceleration, of.size).topLeftCorner(of.coordinates, of.coordinates);
    for (int k = 0; k < of.ownStates; ++k) resisted(of.coordinates + k, of.coordinates + k) = 1;
    const ReducedMotion reduced(of, f0, f0, -resisted);
    if (resistance < 0) {
      const double mass = reduced.mass.cwiseAbs().maxCoeff();
      resistance = mass > 0 ? 10 * reduced.stiffness.cwiseAbs().maxCoeff() / mass : 0;
    }
    const auto descends = [&] {
      const Matrix sum = reduced.stiffness + resistance * reduced.mass;
      return of.ownStates > 0 || choleskyFactorOf(0.5 * (sum + sum.transpose()));
    };
    constexpr int mostRaised = 60;
    for (int k = 0; k < mostRaised && !descends(); ++k) resistance = std::max(4 * resistance, 1e-6);
    const Vector step =
        ScaledMatrix(resistance * resisted - f0).solve(Eigen::Map<const Vector>(at.rows.data(), of.size));
    if (!isFinite(step)) break;
    double turn = 0, relative = 0;
    for (int k = 0; k < of.coordinates + of.ownStates; ++k) {
      if (of.turns[k]) turn = std::max(turn, std::abs(step[k]));
      relative = std::max(relative, std::abs(step[k]) / (of.turns[k] ? 1.0 : std::max(std::abs(v[k]), 1e-3)));
    }
    v = stepped(std::move(v), step, turn > mostTurn ? mostTurn / turn : 1.0);
    if (relative < 1e-6) resistance *= 0.01;
    if (relative < enough && (resistance == 0 || i > most / 2)) break;
    resistance = turn > mostTurn ? 2 * resistance : resistance / 4;
    if (relative < 1e-4 && !descends()) break;  // an unstable one: as near as that
  }
  return rooted(of, std::move(v), parameters);
}

std::vector<double> rooted(const RestRows& of, std::vector<double> v, std::span<const double> parameters) {
  constexpr int most = 50;
  constexpr double enough = 1e-11;
  double size = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most && size > 1e-15; ++i) {
    const LinearRows<double> at = of.at<double>(v, parameters);
    const Vector step =
        ScaledMatrix(-squareMatrix(at.byPosition, of.size)).solve(Eigen::Map<const Vector>(at.rows.data(), of.size));
    double next = isFinite(step) ? 0 : std::numeric_limits<double>::infinity();
    for (int k = 0; k < of.coordinates + of.ownStates; ++k)
      next = std::max(next, std::abs(step[k]) / std::max(std::abs(v[k]), of.turns[k] ? 1.0 : 1e-3));
    if (size < enough && next >= size) break;
    if (!std::isfinite(next)) break;
    v = stepped(std::move(v), step);
    size = next;
  }
  if (!(size < enough))
    throw UnfitPart(of.names.front(), "no position of rest is found from where the mechanism stands at first",
                    "initial values nearer to one, and springs, loads or drives that hold all joints");
  return v;
}

std::vector<Recorded> rooted(const RestRows& of, std::vector<Recorded> v, std::span<const Recorded> parameters) {
  constexpr int steps = 4;
  for (int i = 0; of.dependsOnParameters && i < steps; ++i) {
    LinearRows<Recorded> at = of.at<Recorded>(v, parameters);
    LinearSystem<Recorded>(MatrixKind::general, of.size, std::move(at.byPosition)).solve(at.rows);
    for (int k = 0; k < of.size; ++k) v[k] = v[k] - at.rows[k];
  }
  return v;
}

void refuseLoose(const RestRows& of, const LinearRows<double>& at) {
  constexpr double none = 1e-11;
  const ScaledMatrix scaled(squareMatrix(at.byPosition, of.size));
  const Vector numbers = singularValuesOf(scaled.matrix);
  if (numbers[of.size - 1] > none * numbers[0]) return;
  const Vector loose = scaled.column.asDiagonal() * rightSingularVectorsOf(scaled.matrix).col(of.size - 1);
  Eigen::Index which = 0;
  loose.head(of.coordinates + of.ownStates).cwiseAbs().maxCoeff(&which);
  throw UnfitPart(
      of.names[which],
      fmt::format("nothing holds '{}' where it rests: neighbouring positions rest as well", of.names[which]),
      "a spring, a load or a drive that holds it");
}

}  // namespace gamut
