// Scalars of so many decimal digits, in which programs are judged, and random expressions over any scalar.
#pragma once

#include <gmock/gmock.h>

#include <boost/multiprecision/mpfr.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/recorded.hpp"
#include "scalars/traits.hpp"

namespace gamut {

namespace testing {

template <unsigned digits>
using Digits = boost::multiprecision::number<
    boost::multiprecision::mpfr_float_backend<digits, boost::multiprecision::allocate_stack>,
    boost::multiprecision::et_off>;
using HighPrecision = Digits<50>;

}  // namespace testing

/// An enclosed constant is taken to be the midpoint: ±2^k of it is then ±2^k of the number too.
template <unsigned digits>
struct ScalarTraits<testing::Digits<digits>> {
  static testing::Digits<digits> constant(const Interval& enclosure) {
    return testing::Digits<digits>(midpoint(enclosure));
  }
};

namespace testing {

MATCHER_P(EnclosesExactly, value, "encloses " + value.str(50)) {
  return HighPrecision(arg.lower()) <= value && value <= HighPrecision(arg.upper());
}

/// As EnclosesExactly, but a thin range is compared to 40 digits: it is exact, the value of 50 digits is not.
MATCHER_P(EnclosesToItsDigits, value, "encloses " + value.str(50)) {
  const HighPrecision slack = isThin(arg) ? HighPrecision((1 + abs(value)) * HighPrecision(1e-40)) : HighPrecision(0);
  return HighPrecision(arg.lower()) - slack <= value && value <= HighPrecision(arg.upper()) + slack;
}

/// A random expression, the same for every scalar: operations are drawn by a generator that is started anew each time.
/// It is full of what a recorder rewrites: zeros, ones, negations, powers of two, repetitions, differences of equals.
class RandomExpression {
 public:
  explicit RandomExpression(unsigned seed, int length = 14) : seed_(seed), length_(length) {}

  template <class S>
  std::vector<S> operator()(const S& t, const std::vector<S>& x, const std::vector<S>& p, int outputs) const {
    using std::atan, std::cos, std::exp, std::log, std::sin, std::sqrt, std::tanh;
    std::mt19937_64 engine(seed_);
    const auto integer = [&](int upper) { return static_cast<int>(engine() % static_cast<unsigned>(upper)); };
    std::vector<S> pool{t, S(0.0), S(1.0), S(-1.0), S(2.0), S(0.25), constant<S>(Interval("0.1")), constant<S>(pi())};
    pool.insert(pool.end(), x.begin(), x.end());
    pool.insert(pool.end(), p.begin(), p.end());
    for (int i = 0; i < length_; ++i) {
      const auto pick = [&] { return pool[static_cast<std::size_t>(integer(static_cast<int>(pool.size())))]; };
      const S a = pick(), b = pick();
      const auto positive = [&](const S& y) { return S(1.5) + y * y; };
      switch (integer(16)) {
        case 0:
          pool.push_back(a + b);
          break;
        case 1:
          pool.push_back(a - b);
          break;
        case 2:
          pool.push_back(-a);
          break;
        case 3:
          pool.push_back(a * b);
          break;
        case 4:
          pool.push_back(a * a);
          break;
        case 5:
          pool.push_back(a / positive(b));
          break;
        case 6:
          pool.push_back(S(1.0) / (S(1.0) / positive(a)));
          break;
        case 7:
          pool.push_back(sqrt(positive(a)));
          break;
        case 8:
          pool.push_back(exp(-positive(a) / S(8.0)));
          break;
        case 9:
          pool.push_back(log(positive(a)));
          break;
        case 10:
          pool.push_back(sin(a));
          break;
        case 11:
          pool.push_back(cos(-a));
          break;
        case 12:
          pool.push_back(i % 2 == 0 ? S(atan(a)) : S(tanh(a)));
          break;
        case 13:
          pool.push_back((-a) * (S(0.5) * b));
          break;
        case 14:
          pool.push_back((S(0.5) * a) * (S(2.0) * b) - (-b));
          break;
        default:
          pool.push_back(sin(-b) + (-cos(a)));
          break;
      }
    }
    return {pool.end() - outputs, pool.end()};
  }

  /// The same, recorded.
  Program recorded(int states, int parameters, int outputs) const {
    return record(states, parameters, outputs,
                  [&](const Recorded& t, const auto& x, const auto& p, auto& y) { y = (*this)(t, x, p, outputs); });
  }

 private:
  unsigned seed_;
  int length_;
};

inline std::vector<HighPrecision> highPrecision(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace testing
}  // namespace gamut
