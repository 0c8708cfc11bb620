// Random motions of four to ten uncertain quantities (right-hand sides of every operation, chains, bumps that one
// quantity times, loads of a given motion, kinks, linear systems, inputs that vary in time), in units from 2^-30 to
// 2^30, at rest and in symmetric positions, with components of the box that are thin, hardly wide or of no matter, run
// as the flow chooses, bisected, of a fixed degree, and stopped in their midst. Trajectories in 128 bits from corners,
// faces, the centre and anywhere must lie in states, outputs, alpha-cuts and models, at output times and between them,
// compared exactly; none may contradict what is told of a requirement on an output; and any number of threads must give
// the same. Usage:
//     many_quantities_campaign [systems = 1000] [first = 0] [family, of all if it is left out]
// Prints what was judged, and, where MANY_QUANTITIES_TELL is set, of each system how its flow went; the exit status is
// 1 if something does not hold.
#include <fmt/format.h>
#include <gtest/gtest-spi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analyses/requirements/requirement.hpp"
#include "tests/analyses/even_quantity.hpp"
#include "tests/analyses/event_reference.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/switching_courses.hpp"

namespace gamut::testing {
namespace {

using Values = std::vector<Recorded>;
using Field = std::function<void(const Recorded& t, const Values& x, const Values& p, Values& y)>;

enum class Family { random, chain, bump, loads, kinks, inputs, pendulums };
constexpr std::array names{"random", "chain", "bump", "loads", "kinks", "inputs", "pendulums"};

/// A motion and its outputs in units of one, and the powers of two that are its units.
struct Motion {
  Family family = Family::random;
  int n = 0, k = 0, outputs = 3;
  Field f, g;
  std::vector<double> nominal, radius;
  double horizon = 1;
  std::vector<VaryingParameter> varying = {};
  std::vector<double> unit = {};  // of each state
  double second = 1;

  /// In its own units, or in those of one.
  Program motion(bool isScaled) const {
    return record(n, k, [&](auto t, const auto& x, const auto& p, auto& dx) { apply(f, n, isScaled, t, x, p, dx); });
  }
  Program output(bool isScaled) const {
    return record(n, k, outputs,
                  [&](auto t, const auto& x, const auto& p, auto& y) { apply(g, outputs, isScaled, t, x, p, y); });
  }

