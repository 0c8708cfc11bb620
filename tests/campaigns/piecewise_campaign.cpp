// Random machines of one to three degrees of freedom that are smooth piece by piece: dry friction that sticks and
// breaks away, stick and slip on a belt, friction in two joints, elastic stops, play, load steps, preloaded springs,
// what switches at a position, quadratic drag, relays, jumps that multiply, and surfaces that are bent. Two or three of
// their quantities are uncertain by 0.1, 1, 5 or 10 %, units are of 1e-3 to 1e3, natural frequencies of 0.7 to 30
// rad/s, and two to six events happen to the nominal machine before the horizon; of one in ten, any number. They are
// enclosed by the flow as it chooses for itself, and judged:
// - Solutions in 128 bits whose events are located to the last digits (arbiter.hpp), from all corners and from inside,
//   must lie in states, outputs and models at output times and between them, compared exactly but for what the solution
//   itself is off by its own measurement. Of flows that end early, what was proved until then. Two solutions of each
//   system are found by another method as well (SlidingReference), and those that the first one cannot follow.
// - Widths: the enclosure's over that of solutions in doubles (3^k grid, 100 random points; where that is beyond 1.02,
//   a search for the extremes from the extreme ones found), at each of eight output times, of each state and output.
//   Of what is there less than a thousandth of the width that it has at another time, no ratio is told; that it is not
//   wider than a thousand times that width counts there.
// What is not drawn: surfaces that repel to both sides, of which solutions are not unique (relays, springs and friction
// that drive). Drawn anew are machines that have less than two events within three periods, where these are asked for.
// Some that are drawn neither method follows: what a preload holds in the middle. These are counted, and tell how far
// flows come. Usage:
//     piecewise_campaign [systems = 300] [first = 0] [seconds of work for a flow = 5] [surfaces]
// of all kinds but the last, in turn, or of that one alone: surfaces that are not linear in states.
// Prints the figures, of each kind and of all; where PIECEWISE_MISSES is set, what ended early, and why, and what is
// loose, with its nominal start and quantities; where it is "all", all. The exit status is 1 if a solution is outside,
// or if two methods do not find the same.
#include <fmt/format.h>
#include <gtest/gtest-spi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analyses/samples/arbiter.hpp"
#include "analyses/samples/witness.hpp"
#include "scalars/program/linear_form.hpp"
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/flow/jumping_machine.hpp"
#include "tests/analyses/sliding_reference.hpp"

namespace gamut::testing {
namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  /// Of 0 … count - 1.
  int roll(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  bool happens(double share) { return between(0, 1) < share; }
  double between(double lower, double upper) { return lower + (upper - lower) * roll(1025) / 1024; }
  /// As likely in each decade.
  double scale(double lower, double upper) { return lower * std::pow(upper / lower, between(0, 1)); }
  double eitherSign(double value) { return happens(0.5) ? value : -value; }

 private:
  std::mt19937 engine_;
};

/// |u|, and max(u, 0): as a kink, or for references that locate signs alone.
struct Bends {
  bool areSigns = false;
  Recorded size(const Recorded& u) const { return areSigns ? u * sign(u) : abs(u); }
  Recorded beyond(const Recorded& u) const { return areSigns ? 0.5 * (u + size(u)) : max(u, Recorded(0.0)); }
};

using Values = std::vector<Recorded>;
/// dx of states x and quantities q.
using Rates = std::function<void(const Bends& bends, const Recorded& t, const Values& x, const Values& q, Values& dx)>;
/// Of time and quantities, or of a deflection and quantities.
using Of = std::function<Recorded(const Recorded&, const Values& q)>;

/// A machine of unit masses: its nominal start and quantities.
struct Machine {
  std::vector<double> start, quantity;
  std::size_t masses = 1;       // positions, then their rates; 0: neither
  double length = 1, turn = 1;  // its unit, and its natural frequency in rad/s
  Rates rates = {};

  double force() const { return length * turn * turn; }
  double speed() const { return length * turn; }
  /// Its number.
  std::size_t add(double value) {
    quantity.push_back(value);
    return quantity.size() - 1;
  }
};

/// A spring to the ground, linear, of third power, or a pendulum's weight.
Of springOf(Draw& draw, Machine& m) {
  const std::size_t k = m.add(m.turn * m.turn);
  const double length = m.length;
  switch (draw.roll(3)) {
    case 0:
      return [=](const Recorded& x, const Values& q) { return q[k] * x; };
    case 1: {
      const double cubic = draw.between(0.1, 1) * m.turn * m.turn / (length * length);
      return [=](const Recorded& x, const Values& q) { return q[k] * x + cubic * x * sqr(x); };
    }
    default:
      return [=](const Recorded& x, const Values& q) { return q[k] * (length * sin(x * (1 / length))); };
  }
}

/// A periodic load; its frequency is known mostly.
Of loadOf(Draw& draw, Machine& m, double least, double most) {
  const std::size_t f = m.add(draw.between(least, most) * m.force());
  const double frequency = draw.between(0.4, 1.6) * m.turn, phase = draw.happens(0.5) ? 0.0 : draw.between(-1.5, 1.5);
  if (!draw.happens(0.3)) return [=](const Recorded& t, const Values& q) { return q[f] * sin(frequency * t + phase); };
  const std::size_t w = m.add(frequency);
  return [=](const Recorded& t, const Values& q) { return q[f] * sin(q[w] * t + phase); };
}

Of noLoad() {
  return [](const Recorded&, const Values&) { return Recorded(0.0); };
}

/// Positions and rates of so many masses: at rest, or moving.
void startOf(Draw& draw, Machine& m, std::size_t masses, bool isAtRest) {
  m.masses = masses;
  for (std::size_t i = 0; i < masses; ++i)
    m.start.push_back(isAtRest ? 0.0 : draw.eitherSign(draw.between(0.3, 1.2)) * m.length);
  for (std::size_t i = 0; i < masses; ++i)
    m.start.push_back(isAtRest || draw.happens(0.4) ? 0.0 : draw.eitherSign(draw.between(0.2, 1)) * m.speed());
}

double dampingOf(Draw& draw, const Machine& m) { return draw.happens(0.3) ? 0.0 : draw.between(0.01, 0.3) * m.turn; }

/// A spring and dry friction, loaded or let go.
void frictionMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const bool isLoaded = draw.happens(0.6);
  const std::size_t friction = m.add(draw.between(0.05, 0.4) * m.force());
  const Of load = isLoaded ? loadOf(draw, m, 0.3, 1.2) : noLoad();
  const double damping = dampingOf(draw, m);
  startOf(draw, m, 1, isLoaded && draw.happens(0.6));
  m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    dx[0] = x[1];
    dx[1] = load(t, q) - spring(x[0], q) - damping * x[1] - q[friction] * sign(x[1]);
  };
}

