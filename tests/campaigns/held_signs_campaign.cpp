// Random motions that come to surfaces of their jumps, are held there and leave, with outputs, alpha-cuts, models and
// requirements that hold signs of these surfaces, accelerations and friction forces among them; trajectories whose
// events are located in 128 bits, corners first, must lie in all of them, at output times and between, compared
// exactly, but for what these trajectories are off themselves; none may violate a requirement that is told to be met.
// Flows that end early, for their work is limited, are judged up to where they came, and counted apart. Where outputs
// of what is held are wide, twenty times the work is tried. Where motions may leave a surface to either side at any
// time, trajectories leave to both sides, though they do not tell then how wide anything has to be, nor what is met.
// Usage:
//     held_signs_campaign [systems = 10000] [first = 0] [seconds of work for a flow = 0.2]
// Prints what was judged, how wide the outputs are where motions are held, and how many of the requirements that are
// met by a hundredth of the output's range are told to be; where HELD_SIGNS_MISSES is set, those that are not, what is
// wide, and what ended early. The exit status is 1 if something does not hold.
#include <fmt/format.h>
#include <gtest/gtest-spi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "analyses/requirements/requirement.hpp"
#include "tests/analyses/even_quantity.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/flow/jumping_machine.hpp"
#include "tests/analyses/sliding_reference.hpp"

namespace gamut::testing {
namespace {

class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}
  /// Of 0 … count - 1.
  int roll(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  bool happens(double share) { return between(0, 1) < share; }
  /// A multiple of 2^-10 of the width.
  double between(double lower, double upper) { return lower + (upper - lower) * roll(1025) / 1024; }

 private:
  std::mt19937 engine_;
};

/// ẋ_i = b_i + Σ A_ij x_j + a_i sin(ω t) - m_i sign(u_i), with u_i = x_i - w p_0 or x_i - x_j, times a factor; m_0 is
/// p_1.
struct System {
  static constexpr int most = 3;
  int n = 1;
  std::array<std::array<double, most>, most> A{};
  std::array<double, most> b{}, a{}, m{}, factor{}, shift{};
  std::array<int, most> partner{};  // x_i - x_partner; -1: x_i - shift p_0
  double omega = 1;
  Box box;
  double horizon = 1;
  std::vector<double> times;

  template <class X, class P>
  auto argument(std::size_t i, const X& x, const P& p) const {
    return partner[i] >= 0 ? x[i] - x[static_cast<std::size_t>(partner[i])] : x[i] - shift[i] * p[0];
  }
  template <class T, class X, class P>
  auto rate(std::size_t i, const T& t, const X& x, const P& p) const {
    auto sum = b[i] + a[i] * sin(omega * t);
    for (std::size_t j = 0; j < static_cast<std::size_t>(n); ++j)
      if (A[i][j] != 0) sum = sum + A[i][j] * x[j];
    if (i == 0) return sum - p[1] * sign(factor[i] * argument(i, x, p));
    return m[i] > 0 ? sum - m[i] * sign(factor[i] * argument(i, x, p)) : sum;
  }
  Program motion() const {
    return record(n, 2, [&](auto t, const auto& x, const auto& p, auto& dx) {
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) dx[i] = rate(i, t, x, p);
    });
  }
  /// Of what is held: exactly, wherever series are to some 1e-33 only.
  SlidingReference::Rest rest() const {
    return [*this](const std::vector<Side>& sides, const Vector& p, Vector& x) {
      std::size_t jump = 0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
        if (i > 0 && m[i] == 0) continue;
        if (jump < sides.size() && sides[jump++] == Side::held)
          x[i] = partner[i] >= 0 ? x[static_cast<std::size_t>(partner[i])] : Precise(shift[i]) * p[0];
      }
    };
  }
};