 private:
  template <class T, class X, class P, class Y>
  void apply(const Field& field, int count, bool isScaled, const T& t, const X& x, const P& p, Y& y) const {
    Values states, parameters(p.begin(), p.end()), values(at(count));
    for (std::size_t i = 0; i < x.size(); ++i) states.push_back(isScaled ? x[i] * (1 / unit[i]) : x[i]);
    field(isScaled ? t * (1 / second) : Recorded(t), states, parameters, values);
    const bool isMotion = &field == &f;
    for (std::size_t i = 0; i < values.size(); ++i)
      y[i] = isScaled && isMotion ? values[i] * (unit[i] / second) : values[i];
  }
};

/// Outputs of all kinds of a state, a parameter and time.
Field usualOutputs(Points& points) {
  const std::array<int, 3> kinds{points.integer(0, 7), points.integer(0, 7), points.integer(0, 7)};
  return [kinds](const Recorded& t, const Values& x, const Values& p, Values& y) {
    Recorded sum = t, q = p.empty() ? Recorded(1.0) : p.back();
    for (const Recorded& value : x) sum += sqr(value);
    for (std::size_t o = 0; o < y.size(); ++o) {
      const Recorded &a = x[o % x.size()], &b = x.back();
      const Recorded of[] = {a * b + q,
                             sin(a) / (3.0 + sqr(b)),
                             sqrt(100.0 + sum) - b,
                             exp(-sqr(a)) * q,
                             atan(a - b) * t,
                             tanh(a) + q * sin(t),
                             q * a,
                             log(3.0 + sqr(a)) / (2.0 + sqr(q))};
      y[o] = of[kinds[o]];
    }
  };
}

Motion randomMotion(Points& points) {
  Motion m;
  m.n = points.integer(2, 4);
  m.k = points.integer(std::max(1, 4 - m.n), 6);
  std::vector<double> nominal;
  for (int i = 0; i < m.n + m.k; ++i) nominal.push_back(points.integer(0, 5) == 0 ? 0.0 : points.uniform(-1, 1));
  m.nominal = nominal;
  const int length = points.integer(4, 9);
  const auto seed = static_cast<unsigned>(points.integer(0, 1 << 30));
  m.f = [=](const Recorded& t, const Values& x, const Values& p, Values& y) {
    Points own(seed);
    RandomExpressions expression(own, nominal);
    expression(t, x, p, y, length);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = y[i] - 0.3 * x[i];
    for (std::size_t i = 0; i < p.size(); ++i) y[i % y.size()] = y[i % y.size()] + 0.2 * p[i] * x[(i + 1) % x.size()];
  };
  m.horizon = points.uniform(0.25, 2);
  const double size = std::array{1e-6, 1e-3, 0.02, 0.1, 0.2}[at(points.integer(0, 4))];
  for (int i = 0; i < m.n + m.k; ++i) m.radius.push_back(size * points.uniform(0.2, 1));
  return m;
}

/// Masses in a row, hung between springs that stiffen, damped a little; driven or not; or at rest.
Motion chainMotion(Points& points) {
  Motion m;
  m.family = Family::chain;
  const int masses = points.integer(1, 4);
  m.n = 2 * masses;
  m.k = points.integer(2, 5);
  const double cubic = points.integer(0, 1) * points.uniform(0, 0.5),
               damping = points.integer(0, 1) * points.uniform(0, 3),
               drive = points.integer(0, 1) * points.uniform(0, 1),
               fast = std::array{1.0, 10.0, 400.0}[at(points.integer(0, 2))];
  m.f = [=](const Recorded& t, const Values& x, const Values& p, Values& dx) {
    const auto of = [&](int i) { return p[at(i) % p.size()]; };
    for (int i = 0; i < masses; ++i) {
      dx[at(i)] = x[at(masses + i)];
      Recorded pull = (i > 0 ? x[at(i - 1)] - x[at(i)] : -x[at(0)]) * of(0);
      if (i + 1 < masses) pull += (x[at(i + 1)] - x[at(i)]) * of(i + 1);
      if (cubic > 0) pull -= cubic * x[at(i)] * sqr(x[at(i)]);
      if (damping > 0) pull -= damping * of(i + 2) * x[at(masses + i)];
      if (drive > 0) pull += drive * sin((1.0 + 0.5 * of(3)) * t);
      dx[at(masses + i)] = fast * pull;
    }
  };
  const bool isAtRest = points.integer(0, 3) == 0;
  for (int i = 0; i < m.n; ++i) m.nominal.push_back(isAtRest ? 0.0 : points.uniform(-1, 1));
  for (int i = 0; i < m.k; ++i) m.nominal.push_back(points.uniform(0.5, 2));
  const double size = std::array{1e-4, 0.01, 0.05, 0.1}[at(points.integer(0, 3))];
  for (int i = 0; i < m.n + m.k; ++i)
    m.radius.push_back(i < m.n && (isAtRest || points.integer(0, 1) == 0) ? 0.0 : size * points.uniform(0.3, 1));
  m.horizon = points.uniform(0.5, 4) / std::sqrt(fast);
  return m;
}

/// At rest until a bump comes, whose time one quantity decides.
Motion bumpMotion(Points& points) {
  Motion m;
  m.family = Family::bump;
  m.n = 2 * points.integer(1, 2);
  m.k = points.integer(5, 7);
  const double place = points.uniform(0.5, 3), length = points.uniform(0.15, 0.5), stiff = points.uniform(5, 60);
  m.f = [=](const Recorded& t, const Values& x, const Values& p, Values& dx) {
    const std::size_t half = x.size() / 2;
    const Recorded road = 0.1 * exp(-sqr((p[0] * t - place) * (1 / length)));
    for (std::size_t i = 0; i < half; ++i) {
      dx[i] = x[half + i];
      const Recorded below = i == 0 ? road : x[i - 1];
      Recorded force = stiff * p[1] * (below - x[i]) - p[2] * x[half + i];
      if (i + 1 < half) force += stiff * p[3] * (x[i + 1] - x[i]);
      dx[half + i] = force / p[4];
      for (std::size_t j = 5; j < p.size(); ++j) dx[half + i] = dx[half + i] - 0.1 * p[j] * sin(x[i]) * cos(0.3 * p[j]);
    }
  };
  m.nominal.assign(at(m.n), 0.0);
  m.radius = m.nominal;
  for (int i = 0; i < m.k; ++i) m.nominal.push_back(i == 0 ? points.uniform(2, 4) : points.uniform(0.7, 1.5));
  const double size = std::array{0.02, 0.05, 0.1}[at(points.integer(0, 2))];
  for (int i = 0; i < m.k; ++i)
    m.radius.push_back(i == 0 ? 0.25 * points.uniform(0.3, 1) : size * points.uniform(0.3, 1));
  m.horizon = place / m.nominal[at(m.n)] * points.uniform(0.8, 1.6);
  return m;
}

/// No state moves: outputs are functions of time, as the loads of a driven crank.
Motion loadsMotion(Points& points) {
  Motion m;
  m.family = Family::loads;
  m.n = points.integer(1, 2);
  m.k = points.integer(3, 8);
  m.f = [](const Recorded&, const Values&, const Values&, Values& dx) {
    for (Recorded& rate : dx) rate = Recorded(0.0);
  };
  const double speed = std::array{1.0, 7.0, 40.0}[at(points.integer(0, 2))],
               offset = points.integer(0, 1) * points.uniform(0, 0.2);
  const int kind = points.integer(0, 3);
  m.g = [=](const Recorded& t, const Values& x, const Values& p, Values& y) {
    const auto of = [&](std::size_t i) { return p[i % p.size()]; };
    const Recorded angle = speed * of(0) * t + x[0], s = sin(angle), c = cos(angle);
    const Recorded crank = 0.3 * of(1), rod = of(2);
    const Recorded across = crank * s - offset, along = sqrt(sqr(rod) - sqr(across));
    Recorded spread = Recorded(0.0);
    for (std::size_t i = 3; i < p.size(); ++i) spread += 0.1 * p[i] * cos((1.0 + 0.3 * static_cast<double>(i)) * angle);
    y[0] = crank * c + along;
    y[1] = (crank * s + crank * c * across / along) * (of(3) + spread);
    y[2] = kind == 0   ? exp(-sqr((t - 0.4 * of(1)) * 5.0)) * of(2)
           : kind == 1 ? atan(across / along) * of(3) + tanh(4.0 * s)
           : kind == 2 ? log(2.0 + s * of(1)) / (1.5 + c * of(2))
                       : abs(s * of(1)) + of(2) * s * spread;
  };
  for (int i = 0; i < m.n + m.k; ++i) m.nominal.push_back(i < m.n ? points.uniform(-1, 1) : points.uniform(0.8, 1.2));
  const double size = std::array{1e-3, 0.03, 0.07, 0.1}[at(points.integer(0, 3))];
  for (int i = 0; i < m.n + m.k; ++i) m.radius.push_back(size * points.uniform(0.2, 1));
  m.horizon = points.uniform(0.3, 2) * (1 + 3 * points.integer(0, 1)) / std::sqrt(speed);
  return m;
}

Motion kinksMotion(Points& points) {
  Motion m = chainMotion(points);
  m.family = Family::kinks;
  const Field smooth = m.f;
  const double gap = points.integer(0, 2) == 0 ? 0.0 : points.uniform(0.05, 0.5), stiff = points.uniform(0.5, 20);
  const int kind = points.integer(0, 2);
  m.f = [=](const Recorded& t, const Values& x, const Values& p, Values& dx) {
    smooth(t, x, p, dx);
    const std::size_t half = x.size() / 2;
    dx[half] = dx[half] - (kind == 0   ? stiff * p[0] * max(x[0] - gap, Recorded(0.0))
                           : kind == 1 ? 0.4 * p[1] * abs(x[half]) * x[half]
                                       : stiff * (max(x[0] - gap, Recorded(0.0)) + min(x[0] + gap, Recorded(0.0))));
  };
  return m;
}

Motion inputsMotion(Points& points) {
  Motion m = chainMotion(points);
  while (m.k < 3) m = chainMotion(points);
  m.family = Family::inputs;
  const int masses = m.n / 2;
  const double stiffness = points.uniform(1, 20);
  m.f = [=](const Recorded&, const Values& x, const Values& p, Values& dx) {  // autonomous, as the reference needs
    for (int i = 0; i < masses; ++i) {
      dx[at(i)] = x[at(masses + i)];
      Recorded pull = (i > 0 ? x[at(i - 1)] - x[at(i)] : -sin(x[at(0)])) * p[0];
      if (i + 1 < masses) pull += (x[at(i + 1)] - x[at(i)]) * p[1];
      for (std::size_t j = 3; j < p.size(); ++j) pull -= 0.1 * p[j] * x[at(masses + i)];
      dx[at(masses + i)] = stiffness * pull + p[2] * (1.0 + 0.2 * x[at(i)]);
    }
  };
  for (int i = 0; i < m.n; ++i) m.radius[at(i)] = std::max(m.radius[at(i)], 0.01 * points.integer(0, 1));
  m.nominal[at(m.n + 2)] = points.integer(0, 1) * points.uniform(-1, 1);
  m.radius[at(m.n + 2)] = points.uniform(0.05, 0.3);
  m.varying = {{2}};
  if (points.integer(0, 2) == 0) m.varying.push_back({1});
  m.horizon = points.uniform(0.2, 1.5) / std::sqrt(stiffness);
  return m;
}

/// Three or four equations that are solved together, as those of a chain of pendulums are.
Motion pendulumsMotion(Points& points) {
  Motion m;
  m.family = Family::pendulums;
  const int links = points.integer(2, 3);
  m.n = 2 * links;
  m.k = points.integer(3, 5);
  const bool isUpright = points.integer(0, 3) == 0;
  m.f = [=](const Recorded&, const Values& x, const Values& p, Values& dx) {
    const auto of = [&](int i) { return p[at(i) % p.size()]; };
    std::vector<int> entries, right;
    for (int i = 0; i < links; ++i) {
      dx[at(i)] = x[at(links + i)];
      Recorded torque = -9.81 * (links - i) * of(i) * sin(x[at(i)]) - 0.1 * of(3) * x[at(links + i)];
      for (int j = 0; j < links; ++j) {
        const double mass = links - std::max(i, j);
        entries.push_back((mass * of(i) * of(j) * cos(x[at(i)] - x[at(j)]) + (i == j ? 0.1 : 0.0) * of(4)).node());
        torque -= mass * of(i) * of(j) * sin(x[at(i)] - x[at(j)]) * sqr(x[at(links + j)]);
      }
      right.push_back(torque.node());
    }
    Recorder& recorder = *Recorder::current();
    const int matrix = recorder.matrix({MatrixKind::general, links, std::move(entries)});
    int i = 0;
    for (const int node : recorder.solve(matrix, false, right)) dx[at(links + i++)] = Recorded::node(node);
  };
  for (int i = 0; i < m.n; ++i) m.nominal.push_back(isUpright ? 0.0 : points.uniform(-0.8, 0.8));
  for (int i = 0; i < m.k; ++i) m.nominal.push_back(points.uniform(0.7, 1.3));
  const double size = std::array{1e-4, 0.01, 0.03}[at(points.integer(0, 2))];
  for (int i = 0; i < m.n + m.k; ++i)
    m.radius.push_back(i < m.n && points.integer(0, 1) == 0 ? 0.0 : size * points.uniform(0.3, 1));
  m.horizon = points.uniform(0.2, 0.8);
  return m;
}

Motion motionOf(Family family, Points& points) {
  constexpr std::array make{randomMotion, chainMotion,  bumpMotion,     loadsMotion,
                            kinksMotion,  inputsMotion, pendulumsMotion};
  Motion m = make[static_cast<std::size_t>(family)](points);
  if (!m.g) m.g = usualOutputs(points);
  const bool hasUnits = points.integer(0, 1) == 0;
  const auto unit = [&] { return std::ldexp(1.0, std::array{0, -30, 30, -10, 17}[at(points.integer(0, 4))]); };
  const double all = unit();
  const bool isMixed = points.integer(0, 2) == 0;
  for (int i = 0; i < m.n; ++i) m.unit.push_back(!hasUnits ? 1.0 : isMixed ? unit() : all);
  if (hasUnits) m.second = std::ldexp(1.0, std::array{0, -30, 20, -3, 7}[at(points.integer(0, 4))]);
  return m;
}

/// In its own units; what is degenerate of it among them.
Box boxOf(const Motion& m, Points& points) {
  Box box;
  for (std::size_t i = 0; i < m.nominal.size(); ++i) {
    const double unit = i < m.unit.size() ? m.unit[i] : 1.0;
    box.push_back(Interval((m.nominal[i] - m.radius[i]) * unit, (m.nominal[i] + m.radius[i]) * unit));
  }
  if (points.integer(0, 2) > 0) return box;
  const auto i = at(points.integer(0, static_cast<int>(box.size()) - 1));
  const bool isState = i < m.unit.size();
  const double middle = midpoint(box[i]);
  switch (points.integer(0, 4)) {
    case 0:
      box[i] = Interval(middle);
      break;
    case 1:
      if (isState) box[i] = Interval(-1e-300, 1e-300);
      break;
    case 2:
      box[i] = Interval(middle, std::nextafter(middle, HUGE_VAL));
      break;
    case 3:
      box[i] = middle * Interval(1 - 1e-12, 1 + 1e-12);
      break;
    default:
      if (isState) box[i] = Interval(0.0, 1e-300);
  }
  return box;
}

FlowOptions optionsOf(const Motion& m, Points& points, std::string& how) {
  FlowOptions options;
  options.varying = m.varying;
  const double second = m.second;
  options.budget = 2;
  how = "as it chooses";
  switch (points.integer(0, 9)) {
    case 0:
      options.degree = points.integer(2, 6);
      options.frameDegree = points.integer(0, 4);
      options.order = points.integer(5, 12);
      options.split = points.integer(0, 1) == 0;
      how = fmt::format("degree {}", options.degree);
      break;
    case 1:
      options.split = false;
      how = "one piece";
      break;
    case 2:
      options.budget = std::array{0.001, 0.01, 0.05, 0.2}[at(points.integer(0, 3))];
      how = fmt::format("stopped after {} s", options.budget);
      break;
    case 3:
      options.tightness = 1 + std::array{1e-3, 5e-3, 0.2, 1.0}[at(points.integer(0, 3))];
      how = fmt::format("tightness {}", options.tightness);
      break;
    case 4:
      options.longestStep = m.horizon * second / 16;
      how = "short steps";
      break;
    case 5:
      options.maxPieces = points.integer(1, 6);
      how = "few pieces";
      break;
    case 6:
      options.tightness = 1.002;
      options.budget = 8;
      how = "tightly";
      break;
    default:
      break;
  }
  return options;
}

struct Count {
  long systems = 0, early = 0, atTheStart = 0, trajectories = 0, outside = 0, cut = 0, rejected = 0, differ = 0;
  long requirements = 0, alwaysMet = 0, neverMet = 0, factors = 0, contradicted = 0;
};

/// Starts of trajectories: corners, anywhere, the centre, faces.
Vector startOfTrajectory(const Box& box, int number, Points& points) {
  if (number % 2 == 0) return points.corner(box);
  if (number % 4 == 1) return points.inside(box);
  Vector start = number % 8 == 3 ? Vector{} : points.inside(box);
  for (std::size_t i = 0; i < box.size(); ++i) {
    if (number % 8 == 3)
      start.push_back(midpoint(box[i]));
    else if (points.integer(0, 1) == 0)
      start[i] = points.integer(0, 1) == 0 ? box[i].lower() : box[i].upper();
  }
  return start;
}

bool areSame(const Tube& a, const Tube& b) {
  const auto same = [](const std::vector<Interval>& x, const std::vector<Interval>& y) {
    return std::ranges::equal(x, y, [](const Interval& v, const Interval& w) { return isEqual(v, w); });
  };
  if (a.reachedTimes() != b.reachedTimes() || a.reached() != b.reached() || a.steps() != b.steps()) return false;
  for (std::size_t row = 0; row < a.reachedTimes(); ++row)
    if (!same(a.states(row), b.states(row)) || !same(a.statesOver(row), b.statesOver(row)) ||
        !same(a.outputs(row), b.outputs(row)) || !same(a.outputsOver(row), b.outputsOver(row)))
      return false;
  if ((a.models() == nullptr) != (b.models() == nullptr)) return false;
  return a.models() == nullptr ||
         std::ranges::equal(a.models()->over, b.models()->over, [&](const auto& chords, const auto& others) {
           return std::ranges::equal(chords, others, [&](const FlowChord& v, const FlowChord& w) {
             return same(v.sag, w.sag) && same(v.bound, w.bound);
           });
         });
}

/// What trajectories are, in 128 bits, by the motion in units of one.
class Truth {
 public:
  Truth(const Motion& m, unsigned seed)
      : m_(m), f_(m.motion(false)), g_(m.output(true)), smooth_(f_), kinks_(f_), points_(seed) {}