/// A spring that a belt draws, with friction that may fall with speed.
void beltMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const std::size_t friction = m.add(draw.between(0.3, 1) * m.force()),
                    belt = m.add(draw.between(0.1, 0.6) * m.speed());
  const double damping = dampingOf(draw, m), falling = draw.happens(0.5) ? 0.0 : draw.between(0.2, 3) / m.speed();
  startOf(draw, m, 1, draw.happens(0.6));
  m.rates = [=](const Bends& bends, const Recorded&, const Values& x, const Values& q, Values& dx) {
    const Recorded slip = x[1] - q[belt];
    dx[0] = x[1];
    dx[1] = -spring(x[0], q) - damping * x[1];
    if (falling > 0)
      dx[1] -= q[friction] * sign(slip) / (1.0 + falling * bends.size(slip));
    else
      dx[1] -= q[friction] * sign(slip);
  };
}

/// Two masses on springs, each with friction, the second's against the ground or the first; or two links with friction
/// in their joints.
void jointsMachine(Draw& draw, Machine& m) {
  const bool isLoaded = draw.happens(0.6), areLinks = draw.happens(0.35), isBetween = draw.happens(0.4);
  const double damping = dampingOf(draw, m);
  if (areLinks) {
    m.length = 1;
    const std::size_t weight = m.add(m.turn * m.turn), first = m.add(draw.between(0.03, 0.2) * m.force()),
                      second = m.add(draw.between(0.03, 0.2) * m.force());
    const Of load = isLoaded ? loadOf(draw, m, 0.3, 1) : noLoad();
    startOf(draw, m, 2, isLoaded && draw.happens(0.6));
    m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
      const Recorded c = cos(x[1]), s = sin(x[1]), sum = x[2] + x[3], m12 = 1.0 + c, m11 = 1.0 + m12;
      const Recorded b1 =
          s * sqr(sum) - 2.0 * q[weight] * sin(x[0]) + load(t, q) - q[first] * sign(x[2]) - damping * x[2];
      const Recorded b2 = -q[weight] * sin(x[0] + x[1]) - s * sqr(x[2]) - q[second] * sign(x[3]) - damping * x[3];
      const Recorded determinant = m11 - c * m12;
      dx[0] = x[2];
      dx[1] = x[3];
      dx[2] = (b1 - c * b2) / determinant;
      dx[3] = (m11 * b2 - m12 * b1) / determinant;
    };
    return;
  }
  const Of spring = springOf(draw, m);
  const std::size_t between = m.add(draw.between(0.3, 2) * m.turn * m.turn),
                    first = m.add(draw.between(0.05, 0.3) * m.force()),
                    second = m.add(draw.between(0.05, 0.3) * m.force());
  const Of load = isLoaded ? loadOf(draw, m, 0.4, 1.2) : noLoad();
  startOf(draw, m, 2, isLoaded && draw.happens(0.6));
  m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    const Recorded pull = q[between] * (x[1] - x[0]), rubbing = q[second] * sign(isBetween ? x[3] - x[2] : x[3]);
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = pull - spring(x[0], q) - damping * x[2] - q[first] * sign(x[2]);
    if (isBetween) dx[2] += rubbing;
    dx[3] = load(t, q) - pull - rubbing;
  };
}

/// A mass against one elastic stop or between two, that may damp; another one hangs on it, or not.
void stopMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const bool areTwo = draw.happens(0.4), isLoaded = draw.happens(0.5);
  const std::size_t gap = m.add(draw.between(0.1, 0.7) * m.length),
                    stiffness = m.add(draw.scale(3, 100) * m.turn * m.turn);
  const Of load = isLoaded ? loadOf(draw, m, 0.4, 1.5) : noLoad();
  const double damping = dampingOf(draw, m), between = draw.between(0.3, 2) * m.turn * m.turn,
               stopDamping = draw.happens(0.7) ? 0.0 : draw.between(0.5, 3) * m.turn / m.length;
  const std::size_t masses = draw.happens(0.25) ? 2 : 1;
  startOf(draw, m, masses, isLoaded && draw.happens(0.5));
  m.rates = [=](const Bends& bends, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    const Recorded& v = x[masses];
    const Recorded depth = bends.beyond(x[0] - q[gap]);
    Recorded force = load(t, q) - spring(x[0], q) - damping * v - q[stiffness] * depth;
    if (stopDamping > 0) force -= stopDamping * depth * v;  // Hunt and Crossley's
    if (areTwo) force += q[stiffness] * bends.beyond(-x[0] - q[gap]);
    dx[0] = v;
    if (masses == 2) {
      const Recorded pull = between * (x[1] - x[0]);
      force += pull;
      dx[1] = x[3];
      dx[3] = -pull;
    }
    dx[masses] = force;
  };
}

/// Two masses joined with play.
void playMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const bool isLoaded = draw.happens(0.5);
  const std::size_t gap = m.add(draw.between(0.05, 0.3) * m.length),
                    stiffness = m.add(draw.scale(1, 30) * m.turn * m.turn);
  const Of load = isLoaded ? loadOf(draw, m, 0.4, 1.2) : noLoad();
  const double damping = dampingOf(draw, m);
  startOf(draw, m, 2, isLoaded && draw.happens(0.5));
  m.rates = [=](const Bends& bends, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    const Recorded apart = x[0] - x[1];
    const Recorded pull = q[stiffness] * (bends.beyond(apart - q[gap]) - bends.beyond(-apart - q[gap]));
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = load(t, q) - pull - damping * x[2];
    dx[3] = pull - spring(x[1], q) - damping * x[3];
  };
}

