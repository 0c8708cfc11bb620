// In doubles from the initial position to the nominal rest and its modes, then by Newton's steps written down.
#include "mechanics/rest.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr int recordedSteps = 4;

[[noreturn]] void refuse(const std::string& part, const std::string& problem, const std::string& expected) {
  throw UnfitPart(part, problem, expected);
}

/// Throws where v does not say the position, or forces ask for more.
void checkFit(const Mechanism& mechanism) {
  const std::vector<std::string> names = mechanism.stateNames();
  for (std::size_t i = 0; i < mechanism.positions(); ++i)
    if (mechanism.coordinates().find(names[i]) == nullptr)
      refuse(
          names[i],
          fmt::format("where '{}' is at rest is not looked for: it is no angle or displacement of a joint", names[i]),
          "hinges and sliders in place of balls, free frames and what rolls");
  if (mechanism.isStruck())
    for (const Mechanism::JointCoordinate& joint : mechanism.coordinates())
      if (mechanism.isStruck(joint.name))
        refuse(joint.name, fmt::format("'{}' strikes a rigid end, where it may rest under any force", joint.name),
               "an elastic end (`joint-stop`)");
}

/// Those that rows need.
std::set<Op> inputsOf(const Program& program) {
  std::set<Op> inputs;
  for (int i = 0; i < static_cast<int>(program.nodes().size()); ++i)
    detail::forEachOperand(program.table(), i, [&](int operand) { inputs.insert(program.nodes()[operand].op); });
  return inputs;
}

/// R(v, v̇, v̈) of so many v. Throws where nothing comes to rest, or in too many positions.
Program recordRows(const Mechanism& mechanism, const std::vector<std::string>& freeParameters, int size) {
  const Program rows = record(
      3 * size, static_cast<int>(freeParameters.size()), size, [&](auto t, const auto& x, const auto& p, auto& y) {
        const std::span<const Recorded> all(x);
        Assembly<Recorded> assembly(mechanism, freeParameters, p);
        std::ranges::copy(assembly.rowsOfMotion(all.first(size), all.subspan(size, size), all.last(size), t),
                          y.begin());
      });
  const std::string first = mechanism.stateNames().front();
  if (inputsOf(rows).contains(Op::time))
    refuse(first, "forces or drives follow time, so that nothing comes to rest", "forces and drives without t");
  if (!jumpsOf(rows).empty())
    refuse(first, "something jumps, as dry friction does, which holds a mechanism in many positions", "smooth forces");
  return rows;
}

Matrix matrixOf(const std::vector<double>& entries, int size) {
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(entries.data(), size,
                                                                                                  size);
}

bool isFinite(const Vector& v) { return v.array().isFinite().all(); }

/// Free of units: each row by its greatest entry, then each column.
struct Scaled {
  Matrix matrix;
  Vector row, column;

  explicit Scaled(const Matrix& m) : matrix(m) {
    row = m.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double x) { return x > 0 ? 1 / x : 1.0; });
    matrix = row.asDiagonal() * matrix;
    column = matrix.cwiseAbs().colwise().maxCoeff().transpose().unaryExpr([](double x) { return x > 0 ? 1 / x : 1.0; });
    matrix = matrix * column.asDiagonal();
  }
  Vector solve(const Vector& right) const {
    return column.asDiagonal() * Vector(matrix.fullPivLu().solve(row.asDiagonal() * right));
  }
  Matrix inverse() const { return column.asDiagonal() * matrix.fullPivLu().inverse() * row.asDiagonal(); }
};

/// The mechanism's motion with what its loops hold taken out: a basis Z of the tangents, and Zᵀ(…)Z.
struct Reduced {
  Matrix tangents, stiffness, damping, mass;

  Reduced(const Matrix& f0, const Matrix& f1, const Matrix& f2, int n, int loops) {
    tangents = Matrix::Identity(n, n);
    if (loops > 0) {
      const Matrix kernel = f0.block(f0.rows() - loops, 0, loops, n).fullPivLu().kernel();
      tangents = Eigen::HouseholderQR<Matrix>(kernel).householderQ() * Matrix::Identity(n, kernel.cols());
    }
    const auto along = [&](const Matrix& f) {
      return Matrix(-tangents.transpose() * f.topLeftCorner(n, n) * tangents);
    };
    stiffness = along(f0);
    damping = along(f1);
    mass = along(f2);
  }
  bool isSymmetric() const {
    return (stiffness - stiffness.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * stiffness.cwiseAbs().maxCoeff();
  }
};

std::vector<double> plus(std::vector<double> v, const Vector& step, double share = 1) {
  for (std::size_t i = 0; i < v.size(); ++i) v[i] += share * step[static_cast<Eigen::Index>(i)];
  return v;
}

std::vector<Recorded> moved(std::vector<Recorded> v, std::span<const Recorded> by, const std::vector<double>& unit) {
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = v[i] + unit[i] * by[i];
  return v;
}

std::vector<Recorded> centreAt(const Program& centre, const std::vector<double>& unit,
                               std::span<const Recorded> parameters) {
  std::vector<Recorded> c = evaluate<Recorded>(centre, {}, {parameters.begin(), parameters.end()});
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = unit[i] * c[i];
  return c;
}

/// A power of 2 about as large as the largest of so many numbers.
double unitOf(std::span<const double> numbers) {
  double largest = 0;
  for (const double each : numbers) largest = std::max(largest, std::abs(each));
  return largest > 0 ? std::exp2(std::round(std::log2(largest))) : 1.0;
}

/// The eigenvalues m ∓ √d of Λ, 2 by 2 and row by row, where G Λ is symmetric and G, of which g11, g12, g22 are given,
/// positive definite: Λ21 = q Λ12 − 2 r h with h = (Λ11 − Λ22)/2, q = g11/g22, r = g12/g22, so that
///
///   d = h² + Λ12 Λ21 = (h − r Λ12)² + (q − r²) Λ12²,   a sum of squares.
std::array<Recorded, 2> pairOf(std::span<const Recorded> lambda, const std::array<Recorded, 3>& g) {
  const Recorded q = g[0] / g[2], r = g[1] / g[2], h = 0.5 * (lambda[0] - lambda[3]),
                 mean = 0.5 * (lambda[0] + lambda[3]);
  const Recorded apart = sqrt(sqr(h - r * lambda[1]) + (q - sqr(r)) * sqr(lambda[1]));
  return {mean - apart, mean + apart};
}

}  // namespace

