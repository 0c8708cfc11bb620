// Recorded is a scalar that writes down what is done with it: code that is generic over its scalar, run once with
// Recorded, becomes a Program. Example (a pendulum, one state pair, length as parameter):
//
//     Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
//       dx[0] = x[1];
//       dx[1] = -9.81 / p[0] * sin(x[0]);
//     });
//
// A plain number such as 9.81 is the double nearest to it; write `constant<Recorded>(Interval("9.81"))` for the
// decimal.
#pragma once

#include <stdexcept>
#include <utility>
#include <vector>

#include "scalars/index.hpp"
#include "scalars/interval.hpp"
#include "scalars/program.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// A node of the program being recorded on this thread, or a constant that needs no node yet.
class Recorded {
 public:
  Recorded() : Recorded(0.0) {}
  Recorded(double value) : constant_(value) {}  // NOLINT: implicit, as numbers are
  /// A number that is not a double gets its node at once, so that copies of it stay one number.
  explicit Recorded(const Interval& value) : constant_(value) {
    if (Recorder* current = Recorder::current(); current != nullptr && !isThin(value)) node_ = current->constant(value);
  }
  static Recorded node(int number) {
    Recorded r;
    r.node_ = number;
    return r;
  }

  /// The number of this value's node in the current recorder; a constant gets one.
  int node() const { return node_ >= 0 ? node_ : recorder().constant(constant_); }

  friend Recorded operator+(const Recorded& a, const Recorded& b) { return node(recorder().add(a.node(), b.node())); }
  friend Recorded operator-(const Recorded& a, const Recorded& b) { return node(recorder().sub(a.node(), b.node())); }
  friend Recorded operator*(const Recorded& a, const Recorded& b) { return node(recorder().mul(a.node(), b.node())); }
  friend Recorded operator/(const Recorded& a, const Recorded& b) {
    return node(recorder().mul(a.node(), recorder().recip(b.node())));
  }
  friend Recorded operator-(const Recorded& a) { return node(recorder().neg(a.node())); }
  friend Recorded operator+(const Recorded& a) { return a; }
  Recorded& operator+=(const Recorded& b) { return *this = *this + b; }
  Recorded& operator-=(const Recorded& b) { return *this = *this - b; }
  Recorded& operator*=(const Recorded& b) { return *this = *this * b; }
  Recorded& operator/=(const Recorded& b) { return *this = *this / b; }

  friend Recorded sqr(const Recorded& a) { return node(recorder().sqr(a.node())); }
  friend Recorded sqrt(const Recorded& a) { return node(recorder().sqrt(a.node())); }
  friend Recorded exp(const Recorded& a) { return node(recorder().exp(a.node())); }
  friend Recorded log(const Recorded& a) { return node(recorder().log(a.node())); }
  friend Recorded sin(const Recorded& a) { return node(recorder().sin(a.node())); }
  friend Recorded cos(const Recorded& a) { return node(recorder().cos(a.node())); }
  friend Recorded atan(const Recorded& a) { return node(recorder().atan(a.node())); }
  friend Recorded tan(const Recorded& a) { return sin(a) / cos(a); }
  /// asin x = atan(x / √(1-x²)), for |x| < 1.
  friend Recorded asin(const Recorded& a) { return atan(a / sqrt(Recorded(1.0) - sqr(a))); }
  friend Recorded acos(const Recorded& a);
  friend Recorded sinh(const Recorded& a) { return 0.5 * (exp(a) - exp(-a)); }
  friend Recorded cosh(const Recorded& a) { return 0.5 * (exp(a) + exp(-a)); }
  /// tanh x = 1 - 2/(e^{2x}+1).
  friend Recorded tanh(const Recorded& a) { return 1.0 - 2.0 / (exp(2.0 * a) + 1.0); }
  friend Recorded pow(const Recorded& a, int exponent);
  /// A whole exponent as repeated multiplication; any other as e^{b log a}, for positive a.
  friend Recorded pow(const Recorded& a, double exponent);
  friend Recorded pow(const Recorded& a, const Recorded& b) { return exp(b * log(a)); }

 private:
  static Recorder& recorder() {
    if (Recorder* current = Recorder::current()) return *current;
    throw std::logic_error("arithmetic on Recorded outside of record(): no program is being recorded");
  }
  int node_ = -1;
  Interval constant_;
};

// Friends are found by argument-dependent lookup; these declarations make them visible to qualified calls too.
Recorded acos(const Recorded& a);
Recorded pow(const Recorded& a, int exponent);
Recorded pow(const Recorded& a, double exponent);

template <>
struct ScalarTraits<Recorded> {
  static Recorded constant(const Interval& value) { return Recorded(value); }
};

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

/// Records y = f(t, x, p): `function(t, x, p, y)` with n states, k parameters and m outputs.
template <class Function>
Program record(int n, int k, int m, Function&& function) {
  Recorder recorder(n, k);
  const RecordingGuard guard(recorder);
  std::vector<Recorded> x, p, y(detail::at(m));
  for (int i = 0; i < n; ++i) x.push_back(Recorded::node(recorder.state(i)));
  for (int i = 0; i < k; ++i) p.push_back(Recorded::node(recorder.parameter(i)));
  const std::vector<Recorded>& constX = x;
  const std::vector<Recorded>& constP = p;
  function(Recorded::node(recorder.time()), constX, constP, y);
  std::vector<int> outputs;
  for (const Recorded& value : y) outputs.push_back(value.node());
  return recorder.finish(outputs);
}

/// Records the right-hand side of ẋ = f(t, x, p): n states, k parameters, `function(t, x, p, dx)`.
template <class Function>
Program record(int n, int k, Function&& function) {
  return record(n, k, n, std::forward<Function>(function));
}

}  // namespace gamut