/// A load that comes at a time that is known or not, and may go again.
void stepMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const double period = 2 * std::numbers::pi / m.turn, from = draw.between(0.1, 0.6) * period,
               until = from + draw.between(0.2, 0.8) * period;
  const bool isUncertain = draw.happens(0.6), hasEnd = draw.happens(0.6), hasDrag = draw.happens(0.3);
  const std::size_t force = m.add(draw.eitherSign(draw.between(0.3, 1.5)) * m.force()),
                    begin = isUncertain ? m.add(from) : 0, drag = m.add(draw.between(0.05, 0.4) / m.length);
  const std::size_t masses = draw.happens(0.3) ? 2 : 1;
  const double damping = dampingOf(draw, m), between = draw.between(0.3, 2) * m.turn * m.turn;
  startOf(draw, m, masses, draw.happens(0.5));
  m.rates = [=](const Bends& bends, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    const Recorded& v = x[masses];
    Recorded load = where(t - (isUncertain ? q[begin] : Recorded(from)), q[force], Recorded(0.0));
    if (hasEnd) load -= where(t - until, q[force], Recorded(0.0));
    Recorded sum = load - spring(x[0], q) - damping * v;
    if (hasDrag) sum -= q[drag] * v * bends.size(v);
    dx[0] = v;
    if (masses == 2) {
      const Recorded pull = between * (x[1] - x[0]);
      sum += pull;
      dx[1] = x[3];
      dx[3] = -pull;
    }
    dx[masses] = sum;
  };
}

/// A spring that is preloaded at its middle, where it may also stand at first.
void preloadMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const bool isLoaded = draw.happens(0.6);
  const std::size_t preload = m.add(draw.between(0.05, 0.5) * m.force());
  const Of load = isLoaded ? loadOf(draw, m, 0.3, 1.2) : noLoad();
  const double damping = dampingOf(draw, m);
  startOf(draw, m, 1, isLoaded && draw.happens(0.2));
  m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    dx[0] = x[1];
    dx[1] = load(t, q) - spring(x[0], q) - q[preload] * sign(x[0]) - damping * x[1];
  };
}

/// Behind a position a drive ends, a damper begins, or another spring acts.
void placeMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const std::size_t place = m.add(draw.between(0.1, 0.6) * m.length);
  const int kind = draw.roll(3);
  const std::size_t strength = m.add(kind == 0   ? draw.between(0.2, 1) * m.force()
                                     : kind == 1 ? draw.between(0.3, 2) * m.turn
                                                 : draw.between(0.5, 4) * m.turn * m.turn);
  const double damping = dampingOf(draw, m);
  const Of load = draw.happens(0.4) ? loadOf(draw, m, 0.3, 1) : noLoad();
  startOf(draw, m, 1, false);
  m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    const Recorded behind = x[0] - q[place], none(0.0);
    dx[0] = x[1];
    dx[1] = load(t, q) - spring(x[0], q) - damping * x[1];
    if (kind == 0)
      dx[1] += where(behind, none, q[strength]);
    else
      dx[1] -= where(behind, q[strength] * (kind == 1 ? x[1] : x[0]), none);
  };
}

/// Drag by the square of the speed, against what rests or flows, with a stop or without.
void dragMachine(Draw& draw, Machine& m) {
  const Of spring = springOf(draw, m);
  const std::size_t drag = m.add(draw.between(0.1, 1.5) / m.length);
  const bool isFlowing = draw.happens(0.4), isLoaded = draw.happens(0.5), hasStop = draw.happens(0.3);
  const std::size_t stream = isFlowing ? m.add(draw.between(0.1, 0.6) * m.speed()) : 0,
                    gap = hasStop ? m.add(draw.between(0.1, 0.5) * m.length) : 0;
  const Of load = isLoaded ? loadOf(draw, m, 0.3, 1.5) : noLoad();
  const double stiffness = draw.scale(3, 30) * m.turn * m.turn;
  startOf(draw, m, 1, (isLoaded || isFlowing) && draw.happens(0.5));
  m.rates = [=](const Bends& bends, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    const Recorded slip = isFlowing ? x[1] - q[stream] : x[1];
    dx[0] = x[1];
    dx[1] = load(t, q) - spring(x[0], q) - q[drag] * slip * bends.size(slip);
    if (hasStop) dx[1] -= stiffness * bends.beyond(x[0] - q[gap]);
  };
}

/// A relay that drives a mass to its place by place and speed, or one that heats a body, or the second of two.
void relayMachine(Draw& draw, Machine& m) {
  const int kind = draw.roll(3);
  const std::size_t power = m.add(draw.between(0.4, 1.2) * (kind == 0 ? m.force() : m.speed())),
                    wanted = m.add(draw.between(0.2, 0.5) * m.length);
  if (kind == 0) {
    const std::size_t lead = m.add(draw.between(0.1, 0.6) / m.turn);
    const double damping = dampingOf(draw, m);
    startOf(draw, m, 1, draw.happens(0.5));
    m.rates = [=](const Bends&, const Recorded&, const Values& x, const Values& q, Values& dx) {
      dx[0] = x[1];
      dx[1] = -damping * x[1] - q[power] * sign(x[0] + q[lead] * x[1] - q[wanted]);
    };
    return;
  }
  m.masses = 0;
  const std::size_t loss = m.add(draw.between(0.2, 0.8) * m.turn);
  m.start = {draw.happens(0.5) ? 0.0 : draw.between(0.1, 1) * m.length};
  const Of weather = draw.happens(0.4) ? loadOf(draw, m, 0.02, 0.1) : noLoad();
  const double slowly = 1 / m.turn;
  if (kind == 1) {
    m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
      dx[0] = where(q[wanted] - x[0], q[power], Recorded(0.0)) - q[loss] * x[0] + slowly * weather(t, q);
    };
    return;
  }
  const double between = draw.between(0.5, 2) * m.turn;
  m.start.push_back(m.start[0]);
  m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    dx[0] = where(q[wanted] - x[1], q[power], Recorded(0.0)) - between * (x[0] - x[1]);
    dx[1] = between * (x[0] - x[1]) - q[loss] * x[1] + slowly * weather(t, q);
  };
}