RestEquations restEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  checkFit(mechanism);
  const int n = static_cast<int>(mechanism.positions()), loops = static_cast<int>(mechanism.dependents().size()),
            size = n + loops, unknowns = loops > 0 ? size + 1 : n;
  if (static_cast<int>(mechanism.stateNames().size()) > n + mechanism.degreesOfFreedom())
    refuse(mechanism.stateNames().front(), "all positions of rest are looked for where no element has states alone",
           "no element with a state");
  const Program rows = recordRows(mechanism, freeParameters, size), slopes = forwardDifferentiated(rows);
  const int parameters = rows.parameters();

  // Λ makes loads and multipliers alike where the mechanism stands at first.
  double unit = 1;
  const auto rowsAt = [&]<class S>(const std::vector<S>& q, std::span<const S> p, int multiplier) {
    std::vector<S> x(q.begin(), q.begin() + n);
    x.resize(3 * size, S(0.0));
    if (multiplier >= 0) x[n + multiplier] = S(1.0);
    return evaluate<S>(rows, x, {p.begin(), p.end()});
  };
  if (loops > 0) {
    std::vector<double> start = Assembly<double>(mechanism).initialState(), nominal;
    for (const std::string& name : freeParameters)
      nominal.push_back(midpoint(mechanism.rangeOf(Expression::named(name))));
    double load = 0, lever = 0;
    const std::vector<double> alone = rowsAt(start, std::span<const double>(nominal), -1);
    for (int j = 0; j < loops; ++j) {
      const std::vector<double> with = rowsAt(start, std::span<const double>(nominal), j);
      for (int i = 0; i < n; ++i) {
        load = std::max(load, std::abs(alone[i]));
        lever = std::max(lever, std::abs(with[i] - alone[i]));
      }
    }
    if (load > 0 && lever > 0 && std::isfinite(load / lever)) unit = std::exp2(std::round(std::log2(load / lever)));
  }

  RestEquations equations;
  equations.roots = record(unknowns, parameters, unknowns, [&](auto, const auto& x, const auto& p, auto& y) {
    const std::span<const Recorded> values(p);
    const std::vector<Recorded> q(x.begin(), x.begin() + n), alone = rowsAt(q, values, -1);
    std::ranges::copy(alone, y.begin());
    if (loops == 0) return;
    for (int i = 0; i < n; ++i) y[i] = x[n] * alone[i];
    Recorded length = sqr(x[n]);
    for (int j = 0; j < loops; ++j) {
      const std::vector<Recorded> with = rowsAt(q, values, j);
      for (int i = 0; i < n; ++i) y[i] = y[i] + unit * x[n + 1 + j] * (with[i] - alone[i]);
      length = length + sqr(x[n + 1 + j]);
    }
    y[size] = length - Recorded(1.0);
  });
  equations.stiffness = record(unknowns, parameters, size * size, [&](auto, const auto& x, const auto& p, auto& y) {
    std::vector<Recorded> v(x.begin(), x.begin() + n);
    for (int j = 0; j < loops; ++j) v.push_back(unit * x[n + 1 + j] / x[n]);
    v.resize(3 * size, Recorded(0.0));
    const std::vector<Recorded> all = evaluate<Recorded>(slopes, v, {p.begin(), p.end()});
    const auto slope = [&](int i, int j) { return all[size + i * 3 * size + j]; };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) y[i * size + j] = -slope(i, j);
    for (int k = n; k < size; ++k)
      for (int j = 0; j < size; ++j) y[k * size + j] = y[j * size + k] = j < n ? slope(k, j) : Recorded(0.0);
  });
  if (loops > 0) {
    equations.multipliers.assign(loops + 1, Interval(-2.0, 2.0));  // with room around those that no load bears on
    equations.multipliers.front() = Interval(0.0, 2.0);
  }
  return equations;
}