System systemOf(Dice& dice) {
  System s;
  s.n = 1 + dice.roll(3);
  s.horizon = dice.between(0.75, 2.5);
  s.omega = dice.between(0.5, 4);
  for (std::size_t i = 0; i < static_cast<std::size_t>(s.n); ++i) {
    for (std::size_t j = 0; j < static_cast<std::size_t>(s.n); ++j)
      if (dice.happens(0.4)) s.A[i][j] = dice.between(-0.5, 0.5);
    s.b[i] = dice.happens(0.6) ? dice.between(-0.75, 0.75) : 0;
    s.a[i] = dice.happens(0.3) ? dice.between(-1, 1) : 0;
    s.factor[i] = std::array{1.0, 1.0, -2.0, 0.1, -1.0}[static_cast<std::size_t>(dice.roll(5))];
    if (s.factor[i] < 0 && dice.happens(0.8)) s.factor[i] = -s.factor[i];  // few that repel
    s.m[i] = i > 0 && dice.happens(0.4) ? dice.between(0.5, 1.5) : 0;
    s.shift[i] = dice.happens(0.3) ? dice.between(0.25, 1) : 0;
    s.partner[i] = -1;
  }
  if (s.n > 1 && dice.happens(0.25)) s.partner[0] = 1;
  const double share = std::array{0.0, 0.01, 0.1, 0.3}[static_cast<std::size_t>(dice.roll(4))];
  for (int i = 0; i < s.n; ++i) {
    const double start = dice.happens(0.2) ? 0.0 : dice.between(-1, 1), half = share * dice.between(0.25, 1);
    s.box.push_back(dice.happens(i == 0 ? 0.9 : 0.3) ? Interval(start - half, start + half) : Interval(start));
  }
  const double p0 = dice.between(-0.5, 0.5), p1 = dice.between(0.75, 1.5);
  s.box.push_back(dice.happens(0.2) ? Interval(p0 - 0.1 * share, p0 + 0.1 * share) : Interval(p0));
  s.box.push_back(dice.happens(0.3) ? Interval(p1 * (1 - share / 2), p1 * (1 + share / 2)) : Interval(p1));
  const int rows = 1 + dice.roll(4);
  for (int i = 1; i <= rows; ++i) s.times.push_back(s.horizon * i / rows);
  return s;
}

constexpr int outputCount = 5;

/// Accelerations, friction, what follows a sign, and signs of other surfaces than those of the motion.
Program outputsOf(const System& s, Dice& dice) {
  std::array<int, outputCount> kinds{};
  std::array<double, outputCount> c{}, d{};
  for (std::size_t o = 0; o < kinds.size(); ++o) {
    kinds[o] = dice.roll(10);
    c[o] = dice.between(-2, 2);
    d[o] = dice.between(-2, 2);
  }
  return record(s.n, 2, outputCount, [&](auto t, const auto& x, const auto& p, auto& y) {
    const auto u = s.argument(0, x, p);
    const auto other = x[x.size() - 1];
    for (std::size_t o = 0; o < kinds.size(); ++o) {
      const auto held = sign((c[o] == 0 ? 1.0 : c[o]) * u);
      switch (kinds[o]) {
        case 0:
          y[o] = s.rate(0, t, x, p);
          break;
        case 1:
          y[o] = held;
          break;
        case 2:
          y[o] = (s.rate(0, t, x, p) + c[o]) * (d[o] - t);
          break;
        case 3:
          y[o] = 1.5 - 0.5 * held + d[o] * other;  // where(u > 0, …)
          break;
        case 4:
          y[o] = sqr(held) * (other + d[o]);
          break;
        case 5:
          y[o] = max(p[1] * held + exp(-1.0 - t),
                     d[o] * exp(0.3 + other));  // no double, to which bounds come closer than 128 bits
          break;
        case 6:
          y[o] = held * u + abs(other);
          break;
        case 7:
          y[o] = 1.0 / (2.0 + held) + d[o] * t;
          break;
        case 8:
          y[o] = sin(other) * s.rate(x.size() - 1, t, x, p);
          break;
        default:
          y[o] = abs(p[1] * held + c[o] * other);
      }
    }
  });
}

/// What was told of systems that came to their horizon, or of those that ended early.
struct Answers {
  long asked = 0, truly = 0, told = 0, widths = 0, loose = 0, repeated = 0;
  double ratios = 0;
};

struct Count {
  long systems = 0, ended = 0, atTheStart = 0, trajectories = 0, outside = 0, falselyMet = 0;
  Answers whole, early;
};

/// What trajectories were, output by output: at the last moment; at all moments, events and what is just before and
/// behind them among these.
class Seen {
 public:
  std::vector<Interval> at = std::vector<Interval>(outputCount, Interval::empty()), over = at;

  void add(const std::vector<Vector>& outputs, const std::vector<Vector>& limits) {
    for (const Vector& y : outputs) widen(over, y);
    for (const Vector& y : limits) widen(over, y);
    widen(at, outputs.back());
  }

 private:
  static void widen(std::vector<Interval>& range, const Vector& values) {
    for (std::size_t o = 0; o < values.size(); ++o) range[o] = hull(range[o], Interval(values[o].convert_to<double>()));
  }
};

/// The references' own errors: how far one is from another whose events come a hundred times later and whose steps are
/// shorter, and some units of the last place that series keep, relative to the greatest number beside it.
std::vector<Vector> errorsOf(const std::vector<Vector>& fine, const std::vector<Vector>& coarse) {
  std::vector<Vector> errors;
  for (std::size_t m = 0; m < fine.size(); ++m) {
    Precise size(1.0);
    for (const Precise& value : fine[m]) size = std::max(size, Precise(abs(value)));
    Vector& row = errors.emplace_back();
    for (std::size_t i = 0; i < fine[m].size(); ++i)
      row.push_back(abs(fine[m][i] - coarse[m][i]) + Precise(1e-32) * size);
  }
  return errors;
}

