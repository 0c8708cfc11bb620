// Recorded is a scalar that writes down what is done with it: code that is generic over its scalar, run once with
// Recorded, becomes a Program. A function of two variables, and the right-hand side of a pendulum (one state pair,
// length as parameter):
//
//     Program f = record<2>([](const auto& x) { return x[0] * sin(x[1]); });
//     Program g = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
//       dx[0] = x[1];
//       dx[1] = -9.81 / p[0] * sin(x[0]);
//     });
//
// A plain number such as 9.81 is the double nearest to it; write `constant<Recorded>(Interval("9.81"))` for the
// decimal. docs/recording.md is the user's guide.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "scalars/index.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "scalars/program/recorder.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// The type of comparisons of Recorded, which do not compile; its name stands in the compiler's message.
struct NoComparison_a_recorded_function_cannot_branch_on_values;

/// A node of the program being recorded on this thread, or a constant that needs no node yet. Throws std::logic_error
/// where it is computed with outside of record(), or in another record() than its own.
class Recorded {
 public:
  Recorded() : Recorded(0.0) {}
  Recorded(double value) : constant_(value) {}  // NOLINT(google-explicit-*): implicit, as numbers are
  /// A number that is not a double gets its node at once, so that copies of it stay one number.
  explicit Recorded(const Interval& value) : constant_(value) {
    if (Recorder* current = Recorder::current(); current != nullptr && !isThin(value))
      *this = node(current->constant(value));
  }
  /// Node `number` of the current recorder.
  static Recorded node(int number) {
    Recorded r;
    r.node_ = number;
    r.recorder_ = recorder().identity();
    return r;
  }

  /// The number of this value's node in the current recorder; a constant gets one.
  int node() const {
    Recorder& current = recorder();
    if (node_ < 0) return current.constant(constant_);
    if (recorder_ != current.identity())
      throw std::logic_error(
          "a Recorded of one record() is used in another: record both in one, or pass it a variable");
    return node_;
  }

  friend Recorded operator+(const Recorded& a, const Recorded& b) { return of<&Recorder::add>(a, b); }
  friend Recorded operator-(const Recorded& a, const Recorded& b) { return of<&Recorder::sub>(a, b); }
  friend Recorded operator*(const Recorded& a, const Recorded& b) { return of<&Recorder::mul>(a, b); }
  friend Recorded operator/(const Recorded& a, const Recorded& b) {
    const int inverse = recorder().recip(b.node());
    return node(recorder().mul(a.node(), inverse));
  }
  friend Recorded operator-(const Recorded& a) { return node(recorder().neg(a.node())); }
  friend Recorded operator+(const Recorded& a) { return a; }

  friend NoComparison_a_recorded_function_cannot_branch_on_values operator==(const Recorded&, const Recorded&) = delete;
  friend NoComparison_a_recorded_function_cannot_branch_on_values operator<=>(const Recorded&,
                                                                              const Recorded&) = delete;
  Recorded& operator+=(const Recorded& b) { return *this = *this + b; }
  Recorded& operator-=(const Recorded& b) { return *this = *this - b; }
  Recorded& operator*=(const Recorded& b) { return *this = *this * b; }
  Recorded& operator/=(const Recorded& b) { return *this = *this / b; }

  // What a Program has an operation for.
  friend Recorded sqr(const Recorded& a) { return node(recorder().sqr(a.node())); }
#define GAMUT_FUNCTION(name) \
  friend Recorded name(const Recorded& a) { return node(recorder().name(a.node())); }
  GAMUT_FUNCTIONS(GAMUT_FUNCTION)
#undef GAMUT_FUNCTION

  // What is composed of these, by formulas that hold exactly on the domains given: at the boundary of a domain that is
  // written open, and at a pole, evaluation divides by zero. log 2, log 10 and atan 1 are recorded as such, not as
  // doubles.