  Containment::Motion operator()(const Vector& start, const std::vector<double>& times) {
    Vector own = start;
    std::vector<double> seconds;
    for (std::size_t i = 0; i < m_.unit.size(); ++i) own[i] /= Precise(m_.unit[i]);
    for (const double time : times) seconds.push_back(time / m_.second);
    Containment::Motion motion;
    std::function<Vector(double)> parametersAt = [&](double) { return Vector(start.begin() + m_.n, start.end()); };
    Course course;
    if (!m_.varying.empty()) {
      Box box;  // what is constant is as the start says
      for (const Precise& value : own) box.push_back(Interval(static_cast<double>(value)));
      for (const VaryingParameter& input : m_.varying)
        box[at(m_.n + input.parameter)] = whole[at(m_.n + input.parameter)];
      course = switching(box, m_.n, m_.varying, m_.horizon, points_.integer(0, 12), points_);
      motion.states = follow(f_, Vector(own.begin(), own.begin() + m_.n), course, seconds);
      parametersAt = [&](double time) { return course.at(time / m_.second); };
    } else {
      motion.states = m_.family == Family::kinks ? kinks_(own, seconds) : smooth_(own, seconds);
    }
    for (std::size_t row = 0; row < times.size(); ++row) {
      for (std::size_t i = 0; i < m_.unit.size(); ++i) motion.states[row][i] *= Precise(m_.unit[i]);
      g_.setParameters(parametersAt(times[row]));
      motion.outputs.push_back(g_(Precise(times[row]), motion.states[row]));
    }
    return motion;
  }

