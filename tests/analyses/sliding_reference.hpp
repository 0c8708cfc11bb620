// The truth where solutions are held at jumps: events are located in 128 bits, and in between f is smooth.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "scalars/program/recorder.hpp"
#include "scalars/program/sides.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {

/// Integrates from event to event: every jump is on a side or held.
class SlidingReference {
 public:
  /// `rest` sets those states exactly that are held, which series only are to some 1e-33.
  using Rest = std::function<void(const std::vector<Side>&, const Vector& parameters, Vector& states)>;
  SlidingReference(Program f, Rest rest) : f_(std::move(f)), given_(withSignsGiven(f_)), rest_(std::move(rest)) {}

  /// And values of g: signs in it that are signs of f's surfaces are as they are on the sides that the motion is on.
  SlidingReference(Program f, Program g, Rest rest) : SlidingReference(std::move(f), std::move(rest)) {
    g_ = std::move(g);
  }

  std::vector<Vector> operator()(const Vector& start, const std::vector<double>& times) {
    const auto n = static_cast<std::ptrdiff_t>(f_.states());
    p_.assign(start.begin() + n, start.end());
    choices_ = 0;
    moments.clear();
    for (auto& [sides, phase] : phases_) phase->setParameters(p_);
    Vector x(start.begin(), start.begin() + n);
    Precise t(0.0);
    sides_.assign(jumpsOf(f_).size(), Side::between);
    for (int pass = 0; pass < 3; ++pass)  // where one goes may depend on where others do
      for (std::size_t k = 0; k < sides_.size(); ++k) {
        const Precise u = rates(t, x)[at(k, 0)];
        if (u != 0)
          sides_[k] = u > 0 ? Side::above : Side::below;
        else if (pass > 0)
          sides_[k] = sideFrom(k, t, x);
      }
    std::vector<Vector> result;
    outputs.clear();
    limits.clear();
    while (result.size() < times.size() && moments.size() <= most) {
      Phase& phase = phaseOf(sides_);
      phase.series.solve(t, x);
      Precise h = reach(phase);
      const Precise event = firstEvent(phase, t, h);
      if (event < h) h = event + Precise(0x1p-108);
      while (result.size() < times.size() && Precise(times[result.size()]) <= t + h) {
        const Precise time(times[result.size()]);
        result.push_back(after(phase, time - t));
        if (g_) outputs.push_back((*phase.outputs)(time, result.back()));
      }
      x = after(phase, h);
      t += h;
      if (event >= h || result.size() == times.size())
        continue;  // what comes after the last time is not of this motion
      ++events;
      moments.push_back(t.convert_to<double>());
      if (g_) limits.push_back((*phase.outputs)(t, x));
      const Vector now = phase.all(t, x);
      for (std::size_t k = 0; k < sides_.size(); ++k)
        if (watched(k, now) < -tiny) {
          const Precise& s = now[at(k, 1)];
          sides_[k] = sides_[k] == Side::held ? (s > 0 ? Side::above : Side::below) : sideFrom(k, t, x);
        }
      rest_(sides_, p_, x);
      if (g_) limits.push_back((*phaseOf(sides_).outputs)(t, x));
    }
    return result;
  }

  /// Of the first jump, at the end of the last motion.
  bool isHeld() const { return !sides_.empty() && sides_[0] == Side::held; }

  /// Whether the last motion is the only one from its start: none drove away from a surface that it was at, which any
  /// may leave to either side at any time.
  bool isUnique() const { return choices_ == 0; }
  /// To which side those leave that may leave to either; the one to which they are driven faster: between.
  Side leaves = Side::between;

  /// How far arguments are beyond zero, or signs beyond 1, where that is an event: what makes the motion differ from
  /// the truth, besides steps, whose length is this part of what it may be.
  Precise tiny = Precise(1e-30), share = Precise(1.0);

  /// So many events of one motion are followed; it ends with the next one.
  std::size_t most = static_cast<std::size_t>(-1);

  int events = 0;
  std::vector<double> moments;          ///< of the last motion's events, s
  std::vector<Vector> outputs, limits;  ///< of the last motion, at its times; just before and behind its events