/// Friction on an elastic bed that may be left, of other strength behind a place, or that grows with the deflection;
/// or a load that comes with time where the mass is behind a place.
void productMachine(Draw& draw, Machine& m) {
  const int kind = draw.roll(4);
  const Of spring = springOf(draw, m);
  const double damping = dampingOf(draw, m);
  const std::size_t friction = m.add(draw.between(0.05, 0.4) * (kind == 0 ? 1.0 : m.force()));
  if (kind == 0) {  // x: along, y: into the bed
    const std::size_t bed = m.add(draw.between(3, 20) * m.turn * m.turn),
                      weight = m.add(draw.between(0.5, 1.5) * m.force());
    const Of shaking = loadOf(draw, m, 0.2, 1.6);
    startOf(draw, m, 2, false);
    m.start[1] = m.quantity[weight] / m.quantity[bed];
    m.start[3] = 0;
    m.rates = [=](const Bends& bends, const Recorded& t, const Values& x, const Values& q, Values& dx) {
      const Recorded normal = q[bed] * bends.beyond(x[1]);
      dx[0] = x[2];
      dx[1] = x[3];
      dx[2] = -spring(x[0], q) - q[friction] * normal * sign(x[2]);
      dx[3] = q[weight] + shaking(t, q) - normal - damping * x[3];
    };
    return;
  }
  const Of load = draw.happens(0.6) ? loadOf(draw, m, 0.3, 1.2) : noLoad();
  const std::size_t place = m.add(draw.between(0.05, 0.4) * m.length);
  const double other = draw.between(0.05, 0.4) * m.force(), rise = draw.between(0.05, 0.3) * m.turn * m.turn,
               from = draw.between(0.1, 0.6) * 2 * std::numbers::pi / m.turn;
  startOf(draw, m, 1, false);
  m.rates = [=](const Bends& bends, const Recorded& t, const Values& x, const Values& q, Values& dx) {
    const Recorded behind = x[0] - q[place];
    dx[0] = x[1];
    dx[1] = load(t, q) - spring(x[0], q) - damping * x[1];
    if (kind == 1)
      dx[1] -= where(behind, Recorded(other), q[friction]) * sign(x[1]);
    else if (kind == 2)
      dx[1] -= (q[friction] + rise * bends.size(x[0])) * sign(x[1]);
    else
      dx[1] += where(t - from, where(behind, q[friction], Recorded(-other)), Recorded(0.0));
  };
}

/// Surfaces that are no planes, or of which the quantities decide how they lie: what slips on a wheel, a place within a
/// radius, what hangs by a wall, a course that is followed, play behind a gear, what is pushed away from a point.
void surfaceMachine(Draw& draw, Machine& m) {
  const int kind = draw.roll(6);
  if (kind == 0) {
    m.masses = 0;
    const std::size_t grip = m.add(draw.between(0.2, 1) * m.force()), radius = m.add(draw.between(0.5, 2)),
                      stiffness = m.add(m.turn * m.turn);
    const double inertia = draw.between(0.5, 2), drag = draw.between(0, 0.3) * m.turn;
    m.start = {0, draw.happens(0.5) ? 0 : draw.between(0.2, 1) * m.speed(), draw.between(0.5, 2) * m.speed()};
    m.rates = [=](const Bends&, const Recorded&, const Values& x, const Values& q, Values& dx) {
      const Recorded slip = sign(x[1] - q[radius] * x[2]);
      dx[0] = x[1];
      dx[1] = -q[stiffness] * x[0] - q[grip] * slip;
      dx[2] = q[radius] * q[grip] * slip * (1 / inertia) - drag * x[2];
    };
    return;
  }
  const double damping = dampingOf(draw, m), across = 1 / m.length;
  if (kind == 1 || kind == 5) {
    const std::size_t radius = m.add(draw.between(0.4, 0.8) * m.length),
                      inside = m.add(kind == 1 ? draw.eitherSign(draw.between(0.3, 1)) * m.force()
                                               : draw.between(5, 40) * m.turn * m.turn);
    const double stiffness = draw.between(0.2, 1) * m.turn * m.turn;
    startOf(draw, m, 2, false);
    m.rates = [=](const Bends& bends, const Recorded&, const Values& x, const Values& q, Values& dx) {
      const Recorded square = x[0] * x[0] + x[1] * x[1];
      dx[0] = x[2];
      dx[1] = x[3];
      dx[2] = -stiffness * x[0] - damping * x[2];
      dx[3] = -stiffness * x[1] - damping * x[3];
      if (kind == 1) {
        dx[2] += where(q[radius] * q[radius] - square, q[inside], Recorded(0.0));
      } else {
        const Recorded distance = sqrt(square + sqr(Recorded(0.125 * m.length)));
        const Recorded push = q[inside] * bends.beyond(q[radius] - distance) / distance;
        dx[2] += push * x[0];
        dx[3] += push * x[1];
      }
    };
    return;
  }
  if (kind == 2) {
    const std::size_t wall = m.add(draw.between(-0.2, 0.6) * m.length),
                      stiffness = m.add(draw.between(5, 60) * m.turn * m.turn);
    const double weight = m.turn * m.turn;
    startOf(draw, m, 1, false);
    m.rates = [=](const Bends& bends, const Recorded&, const Values& x, const Values& q, Values& dx) {
      const Recorded angle = x[0] * across, beyond = bends.beyond(m.length * sin(angle) - q[wall]);
      dx[0] = x[1];
      dx[1] = -weight * m.length * sin(angle) - damping * x[1] - q[stiffness] * cos(angle) * beyond;
    };
    return;
  }
  if (kind == 3) {
    const std::size_t far = m.add(draw.between(0.2, 1) * m.length), power = m.add(draw.between(0.5, 3) * m.force()),
                      lead = m.add(draw.between(0.05, 0.5) / m.turn);
    const double frequency = draw.between(0.3, 1.2) * m.turn;
    startOf(draw, m, 1, draw.happens(0.5));
    m.rates = [=](const Bends&, const Recorded& t, const Values& x, const Values& q, Values& dx) {
      dx[0] = x[1];
      dx[1] = -damping * x[1] - q[power] * sign(x[0] - q[far] * sin(frequency * t) + q[lead] * x[1]);
    };
    return;
  }
  const std::size_t ratio = m.add(draw.between(0.5, 3)), gap = m.add(draw.between(0.02, 0.2) * m.length),
                    stiffness = m.add(draw.between(2, 30) * m.turn * m.turn);
  startOf(draw, m, 2, false);
  m.rates = [=](const Bends& bends, const Recorded&, const Values& x, const Values& q, Values& dx) {
    const Recorded apart = q[ratio] * x[0] - x[1];
    const Recorded force = q[stiffness] * (bends.beyond(apart - q[gap]) - bends.beyond(-apart - q[gap]));
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = -q[ratio] * force - m.turn * m.turn * x[0];
    dx[3] = force - damping * x[3];
  };
}