  Box whole;

 private:
  const Motion& m_;
  Program f_;
  Evaluator<Precise> g_;
  Reference smooth_;
  EventReference kinks_;
  Points points_;
};

/// One requirement, that an output stays below a limit, at all times or at some: what is told of it against what
/// trajectories do. Of these the margin over many moments, the greatest and the least.
void judgeRequirement(const Motion& m, const Box& box, const FlowOptions& options, Truth& truth, unsigned number,
                      Count& count) {
  Points points(number + 77);
  const double end = m.horizon * m.second;
  std::vector<double> moments;
  for (int i = 0; i <= 96; ++i) moments.push_back(end / 96 * i);
  const auto output = at(points.integer(0, m.outputs - 1));
  const bool isAlways = points.integer(0, 2) > 0;
  std::vector<Vector> starts;
  std::vector<Precise> extremes;  // the greatest value, or, of what is asked for once, the least
  for (int i = 0; i < 40; ++i) {
    starts.push_back(i % 8 < 2 ? startOfTrajectory(box, i, points) : points.inside(box));
    const Containment::Motion motion = truth(starts.back(), moments);
    Precise extreme = motion.outputs[0][output];
    for (const Vector& y : motion.outputs)
      extreme = isAlways ? std::max(extreme, y[output]) : std::min(extreme, y[output]);
    extremes.push_back(extreme);
  }
  const auto [least, most] = std::ranges::minmax(extremes);
  const double width = static_cast<double>(Precise(most - least));
  if (!(width > 1e-9 * (1 + std::fabs(static_cast<double>(most))))) return;
  const double limit = static_cast<double>(least) + width * points.uniform(-0.3, 1.3);
  Recorder recorder(m.output(true));
  const Program only = recorder.finish({recorder.sub(recorder.constant(limit), m.output(true).outputNodes()[output])});
  FlowOptions own = options;
  own.modelled = {0};
  std::vector<double> times;
  for (int i = 1; i <= 4; ++i) times.push_back(end / 4 * i);
  const Tube tube = Flow(m.motion(true), only, own).enclose(box, end, times);
  if (!tube.models() || tube.models()->areAlternatives || tube.reachedTimes() != tube.times().size()) return;
  std::vector<Uncertain> uncertain;
  std::vector<CellQuantity> quantities;
  for (const Interval& value : box) uncertain.push_back(evenQuantity(value));
  for (std::size_t i = 0; i < box.size(); ++i)
    if (!isThin(box[i]) &&
        std::ranges::find(m.varying, static_cast<int>(i) - m.n, &VaryingParameter::parameter) == m.varying.end())
      quantities.push_back({static_cast<int>(i), &uncertain[i]});
  const CellQuestion question{
      isAlways ? CellQuestion::When::always : CellQuestion::When::eventually, {0}, {0}, 0, tube.reachedTimes() - 1};
  RequirementOptions cells;
  cells.mostCells = 2000;
  const RequirementFinding found = examine(*tube.models(), question, quantities, cells);
  ++count.requirements;
  count.alwaysMet += found.isAlwaysMet;
  count.neverMet += found.isNeverMet;
  count.factors += found.factor > 0 && found.factor < 1;
  int met = 0, sampled = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    // Of "always" what is seen violates it; of "eventually" what is seen meets it. The rest is all but known.
    const bool isSeen = isAlways ? extremes[i] >= Precise(limit) : extremes[i] < Precise(limit);
    const bool isMet = isAlways != isSeen;
    const Precise clear(0.02 * width);
    const bool isClear = isSeen || (isAlways ? extremes[i] < limit - clear : extremes[i] > limit + clear);
    bool isWithinFactor = true;
    for (std::size_t c = 0; c < box.size(); ++c)
      isWithinFactor = isWithinFactor && abs(starts[i][c] - Precise(midpoint(box[c]))) <=
                                             Precise(found.factor) * Precise(0.999 * radius(box[c]));
    std::string what;
    if (isClear && found.isAlwaysMet && !isMet) what = "always met";
    if (isClear && found.isNeverMet && isMet) what = "never met";
    if (isClear && !isMet && isWithinFactor && found.factor > 0) what = "met within a factor";
    if (!what.empty()) {
      ++count.contradicted;
      ADD_FAILURE() << "system " << number << ": output " << output << " < " << limit << " is told to be " << what;
      return;
    }
    if (i % 8 >= 2 && isClear) met += isMet, ++sampled;
  }
  // Thirty samples, those that are not clear on either side: shares that are off by more than six deviations, and what
  // one sample makes, are none of chance.
  constexpr double n = 30;
  const double fewest = met / n, greatest = (met + n - sampled) / n;
  const auto chance = [](double p) { return 6 * std::sqrt(p * (1 - p) / n) + 1 / n; };
  const double from = found.probability.lower(), to = found.probability.upper();
  if (m.varying.empty() && (from - chance(from) > greatest || to + chance(to) < fewest)) {
    ++count.contradicted;
    ADD_FAILURE() << "system " << number << ": probability " << toString(found.probability) << ", of samples " << fewest
                  << " to " << greatest;
  }
}

void judgeSystem(unsigned number, std::optional<int> family, Count& count) {
  Points points(number);
  const auto which = static_cast<Family>(family ? *family : static_cast<int>(number % names.size()));
  const Motion m = motionOf(which, points);
  const Box box = boxOf(m, points);
  Containment c;
  c.f = m.motion(true);
  c.g = m.output(true);
  c.box = box;
  c.horizon = m.horizon * m.second;
  const int rows = points.integer(1, 9);
  for (int i = 1; i <= rows; ++i)
    c.times.push_back(points.integer(0, 5) == 0 ? c.horizon / (rows + 1) * i : c.horizon / 16 * (16 * i / rows));
  std::ranges::sort(c.times);
  std::string how;
  c.options = optionsOf(m, points, how);
  if (m.varying.empty()) {
    Box level = box;
    for (Interval& value : level)
      if (!isThin(value) && points.integer(0, 2) > 0)
        value = Interval(midpoint(value), midpoint(value) + 0.5 * (value.upper() - midpoint(value)));
    c.levels = {level};
    c.options.levelBudget = 0.5;
  }
  Truth truth(m, number);
  truth.whole = box;
  c.motion = [&](const Vector& start, const std::vector<double>& times) {
    ++count.trajectories;
    return truth(start, times);
  };
  ++count.systems;
  ::testing::TestPartResultArray failures;  // of this system alone
  std::optional<Judge> judge;
  try {
    judge.emplace(c, number + 1);
    const bool isTelling = std::getenv("MANY_QUANTITIES_TELL") != nullptr;
    const Tube& tube = judge->tube();
    count.early += tube.why().empty() ? 0 : 1;
    count.atTheStart += tube.reachedTimes() <= 1;
    count.cut += tube.pieces() > 1;
    if (isTelling)
      fmt::print(
          "{:>6} {:<9} n {} k {} {:<22} reached {:.3g} of {:.3g}, {} pieces, {} steps, tightness {:.4f}, {:.2f} s: "
          "{}\n",
          number, names[static_cast<std::size_t>(which)], m.n, m.k, how, tube.reached(), c.horizon, tube.pieces(),
          tube.steps(), tube.tightness(), tube.cpuSeconds(), tube.why());
    std::fflush(stdout);
    const ::testing::ScopedFakeTestPartResultReporter reporter(
        ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
    if (tube.reachedTimes() > 1)
      for (int i = 0; i < 12 && failures.size() == 0; ++i)
        judge->follow(startOfTrajectory(i % 3 == 2 && !c.levels.empty() ? c.levels[0] : box, i, points),
                      i % 3 == 2 && !c.levels.empty() ? 1 : 0);
  } catch (const std::exception& error) {
    ++count.rejected;
    fmt::print("system {} ({}, {}): {}\n", number, names[static_cast<std::size_t>(which)], how, error.what());
    return;
  }
  if (failures.size() > 0) {
    ++count.outside;
    ADD_FAILURE() << "system " << number << " (" << names[static_cast<std::size_t>(which)] << ", " << how
                  << "): " << failures.GetTestPartResult(0).message();
    return;
  }
  if (number % 5 == 0) {
    Containment other = c;
    other.options.jobs = 3;
    if (!areSame(judge->tube(), other.tube())) {
      ++count.differ;
      ADD_FAILURE() << "system " << number << ": three threads give another tube";
    }
  }
  if (number % 3 == 0) return;
  try {
    judgeRequirement(m, box, c.options, truth, number, count);
  } catch (const std::exception& error) {
    ++count.rejected;
    fmt::print("requirement of system {}: {}\n", number, error.what());
  }
}

}  // namespace
}  // namespace gamut::testing

int main(int argc, char** argv) {
  using namespace gamut::testing;
  const int systems = argc > 1 ? std::atoi(argv[1]) : 1000, first = argc > 2 ? std::atoi(argv[2]) : 0;
  std::optional<int> family;
  if (argc > 3) family = std::atoi(argv[3]);
  Count count;
  for (int i = first; i < first + systems; ++i) judgeSystem(static_cast<unsigned>(i), family, count);
  fmt::print(
      "{} systems ({} ended early, {} of them before any time asked for; {} of more than one piece), {} trajectories; "
      "{} outside, {} otherwise with three threads\n{} requirements ({} told to be always met, {} never, {} within a "
      "factor), {} contradicted\n",
      count.systems, count.early, count.atTheStart, count.cut, count.trajectories, count.outside, count.differ,
      count.requirements, count.alwaysMet, count.neverMet, count.factors, count.contradicted);
  return ::testing::Test::HasFailure() || count.rejected > 0 || count.early == count.systems ? 1 : 0;
}