 private:
  static constexpr int order = 30, parts = 32;
  struct Phase {
    Phase(const Program& onSides, int states)
        : all(onSides),
          f(Recorder(onSides).finish({onSides.outputNodes().begin(), onSides.outputNodes().begin() + states})),
          series(f, order) {}
    void setParameters(const Vector& p) {
      all.setParameters(p);
      series.setParameters(p);
      if (outputs) outputs->setParameters(p);
    }
    Evaluator<Precise> all;
    std::optional<Evaluator<Precise>> outputs;
    Program f;
    Series<Precise> series;
  };

  std::size_t at(std::size_t k, std::size_t group) const {
    return static_cast<std::size_t>(f_.states()) + group * sides_.size() + k;
  }
  Phase& phaseOf(const std::vector<Side>& sides) {
    std::unique_ptr<Phase>& phase = phases_[sides];
    if (phase) return *phase;
    phase = std::make_unique<Phase>(onSides(f_, sides), f_.states());
    if (g_) phase->outputs.emplace(outputsOnSides(f_, *g_, sides));
    phase->setParameters(p_);
    return *phase;
  }
  /// f, arguments and their rates, with signs as they are, but for one.
  Vector rates(const Precise& t, const Vector& x, std::size_t k = static_cast<std::size_t>(-1), double sign = 0) {
    Vector signs;
    const Vector now = phaseOf(sides_).all(t, x);
    for (std::size_t j = 0; j < sides_.size(); ++j) signs.push_back(j == k ? Precise(sign) : now[at(j, 1)]);
    Vector all = p_;
    all.insert(all.end(), signs.begin(), signs.end());
    given_.setParameters(all);
    return given_(t, x);
  }
  Side sideFrom(std::size_t k, const Precise& t, const Vector& x) {
    const Precise up = rates(t, x, k, 1)[at(k, 1)], down = rates(t, x, k, -1)[at(k, 1)];
    if (up < 0 && down > 0) return Side::held;
    const bool isChoice = up > 0 && down < 0;
    choices_ += isChoice;
    return isChoice && leaves != Side::between ? leaves : up + down > 0 ? Side::above : Side::below;
  }
  /// Where the last orders are 1e-34 of the states, by doubles: a step's length may be any.
  Precise reach(Phase& phase) const {
    Precise largest(0x1p-20);
    for (int s = 0; s < f_.states(); ++s)
      largest = std::max({largest, Precise(abs(phase.series.at(s, 0))), Precise(abs(phase.series.at(s, 1)))});
    double h = -3;  // log2
    const double size = std::log2(1e-34) + log2Of(largest);
    for (int s = 0; s < f_.states(); ++s)
      for (int i = order / 2; i <= order; ++i) h = std::min(h, (size - log2Of(phase.series.at(s, i))) / i);
    return share * Precise(std::exp2(h));
  }
  Vector after(Phase& phase, const Precise& tau) {
    Vector x = sumsOf(phase.series, f_.states(), order, tau);
    rest_(sides_, p_, x);
    return x;
  }
  /// Negative once the phase is over for jump k; of f, arguments and signs.
  Precise watched(std::size_t k, const Vector& all) const {
    if (sides_[k] == Side::held) return 1 - all[at(k, 1)] * all[at(k, 1)];
    return all[at(k, 0)] * static_cast<int>(sides_[k]);
  }
  /// No more than a part of the step may hide two events of one jump: all of its parts are looked at.
  Precise firstEvent(Phase& phase, const Precise& t, const Precise& h) {
    const auto left = [&](const Precise& tau) {
      Precise least(1e300);
      const Vector all = phase.all(Precise(t + tau), after(phase, tau));
      for (std::size_t k = 0; k < sides_.size(); ++k) least = std::min(least, Precise(watched(k, all) + tiny));
      return least;
    };
    if (sides_.empty()) return 2 * h;
    for (int part = 1; part <= parts; ++part)
      if (const Precise high = h * part / parts; !(left(high) > 0))
        return behindRoot(left, Precise(h * (part - 1) / parts), high);
    return 2 * h;
  }

  Program f_;
  Evaluator<Precise> given_;
  std::optional<Program> g_;
  Rest rest_;
  Vector p_;
  int choices_ = 0;
  std::vector<Side> sides_;
  std::map<std::vector<Side>, std::unique_ptr<Phase>> phases_;
};

}  // namespace gamut::testing