  /// sin x / cos x, for cos x ≠ 0.
  friend Recorded tan(const Recorded& x);
  /// 2·atan(x / (1 + √(1-x²))), for |x| <= 1 (differentiable for |x| < 1).
  friend Recorded asin(const Recorded& x);
  /// 2·(atan 1 - atan(x / (1 + √(1-x²)))), for |x| <= 1 (differentiable for |x| < 1); in doubles digits are lost near x
  /// = 1.
  friend Recorded acos(const Recorded& x);
  /// 2·atan(y / (x + √(x²+y²))), everywhere but where y is 0 and x <= 0: the angle in (-π, π). In doubles digits are
  /// lost where x < 0 and |y| << |x|: x + √ cancels there. (No one formula is free of it for all angles.) Of a y that
  /// is 0 whatever the inputs are, 0 or π, and at x = 0 their mean.
  friend Recorded atan2(const Recorded& y, const Recorded& x);
  /// ½(eˣ - e⁻ˣ); in doubles digits are lost near x = 0.
  friend Recorded sinh(const Recorded& x);
  /// ½(eˣ + e⁻ˣ).
  friend Recorded cosh(const Recorded& x);
  /// log(x + √(x²+1)), for all x; in doubles digits are lost near x = 0 and where x is large and negative.
  friend Recorded asinh(const Recorded& x);
  /// log(x + √(x²-1)), for x >= 1 (differentiable for x > 1); in doubles digits are lost near x = 1.
  friend Recorded acosh(const Recorded& x);
  /// ½ log((1+x)/(1-x)), for |x| < 1; in doubles digits are lost near x = 0.
  friend Recorded atanh(const Recorded& x);
  /// e^{x log 2}.
  friend Recorded exp2(const Recorded& x);
  /// e^{x log 10}.
  friend Recorded exp10(const Recorded& x);
  /// eˣ - 1; in doubles digits are lost near x = 0.
  friend Recorded expm1(const Recorded& x);
  /// log x / log 2, for x > 0.
  friend Recorded log2(const Recorded& x);
  /// log x / log 10, for x > 0.
  friend Recorded log10(const Recorded& x);
  /// log(1+x), for x > -1; in doubles digits are lost near x = 0.
  friend Recorded log1p(const Recorded& x);
  /// e^{⅓ log x}, for x > 0.
  friend Recorded cbrt(const Recorded& x);
  /// e^{(log x)/n}, for x > 0 and n ≠ 0.
  friend Recorded rootn(const Recorded& x, int n);
  /// x where the condition is above 0, y where it is below; where it is 0, their mean, and in ẋ = f all that lies
  /// between.
  friend Recorded where(const Recorded& condition, const Recorded& x, const Recorded& y);
  /// ½(x + y - |x - y|) and ½(x + y + |x - y|) (differentiable for x ≠ y); in doubles digits are lost where the result
  /// is much smaller than the other number.
  friend Recorded min(const Recorded& x, const Recorded& y);
  friend Recorded max(const Recorded& x, const Recorded& y);
  /// √(x²+y²) (differentiable except where both are 0).
  friend Recorded hypot(const Recorded& x, const Recorded& y);
  /// Repeated multiplication; for a negative exponent its reciprocal, for x ≠ 0.
  friend Recorded pow(const Recorded& x, int exponent);
  /// A whole exponent below 1024 as repeated multiplication; any other as e^{exponent·log x}, for x > 0.
  friend Recorded pow(const Recorded& x, double exponent);
  /// e^{y log x}, for x > 0.
  friend Recorded pow(const Recorded& x, const Recorded& y);

 private:
  static Recorder& recorder() {
    if (Recorder* current = Recorder::current()) return *current;
    throw std::logic_error("arithmetic on Recorded outside of record(): no program is being recorded");
  }
  /// The right operand gets its node first, whatever the compiler: programs are the same everywhere.
  template <int (Recorder::*operation)(int, int)>
  static Recorded of(const Recorded& a, const Recorded& b) {
    const int right = b.node();
    return node((recorder().*operation)(a.node(), right));
  }