std::optional<int> negativeEigenvalues(const std::vector<Interval>& k, int n) {
  Matrix middle(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (isEmpty(intersection(k[i * n + j], k[j * n + i])) || !isBounded(k[i * n + j])) return {};  // no potential
      middle(i, j) = midpoint(k[i * n + j]);
    }
  Vector scale = middle.diagonal().cwiseAbs().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 0.0; });
  for (int j = 0; j < n; ++j)
    if (scale[j] == 0) {
      const double most = (middle.col(j).cwiseAbs().array() * scale.array()).maxCoeff();
      scale[j] = most > 0 ? 1 / most : 1.0;
    }
  const Matrix scaled = scale.asDiagonal() * Matrix(0.5 * (middle + middle.transpose())) * scale.asDiagonal();
  const Matrix t = scale.asDiagonal() * Eigen::SelfAdjointEigenSolver<Matrix>(scaled).eigenvectors();
  int negatives = 0;
  for (int a = 0; a < n; ++a) {
    Interval disc(0.0);
    for (int b = 0; b < n; ++b) {
      Interval sum(0.0);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          sum += Interval(t(i, a)) * intersection(k[i * n + j], k[j * n + i]) * Interval(t(j, b));
      disc += a == b ? sum : Interval(-1.0, 1.0) * sum;
    }
    if (contains(disc, 0.0)) return {};
    negatives += disc.upper() < 0 ? 1 : 0;
  }
  return negatives;
}

template <class S>
Rest::Linear<S> Rest::linearAt(const std::vector<S>& v, std::span<const S> parameters) const {
  std::vector<S> x(3 * v.size(), S(0.0));
  std::ranges::copy(v, x.begin());
  const std::vector<S> all = evaluate<S>(linear_, x, std::vector<S>(parameters.begin(), parameters.end()), S(0.0));
  Linear<S> at{size_, {all.begin(), all.begin() + size_}, {}, {}, {}};
  for (int i = 0; i < size_; ++i)
    for (int j = 0; j < 3 * size_; ++j)
      (j < size_       ? at.byPosition
       : j < 2 * size_ ? at.byRate
                       : at.byAcceleration)
          .push_back(all[size_ + i * 3 * size_ + j]);
  return at;
}

Rest::Rest(const Mechanism& mechanism, const std::vector<std::string>& freeParameters, const Box& parameters,
           const std::set<int>& modes, const Approximation& approximated) {
  checkFit(mechanism);
  const std::vector<std::string> states = mechanism.stateNames();
  coordinates_ = static_cast<int>(mechanism.positions());
  speeds_ = mechanism.degreesOfFreedom();
  ownStates_ = static_cast<int>(states.size()) - coordinates_ - speeds_;
  parameters_ = static_cast<int>(freeParameters.size());
  size_ = coordinates_ + ownStates_ + static_cast<int>(mechanism.dependents().size());
  const Assembly<double> start(mechanism);
  for (int i = 0; i < static_cast<int>(states.size()); ++i) {
    if (i >= coordinates_ && i < coordinates_ + speeds_) continue;
    names_.push_back(states[i]);
    const Mechanism::JointCoordinate* coordinate = mechanism.coordinates().find(states[i]);
    turns_.push_back(coordinate != nullptr && coordinate->kind == Coordinate::angle);
    nominal_.push_back(start.initialState()[i]);
  }
  nominal_.resize(size_, 0.0);
  const Program motion = recordRows(mechanism, freeParameters, size_);
  dependsOnParameters_ = inputsOf(motion).contains(Op::parameter);
  linear_ = forwardDifferentiated(motion);

  std::vector<double> values;
  for (const Interval& each : parameters) values.push_back(midpoint(each));
  nominal_ = settled(nominal_, values);
  const Linear<double> at = linearAt<double>(nominal_, values);
  refuseLoose(at);
  const std::span<const double> nominal(nominal_);
  unit_.assign(size_, 1.0);  // rad, m
  std::fill(unit_.begin() + coordinates_ + ownStates_, unit_.end(), unitOf(nominal.subspan(coordinates_ + ownStates_)));
  for (int k = coordinates_; k < coordinates_ + ownStates_; ++k) unit_[k] = unitOf(nominal.subspan(k, 1));
  const auto takeFamily = [&](int n, int extra, const std::vector<double>& unit,
                              const std::vector<double>& slopesAtNominal, auto centre, auto equations) {
    const auto written = [&](int open, int given, auto what) {
      return record(open, given, n, [&](auto, const auto& delta, const auto& p, auto& y) {
        std::ranges::copy(what(std::span<const Recorded>(delta), std::span<const Recorded>(p)), y.begin());
      });
    };
    const Program steps = written(0, parameters_, [&](auto, auto p) {
      std::vector<Recorded> c = centre(p);
      for (int i = 0; i < n; ++i) c[i] = c[i] / unit[i];
      return c;
    });
    centres_.push_back(dependsOnParameters_ ? approximated(steps) : steps);
    const Matrix inverse =
        Scaled(matrixOf(slopesAtNominal, n) * Eigen::Map<const Vector>(unit.data(), n).asDiagonal()).inverse();
    const auto nearUnity = [&](const std::vector<Recorded>& columns) {
      std::vector<Recorded> product;
      const int many = static_cast<int>(columns.size()) / n;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < many; ++j) {
          Recorded sum(0.0);
          for (int k = 0; k < n; ++k) sum = sum + inverse(i, k) * columns[k * many + j];
          product.push_back(sum);
        }
      return product;
    };
    // φ = δ − (N J(c) U)⁻¹ N g(c + U δ), U their units, N near to (J U)⁻¹
    families_.push_back(written(n, parameters_ + extra, [&](auto delta, auto p) {
      const std::vector<Recorded> c = centreAt(centres_.back(), unit, p.first(parameters_));
      auto [slopes, rows] = equations(c, moved(c, delta, unit), p);
      for (int i = 0; i < n * n; ++i) slopes[i] = unit[i % n] * slopes[i];
      std::vector<Recorded> image = nearUnity(rows);
      LinearSystem<Recorded>(MatrixKind::general, n, nearUnity(slopes)).solve(image);
      for (int i = 0; i < n; ++i) image[i] = delta[i] - image[i];
      return image;
    }));
  };
  using Equations = std::pair<std::vector<Recorded>, std::vector<Recorded>>;  // slopes at the centre, rows beside it
  takeFamily(
      size_, 0, unit_, at.byPosition,
      [&](auto p) {
        return rooted({nominal_.begin(), nominal_.end()}, p);
      },
      [&](const auto& c, const auto& v, auto p) {
        return Equations(linearAt<Recorded>(c, p).byPosition, linearAt<Recorded>(v, p).rows);
      });
  record(0, parameters_, 1, [&](auto, const auto&, const auto& p, auto&) {
    const Linear<Recorded> of = linearAt<Recorded>(positionAt(p), p);
    for (int i = 0; i < coordinates_; ++i)
      for (int j = 0; j < coordinates_; ++j) isDamped_ = isDamped_ || !isKnownZero(of.byRate[i * size_ + j]);
  });
  isDamped_ = isDamped_ || ownStates_ > 0 || !hasPotential(parameters);
  if (modes.empty()) return;
  eigenvalues_ = eigenvaluesOf(at);
  takeModes(parameters, modes);
  for (const Block& block : blocks_)
    takeFamily(
        static_cast<int>(block.nominal.size()), size_, block.unit, slopesOf<double>(block, at, block.nominal),
        [&](auto p) {
          return rooted(block, {block.nominal.begin(), block.nominal.end()}, linearAt<Recorded>(positionAt(p), p));
        },
        [&](const auto& c, const auto& w, auto p) {
          const auto own = p.first(parameters_);
          const Linear<Recorded> of = linearAt<Recorded>(moved(positionAt(own), p.last(size_), unit_), own);
          return Equations(slopesOf<Recorded>(block, of, c), rowsOf<Recorded>(block, of, w));
        });
}

