// The truth where right-hand sides have kinks and jumps: events are located in 128 bits.
#pragma once

#include <algorithm>
#include <vector>

#include "scalars/program/recorder.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {

/// Integrates from event to event: the arguments of all abs and sign keep their signs in between.
class EventReference : private Reference {
 public:
  explicit EventReference(const Program& f) : Reference(f), switches_(argumentsOf(f)) {}

  std::vector<Vector> operator()(const Vector& start, const std::vector<double>& times) {
    const auto n = static_cast<std::size_t>(f_.states());
    Vector x(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(n));
    const Vector p(start.begin() + static_cast<std::ptrdiff_t>(n), start.end());
    series_.setParameters(p);
    switches_.setParameters(p);
    std::vector<Vector> result;
    Precise t(0.0);
    for (;;) {
      series_.solve(t, x);
      Precise h = std::min(reach(), Precise(0.125));
      const std::vector<int> before = signs(t + h * Precise(1e-20), after(h * Precise(1e-20)));
      const auto left = [&](const Precise& tau) { return leastLeft(before, t + tau, after(tau)); };
      // No more than a part of the step may hide two events of one argument: all of its tenths are looked at.
      for (int part = 1; part <= 10; ++part) {
        Precise high = h * part / 10;
        if (left(high) > 0) continue;
        high = behindRoot(left, Precise(part == 1 ? Precise(h * Precise(1e-20)) : Precise(h * (part - 1) / 10)), high);
        h = high + Precise(0x1p-110);  // just behind the event
        ++events;
        break;
      }
      while (result.size() < times.size() && Precise(times[result.size()]) <= t + h)
        result.push_back(after(Precise(times[result.size()]) - t));
      if (result.size() == times.size()) return result;
      x = after(h);
      t += h;
    }
  }

  int events = 0;

 private:
  static Program argumentsOf(const Program& f) {
    std::vector<int> arguments;
    for (const Node& node : f.nodes())
      if (node.op == Op::abs || node.op == Op::sign) arguments.push_back(node.a);
    return Recorder(f).finish(arguments);
  }
  std::vector<int> signs(const Precise& t, const Vector& x) {
    std::vector<int> result;
    for (const Precise& value : switches_(t, x)) result.push_back(value > 0 ? 1 : value < 0 ? -1 : 0);
    return result;
  }
  /// Of the arguments, what is left of the one that is nearest to another sign than it had; zero or less: it is there.
  Precise leastLeft(const std::vector<int>& before, const Precise& t, const Vector& x) {
    Precise least(1e300);
    const Vector values = switches_(t, x);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (before[k] != 0 || values[k] != 0)
        least = std::min(least, Precise(before[k] != 0 ? Precise(values[k] * before[k]) : Precise(-abs(values[k]))));
    return least;
  }
  Evaluator<Precise> switches_;
};

}  // namespace gamut::testing