  int node_ = -1;
  std::uint64_t recorder_ = 0;  // the identity of the one that node_ belongs to
  Interval constant_;
};

template <>
struct ScalarTraits<Recorded> {
  static Recorded constant(const Interval& value) { return Recorded(value); }
};

/// The outputs of f at the states x, parameters p and time t, written down node by node in the program that is being
/// recorded.
std::vector<Recorded> written(const Program& f, const std::vector<Recorded>& x, const std::vector<Recorded>& p,
                              const Recorded& t);

/// True only if x is the number 0 whatever the inputs are: known while recording, never asked of a value. Terms that
/// are known zeros may be left out; the result is the same number with or without them.
template <class S>
bool isKnownZero(const S&) {
  return false;
}
inline bool isKnownZero(const Recorded& x) { return Recorder::current()->isExactly(x.node(), 0.0); }

/// True only if x and y are the same number whatever the inputs are.
template <class S>
bool isKnownSame(const S&, const S&) {
  return false;
}
inline bool isKnownSame(const Recorded& x, const Recorded& y) { return x.node() == y.node(); }

/// True only if x is a number other than 0 whatever the inputs are.
template <class S>
bool isKnownNonzero(const S&) {
  return false;
}
inline bool isKnownNonzero(const Recorded& x) {
  const Recorder* recorder = Recorder::current();
  const int node = x.node();
  return recorder->isConstant(node) && !contains(recorder->value(node), 0.0);
}

/// Makes `recorder` the one that this thread's Recorded numbers write to, for the life of the guard.
class RecordingGuard {
 public:
  explicit RecordingGuard(Recorder& recorder) : before_(Recorder::current()) { Recorder::current() = &recorder; }
  ~RecordingGuard() { Recorder::current() = before_; }
  RecordingGuard(const RecordingGuard&) = delete;
  RecordingGuard& operator=(const RecordingGuard&) = delete;

 private:
  Recorder* before_;
};

namespace detail {

/// A vector or array of Recorded that refuses an index beyond its end.
template <class Container>
class Checked : public Container {
 public:
  using Container::Container;
  using Container::operator=;
  Recorded& operator[](std::size_t i) { return Container::operator[](checked(i)); }
  const Recorded& operator[](std::size_t i) const { return Container::operator[](checked(i)); }

 private:
  std::size_t checked(std::size_t i) const {
    if (i < this->size()) return i;
    throw std::out_of_range("number " + std::to_string(i) + " is used in a recorded function, which has " +
                            std::to_string(this->size()) + ", counted from 0");
  }
};

}  // namespace detail

/// Records y = f(t, x, p): `function(t, x, p, y)` with n states, k parameters and m outputs. The rules are applied
/// while recording; RuleSet::none() keeps every operation as it was written.
template <class Function>
Program record(int n, int k, int m, Function&& function, RuleSet rules = RuleSet::all()) {
  Recorder recorder(n, k, rules);
  const RecordingGuard guard(recorder);
  detail::Checked<std::vector<Recorded>> x, p, y(detail::at(m));
  for (int i = 0; i < n; ++i) x.push_back(Recorded::node(recorder.state(i)));
  for (int i = 0; i < k; ++i) p.push_back(Recorded::node(recorder.parameter(i)));
  function(Recorded::node(recorder.time()), std::as_const(x), std::as_const(p), y);
  if (y.size() != detail::at(m))
    throw std::invalid_argument("a recorded function gave " + std::to_string(y.size()) + " outputs, not " +
                                std::to_string(m));
  std::vector<int> outputs;
  for (const Recorded& value : y) outputs.push_back(value.node());
  return recorder.finish(outputs);
}

/// Records the right-hand side of ẋ = f(t, x, p): n states, k parameters, `function(t, x, p, dx)`.
template <class Function>
Program record(int n, int k, Function&& function) {
  return record(n, k, n, std::forward<Function>(function));
}