/// At many values of the parameters, which no force of another kind passes unless it is zero at all of them: pairs of
/// frequencies rely on it.
bool Rest::hasPotential(const Box& parameters) const {
  constexpr int points = 16;
  for (int k = 0; k < points; ++k) {
    std::vector<double> values;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      const double turns = std::sqrt(static_cast<double>(i) + 2.0) * k + 0.5;  // the middle first
      values.push_back(parameters[i].lower() +
                       (turns - std::floor(turns)) * (parameters[i].upper() - parameters[i].lower()));
    }
    const Linear<double> at = linearAt<double>(nominal_, values);
    if (!Reduced(matrixOf(at.byPosition, size_), matrixOf(at.byRate, size_), matrixOf(at.byAcceleration, size_),
                 coordinates_, size_ - coordinates_ - ownStates_)
             .isSymmetric())
      return false;
  }
  return true;
}

int Rest::remainders() const {
  int sum = 0;
  for (const Program& family : families_) sum += family.states();
  return sum;
}

/// Against a resistance that is like the inertia and fades: down the potential, if there is one, so that what is found
/// is stable where that is near.
std::vector<double> Rest::settled(std::vector<double> v, std::span<const double> parameters) const {
  constexpr int most = 500;
  constexpr double mostTurn = 0.3, enough = 1e-13;  // rad a step; of a step, where Newton's own converge
  const int loops = size_ - coordinates_ - ownStates_;
  double resistance = -1;
  for (int i = 0; i < most; ++i) {
    const Linear<double> at = linearAt<double>(v, parameters);
    const Matrix f0 = matrixOf(at.byPosition, size_);
    Matrix resisted = Matrix::Zero(size_, size_);
    resisted.topLeftCorner(coordinates_, coordinates_) =
        -matrixOf(at.byAcceleration, size_).topLeftCorner(coordinates_, coordinates_);
    for (int k = 0; k < ownStates_; ++k) resisted(coordinates_ + k, coordinates_ + k) = 1;
    const Reduced of(f0, f0, -resisted, coordinates_, loops);
    if (resistance < 0) {
      const double mass = of.mass.cwiseAbs().maxCoeff();
      resistance = mass > 0 ? 10 * of.stiffness.cwiseAbs().maxCoeff() / mass : 0;
    }
    const auto descends = [&] {
      const Matrix sum = of.stiffness + resistance * of.mass;
      return ownStates_ > 0 || Matrix(0.5 * (sum + sum.transpose())).llt().info() == Eigen::Success;
    };
    constexpr int mostRaised = 60;
    for (int k = 0; k < mostRaised && !descends(); ++k) resistance = std::max(4 * resistance, 1e-6);
    const Vector rows = Eigen::Map<const Vector>(at.rows.data(), size_);
    const Vector step = Scaled(resistance * resisted - f0).solve(rows);
    if (!isFinite(step)) break;
    double turn = 0, relative = 0;
    for (int k = 0; k < coordinates_ + ownStates_; ++k) {
      if (turns_[k]) turn = std::max(turn, std::abs(step[k]));
      relative = std::max(relative, std::abs(step[k]) / (turns_[k] ? 1.0 : std::max(std::abs(v[k]), 1e-3)));
    }
    v = plus(std::move(v), step, turn > mostTurn ? mostTurn / turn : 1.0);
    if (relative < 1e-6) resistance *= 0.01;
    if (relative < enough && (resistance == 0 || i > most / 2)) break;
    resistance = turn > mostTurn ? 2 * resistance : resistance / 4;
    if (relative < 1e-4 && !descends()) break;  // an unstable one: as near as that
  }
  return rooted(std::move(v), parameters);
}