struct Kind {
  const char* name;
  void (*make)(Draw&, Machine&);
};
constexpr std::array kinds{
    Kind{"friction", frictionMachine}, Kind{"belt", beltMachine},       Kind{"two joints", jointsMachine},
    Kind{"stops", stopMachine},        Kind{"play", playMachine},       Kind{"load steps", stepMachine},
    Kind{"preload", preloadMachine},   Kind{"places", placeMachine},    Kind{"drag", dragMachine},
    Kind{"relays", relayMachine},      Kind{"products", productMachine}};
constexpr std::array bent{Kind{"surfaces", surfaceMachine}};
std::span<const Kind> drawn = kinds;

/// What of a machine is uncertain makes it a system.
struct System {
  Machine machine;
  std::vector<std::size_t> uncertain;  // of start and quantities, rising
  Box box;                             // start, and those quantities that are uncertain
  double horizon = 0;
  std::size_t events = 0;  // of the nominal machine before it
  bool showsRate = false;

  std::size_t states() const { return machine.start.size(); }
  /// Known quantities are numbers, as in a program that somebody writes.
  Values quantities(const Values& p) const {
    Values q(machine.quantity.begin(), machine.quantity.end());
    std::size_t next = 0;
    for (const std::size_t u : uncertain)
      if (u >= states()) q[u - states()] = p[next++];
    return q;
  }
  int parameters() const { return static_cast<int>(box.size() - states()); }
  Program motion(bool areSigns = false) const {
    return record(static_cast<int>(states()), parameters(), [&](auto t, const auto& x, const auto& p, auto& dx) {
      const Values rates = ratesAt(areSigns, t, Values(x.begin(), x.end()), Values(p.begin(), p.end()));
      std::ranges::copy(rates, dx.begin());
    });
  }
  /// States, an energy, and of some the last state's rate, with its signs.
  Program outputs(bool areSigns = false) const {
    const int count = static_cast<int>(states()) + (showsRate ? 2 : 1);
    return record(static_cast<int>(states()), parameters(), count, [&](auto t, const auto& x, const auto& p, auto& y) {
      const Values now(x.begin(), x.end());
      std::ranges::copy(now, y.begin());
      const std::size_t n = now.size();
      Recorded sum(0.0);
      for (std::size_t i = 0; i < n; ++i)
        sum += sqr(now[i]) * (machine.masses > 0 && i >= machine.masses ? 0.5 : 0.5 * machine.turn * machine.turn);
      y[n] = sum;
      if (showsRate) y[n + 1] = ratesAt(areSigns, t, now, Values(p.begin(), p.end())).back();
    });
  }

 private:
  Values ratesAt(bool areSigns, const Recorded& t, const Values& x, const Values& p) const {
    Values rates(x.size());
    machine.rates(Bends{areSigns}, t, x, quantities(p), rates);
    return rates;
  }
};

/// Of what is held: exactly, wherever series are to some 1e-33 only.
SlidingReference::Rest restOf(const Program& f) {
  std::vector<std::optional<LinearForm>> forms;
  for (const int jump : jumpsOf(f)) forms.push_back(linearFormOf(f, f.nodes()[at(jump)].a));
  return [forms](const std::vector<Side>& sides, const Vector& p, Vector& x) {
    std::vector<const LinearForm*> held;
    for (std::size_t k = 0; k < std::min(sides.size(), forms.size()); ++k)
      if (sides[k] == Side::held && forms[k]) held.push_back(&*forms[k]);
    for (const auto& [which, state] : statesThatFollow(held)) {
      const LinearForm& form = *held[which];
      Precise sum(midpoint(form.constant));
      for (std::size_t j = 0; j < p.size(); ++j) sum += Precise(form.parameters[j]) * p[j];
      for (std::size_t i = 0; i < x.size(); ++i)
        if (i != at(state)) sum += Precise(form.states[i]) * x[i];
      x[at(state)] = -sum / Precise(form.states[at(state)]);
    }
  };
}

struct Count {
  long systems = 0, reached = 0, solutions = 0, outside = 0, unfollowed = 0, slid = 0, compared = 0, different = 0,
       beyond = 0, drawnAnew = 0, endless = 0, small = 0, unmeasured = 0;
  double longest = 0;
  std::vector<double> middles, greatest, ratios, events;  // of systems, of systems, of all, of nominal machines
};

double middleOf(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  return values[values.size() / 2];
}
double greatestOf(const std::vector<double>& values) {
  return values.empty() ? std::numeric_limits<double>::quiet_NaN() : *std::ranges::max_element(values);
}

constexpr int rows = 8;
constexpr std::size_t mostEvents = 200;
constexpr double far = 1e3, tight = 1.02;

/// Draws until two to six events happen before the horizon, or as many as there are.
System systemOf(unsigned number, Count& count) {
  const Kind& kind = drawn[number % drawn.size()];
  for (unsigned attempt = 0;; ++attempt) {
    Draw draw(number + 1'000'003U * attempt);
    System s;
    Machine& m = s.machine;
    m.length = std::array{1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3}[at(draw.roll(7))];
    m.turn = draw.scale(0.7, 30);
    kind.make(draw, m);
    s.showsRate = draw.happens(0.3);
    std::vector<std::size_t> candidates;
    for (std::size_t i = 0; i < m.start.size() + m.quantity.size(); ++i)
      if (i >= m.start.size() || m.start[i] != 0) candidates.push_back(i);
    const std::size_t wanted = std::min<std::size_t>(2 + at(draw.roll(2)), candidates.size());
    while (candidates.size() > wanted)
      candidates.erase(candidates.begin() + draw.roll(static_cast<int>(candidates.size())));
    s.uncertain = candidates;
    for (const double value : m.start) s.box.emplace_back(value);
    for (const std::size_t u : s.uncertain) {
      const double value = u < m.start.size() ? m.start[u] : m.quantity[u - m.start.size()],
                   part = std::array{0.001, 0.01, 0.05, 0.1}[at(draw.roll(4))] * std::fabs(value);
      const Interval range(value - part, value + part);
      if (u < m.start.size())
        s.box[u] = range;
      else
        s.box.push_back(range);
    }
    const double period = 2 * std::numbers::pi / m.turn, longest = 3 * period;
    const bool anyNumber = draw.happens(0.1);
    const std::size_t events = 2 + at(draw.roll(5));
    const double part = draw.between(0.1, 0.9);
    const Program truth = s.motion(true);
    SlidingReference nominal(truth, restOf(truth));
    nominal.most = anyNumber ? mostEvents : events;  // and the next
    Vector start;
    for (const Interval& value : s.box) start.emplace_back(midpoint(value));
    nominal(start, {longest});
    const std::vector<double>& moments = nominal.moments;
    const auto isUpTo = [&](double horizon) {
      s.horizon = horizon;
      s.events = static_cast<std::size_t>(std::ranges::upper_bound(moments, horizon) - moments.begin());
      return s;
    };
    if (moments.size() > events && moments[events - 1] < 1e-3 * period) {  // again and again from the start
      ++count.endless;
      return isUpTo(part * period);
    }
    if (anyNumber) return isUpTo(part * period * 2);
    if (moments.size() < 2) {
      ++count.drawnAnew;
      continue;
    }
    const std::size_t last = std::min(events, moments.size());
    const double next = last < moments.size() ? moments[last] : longest;
    return isUpTo(moments[last - 1] + part * std::min(next - moments[last - 1], 0.3 * period));
  }
}

