// In doubles from the initial position to the nominal rest and its modes, then by Newton's steps written down.
#include "mechanics/rest.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/rest_algebra.hpp"
#include "mechanics/rest_position.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/evaluate.hpp"

namespace gamut {
namespace {

constexpr int perUndamped = 3;  // numbers that each leaves open

std::string nameOf(const char* what, int mode) { return fmt::format("{}.{}", what, mode + 1); }

std::vector<Recorded> moved(std::vector<Recorded> v, std::span<const Recorded> by, const std::vector<double>& unit) {
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = v[i] + unit[i] * by[i];
  return v;
}

std::vector<Recorded> recorded(const std::vector<double>& numbers) { return {numbers.begin(), numbers.end()}; }

/// From the numbers of programs, 0 states and so many parameters, to so many outputs.
template <class What>
Program written(int open, int given, std::size_t outputs, const What& what) {
  return record(open, given, static_cast<int>(outputs), [&](auto, const auto& delta, const auto& p, auto& y) {
    std::ranges::copy(what(std::span<const Recorded>(delta), std::span<const Recorded>(p)), y.begin());
  });
}

/// A centre of parameters, in units: of so many steps one that is near to them.
template <class Steps>
Program centreOf(const RestRows& rows, const std::vector<double>& unit, const Rest::Approximation& approximated,
                 const Steps& steps) {
  const Program program = written(0, rows.parameters, unit.size(), [&](auto, auto p) {
    std::vector<Recorded> c = steps(p);
    for (std::size_t i = 0; i < unit.size(); ++i) c[i] = c[i] / unit[i];
    return c;
  });
  return rows.dependsOnParameters ? approximated(program, 1) : program;
}

/// Slopes of equations at the centre, and their rows beside it.
struct Equations {
  std::vector<Recorded> slopes, rows;
};

/// φ = δ − (N J(c) U)⁻¹ N g(c + U δ), U their units, N near to (J U)⁻¹. `equations` of δ and parameters, of which there
/// are `extra` more than the mechanism's.
template <class EquationsAt>
Program familyOf(const RestRows& of, int extra, const std::vector<double>& unit,
                 const std::vector<double>& slopesAtNominal, const EquationsAt& equations) {
  const int n = static_cast<int>(unit.size());
  const Eigen::MatrixXd inverse =
      ScaledMatrix(squareMatrix(slopesAtNominal, n) * Eigen::Map<const Eigen::VectorXd>(unit.data(), n).asDiagonal())
          .inverse();
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
  return written(n, of.parameters + extra, unit.size(), [&](auto delta, auto p) {
    Equations at = equations(delta, p);
    for (int i = 0; i < n * n; ++i) at.slopes[i] = unit[i % n] * at.slopes[i];
    std::vector<Recorded> image = nearUnity(at.rows);
    LinearSystem<Recorded>(MatrixKind::general, n, nearUnity(at.slopes)).solve(image);
    for (int i = 0; i < n; ++i) image[i] = delta[i] - image[i];
    return image;
  });
}

}  // namespace

Rest::Rest(const Mechanism& mechanism, const std::vector<std::string>& freeParameters, const Box& parameters,
           const std::set<int>& modes, const Approximation& approximated)
    : rows_(mechanism, freeParameters) {
  const std::vector<double> start = Assembly<double>(mechanism).initialState();
  std::vector<double> v(start.begin(), start.begin() + rows_.coordinates);
  v.insert(v.end(), start.begin() + rows_.coordinates + rows_.speeds, start.end());
  v.resize(rows_.size, 0.0);
  for (const Interval& each : parameters) values_.push_back(midpoint(each));
  nominal_ = settled(rows_, std::move(v), values_);
  refuseLoose(rows_, rows_.at<double>(nominal_, values_));
  takePosition(approximated);
  bool isDamped = rows_.ownStates > 0 || !hasPotential(rows_, nominal_, parameters);
  record(0, rows_.parameters, 1, [&](auto, const auto&, const auto& p, auto&) {
    const LinearRows<Recorded> of = rows_.at<Recorded>(centreAt(0, p), p);
    for (int i = 0; i < rows_.coordinates; ++i)
      for (int j = 0; j < rows_.coordinates; ++j) isDamped = isDamped || !isKnownZero(of.byRate[i * rows_.size + j]);
  });
  if (!modes.empty() && isDamped) takeDampedModes(modes, approximated);
  if (!modes.empty() && !isDamped) {
    vibration_ = vibrationOf(
        rows_, nominal_, parameters, [&](std::span<const Recorded> p) { return centreAt(0, p); },
        {modes.begin(), modes.end()}, approximated);
    for (std::size_t i = vibration_->unstable; i < vibration_->squares.size(); ++i)
      modes_.emplace_back(0.0, std::sqrt(vibration_->squares[i]));
  }
  recordSampled();
}

void Rest::takePosition(const Approximation& approximated) {
  const std::span<const double> nominal(nominal_);
  const int told = rows_.coordinates + rows_.ownStates;
  unit_.assign(rows_.size, 1.0);  // rad, m
  std::fill(unit_.begin() + told, unit_.end(), unitOf(nominal.subspan(told)));
  for (int k = rows_.coordinates; k < told; ++k) unit_[k] = unitOf(nominal.subspan(k, 1));
  centres_.push_back(
      centreOf(rows_, unit_, approximated, [&](auto p) { return rooted(rows_, recorded(nominal_), p); }));
  families_.push_back(
      familyOf(rows_, 0, unit_, rows_.at<double>(nominal_, values_).byPosition, [&](auto delta, auto p) -> Equations {
        const std::vector<Recorded> c = centreAt(0, p);
        return {rows_.at<Recorded>(c, p).byPosition, rows_.at<Recorded>(moved(c, delta, unit_), p).rows};
      }));
  position_ = written(0, rows_.parameters + rows_.size, rows_.size, [&](auto, auto p) {
    return moved(centreAt(0, p.first(rows_.parameters)), p.subspan(rows_.parameters), unit_);
  });
}

void Rest::takeDampedModes(const std::set<int>& wanted, const Approximation& approximated) {
  const LinearRows<double> at = rows_.at<double>(nominal_, values_);
  modes_ = modesAmong(eigenvaluesOf(rows_, at));
  const int many = static_cast<int>(modes_.size());
  for (const int mode : wanted) {
    if (mode > many) continue;
    constexpr double apart = 1e-6;
    const auto meet = [&](int lower) {
      return lower > 0 && lower < many &&
             !(std::abs(modes_[lower]) - std::abs(modes_[lower - 1]) > apart * std::abs(modes_[lower]));
    };
    if (meet(mode - 1) || meet(mode))
      throw UnfitPart(rows_.names.front(),
                      fmt::format("the frequencies {} and {} may meet, and are not told apart",
                                  meet(mode - 1) ? mode - 1 : mode, meet(mode - 1) ? mode : mode + 1),
                      "narrower intervals, or less symmetry");
    damped_.emplace_back(rows_, at, mode - 1, modes_[mode - 1]);
  }
  for (std::size_t k = 0; k < damped_.size(); ++k) {
    const DampedMode& mode = damped_[k];
    centres_.push_back(centreOf(rows_, mode.unit, approximated, [&](auto p) {
      std::vector<Recorded> w = recorded(mode.nominal);
      return rows_.dependsOnParameters ? mode.rooted(rows_.at<Recorded>(centreAt(0, p), p), std::move(w)) : w;
    }));
    families_.push_back(familyOf(
        rows_, rows_.size, mode.unit, mode.slopesOf<double>(at, mode.nominal), [&](auto delta, auto p) -> Equations {
          const auto own = p.first(rows_.parameters);
          const std::vector<Recorded> v = moved(centreAt(0, own), p.last(rows_.size), unit_), c = centreAt(k + 1, own);
          const LinearRows<Recorded> of = rows_.at<Recorded>(v, own);
          return {mode.slopesOf<Recorded>(of, c), mode.rowsOf<Recorded>(of, moved(c, delta, mode.unit))};
        }));
  }
}

std::vector<Recorded> Rest::centreAt(std::size_t family, std::span<const Recorded> parameters) const {
  const std::vector<double>& unit = family == 0 ? unit_ : damped_[family - 1].unit;
  std::vector<Recorded> c = evaluate<Recorded>(centres_[family], {}, {parameters.begin(), parameters.end()});
  for (std::size_t i = 0; i < c.size(); ++i) c[i] = unit[i] * c[i];
  return c;
}

int Rest::remainders() const {
  int sum = vibration_ ? perUndamped * static_cast<int>(vibration_->modes.size()) : 0;
  for (const Program& family : families_) sum += family.states();
  return sum;
}

std::vector<double> Rest::ownInertias() const {
  const std::vector<double> byAcceleration = rows_.at<double>(nominal_, values_).byAcceleration;
  std::vector<double> all;
  for (int i = 0; i < rows_.coordinates; ++i) all.push_back(-byAcceleration[i * rows_.size + i]);
  return all;
}

std::vector<Recorded> Rest::dampedAt(std::size_t k, std::span<const Recorded> remainders,
                                     std::span<const Recorded> parameters) const {
  std::size_t first = rows_.size;
  for (std::size_t i = 0; i < k; ++i) first += damped_[i].unit.size();
  const std::vector<double>& unit = damped_[k].unit;
  return moved(centreAt(k + 1, parameters), remainders.subspan(first, unit.size()), unit);
}

Rest::Found Rest::at(std::span<const Recorded> remainders, std::span<const Recorded> parameters,
                     bool withinEnds) const {
  const std::vector<Recorded> v = moved(centreAt(0, parameters), remainders.first(rows_.size), unit_);
  Found found;
  found.state.assign(v.begin(), v.begin() + rows_.coordinates);
  found.state.resize(rows_.coordinates + rows_.speeds, Recorded(0.0));
  found.state.insert(found.state.end(), v.begin() + rows_.coordinates, v.begin() + rows_.coordinates + rows_.ownStates);
  const Recorded turn = Recorded(2.0) * constant<Recorded>(pi());
  for (std::size_t k = 0; k < damped_.size(); ++k) {
    const std::vector<Recorded> w = dampedAt(k, remainders, parameters);
    const Recorded re = w[w.size() - 2], size = sqrt(sqr(re) + sqr(w.back()));
    found.known[nameOf("frequency", damped_[k].number)] = size / turn;
    found.known[nameOf("damping", damped_[k].number)] = -re / size;
  }
  if (vibration_) {
    std::span<const Recorded> open = remainders.subspan(rows_.size);
    const std::vector<Recorded> near = evaluate<Recorded>(vibration_->near, {}, {parameters.begin(), parameters.end()});
    for (std::size_t k = 0; k < vibration_->modes.size(); ++k) {
      Recorded square = near[k] + open[0];
      if (withinEnds) square = max(min(square, open[2]), open[1]);
      found.known[nameOf("frequency", vibration_->modes[k])] = sqrt(square) / turn;
      found.known[nameOf("damping", vibration_->modes[k])] = Recorded(0.0);
      open = open.subspan(perUndamped);
    }
  }
  for (int mode = static_cast<int>(modes_.size()); mode < rows_.speeds; ++mode)
    for (const char* what : {"frequency", "damping"})
      found.unknown[nameOf(what, mode)] = fmt::format("at rest {} of {} modes oscillate", modes_.size(), rows_.speeds);
  return found;
}

/// Of parameters: what families leave open, then the triangles of the pencil.
void Rest::recordSampled() {
  const int triangles = vibration_ ? vibration_->size * (vibration_->size + 1) : 0;
  int families = 0;
  for (const Program& family : families_) families += family.states();
  sampled_ = written(0, rows_.parameters, static_cast<std::size_t>(families + triangles), [&](auto, auto p) {
    std::vector<Recorded> open;
    const auto leave = [&](std::size_t family, const std::vector<Recorded>& root, const std::vector<double>& unit) {
      const std::vector<Recorded> c = centreAt(family, p);
      for (std::size_t i = 0; i < c.size(); ++i) open.push_back((root[i] - c[i]) / unit[i]);
    };
    const std::vector<Recorded> v = rooted(rows_, centreAt(0, p), p);
    leave(0, v, unit_);
    for (std::size_t k = 0; k < damped_.size(); ++k) {
      std::vector<Recorded> w = centreAt(k + 1, p);
      if (rows_.dependsOnParameters) w = damped_[k].rooted(rows_.at<Recorded>(v, p), std::move(w));
      leave(k + 1, w, damped_[k].unit);
    }
    if (vibration_) {
      const std::vector<Recorded> all = evaluate<Recorded>(vibration_->pencil, v, {p.begin(), p.end()});
      open.insert(open.end(), all.end() - triangles, all.end());
    }
    return open;
  });
}

std::vector<Samples> Rest::remaindersAt(const std::vector<Samples>& parameters) const {
  std::vector<Samples> open = evaluate<Samples>(sampled_, {}, parameters);
  if (!vibration_) return open;
  const int size = vibration_->size, triangles = size * (size + 1);
  const std::vector<Samples> near = evaluate<Samples>(vibration_->near, {}, parameters);
  const std::vector<Samples> entries(open.end() - triangles, open.end());
  open.resize(open.size() - triangles);
  std::size_t many = 1;
  for (const Samples& each : entries) many = std::max(many, each.size());
  std::vector<std::vector<double>> squares(vibration_->modes.size());
  for (std::size_t i = 0; i < many; ++i) {
    std::vector<double> own;
    for (const Samples& each : entries) own.push_back(each[each.isConstant() ? 0 : i]);
    const std::vector<double> all = squaresOf(own, size);
    for (std::size_t k = 0; k < squares.size(); ++k) squares[k].push_back(all[vibration_->number(k)]);
  }
  for (std::size_t k = 0; k < squares.size(); ++k) {
    const Samples square(std::move(squares[k]));
    open.insert(open.end(), {square - near[k], square, square});
  }
  return open;
}

}  // namespace gamut
