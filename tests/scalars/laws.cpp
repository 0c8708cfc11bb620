// The table of operations that the laws of numbers are tried on.
#include "tests/scalars/laws.hpp"

#include <cmath>
#include <type_traits>

namespace gamut::testing {
namespace {

/// True if f(S, S) is an S.
template <class F, class S, class = void>
constexpr bool isOperation = false;
template <class F, class S>
constexpr bool isOperation<F, S, std::void_t<std::invoke_result_t<F, const S&, const S&>>> =
    std::is_convertible_v<std::invoke_result_t<F, const S&, const S&>, S>;

template <class F, class S>
void set(Operation::Function<S>& function) {
  if constexpr (isOperation<F, S>)
    function = [](const S& x, const S& y) -> S { return F()(x, y); };
  else
    function = nullptr;
}

template <class F>
Operation ofTwo(const char* name, const Interval& x, const Interval& y, F) {
  Operation result{name, x, y, {}};
  std::apply([](auto&... function) { (set<F>(function), ...); }, result.functions);
  return result;
}

template <class F>
struct OfTheFirst {
  template <class S>
  auto operator()(const S& x, const S&) const -> decltype(F()(x)) {
    return F()(x);
  }
};

template <class F>
Operation ofOne(const char* name, double lower, double upper, F) {
  return ofTwo(name, {lower, upper}, {0, 1}, OfTheFirst<F>());
}

// Functions of double found beside those that scalars bring along, and what high precision lacks.
using std::abs, std::acos, std::acosh, std::asin, std::asinh, std::atan, std::atan2, std::atanh, std::cbrt, std::ceil,
    std::cos, std::cosh, std::exp, std::exp2, std::expm1, std::floor, std::hypot, std::log, std::log10, std::log1p,
    std::log2, std::max, std::min, std::pow, std::round, std::sin, std::sinh, std::sqrt, std::tan, std::tanh,
    std::trunc;
Real exp10(const Real& x) { return pow(Real(10), x); }
Real rootn(const Real& x, int n) { return pow(x, 1 / Real(n)); }
Real sign(const Real& x) { return x.sign(); }

const std::vector<Operation>& functions() {
  static const std::vector<Operation> operations{
      ofOne("sqr", -8, 8, [](const auto& x) { return square(x); }),
      ofOne("cbrt", 0.125, 8, [](const auto& x) -> decltype(cbrt(x)) { return cbrt(x); }),
      ofOne("rootn", 0.125, 8, [](const auto& x) -> decltype(rootn(x, 5)) { return rootn(x, 5); }),
      ofOne("abs", -8, 8, [](const auto& x) -> decltype(abs(x)) { return abs(x); }),
      ofOne("exp", -8, 3, [](const auto& x) -> decltype(exp(x)) { return exp(x); }),
      ofOne("exp2", -8, 3, [](const auto& x) -> decltype(exp2(x)) { return exp2(x); }),
      ofOne("exp10", -8, 1, [](const auto& x) -> decltype(exp10(x)) { return exp10(x); }),
      ofOne("expm1", -8, 3, [](const auto& x) -> decltype(expm1(x)) { return expm1(x); }),
      ofOne("log", 0.125, 9, [](const auto& x) -> decltype(log(x)) { return log(x); }),
      ofOne("log2", 0.125, 9, [](const auto& x) -> decltype(log2(x)) { return log2(x); }),
      ofOne("log10", 0.125, 9, [](const auto& x) -> decltype(log10(x)) { return log10(x); }),
      ofOne("log1p", -0.875, 9, [](const auto& x) -> decltype(log1p(x)) { return log1p(x); }),
      ofOne("sin", -9, 9, [](const auto& x) -> decltype(sin(x)) { return sin(x); }),
      ofOne("cos", -9, 9, [](const auto& x) -> decltype(cos(x)) { return cos(x); }),
      ofOne("tan", -1.5, 1.5, [](const auto& x) -> decltype(tan(x)) { return tan(x); }),
      ofOne("asin", -0.875, 0.875, [](const auto& x) -> decltype(asin(x)) { return asin(x); }),
      ofOne("acos", -0.875, 0.875, [](const auto& x) -> decltype(acos(x)) { return acos(x); }),
      ofOne("atan", -9, 9, [](const auto& x) -> decltype(atan(x)) { return atan(x); }),
      ofOne("sinh", -3, 3, [](const auto& x) -> decltype(sinh(x)) { return sinh(x); }),
      ofOne("cosh", -3, 3, [](const auto& x) -> decltype(cosh(x)) { return cosh(x); }),
      ofOne("tanh", -3, 3, [](const auto& x) -> decltype(tanh(x)) { return tanh(x); }),
      ofOne("asinh", -9, 9, [](const auto& x) -> decltype(asinh(x)) { return asinh(x); }),
      ofOne("acosh", 1.25, 9, [](const auto& x) -> decltype(acosh(x)) { return acosh(x); }),
      ofOne("atanh", -0.875, 0.875, [](const auto& x) -> decltype(atanh(x)) { return atanh(x); }),
      ofOne("sign", -2, 2, [](const auto& x) -> decltype(sign(x)) { return sign(x); }),
      ofOne("floor", -8, 8, [](const auto& x) -> decltype(floor(x)) { return floor(x); }),
      ofOne("ceil", -8, 8, [](const auto& x) -> decltype(ceil(x)) { return ceil(x); }),
      ofOne("trunc", -8, 8, [](const auto& x) -> decltype(trunc(x)) { return trunc(x); }),
      ofOne("round", -8, 8, [](const auto& x) -> decltype(round(x)) { return round(x); }),
      ofOne("pow 3", -3, 3, [](const auto& x) -> decltype(pow(x, 3)) { return pow(x, 3); }),
      ofOne("pow -2", 0.25, 3, [](const auto& x) -> decltype(pow(x, -2)) { return pow(x, -2); }),
      ofOne("pow 1.5", 0.25, 3, [](const auto& x) -> decltype(pow(x, 1.5)) { return pow(x, 1.5); }),
      ofTwo("pow", {0.25, 3}, {-2, 2}, [](const auto& x, const auto& y) -> decltype(pow(x, y)) { return pow(x, y); }),
      ofTwo("atan2", {-8, 8}, {0.25, 8},
            [](const auto& y, const auto& x) -> decltype(atan2(y, x)) { return atan2(y, x); }),
      ofTwo("hypot", {-8, 8}, {0.25, 8},
            [](const auto& x, const auto& y) -> decltype(hypot(x, y)) { return hypot(x, y); }),
      ofTwo("min", {-8, 8}, {-8, 8}, [](const auto& x, const auto& y) -> decltype(min(x, y)) { return min(x, y); }),
      ofTwo("max", {-8, 8}, {-8, 8}, [](const auto& x, const auto& y) -> decltype(max(x, y)) { return max(x, y); })};
  return operations;
}

}  // namespace

const std::vector<Operation>& arithmetic() {
  static const std::vector<Operation> operations{
      ofTwo("x + y", {-8, 8}, {-8, 8}, [](const auto& x, const auto& y) { return x + y; }),
      ofTwo("x - y", {-8, 8}, {-8, 8}, [](const auto& x, const auto& y) { return x - y; }),
      ofTwo("x * y", {-8, 8}, {-8, 8}, [](const auto& x, const auto& y) { return x * y; }),
      ofTwo("x / y", {-8, 8}, {0.25, 8}, [](const auto& x, const auto& y) { return x / y; }),
      ofOne("-x", -8, 8, [](const auto& x) { return -x; }),
      ofOne("sqrt", 0, 9, [](const auto& x) -> decltype(sqrt(x)) { return sqrt(x); }),
      ofTwo("(x * y - x) / (y + 9)", {-8, 8}, {-8, 8},
            [](const auto& x, const auto& y) { return (x * y - x) / (y + 9.0); }),
      ofTwo("sqrt(1 + x * x / (2 + y * y))", {-8, 8}, {-8, 8},
            [](const auto& x, const auto& y) { return sqrt(1.0 + x * x / (2.0 + y * y)); })};
  return operations;
}

const std::vector<Operation>& everyOperation() {
  static const std::vector<Operation> operations = [] {
    std::vector<Operation> all = arithmetic();
    all.insert(all.end(), functions().begin(), functions().end());
    return all;
  }();
  return operations;
}

}  // namespace gamut::testing