std::vector<double> doublesOf(const Vector& values) {
  std::vector<double> result;
  for (const Precise& value : values) result.push_back(value.convert_to<double>());
  return result;
}

/// By the arbiter; nothing if it could not follow the solution.
std::optional<Containment::Motion> arbitrated(const System& s, const Vector& start, const std::vector<double>& times) {
  const gamut::Motion motion{s.motion(), s.outputs(), {}, times};
  const PreciseTrajectory found = arbitrate(motion, doublesOf(start));
  if (found.times < times.size()) return std::nullopt;
  Containment::Motion result;
  const auto n = static_cast<std::ptrdiff_t>(s.states());
  for (std::size_t m = 0; m < times.size(); ++m) {
    Vector y, off;
    for (std::size_t o = 0; o < motion.outputs(); ++o) {
      y.push_back(found.values[m * motion.outputs() + o]);
      off.emplace_back(found.error[m * motion.outputs() + o]);
    }
    result.states.emplace_back(y.begin(), y.begin() + n);
    result.stateErrors.emplace_back(off.begin(), off.begin() + n);
    result.outputs.push_back(std::move(y));
    result.outputErrors.push_back(std::move(off));
  }
  return result;
}

/// How far one is from another whose events come a hundred times later and whose steps are shorter, and some units of
/// the last place that series keep, relative to the greatest number beside it.
std::vector<Vector> differencesOf(const std::vector<Vector>& fine, const std::vector<Vector>& coarse) {
  std::vector<Vector> errors;
  for (std::size_t m = 0; m < fine.size(); ++m) {
    Precise size(0x1p-20);
    for (const Precise& value : fine[m]) size = std::max(size, Precise(abs(value)));
    Vector& row = errors.emplace_back();
    for (std::size_t i = 0; i < fine[m].size(); ++i)
      row.push_back(abs(fine[m][i] - coarse[m][i]) + Precise(1e-30) * size);
  }
  return errors;
}

/// By the other method; nothing if there are events without end.
std::optional<Containment::Motion> slid(const System& s, const Vector& start, const std::vector<double>& times) {
  const Program f = s.motion(true), g = s.outputs(true);
  SlidingReference reference(f, g, restOf(f)), coarser(f, g, restOf(f));
  reference.most = coarser.most = mostEvents;
  coarser.tiny = Precise(1e-28);
  coarser.share = Precise(0.8125);
  const std::vector<Vector> states = reference(start, times), other = coarser(start, times);
  if (states.size() < times.size() || other.size() < times.size()) return std::nullopt;
  return Containment::Motion{states, reference.outputs, differencesOf(states, other),
                             differencesOf(reference.outputs, coarser.outputs)};
}

/// A solution that neither method could follow.
struct Unfollowed {};

/// What solutions in doubles span, [time][output].
class Extent {
 public:
  Extent(const System& s, const Program& f, const Program& g, const std::vector<double>& times)
      : s_(s), motion_{f, g, {}, times}, witness_(motion_), outputs_(at(g.outputs())) {
    lower_.assign(times.size() * outputs_, {std::numeric_limits<double>::infinity(), {}});
    upper_.assign(times.size() * outputs_, {-std::numeric_limits<double>::infinity(), {}});
    for (std::size_t i = 0; i < s.box.size(); ++i)
      if (!isThin(s.box[i])) wide_.push_back(i);
  }

  /// Parts of the box, 0 … 1 of each wide component.
  using Place = std::vector<double>;

  void take(const Place& place) {
    std::vector<double> start, trajectory(lower_.size());
    for (const Interval& value : s_.box) start.push_back(value.lower());
    for (std::size_t l = 0; l < wide_.size(); ++l) {
      const Interval& range = s_.box[wide_[l]];
      start[wide_[l]] = std::clamp(range.lower() + place[l] * gamut::width(range), range.lower(), range.upper());
    }
    constexpr double seconds = 2;
    witness_.integrate(start, Tolerance{1e-11, 1e-14 * s_.machine.length}, trajectory, seconds);
    for (std::size_t i = 0; i < trajectory.size(); ++i) {
      if (trajectory[i] < lower_[i].value) lower_[i] = {trajectory[i], place};
      if (trajectory[i] > upper_[i].value) upper_[i] = {trajectory[i], place};
    }
  }
  void takeGridAndRandom(Points& points) {
    Place place(wide_.size());
    int count = 1;
    for (std::size_t l = 0; l < wide_.size(); ++l) count *= 3;
    for (int i = 0; i < count; ++i) {
      for (int l = 0, rest = i; l < static_cast<int>(place.size()); ++l, rest /= 3) place[at(l)] = 0.5 * (rest % 3);
      take(place);
    }
    for (int i = 0; i < 100; ++i) {
      for (double& part : place) part = points.uniform(0, 1);
      take(place);
    }
  }
  /// About what is extreme of this, ever nearer.
  void search(std::size_t time, std::size_t output, Points& points) {
    for (const bool isUpper : {false, true})
      for (double radius = 0.3; radius > 0.003; radius *= 0.8) {
        const Place& best = (isUpper ? upper_ : lower_)[time * outputs_ + output].place;
        if (best.empty()) return;
        Place place = best;
        for (double& part : place) part = std::clamp(part + points.uniform(-radius, radius), 0.0, 1.0);
        take(place);
      }
  }
  double width(std::size_t time, std::size_t output) const {
    const std::size_t i = time * outputs_ + output;
    return upper_[i].value - lower_[i].value;
  }
  double size(std::size_t time, std::size_t output) const {
    const std::size_t i = time * outputs_ + output;
    return std::max(std::fabs(upper_[i].value), std::fabs(lower_[i].value));
  }