/// Newton's steps.
std::vector<double> Rest::rooted(std::vector<double> v, std::span<const double> parameters) const {
  constexpr int most = 50;
  constexpr double enough = 1e-11;
  double size = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most && size > 1e-15; ++i) {
    const Linear<double> at = linearAt<double>(v, parameters);
    const Vector step = Scaled(-matrixOf(at.byPosition, size_)).solve(Eigen::Map<const Vector>(at.rows.data(), size_));
    double next = isFinite(step) ? 0 : std::numeric_limits<double>::infinity();
    for (int k = 0; k < coordinates_ + ownStates_; ++k)
      next = std::max(next, std::abs(step[k]) / std::max(std::abs(v[k]), turns_[k] ? 1.0 : 1e-3));
    if (size < enough && next >= size) break;
    if (!std::isfinite(next)) break;
    v = plus(std::move(v), step);
    size = next;
  }
  if (!(size < enough))
    refuse(names_.front(), "no position of rest is found from where the mechanism stands at first",
           "initial values nearer to one, and springs, loads or drives that hold all joints");
  return v;
}

/// Throws where the position of rest is one of many.
void Rest::refuseLoose(const Linear<double>& at) const {
  constexpr double none = 1e-11;
  const Scaled scaled(matrixOf(at.byPosition, size_));
  const Eigen::JacobiSVD<Matrix> svd(scaled.matrix, Eigen::ComputeFullV);
  if (svd.singularValues()[size_ - 1] > none * svd.singularValues()[0]) return;
  const Vector loose = scaled.column.asDiagonal() * svd.matrixV().col(size_ - 1);
  Eigen::Index which = 0;
  loose.head(coordinates_ + ownStates_).cwiseAbs().maxCoeff(&which);
  refuse(names_[which],
         fmt::format("nothing holds '{}' where it rests: neighbouring positions rest as well", names_[which]),
         "a spring, a load or a drive that holds it");
}

std::vector<std::complex<double>> Rest::eigenvaluesOf(const Linear<double>& at) const {
  const Matrix f0 = matrixOf(at.byPosition, size_), f1 = matrixOf(at.byRate, size_);
  const Reduced of(f0, f1, matrixOf(at.byAcceleration, size_), coordinates_, size_ - coordinates_ - ownStates_);
  const int f = static_cast<int>(of.mass.rows()), n = coordinates_, z = ownStates_;
  const auto mass = of.mass.fullPivLu();
  if (!mass.isInvertible())
    refuse(names_.front(), "not all joints move a mass, so that there are no modes", "a mass that every joint moves");
  Matrix a = Matrix::Zero(2 * f + z, 2 * f + z);
  a.block(0, f, f, f).setIdentity();
  a.block(f, 0, f, f) = -mass.solve(of.stiffness);
  a.block(f, f, f, f) = -mass.solve(of.damping);
  if (z > 0) {
    a.block(f, 2 * f, f, z) = mass.solve(of.tangents.transpose() * f0.block(0, n, n, z));
    a.block(2 * f, 0, z, f) = f0.block(n, 0, z, n) * of.tangents;
    a.block(2 * f, f, z, f) = f1.block(n, 0, z, n) * of.tangents;
    a.block(2 * f, 2 * f, z, z) = f0.block(n, n, z, z);
  }
  std::vector<std::complex<double>> all;
  if (isDamped_) {
    const Eigen::VectorXcd values = Eigen::EigenSolver<Matrix>(a, false).eigenvalues();
    all.assign(values.begin(), values.end());
  } else {
    const Matrix k = 0.5 * (of.stiffness + of.stiffness.transpose()), m = 0.5 * (of.mass + of.mass.transpose());
    const Vector squares = Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(k, m, Eigen::EigenvaluesOnly).eigenvalues();
    for (const double square : squares) {
      const double size = std::sqrt(std::abs(square));
      for (const double sign : {1.0, -1.0})
        all.push_back(square > 0 ? std::complex(0.0, sign * size) : std::complex(sign * size, 0.0));
    }
  }
  std::ranges::stable_sort(all, {}, [](const std::complex<double>& s) { return std::abs(s); });
  return all;
}

namespace {

/// One of each pair.
std::vector<std::complex<double>> modesAmong(const std::vector<std::complex<double>>& eigenvalues) {
  std::vector<std::complex<double>> modes;
  for (const std::complex<double>& s : eigenvalues)
    if (s.imag() > 1e-9 * std::abs(s)) modes.push_back(s);
  return modes;
}

}  // namespace