namespace detail {

/// Stands for the N variables where a function asks for a vector type of its own, such as an Eigen vector: becomes any
/// type whose elements can be assigned one by one.
template <std::size_t N>
struct Variables {
  const Checked<std::array<Recorded, N>>& values;
  template <class Vector>
  requires(!std::is_arithmetic_v<Vector>) && std::is_default_constructible_v<Vector>&& requires(Vector v,
                                                                                                const Recorded& r) {
    v[0] = r;
  }
  operator Vector() const {  // NOLINT(google-explicit-*): implicit, so that it can be an argument
    Vector result;
    if constexpr (requires { result.resize(N); }) result.resize(N);
    for (std::size_t i = 0; i < N; ++i) result[static_cast<decltype(result.size())>(i)] = values[i];
    return result;
  }
};

/// True for a function of as many scalars, two or more. (Of one argument a generic function could be either; it is a
/// vector then.)
template <class Function, std::size_t... I>
constexpr bool takesScalars(std::index_sequence<I...>) {
  if constexpr (sizeof...(I) > 1)
    return std::is_invocable_v<Function&, const std::tuple_element_t<I, std::array<Recorded, sizeof...(I)>>&...>;
  else
    return false;
}

/// function(x), whatever form of N variables it takes.
template <std::size_t N, class Function>
decltype(auto) applied(Function& function, const Checked<std::array<Recorded, N>>& x) {
  if constexpr (takesScalars<Function>(std::make_index_sequence<N>()))
    return std::apply(function, static_cast<const std::array<Recorded, N>&>(x));
  else if constexpr (std::is_invocable_v<Function&, decltype(x)>)
    return function(x);
  else
    return function(Variables<N>{x});
}

/// Whatever a function returned, as nodes: one scalar, or the elements of an array, vector, span or Eigen vector.
template <class Result>
std::vector<int> outputNodes(const Result& result) {
  std::vector<int> nodes;
  if constexpr (requires { typename Result::PlainObject; })
    static_assert(std::is_same_v<Result, typename Result::PlainObject>,
                  "return the .eval() of an Eigen expression: it refers to variables that end with the function");
  if constexpr (std::is_convertible_v<const Result&, Recorded>) {
    nodes.push_back(static_cast<Recorded>(result).node());
  } else {
    static_assert(
        requires { result[0], result.size(); },
        "a recorded function returns a scalar, or an array or vector of scalars");
    for (decltype(result.size()) i = 0; i < result.size(); ++i)
      nodes.push_back(static_cast<Recorded>(result[i]).node());
  }
  return nodes;
}

}  // namespace detail

/// Records a function of N variables, which become the states of the program. `function` takes them as N scalars, or as
/// one array, span or vector of scalars (std::array<Recorded, N> for `const auto&`, or what it asks for: an Eigen
/// vector), and returns one scalar or an array or vector of them: as many outputs. One variable is x[0].
template <int N, class Function>
requires(N >= 0) Program record(Function&& function, RuleSet rules = RuleSet::all()) {
  Recorder recorder(N, 0, rules);
  const RecordingGuard guard(recorder);
  detail::Checked<std::array<Recorded, static_cast<std::size_t>(N)>> x;
  for (int i = 0; i < N; ++i) x[i] = Recorded::node(recorder.state(i));
  return recorder.finish(detail::outputNodes(detail::applied(function, x)));
}

/// The same where the number of variables is known at run time only; `function` takes a vector of scalars.
template <class Function>
Program record(int n, Function&& function, RuleSet rules = RuleSet::all()) {
  Recorder recorder(n, 0, rules);
  const RecordingGuard guard(recorder);
  detail::Checked<std::vector<Recorded>> x;
  for (int i = 0; i < n; ++i) x.push_back(Recorded::node(recorder.state(i)));
  return recorder.finish(detail::outputNodes(function(std::as_const(x))));
}

}  // namespace gamut