 private:
  struct End {
    double value;
    Place place;
  };
  const System& s_;
  gamut::Motion motion_;
  Witness witness_;
  std::size_t outputs_;
  std::vector<End> lower_, upper_;
  std::vector<std::size_t> wide_;
};

/// Ratios of each state and output at the output times that were reached.
struct Widths {
  std::vector<double> ratios;  // rising
  std::size_t output = 0;      // of the greatest
  double time = 0;
  bool isBeyond = false;
  long small = 0;
};

Widths widthsOf(const System& s, const Program& f, const Program& g, const Tube& tube, unsigned number) {
  const std::vector<double> times(tube.times().begin() + 1,
                                  tube.times().begin() + static_cast<std::ptrdiff_t>(tube.reachedTimes()));
  Widths result;
  if (times.empty()) return result;
  Extent extent(s, f, g, times);
  Points points(number + 7);
  extent.takeGridAndRandom(points);
  const auto outputs = at(g.outputs());
  const auto enclosed = [&](std::size_t m, std::size_t o) {
    const double own = gamut::width(tube.outputs(m + 1)[o]);
    return o < s.states() ? std::min(own, gamut::width(tube.states(m + 1)[o])) : own;
  };
  struct Loose {
    double ratio;
    std::size_t time, output;
  };
  std::vector<Loose> loose;
  for (std::size_t m = 0; m < times.size(); ++m)
    for (std::size_t o = 0; o < outputs; ++o)
      if (const double w = extent.width(m, o); w > 0 && enclosed(m, o) > tight * w)
        loose.push_back({enclosed(m, o) / w, m, o});
  std::ranges::sort(loose, [](const Loose& a, const Loose& b) { return a.ratio < b.ratio; });
  constexpr std::size_t searched = 12;
  for (std::size_t i = 0; i < std::min(searched, loose.size()); ++i)  // from where little is missing to where much is
    extent.search(loose[i * loose.size() / std::min(searched, loose.size())].time,
                  loose[i * loose.size() / std::min(searched, loose.size())].output, points);
  double worst = 0;
  for (std::size_t o = 0; o < outputs; ++o) {
    double widest = 0, size = 0;
    for (std::size_t m = 0; m < times.size(); ++m) {
      widest = std::max(widest, extent.width(m, o));
      size = std::max(size, extent.size(m, o));
    }
    const double least = std::max(1e-3 * widest, 1e-9 * size);
    for (std::size_t m = 0; m < times.size(); ++m) {
      const double w = extent.width(m, o), own = enclosed(m, o);
      result.isBeyond = result.isBeyond || own > far * std::max(widest, 1e-9 * size);
      if (!(w > least)) {
        ++result.small;
        continue;
      }
      result.ratios.push_back(own / w);
      result.isBeyond = result.isBeyond || own / w > far;
      if (own / w <= worst) continue;
      worst = own / w;
      result.output = o;
      result.time = times[m];
    }
  }
  std::ranges::sort(result.ratios);
  return result;
}

/// Whether the other method finds the same solution.
void compareMethods(const System& s, const Vector& start, const std::vector<double>& times,
                    const Containment::Motion& found, unsigned number, Count& count) {
  const Program f = s.motion(true);
  SlidingReference reference(f, restOf(f));
  reference.most = mostEvents;
  const std::vector<Vector> states = reference(start, times);
  if (states.size() < times.size()) return;
  ++count.compared;
  Vector size(s.states(), Precise(0.0));
  for (const Vector& x : states)
    for (std::size_t i = 0; i < x.size(); ++i) size[i] = std::max(size[i], Precise(abs(x[i])));
  for (std::size_t m = 0; m < times.size(); ++m)
    for (std::size_t i = 0; i < s.states(); ++i) {
      const Precise &a = found.states[m][i], &b = states[m][i];
      if (abs(a - b) <= Precise(1e-12) * size[i] + found.stateErrors[m][i]) continue;
      ++count.different;
      fmt::print("system {}: two methods find {} and {} for state {} at {} s\n", number, a.str(20), b.str(20), i,
                 times[m]);
      return;
    }
}

/// Solutions from all corners and from inside, until one is outside.
void judgeSolutions(const System& s, Judge& judge, unsigned number, Count& count) {
  SCOPED_TRACE(fmt::format("system {}", number));
  Points points(number);
  const auto wide = std::ranges::count_if(s.box, [](const Interval& value) { return !isThin(value); });
  const int corners = 1 << wide, inside = 4;
  for (int i = 0; i < corners + inside; ++i) {
    const Vector start = i < corners ? cornerOf(s.box, i) : points.inside(s.box);
    ::testing::TestPartResultArray failures;  // of this solution alone
    try {
      const ::testing::ScopedFakeTestPartResultReporter reporter(
          ::testing::ScopedFakeTestPartResultReporter::INTERCEPT_ONLY_CURRENT_THREAD, &failures);
      judge.follow(start);
      ++count.solutions;
    } catch (const Unfollowed&) {
      ++count.unfollowed;
    }
    if (failures.size() == 0) continue;
    ++count.outside;
    ADD_FAILURE() << failures.GetTestPartResult(0).message();
    return;
  }
}

/// Start and quantities in their order, those that are uncertain with their half width.
std::string describe(const System& s) {
  std::string text;
  const std::size_t n = s.states();
  std::size_t next = n;
  for (std::size_t i = 0; i < n + s.machine.quantity.size(); ++i) {
    const bool isUncertain = std::ranges::find(s.uncertain, i) != s.uncertain.end();
    text += fmt::format("{}{:.6g}",
                        i == 0   ? ""
                        : i == n ? "; "
                                 : ", ",
                        i < n ? s.machine.start[i] : s.machine.quantity[i - n]);
    if (isUncertain) text += fmt::format(" ± {:.3g}", 0.5 * gamut::width(s.box[i < n ? i : next++]));
  }
  return text + fmt::format("; length {}, {:.4g} rad/s", s.machine.length, s.machine.turn);
}