/// Frequencies that come together where one parameter after the other leaves its nominal value are found together.
std::vector<std::vector<int>> Rest::blocksOf(const Box& parameters, const std::set<int>& wanted) const {
  std::vector<double> values, distance, change;
  for (const Interval& each : parameters) values.push_back(midpoint(each));
  const auto distances = [&](const std::vector<std::complex<double>>& modes) {
    std::vector<double> result;
    for (std::size_t i = 0; i + 1 < modes.size(); ++i) result.push_back(std::abs(modes[i + 1]) - std::abs(modes[i]));
    return result;
  };
  distance = distances(modes_);
  change.assign(distance.size(), 0.0);
  for (std::size_t i = 0; i < distance.size(); ++i) change[i] = 1e-6 * std::abs(modes_[i]);
  for (std::size_t k = 0; k < values.size() && !isDamped_; ++k) {
    std::vector<double> most(distance.size(), 0.0);
    for (const double end : {parameters[k].lower(), parameters[k].upper()}) {
      std::vector<double> there = values;
      there[k] = end;
      const std::vector<double> now =
          distances(modesAmong(eigenvaluesOf(linearAt<double>(rooted(nominal_, there), there))));
      for (std::size_t i = 0; i < std::min(now.size(), distance.size()); ++i)
        most[i] = std::max(most[i], distance[i] - now[i]);
    }
    for (std::size_t i = 0; i < distance.size(); ++i) change[i] += most[i];
  }
  std::vector<std::vector<int>> blocks;
  for (int mode = 0; mode < static_cast<int>(modes_.size()); ++mode) {
    const bool joins = mode > 0 && !(change[mode - 1] < 0.8 * distance[mode - 1]);
    if (!joins) blocks.emplace_back();
    blocks.back().push_back(mode);
  }
  std::erase_if(blocks, [&](const std::vector<int>& block) {
    return std::ranges::none_of(block, [&](int mode) { return wanted.contains(mode + 1); });
  });
  return blocks;
}

void Rest::takeModes(const Box& parameters, const std::set<int>& wanted) {
  modes_ = modesAmong(eigenvalues_);
  std::vector<double> values;
  for (const Interval& each : parameters) values.push_back(midpoint(each));
  const Linear<double> at = linearAt<double>(nominal_, values);
  for (const std::vector<int>& block : blocksOf(parameters, wanted)) {
    if (block.size() > (isDamped_ ? 1 : 2))
      refuse(
          names_.front(),
          fmt::format("the frequencies {} to {} may meet, and are not told apart", block.front() + 1, block.back() + 1),
          isDamped_ ? "narrower intervals, or less symmetry" : "narrower intervals, or two of them at most");
    Block& taken = blocks_.emplace_back(isDamped_ ? dampedBlock(at, block.front()) : undampedBlock(at, block));
    refine(taken, at);
    const std::span<const double> w(taken.nominal);
    const std::size_t last = taken.isDamped ? 2 : block.size() * block.size(), shapes = w.size() - last;
    taken.unit.assign(shapes, unitOf(w.first(shapes)));
    taken.unit.resize(w.size(), unitOf(w.last(last)));
  }
}

Rest::Block Rest::undampedBlock(const Linear<double>& at, std::vector<int> modes) const {
  const Matrix f0 = matrixOf(at.byPosition, size_), f2 = matrixOf(at.byAcceleration, size_);
  const int n = coordinates_, loops = size_ - n;
  const Reduced of(f0, f2, f2, n, loops);
  const Matrix k = 0.5 * (of.stiffness + of.stiffness.transpose()), m = 0.5 * (of.mass + of.mass.transpose());
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(k, m);
  const int b = static_cast<int>(modes.size()),
            unstable = static_cast<int>((solver.eigenvalues().array() <= 0).count());
  Block block{modes, false, {}, {}, {}};
  Matrix duals = Matrix::Zero(b, size_), squares = Matrix::Zero(b, b);
  for (int j = 0; j < b; ++j) {
    const int which = unstable + modes[j];  // the least are not oscillations
    Vector shape = Vector::Zero(size_);
    shape.head(n) = of.tangents * solver.eigenvectors().col(which);
    squares(j, j) = solver.eigenvalues()[which];
    if (loops > 0)
      shape.tail(loops) =
          f0.block(0, n, n, loops)
              .fullPivHouseholderQr()
              .solve(squares(j, j) * f2.topLeftCorner(n, n) * shape.head(n) - f0.topLeftCorner(n, n) * shape.head(n));
    duals.row(j).head(n) = -(f2.topLeftCorner(n, n) * shape.head(n)).transpose();
    block.nominal.insert(block.nominal.end(), shape.begin(), shape.end());
  }
  for (int i = 0; i < b; ++i)
    for (int j = 0; j < b; ++j) block.nominal.push_back(squares(i, j));
  for (int i = 0; i < b; ++i)
    for (int j = 0; j < size_; ++j) block.dual.push_back(duals(i, j));
  return block;
}

Rest::Block Rest::dampedBlock(const Linear<double>& at, int mode) const {
  const std::complex<double> s = modes_[mode];
  const Eigen::MatrixXcd pencil = matrixOf(at.byPosition, size_).cast<std::complex<double>>() +
                                  s * matrixOf(at.byRate, size_) + s * s * matrixOf(at.byAcceleration, size_);
  const Vector row = pencil.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double x) { return x > 0 ? 1 / x : 1.0; });
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(row.asDiagonal() * pencil, Eigen::ComputeFullV);
  const Eigen::VectorXcd shape = svd.matrixV().col(size_ - 1);
  const int told = coordinates_ + ownStates_;
  const double length = shape.head(told).squaredNorm();
  Block block{{mode}, true, {}, {}, {}};
  for (int i = 0; i < size_; ++i) block.nominal.push_back(shape[i].real());
  for (int i = 0; i < size_; ++i) block.nominal.push_back(shape[i].imag());
  block.nominal.push_back(s.real());
  block.nominal.push_back(s.imag());
  for (int i = 0; i < size_; ++i) block.dual.push_back(i < told ? shape[i].real() / length : 0.0);
  for (int i = 0; i < size_; ++i) block.dual.push_back(i < told ? -shape[i].imag() / length : 0.0);
  return block;
}

