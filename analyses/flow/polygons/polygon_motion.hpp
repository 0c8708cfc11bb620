// The set of all motions of two states under inputs that vary freely, as a convex polygon whose sides move: each side's
// normal follows the adjoint of the motion at its middle, and its offset rises as fast as any motion there can cross
// it. docs/flow.md, section 6.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "analyses/flow/polygons/polygon.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class PolygonMotion {
 public:
  /// ẋ = f(t, x, p), p anywhere in `parameters` at any time. `sides`: about so many. `isWide`: of each parameter,
  /// whether it has a width, or may have one later.
  PolygonMotion(const Program& f, const Box& starts, const Box& parameters, const std::vector<char>& isWide,
                double horizon, int sides);
  /// From now on.
  void setParameters(const Box& parameters);

  double time() const { return time_; }
  /// At that time, x_i = units()[i] X_i.
  const Polygon& polygon() const { return polygon_; }
  const std::array<double, 2>& units() const { return unit_; }
  /// That keeps what is added in a step little beside what inputs do.
  double longestStep() const { return longest_; }

  /// Goes on to `end` or to before it; false if it cannot.
  bool step(double end);
  /// u·X is no greater in the last step at any time.
  double reachOver(const PlaneVector& u) const;

 private:
  /// A side on its way, λ ∈ [0, 1] being the part of the step that has passed: what is a + (b - a)λ + bend λ(1 - λ).
  struct Way {
    PlaneVector from, to, bend;
    PlaneBox middle() const;
    PlaneBox all() const;                      ///< for any λ
    PlaneBox speed() const;                    ///< by λ
    Interval all(const PlaneVector& u) const;  ///< u·way
  };
  struct Moving {
    Way normal, centre;
    Interval excess;         ///< of the offset over normal·centre at first
    double allowed = 0;      ///< |rate| is no more
    double rate = 0;         ///< of the excess by λ
    Interval along, across;  ///< y = along·(normal turned left) + across·normal: places on the side
  };
  struct Values {
    std::array<double, 2> f, pushed;  // at the parameters' middle, and with what pushes most along the normal
    std::array<std::array<double, 2>, 2> jacobian;
  };

  void setUnits(const Box& starts, double horizon);
  Values valuesAt(double t, const PlaneVector& x, const PlaneVector& normal);
  void tidy();
  bool move(std::size_t i, double h);
  bool tryStep(double end);
  bool boundEnds(std::size_t i);
  struct Pose;
  struct Rate {
    Interval all;
    double byTime, byPush;
  };
  std::optional<Rate> rateOn(const Interval& along, const Moving& side, const Pose& at, const Interval& h,
                             const Interval& t);
  double boundRate(const Moving& side, const Interval& h, const Interval& t);
  bool boundRates(const Interval& step, const Interval& t);

  std::vector<char> isWide_;          // of each parameter
  std::size_t wide_;                  // how many are: those whose derivative counts
  Evaluator<Interval> plain_, full_;  // f at the parameters' middle; f, ∂f/∂(x, t), ∂f/∂p anywhere
  Evaluator<double> numbers_;         // the same at the middle
  std::vector<double> radius_;        // of those parameters
  std::array<double, 2> unit_{1, 1};
  double time_ = 0, longest_ = 0, mostLong_ = 0, leastLong_ = 0;
  double loose_ = 0, pushed_ = 0;  // in all rates of the last step: by its length, by inputs
  std::size_t count_;
  Polygon polygon_;
  std::vector<Moving> moving_;
  std::vector<Interval> found_;
  std::vector<double> values_;
};

}  // namespace gamut