void judgeSystem(unsigned number, double work, Count& count) {
  const char* const told = std::getenv("PIECEWISE_MISSES");
  const System s = systemOf(number, count);
  const Program f = s.motion(), g = s.outputs();
  Containment c;
  c.f = f;
  c.g = g;
  c.box = s.box;
  c.horizon = s.horizon;
  for (int i = 1; i <= rows; ++i) c.times.push_back(s.horizon * i / rows);
  c.options.budget = work;
  int compared = 0;
  c.motion = [&](const Vector& start, const std::vector<double>& times) {
    std::optional<Containment::Motion> found = arbitrated(s, start, times);
    if (!found) {
      found = slid(s, start, times);
      if (!found) throw Unfollowed{};
      ++count.slid;
    } else if (compared++ % 6 == 0) {  // of the first, a corner, and of one more
      compareMethods(s, start, times, *found, number, count);
    }
    return *std::move(found);
  };
  std::optional<Judge> judge(std::in_place, c, number + 1);
  const double reached = judge->tube().reached(), cpu = judge->tube().cpuSeconds();
  const std::string why = judge->tube().why();
  const bool isEarly = reached < s.horizon || !why.empty();
  ++count.systems;
  count.reached += !isEarly;
  count.events.push_back(static_cast<double>(s.events));
  count.longest = std::max(count.longest, cpu);
  judgeSolutions(s, *judge, number, count);
  if (isEarly && reached > 0 && judge->tube().reachedTimes() < 3) {  // more of what was proved
    c.times.clear();
    for (const double part : {0.25, 0.5, 0.75, 0.9375}) c.times.push_back(part * reached);
    judge.emplace(c, number + 1);
    judgeSolutions(s, *judge, number, count);
  }
  const Widths widths = widthsOf(s, f, g, judge->tube(), number);
  count.small += widths.small;
  count.beyond += widths.isBeyond && !isEarly;
  const double middle = middleOf(widths.ratios), greatest = greatestOf(widths.ratios);
  if (told && (isEarly || widths.isBeyond || greatest > tight || std::string(told) == "all"))
    fmt::print(
        "system {} ({}): {:.4g} of {:.4g} s, {:.1f} s CPU; ratio {:.4f}, {:.4g} of output {} at {:.4g} s{} {}\n    "
        "{}\n",
        number, drawn[number % drawn.size()].name, reached, s.horizon, cpu, middle, greatest, widths.output,
        widths.time, why.empty() ? "" : ":", why, describe(s));
  count.unmeasured += !isEarly && widths.ratios.empty();
  if (isEarly || widths.ratios.empty()) return;
  count.middles.push_back(middle);
  count.greatest.push_back(greatest);
  count.ratios.insert(count.ratios.end(), widths.ratios.begin(), widths.ratios.end());
}

void add(Count& sum, const Count& part) {
  for (long Count::*number : {&Count::systems, &Count::reached, &Count::solutions, &Count::outside, &Count::unfollowed,
                              &Count::slid, &Count::compared, &Count::different, &Count::beyond, &Count::drawnAnew,
                              &Count::endless, &Count::small, &Count::unmeasured})
    sum.*number += part.*number;
  sum.longest = std::max(sum.longest, part.longest);
  for (std::vector<double> Count::*values : {&Count::middles, &Count::greatest, &Count::ratios, &Count::events})
    (sum.*values).insert((sum.*values).end(), (part.*values).begin(), (part.*values).end());
}

void tell(const char* name, const Count& count) {
  fmt::print("{:<12} {:>7} {:>7} {:>6.1f} {:>9} {:>7} {:>9.4f} {:>9.4f} {:>10.4g} {:>7} {:>7.1f}\n", name,
             count.systems, count.reached,
             100.0 * static_cast<double>(count.reached) / static_cast<double>(std::max(1L, count.systems)),
             count.solutions, count.outside, middleOf(count.middles), middleOf(count.greatest),
             greatestOf(count.greatest), count.beyond, count.longest);
}

}  // namespace
}  // namespace gamut::testing

int main(int argc, char** argv) {
  using namespace gamut::testing;
  const int systems = argc > 1 ? std::atoi(argv[1]) : 300;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  const double work = argc > 3 ? std::atof(argv[3]) : 5;
  if (argc > 4 && std::string(argv[4]) != "surfaces") {
    fmt::print(stderr, "unknown kind '{}'; expected surfaces, or none\n", argv[4]);
    return 2;
  }
  if (argc > 4) drawn = bent;
  std::vector<Count> counts(drawn.size());
  Count all;
  for (int i = first; i < first + systems; ++i) {
    judgeSystem(static_cast<unsigned>(i), work, counts[static_cast<std::size_t>(i) % drawn.size()]);
    std::fflush(stdout);
  }
  // Ratios of systems that came to their horizon: of each its middle one and its greatest, and the medians of these.
  fmt::print("{:<12} {:>7} {:>7} {:>6} {:>9} {:>7} {:>9} {:>9} {:>10} {:>7} {:>7}\n", "kind", "systems", "reached", "%",
             "solutions", "outside", "middle", "greatest", "of all", "> 1e3", "cpu/s");
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    tell(drawn[k].name, counts[k]);
    add(all, counts[k]);
  }
  tell("all", all);
  fmt::print("outside: {} of {} solutions; {} by the other method, {} that neither could follow\n", all.outside,
             all.solutions, all.slid, all.unfollowed);
  fmt::print("two methods: {} solutions compared, {} different\n", all.compared, all.different);
  fmt::print("reached: {} of {} systems\n", all.reached, all.systems);
  fmt::print("width ratio: {:.4f} the median of {} ratios ({} of too little width left out)\n", middleOf(all.ratios),
             all.ratios.size(), all.small);
  fmt::print("wider than {} times without ending: {} systems; {} not measured, for want of solutions in doubles\n", far,
             all.beyond, all.unmeasured);
  fmt::print("nominal machines: {} events in the median, {} at most\n", middleOf(all.events), greatestOf(all.events));
  fmt::print("drawn anew for want of events: {}; with events without end at the start: {}\n", all.drawnAnew,
             all.endless);
  return ::testing::Test::HasFailure() || all.different > 0 || all.solutions == 0 ? 1 : 0;
}