/// "31 of 32 (97 %)".
std::string shareText(long part, long all) {
  return fmt::format("{} of {} ({:.1f} %)", part, all,
                     all > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(all) : 0.0);
}

/// One requirement on an output up to the last of these times: its margin is another output, limit - y. Whether it is
/// told to be met.
bool isToldMet(const System& s, const std::vector<double>& times, const Program& f, const Program& g,
               std::size_t output, double limit, double work) {
  Recorder recorder(g);
  const Program only = recorder.finish({recorder.sub(recorder.constant(limit), g.outputNodes()[output])});
  FlowOptions options;
  options.modelled = {0};
  options.budget = work;
  const Tube tube = Flow(f, only, options).enclose(s.box, s.horizon, times);
  if (!tube.models() || tube.times().back() != times.back() || tube.reachedTimes() != tube.times().size()) return false;
  std::vector<Uncertain> uncertain;
  std::vector<CellQuantity> quantities;
  for (const Interval& value : s.box) uncertain.push_back(evenQuantity(value));
  for (std::size_t i = 0; i < s.box.size(); ++i)
    if (!isThin(s.box[i])) quantities.push_back({static_cast<int>(i), &uncertain[i]});
  const CellQuestion question{CellQuestion::When::always, {0}, {0}, 0, tube.reachedTimes() - 1};
  RequirementOptions cells;
  cells.mostCells = 300;
  return examine(*tube.models(), question, quantities, cells).isAlwaysMet;
}

/// Where a flow that ended early is asked for more: on the way to where it came.
std::vector<double> timesUpTo(double reached) {
  std::vector<double> times;
  for (const double part : {0.25, 0.5, 0.75, 0.9375}) times.push_back(part * reached);
  return times;
}

