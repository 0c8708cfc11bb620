// Samples: construction, statistics and the elementwise functions; the loops are in Samples::transform and combine.
#include "scalars/samples.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>
#include <stdexcept>
#include <string>

#include "scalars/vector_functions.hpp"

namespace gamut {

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
Samples sqrt(Samples x) {
  return std::move(x.transform([](double v) { return std::sqrt(v); }));
}
Samples cbrt(Samples x) {
  return std::move(x.transform([](double v) { return std::cbrt(v); }));
}
Samples abs(Samples x) {
  return std::move(x.transform([](double v) { return std::abs(v); }));
}
Samples exp(Samples x) {
  return std::move(x.transform([](double v) { return std::exp(v); }));
}
Samples exp2(Samples x) {
  return std::move(x.transform([](double v) { return std::exp2(v); }));
}
Samples exp10(Samples x) {
  return std::move(x.transform([](double v) { return std::pow(10.0, v); }));
}
Samples expm1(Samples x) {
  return std::move(x.transform([](double v) { return std::expm1(v); }));
}
Samples log(Samples x) {
  return std::move(x.transform([](double v) { return std::log(v); }));
}
Samples log2(Samples x) {
  return std::move(x.transform([](double v) { return std::log2(v); }));
}
Samples log10(Samples x) {
  return std::move(x.transform([](double v) { return std::log10(v); }));
}
Samples log1p(Samples x) {
  return std::move(x.transform([](double v) { return std::log1p(v); }));
}
Samples sin(Samples x) {
  return std::move(x.transformAll([](auto angles, auto results) { sine(angles, results); }));
}
Samples cos(Samples x) {
  return std::move(x.transformAll([](auto angles, auto results) { cosine(angles, results); }));
}
Samples tan(Samples x) {
  return std::move(x.transform([](double v) { return std::tan(v); }));
}
Samples asin(Samples x) {
  return std::move(x.transform([](double v) { return std::asin(v); }));
}
Samples acos(Samples x) {
  return std::move(x.transform([](double v) { return std::acos(v); }));
}
Samples atan(Samples x) {
  return std::move(x.transform([](double v) { return std::atan(v); }));
}
Samples sinh(Samples x) {
  return std::move(x.transform([](double v) { return std::sinh(v); }));
}
Samples cosh(Samples x) {
  return std::move(x.transform([](double v) { return std::cosh(v); }));
}
Samples tanh(Samples x) {
  return std::move(x.transform([](double v) { return std::tanh(v); }));
}
Samples asinh(Samples x) {
  return std::move(x.transform([](double v) { return std::asinh(v); }));
}
Samples acosh(Samples x) {
  return std::move(x.transform([](double v) { return std::acosh(v); }));
}
Samples atanh(Samples x) {
  return std::move(x.transform([](double v) { return std::atanh(v); }));
}
Samples floor(Samples x) {
  return std::move(x.transform([](double v) { return std::floor(v); }));
}
Samples ceil(Samples x) {
  return std::move(x.transform([](double v) { return std::ceil(v); }));
}
Samples sign(Samples x) {
  return std::move(x.transform([](double v) { return v > 0 ? 1.0 : v < 0 ? -1.0 : v; }));
}
Samples atan2(Samples y, const Samples& x) {
  return std::move(y.combine(x, [](double a, double b) { return std::atan2(a, b); }));
}
Samples hypot(Samples x, const Samples& y) {
  return std::move(x.combine(y, [](double a, double b) { return std::hypot(a, b); }));
}
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
Samples pow(Samples x, const Samples& y) {
  return std::move(x.combine(y, [](double a, double b) { return std::pow(a, b); }));
}

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
