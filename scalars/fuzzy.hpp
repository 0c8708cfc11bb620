// Fuzzy: a fuzzy number as a stack of nested alpha-cuts. Level 0 is the support (what is possible at all), the last
// level the core (membership 1), and cut j of the result of an operation is that operation on the operands' cuts j
// (Zadeh's extension principle; Nguyen 1978), enclosed by interval arithmetic.
#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include "scalars/traits.hpp"

namespace gamut {

class Fuzzy {
 public:
  /// The crisp 0.
  Fuzzy() : Fuzzy(Interval()) {}

  /// Crisp: every alpha-cut is that value or interval; combines with any number of levels.
  Fuzzy(double value) : Fuzzy(Interval(value)) {}  // NOLINT: implicit on purpose
  Fuzzy(const Interval& cut) : cuts_(1, cut) {}    // NOLINT: implicit on purpose

  /// Alpha-cuts from support to core. Throws std::invalid_argument for none, or where one leaves the cut before it.
  explicit Fuzzy(std::vector<Interval> cuts);

  /// Membership rising linearly from 0 at `lower` to 1 at `apex` and falling to 0 at `upper`, cut at `levels` >= 2
  /// equally spaced memberships, each cut rounded outward. Throws std::invalid_argument unless lower <= apex <= upper.
  static Fuzzy triangular(double lower, double apex, double upper, std::size_t levels);

  /// As triangular, with membership 1 on all of [coreLower, coreUpper].
  static Fuzzy trapezoidal(double lower, double coreLower, double coreUpper, double upper, std::size_t levels);

  /// The number of alpha-cuts; 1 for a crisp quantity.
  std::size_t levels() const { return cuts_.size(); }
  /// The alpha-cut at a level below levels(); a crisp quantity has the same at every level.
  const Interval& cut(std::size_t level) const { return cuts_.size() == 1 ? cuts_.front() : cuts_[level]; }
  /// The membership of a level: level / (levels() - 1); 1 for a crisp quantity.
  double alpha(std::size_t level) const;
  const Interval& support() const { return cuts_.front(); }
  const Interval& core() const { return cuts_.back(); }
  std::span<const Interval> cuts() const { return cuts_; }

  // Numbers of different levels do not combine: std::invalid_argument, unless one is crisp.
  Fuzzy& operator+=(const Fuzzy& other) { return *this = *this + other; }
  Fuzzy& operator-=(const Fuzzy& other) { return *this = *this - other; }
  Fuzzy& operator*=(const Fuzzy& other) { return *this = *this * other; }
  Fuzzy& operator/=(const Fuzzy& other) { return *this = *this / other; }

  friend Fuzzy operator+(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator-(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator*(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator/(const Fuzzy& x, const Fuzzy& y);
  friend Fuzzy operator+(const Fuzzy& x) { return x; }
  friend Fuzzy operator-(const Fuzzy& x);

 private:
  std::vector<Interval> cuts_;  // nested, from support to core; one for a crisp quantity
};

// The functions of Interval, cut by cut.
Fuzzy sqr(const Fuzzy& x);
Fuzzy sqrt(const Fuzzy& x);
Fuzzy abs(const Fuzzy& x);
Fuzzy exp(const Fuzzy& x);
Fuzzy log(const Fuzzy& x);
Fuzzy sin(const Fuzzy& x);
Fuzzy cos(const Fuzzy& x);
Fuzzy tan(const Fuzzy& x);
Fuzzy asin(const Fuzzy& x);
Fuzzy acos(const Fuzzy& x);
Fuzzy atan(const Fuzzy& x);
Fuzzy sinh(const Fuzzy& x);
Fuzzy cosh(const Fuzzy& x);
Fuzzy tanh(const Fuzzy& x);
Fuzzy min(const Fuzzy& x, const Fuzzy& y);
Fuzzy max(const Fuzzy& x, const Fuzzy& y);
Fuzzy pow(const Fuzzy& x, int n);
Fuzzy pow(const Fuzzy& x, double y);
Fuzzy pow(const Fuzzy& x, const Fuzzy& y);

/// "{support, ..., core}".
std::ostream& operator<<(std::ostream& stream, const Fuzzy& x);

template <>
struct ScalarTraits<Fuzzy> {
  static Fuzzy constant(const Interval& enclosure) { return enclosure; }
};

static_assert(Scalar<Fuzzy>);

}  // namespace gamut