void judgeSystem(unsigned number, double work, Count& count) {
  Dice dice(number);
  const System s = systemOf(dice);
  const Program f = s.motion(), g = outputsOf(s, dice);
  SlidingReference reference(f, g, s.rest()), coarser(f, g, s.rest());
  coarser.tiny = Precise(1e-28);
  coarser.share = Precise(0.8125);
  Containment c;
  c.f = f;
  c.g = g;
  c.box = s.box;
  c.horizon = s.horizon;
  c.times = s.times;
  c.options.budget = work;
  Box level = s.box;
  for (Interval& value : level)
    if (!isThin(value) && dice.happens(0.7))
      value = Interval(midpoint(value), midpoint(value) + 0.5 * (value.upper() - midpoint(value)));
  c.levels = {level};
  c.motion = [&](const Vector& start, const std::vector<double>& times) {
    reference.leaves = coarser.leaves = count.trajectories % 2 == 0 ? Side::above : Side::below;
    Containment::Motion motion{reference(start, times), {}};
    motion.outputs = reference.outputs;
    motion.stateErrors = errorsOf(motion.states, coarser(start, times));
    motion.outputErrors = errorsOf(motion.outputs, coarser.outputs);
    ++count.trajectories;
    return motion;
  };
  std::optional<Judge> judge(std::in_place, c, number + 1);
  ++count.systems;
  const bool isTelling = std::getenv("HELD_SIGNS_MISSES") != nullptr, isEarly = !judge->tube().why().empty();
  if (isEarly) {
    ++count.ended;
    const double reached = judge->tube().reached();
    if (isTelling) fmt::print("system {}: ended at {} s: {}\n", number, reached, judge->tube().why());
    if (reached > 0) {
      c.times = timesUpTo(reached);
      judge.emplace(c, number + 1);
    }
  }
  Answers& answers = isEarly ? count.early : count.whole;
  const auto holds = [&](Judge& of) {
    SCOPED_TRACE(fmt::format("system {}", number));
    ::testing::TestPartResultArray failures;  // of this system alone
    {
      const ::testing::ScopedFakeTestPartResultReporter reporter(
          ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
      of.judge(6);
    }
    if (failures.size() == 0) return true;
    ++count.outside;
    ADD_FAILURE() << failures.GetTestPartResult(0).message();
    return false;
  };
  if (!holds(*judge)) return;
  const std::size_t last = judge->tube().reachedTimes() - 1;
  if (last == 0) {
    ++count.atTheStart;
    return;
  }
  const std::vector<double> reachedTimes(judge->tube().times().begin() + 1,
                                         judge->tube().times().begin() + static_cast<std::ptrdiff_t>(last) + 1);
  const double end = reachedTimes.back();
  constexpr int most = 16, inside = 8, moments = 64, further = 600;
  const auto wide = std::ranges::count_if(s.box, [](const Interval& value) { return !isThin(value); });
  const int corners = static_cast<int>(std::min<long>(most, 1L << wide));
  std::vector<double> times;
  for (int i = 0; i <= moments; ++i) times.push_back(end * i / moments);
  Seen seen;
  Points points(number);
  bool areHeld = true, areUnique = true;  // else trajectories do not tell all that there is
  for (int i = 0; i < (wide == 0 ? 1 : corners + inside); ++i) {
    const Vector start = i < corners ? cornerOf(s.box, i) : points.inside(s.box);
    for (const Side side : {Side::above, Side::below}) {
      reference.leaves = side;
      reference(start, times);
      seen.add(reference.outputs, reference.limits);
      areHeld = areHeld && reference.isHeld();
      if (reference.isUnique()) break;
      areUnique = false;
    }
  }
  const auto output = static_cast<std::size_t>(dice.roll(outputCount));
  const Interval range = seen.over[output];
  if (!(gamut::width(range) > 1e-9)) return;
  const double by = 0.01 * gamut::width(range);
  const bool isAbove = dice.happens(0.7), isTruly = isAbove && areUnique;
  const double limit = range.upper() + (isAbove ? by : -by);
  const bool isTold = isToldMet(s, reachedTimes, f, g, output, limit, work);
  ++answers.asked;
  answers.truly += isTruly;
  answers.told += isTold && isTruly;
  if (isTruly && !isTold && isTelling)
    fmt::print("system {}: output {} is not told to be below {}\n", number, output, limit);
  if (isTold && !isAbove) {
    ++count.falselyMet;
    ADD_FAILURE() << "system " << number << ": output " << output << " < " << limit << " is told to be met";
  }
  constexpr double more = 20;  // of the work, once it was not enough
  bool isLookedAt = false, isRepeated = false;
  std::vector<Interval> at = judge->tube().outputs(last);
  for (std::size_t o = 0; areHeld && areUnique && o < seen.at.size(); ++o) {
    const auto ratio = [&] { return gamut::width(at[o]) / gamut::width(seen.at[o]); };
    const double width = gamut::width(seen.at[o]);
    if (!(width > 1e-3 * gamut::width(seen.over[o])) || !(width > 1e-9)) continue;
    constexpr double loose = 1.05;
    if (ratio() > loose && !std::exchange(isLookedAt, true))  // what is extreme need not be at a corner
      for (int i = 0; i < further; ++i) {
        reference(points.inside(s.box), {end});
        seen.add(reference.outputs, reference.limits);
      }
    if (ratio() > loose && !std::exchange(isRepeated, true) && !isEarly) {
      c.options.budget *= more;
      ++answers.repeated;
      Judge again(c, number + 1);
      if (!holds(again)) return;
      for (std::size_t i = 0; again.tube().why().empty() && i < at.size(); ++i)
        at[i] = intersection(at[i], again.tube().outputs(last)[i]);
    }
    ++answers.widths;
    answers.loose += ratio() > loose;
    answers.ratios += std::log(ratio());
    if (ratio() > loose && isTelling)
      fmt::print("system {}: output {} is {:.4f} times as wide as {}\n", number, o, ratio(), toString(seen.at[o]));
  }
}

void tell(const char* which, const Answers& answers) {
  fmt::print("{}: {} requirements, {} that are met by 1 % told to be\n", which, answers.asked,
             shareText(answers.told, answers.truly));
  fmt::print(
      "{}: where all are held at the end, {} outputs at most 1.05 times as wide as trajectories tell, in the mean "
      "{:.4f}; {} systems took more work for it\n",
      which, shareText(answers.widths - answers.loose, answers.widths),
      std::exp(answers.ratios / static_cast<double>(std::max(1L, answers.widths))), answers.repeated);
}

}  // namespace
}  // namespace gamut::testing

int main(int argc, char** argv) {
  using namespace gamut::testing;
  const int systems = argc > 1 ? std::atoi(argv[1]) : 10000;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  const double work = argc > 3 ? std::atof(argv[3]) : 0.2;
  Count count;
  for (int i = first; i < first + systems; ++i) judgeSystem(static_cast<unsigned>(i), work, count);
  fmt::print(
      "{} systems ({} ended early, {} of them before any time asked for), {} trajectories; {} outside, {} falsely "
      "met\n",
      count.systems, count.ended, count.atTheStart, count.trajectories, count.outside, count.falselyMet);
  tell("to the horizon", count.whole);
  tell("ended early", count.early);
  const bool isBad = ::testing::Test::HasFailure() || count.ended == count.systems;
  return isBad ? 1 : 0;
}