/// Newton's steps in doubles.
void Rest::refine(Block& block, const Linear<double>& at) const {
  constexpr int steps = 4;
  for (int i = 0; i < steps; ++i) {
    const std::vector<double> rows = rowsOf<double>(block, at, block.nominal);
    const int size = static_cast<int>(rows.size());
    const Vector step = Scaled(matrixOf(slopesOf<double>(block, at, block.nominal), size))
                            .solve(Eigen::Map<const Vector>(rows.data(), size));
    if (!isFinite(step)) return;
    block.nominal = plus(std::move(block.nominal), step, -1);
  }
}

/// F_0 X − F_2 X Λ and C X − 1; or, damped, (F_0 + s F_1 + s² F_2) φ and cᵀφ − 1, real and imaginary parts.
template <class S>
std::vector<S> Rest::rowsOf(const Block& block, const Linear<S>& at, std::span<const S> w) {
  const int n = at.size;
  const auto times = [&](const std::vector<S>& m, int column) {
    std::vector<S> result;
    for (int i = 0; i < n; ++i) {
      S sum(0.0);
      for (int j = 0; j < n; ++j) sum = sum + m[i * n + j] * w[column * n + j];
      result.push_back(std::move(sum));
    }
    return result;
  };
  const auto dual = [&](int row, int column) {
    S sum(0.0);
    for (int j = 0; j < n; ++j) sum = sum + S(block.dual[row * n + j]) * w[column * n + j];
    return sum;
  };
  std::vector<S> rows;
  if (!block.isDamped) {
    const int b = static_cast<int>(block.modes.size());
    std::vector<std::vector<S>> resisted;
    for (int l = 0; l < b; ++l) resisted.push_back(times(at.byAcceleration, l));
    for (int j = 0; j < b; ++j) {
      const std::vector<S> held = times(at.byPosition, j);
      for (int i = 0; i < n; ++i) {
        S row = held[i];
        for (int l = 0; l < b; ++l) row = row - resisted[l][i] * w[b * n + l * b + j];
        rows.push_back(std::move(row));
      }
    }
    for (int l = 0; l < b; ++l)
      for (int j = 0; j < b; ++j) rows.push_back(dual(l, j) - S(l == j ? 1.0 : 0.0));
    return rows;
  }
  const S &re = w[2 * n], &im = w[2 * n + 1], reSquare = re * re - im * im, imSquare = S(2.0) * re * im;
  std::vector<S> lower;
  const std::vector<S> f0r = times(at.byPosition, 0), f0i = times(at.byPosition, 1), f1r = times(at.byRate, 0),
                       f1i = times(at.byRate, 1), f2r = times(at.byAcceleration, 0), f2i = times(at.byAcceleration, 1);
  for (int i = 0; i < n; ++i) {
    rows.push_back(f0r[i] + re * f1r[i] - im * f1i[i] + reSquare * f2r[i] - imSquare * f2i[i]);
    lower.push_back(f0i[i] + re * f1i[i] + im * f1r[i] + reSquare * f2i[i] + imSquare * f2r[i]);
  }
  rows.insert(rows.end(), lower.begin(), lower.end());
  rows.push_back(dual(0, 0) - dual(1, 1) - S(1.0));
  rows.push_back(dual(0, 1) + dual(1, 0));
  return rows;
}

/// Of these rows the derivatives by w, row by row.
template <class S>
std::vector<S> Rest::slopesOf(const Block& block, const Linear<S>& at, std::span<const S> w) {
  const int n = at.size, size = static_cast<int>(w.size());
  std::vector<S> slopes(static_cast<std::size_t>(size) * size, S(0.0));
  const auto entry = [&](int i, int j) -> S& { return slopes[i * size + j]; };
  const auto times = [&](const std::vector<S>& m, int row, int column) {
    S sum(0.0);
    for (int j = 0; j < n; ++j) sum = sum + m[row * n + j] * w[column * n + j];
    return sum;
  };
  if (!block.isDamped) {
    const int b = static_cast<int>(block.modes.size());
    for (int j = 0; j < b; ++j)
      for (int i = 0; i < n; ++i)
        for (int l = 0; l < b; ++l) {
          for (int k = 0; k < n; ++k)
            entry(j * n + i, l * n + k) =
                (l == j ? at.byPosition[i * n + k] : S(0.0)) - at.byAcceleration[i * n + k] * w[b * n + l * b + j];
          entry(j * n + i, b * n + l * b + j) = -times(at.byAcceleration, i, l);
        }
    for (int l = 0; l < b; ++l)
      for (int j = 0; j < b; ++j)
        for (int k = 0; k < n; ++k) entry(b * n + l * b + j, j * n + k) = S(block.dual[l * n + k]);
    return slopes;
  }
  const S &re = w[2 * n], &im = w[2 * n + 1], reSquare = re * re - im * im, imSquare = S(2.0) * re * im,
          twoRe = S(2.0) * re, twoIm = S(2.0) * im;
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < n; ++k) {
      const int ik = i * n + k;
      const S real = at.byPosition[ik] + re * at.byRate[ik] + reSquare * at.byAcceleration[ik],
              imaginary = im * at.byRate[ik] + imSquare * at.byAcceleration[ik];
      entry(i, k) = entry(n + i, n + k) = real;
      entry(n + i, k) = imaginary;
      entry(i, n + k) = -imaginary;
    }
    // (F_1 + 2 s F_2) φ
    const S real = times(at.byRate, i, 0) + twoRe * times(at.byAcceleration, i, 0) -
                   twoIm * times(at.byAcceleration, i, 1),
            imaginary = times(at.byRate, i, 1) + twoRe * times(at.byAcceleration, i, 1) +
                        twoIm * times(at.byAcceleration, i, 0);
    entry(i, 2 * n) = entry(n + i, 2 * n + 1) = real;
    entry(n + i, 2 * n) = imaginary;
    entry(i, 2 * n + 1) = -imaginary;
  }
  for (int k = 0; k < n; ++k) {
    const S re0(block.dual[k]), im0(block.dual[n + k]);
    entry(2 * n, k) = entry(2 * n + 1, n + k) = re0;
    entry(2 * n, n + k) = -im0;
    entry(2 * n + 1, k) = im0;
  }
  return slopes;
}

