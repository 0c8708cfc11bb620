// Samples: a pack of Monte-Carlo values of one quantity. Every operation acts sample by sample, so moving a mechanism
// once with packs moves it once for each sample. A double is a pack of one value, the constant of every sample.
#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include "scalars/traits.hpp"

namespace gamut {

class Samples {
 public:
  /// The constant 0.
  Samples() = default;

  /// A constant, which combines with packs of any size.
  Samples(double value) : constant_(value) {}  // NOLINT(google-explicit-*): implicit on purpose

  /// One value a sample; a single value is a constant. Throws std::invalid_argument for none.
  explicit Samples(std::vector<double> values);

  /// The number of samples; 1 for a constant.
  std::size_t size() const { return values_.empty() ? 1 : values_.size(); }
  bool isConstant() const { return values_.empty(); }
  /// Sample i, 0 <= i < size(); a constant has the same value at every i.
  double operator[](std::size_t i) const { return values_.empty() ? constant_ : values_[i]; }
  /// All size() values; valid while this object is neither changed nor moved.
  std::span<const double> values() const {
    return values_.empty() ? std::span<const double>(&constant_, 1) : std::span<const double>(values_);
  }

  double minimum() const;
  double maximum() const;
  double mean() const;

  // Packs of different sizes do not combine: std::invalid_argument, unless one is a constant.
  Samples& operator+=(const Samples& other);
  Samples& operator-=(const Samples& other);
  Samples& operator*=(const Samples& other);
  Samples& operator/=(const Samples& other);

  friend Samples operator+(Samples x, const Samples& y) { return std::move(x += y); }
  friend Samples operator-(Samples x, const Samples& y) { return std::move(x -= y); }
  friend Samples operator*(Samples x, const Samples& y) { return std::move(x *= y); }
  friend Samples operator/(Samples x, const Samples& y) { return std::move(x /= y); }
  friend Samples operator+(Samples x) { return x; }
  friend Samples operator-(Samples x) {
    return std::move(x.transform([](double value) { return -value; }));
  }

  /// Replaces each value by function(value).
  template <class Function>
  Samples& transform(Function function) {
    if (isConstant()) constant_ = function(constant_);
    for (double& value : values_) value = function(value);
    return *this;
  }

  /// Replaces all values at once by function(values, results), two spans of one length.
  template <class Function>
  Samples& transformAll(Function function) {
    const std::span<double> all = values_.empty() ? std::span<double>(&constant_, 1) : std::span<double>(values_);
    function(std::span<const double>(all), all);
    return *this;
  }

  /// Replaces each value by function(value, the other's value of the same sample).
  template <class Function>
  Samples& combine(const Samples& other, Function function) {
    const std::size_t n = commonSize(other);
    if (isConstant() && n > 1) values_.assign(n, constant_);
    if (n == 1) {
      constant_ = function(constant_, other.constant_);
    } else if (other.isConstant()) {
      const double right = other.constant_;
      for (double& value : values_) value = function(value, right);
    } else {
      const double* right = other.values_.data();
      for (std::size_t i = 0; i < n; ++i) values_[i] = function(values_[i], right[i]);
    }
    return *this;
  }

 private:
  /// The size of the combination; throws std::invalid_argument when there is none.
  std::size_t commonSize(const Samples& other) const;

  double constant_ = 0;         // the value when values_ is empty
  std::vector<double> values_;  // empty, or at least two values
};

// Sample by sample, as <cmath> does (NaN outside the domain); sin and cos as elementary/vector_functions.hpp does,
// with errors < 1.25 ulp while doubles are rounded to nearest.
Samples sqr(Samples x);
Samples sqrt(Samples x);
Samples cbrt(Samples x);
Samples abs(Samples x);
Samples exp(Samples x);
Samples exp2(Samples x);
Samples exp10(Samples x);
Samples expm1(Samples x);
Samples log(Samples x);
Samples log2(Samples x);
Samples log10(Samples x);
Samples log1p(Samples x);
Samples sin(Samples x);
Samples cos(Samples x);
Samples tan(Samples x);
Samples asin(Samples x);
Samples acos(Samples x);
Samples atan(Samples x);
/// The angle of (x, y): y comes first, as in `<cmath>`.
Samples atan2(Samples y, const Samples& x);
Samples sinh(Samples x);
Samples cosh(Samples x);
Samples tanh(Samples x);
Samples asinh(Samples x);
Samples acosh(Samples x);
Samples atanh(Samples x);
Samples floor(Samples x);
Samples ceil(Samples x);
Samples trunc(Samples x);
/// The nearest integer; half-way cases away from zero.
Samples round(Samples x);
/// -1, 0 or 1.
Samples sign(Samples x);
Samples hypot(Samples x, const Samples& y);
Samples min(Samples x, const Samples& y);
Samples max(Samples x, const Samples& y);
Samples pow(Samples x, int n);
Samples pow(Samples x, double y);
Samples pow(Samples x, const Samples& y);

/// "{v0, v1, ...}", or the value of a constant.
std::ostream& operator<<(std::ostream& stream, const Samples& x);

template <>
struct ScalarTraits<Samples> {
  static Samples constant(const Interval& enclosure) { return midpoint(enclosure); }
};

static_assert(Scalar<Samples>);

}  // namespace gamut
