// Samples: construction, statistics and the elementwise functions; the loops are in Samples::transform and combine.
#include "scalars/samples.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <string>

#include "scalars/elementary/vector_functions.hpp"

namespace gamut {
namespace {

template <double function(double)>
Samples mapped(Samples x) {
  return std::move(x.transform([](double v) { return function(v); }));
}

template <double function(double, double)>
Samples combined(Samples x, const Samples& y) {
  return std::move(x.combine(y, [](double a, double b) { return function(a, b); }));
}

/// As of intervals, in (-π, π]: no zero has a sign.
double angleOf(double y, double x) { return std::atan2(y + 0.0, x); }

}  // namespace

Samples::Samples(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("a pack of samples needs at least one value");
  if (values.size() == 1) {
    constant_ = values.front();
  } else {
    values_ = std::move(values);
  }
}

std::size_t Samples::commonSize(const Samples& other) const {
  if (other.isConstant()) return size();
  if (isConstant() || size() == other.size()) return other.size();
  throw std::invalid_argument("packs of " + std::to_string(size()) + " and " + std::to_string(other.size()) +
                              " samples do not combine");
}

double Samples::minimum() const { return *std::ranges::min_element(values()); }
double Samples::maximum() const { return *std::ranges::max_element(values()); }

double Samples::mean() const {
  const auto all = values();
  return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
}

Samples& Samples::operator+=(const Samples& other) { return combine(other, std::plus<>()); }
Samples& Samples::operator-=(const Samples& other) { return combine(other, std::minus<>()); }
Samples& Samples::operator*=(const Samples& other) { return combine(other, std::multiplies<>()); }
Samples& Samples::operator/=(const Samples& other) { return combine(other, std::divides<>()); }

Samples sqr(Samples x) {
  return std::move(x.transform([](double v) { return v * v; }));
}
Samples sqrt(Samples x) { return mapped<std::sqrt>(std::move(x)); }
Samples cbrt(Samples x) { return mapped<std::cbrt>(std::move(x)); }
Samples abs(Samples x) { return mapped<std::abs>(std::move(x)); }
Samples exp(Samples x) { return mapped<std::exp>(std::move(x)); }
Samples exp2(Samples x) { return mapped<std::exp2>(std::move(x)); }
Samples exp10(Samples x) {
  return std::move(x.transform([](double v) { return std::pow(10.0, v); }));
}
Samples expm1(Samples x) { return mapped<std::expm1>(std::move(x)); }
Samples log(Samples x) { return mapped<std::log>(std::move(x)); }
Samples log2(Samples x) { return mapped<std::log2>(std::move(x)); }
Samples log10(Samples x) { return mapped<std::log10>(std::move(x)); }
Samples log1p(Samples x) { return mapped<std::log1p>(std::move(x)); }
Samples sin(Samples x) {
  return std::move(x.transformAll([](auto angles, auto results) { sine(angles, results); }));
}
Samples cos(Samples x) {
  return std::move(x.transformAll([](auto angles, auto results) { cosine(angles, results); }));
}
Samples tan(Samples x) { return mapped<std::tan>(std::move(x)); }
Samples asin(Samples x) { return mapped<std::asin>(std::move(x)); }
Samples acos(Samples x) { return mapped<std::acos>(std::move(x)); }
Samples atan(Samples x) { return mapped<std::atan>(std::move(x)); }
Samples sinh(Samples x) { return mapped<std::sinh>(std::move(x)); }
Samples cosh(Samples x) { return mapped<std::cosh>(std::move(x)); }
Samples tanh(Samples x) { return mapped<std::tanh>(std::move(x)); }
Samples asinh(Samples x) { return mapped<std::asinh>(std::move(x)); }
Samples acosh(Samples x) { return mapped<std::acosh>(std::move(x)); }
Samples atanh(Samples x) { return mapped<std::atanh>(std::move(x)); }
Samples floor(Samples x) { return mapped<std::floor>(std::move(x)); }
Samples ceil(Samples x) { return mapped<std::ceil>(std::move(x)); }
Samples trunc(Samples x) { return mapped<std::trunc>(std::move(x)); }
Samples round(Samples x) { return mapped<std::round>(std::move(x)); }
Samples sign(Samples x) {
  return std::move(x.transform([](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : v; }));
}
Samples atan2(Samples y, const Samples& x) { return combined<angleOf>(std::move(y), x); }
Samples hypot(Samples x, const Samples& y) { return combined<std::hypot>(std::move(x), y); }
Samples min(Samples x, const Samples& y) {
  return std::move(x.combine(y, [](double a, double b) { return std::min(a, b); }));
}
Samples max(Samples x, const Samples& y) {
  return std::move(x.combine(y, [](double a, double b) { return std::max(a, b); }));
}
Samples pow(Samples x, int n) {
  return std::move(x.transform([n](double v) { return std::pow(v, n); }));
}
Samples pow(Samples x, double y) {
  return std::move(x.transform([y](double v) { return std::pow(v, y); }));
}
Samples pow(Samples x, const Samples& y) { return combined<std::pow>(std::move(x), y); }

std::ostream& operator<<(std::ostream& stream, const Samples& x) {
  if (x.isConstant()) return stream << x[0];
  const char* separator = "{";
  for (const double value : x.values()) {
    stream << separator << value;
    separator = ", ";
  }
  return stream << "}";
}

}  // namespace gamut