std::vector<Recorded> Rest::rooted(std::vector<Recorded> v, std::span<const Recorded> parameters) const {
  for (int i = 0; dependsOnParameters_ && i < recordedSteps; ++i) {
    Linear<Recorded> at = linearAt<Recorded>(v, parameters);
    LinearSystem<Recorded>(MatrixKind::general, size_, std::move(at.byPosition)).solve(at.rows);
    for (int k = 0; k < size_; ++k) v[k] = v[k] - at.rows[k];
  }
  return v;
}

std::vector<Recorded> Rest::rooted(const Block& block, std::vector<Recorded> w, const Linear<Recorded>& at) const {
  for (int i = 0; dependsOnParameters_ && i < recordedSteps; ++i) {
    std::vector<Recorded> step = rowsOf<Recorded>(block, at, w);
    LinearSystem<Recorded>(MatrixKind::general, static_cast<int>(w.size()), slopesOf<Recorded>(block, at, w))
        .solve(step);
    for (std::size_t k = 0; k < w.size(); ++k) w[k] = w[k] - step[k];
  }
  return w;
}

void Rest::tell(const Block& block, const std::vector<Recorded>& w, const Linear<Recorded>& at, Found& found) const {
  const auto name = [](const char* what, int number) { return fmt::format("{}.{}", what, number + 1); };
  const Recorded turn = Recorded(2.0) * constant<Recorded>(pi());
  const int n = at.size;
  if (block.isDamped) {
    const Recorded size = sqrt(sqr(w[2 * n]) + sqr(w[2 * n + 1]));
    found.known[name("frequency", block.modes[0])] = size / turn;
    found.known[name("damping", block.modes[0])] = -w[2 * n] / size;
    return;
  }
  std::vector<Recorded> squares{w[n]};  // one: λ stands behind x
  if (block.modes.size() == 2) {
    const auto form = [&](int i, int j) {
      Recorded sum(0.0);
      for (int k = 0; k < n; ++k)
        for (int l = 0; l < n; ++l) sum = sum - w[i * n + k] * at.byAcceleration[k * n + l] * w[j * n + l];
      return sum;
    };
    const auto both = pairOf(std::span<const Recorded>(w).last(4), {form(0, 0), form(0, 1), form(1, 1)});
    squares.assign(both.begin(), both.end());
  }
  for (std::size_t i = 0; i < block.modes.size(); ++i) {
    found.known[name("frequency", block.modes[i])] = sqrt(squares[i]) / turn;
    found.known[name("damping", block.modes[i])] = Recorded(0.0);
  }
}

std::vector<Recorded> Rest::positionAt(std::span<const Recorded> parameters) const {
  return centreAt(centres_.front(), unit_, parameters);
}

Rest::Found Rest::at(std::span<const Recorded> remainders, std::span<const Recorded> parameters) const {
  const std::vector<Recorded> v = moved(positionAt(parameters), remainders.first(size_), unit_);
  std::vector<std::vector<Recorded>> modes;
  std::size_t first = size_;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const std::vector<double>& unit = blocks_[k].unit;
    modes.push_back(moved(centreAt(centres_[k + 1], unit, parameters), remainders.subspan(first, unit.size()), unit));
    first += unit.size();
  }
  return foundAt(v, modes, parameters);
}

Rest::Found Rest::at(std::span<const Recorded> parameters) const {
  const std::vector<Recorded> v = rooted(positionAt(parameters), parameters);
  std::vector<std::vector<Recorded>> modes;
  if (!blocks_.empty()) {
    const Linear<Recorded> of = linearAt<Recorded>(v, parameters);
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      modes.push_back(rooted(blocks_[k], centreAt(centres_[k + 1], blocks_[k].unit, parameters), of));
  }
  return foundAt(v, modes, parameters);
}

Rest::Found Rest::foundAt(const std::vector<Recorded>& v, const std::vector<std::vector<Recorded>>& modes,
                          std::span<const Recorded> parameters) const {
  Found found;
  found.state.assign(v.begin(), v.begin() + coordinates_);
  found.state.resize(coordinates_ + speeds_, Recorded(0.0));
  found.state.insert(found.state.end(), v.begin() + coordinates_, v.begin() + coordinates_ + ownStates_);
  if (eigenvalues_.empty()) return found;
  const Linear<Recorded> of = linearAt<Recorded>(v, parameters);
  for (std::size_t k = 0; k < modes.size(); ++k) tell(blocks_[k], modes[k], of, found);
  for (int mode = static_cast<int>(modes_.size()); mode < speeds_; ++mode)
    for (const char* what : {"frequency", "damping"})
      found.unknown[fmt::format("{}.{}", what, mode + 1)] =
          fmt::format("at rest {} of {} modes oscillate", modes_.size(), speeds_);
  return found;
}

}  // namespace gamut
