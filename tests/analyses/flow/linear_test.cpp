// The flow on equations whose solutions are known in closed form: wherever a term is missing in a bound, the true error
// of a linear system shows it, because nothing else hides it.
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

/// A linear system and its solution x(t; start, parameters).
struct Linear {
  std::string name;
  int states, parameters;
  Program f;
  std::vector<double> nominal;
  std::function<Vector(const Precise& t, const Vector& x)> solution;
};

void PrintTo(const Linear& system, std::ostream* out) { *out << system.name; }

std::vector<Linear> linearSystems() {
  std::vector<Linear> systems;
  systems.push_back({"growth",
                     1,
                     0,
                     record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = x[0]; }),
                     {1.0},
                     [](const Precise& t, const Vector& x) { return Vector{x[0] * exp(t)}; }});
  systems.push_back({"decay",
                     1,
                     0,
                     record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -x[0]; }),
                     {0.7},
                     [](const Precise& t, const Vector& x) { return Vector{x[0] * exp(-t)}; }});
  systems.push_back({"rotation",
                     2,
                     0,
                     record(2, 0,
                            [](auto, const auto& x, const auto&, auto& dx) {
                              dx[0] = x[1];
                              dx[1] = -x[0];
                            }),
                     {0.6, -0.3},
                     [](const Precise& t, const Vector& x) {
                       const Precise c = cos(t), s = sin(t);
                       return Vector{c * x[0] + s * x[1], c * x[1] - s * x[0]};
                     }});
  systems.push_back({"rate",
                     1,
                     1,
                     record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * x[0]; }),
                     {1.3, -0.8},
                     [](const Precise& t, const Vector& x) { return Vector{x[0] * exp(x[1] * t)}; }});
  // Eigenvectors (1,1,1), (1,0,-1), (1,-2,1) with eigenvalues 1, -1, -4: a full matrix, 0.5 and multiples of it exact.
  systems.push_back({"coupled",
                     3,
                     0,
                     record(3, 0,
                            [](auto, const auto& x, const auto&, auto& dx) {
                              const auto mean = (x[0] + x[1] + x[2]) / 3.0;
                              const auto slope = (x[0] - x[2]) / 2.0;
                              const auto bend = (x[0] - 2.0 * x[1] + x[2]) / 6.0;
                              dx[0] = mean - slope - 4.0 * bend;
                              dx[1] = mean + 8.0 * bend;
                              dx[2] = mean + slope - 4.0 * bend;
                            }),
                     {1.0, -0.5, 0.25},
                     [](const Precise& t, const Vector& x) {
                       const Precise mean = (x[0] + x[1] + x[2]) / 3 * exp(t);
                       const Precise slope = (x[0] - x[2]) / 2 * exp(-t);
                       const Precise bend = (x[0] - 2 * x[1] + x[2]) / 6 * exp(-4 * t);
                       return Vector{mean + slope + bend, mean - 2 * bend, mean - slope + bend};
                     }});
  // x' = c: nothing but the addition of steps can go wrong.
  systems.push_back({"drift",
                     1,
                     1,
                     record(1, 1, [](auto, const auto&, const auto& p, auto& dx) { dx[0] = p[0]; }),
                     {1.0, 1e-3},
                     [](const Precise& t, const Vector& x) { return Vector{x[0] + x[1] * t}; }});
  // x' = t³ p: polynomials in time, kept exactly by every order above 4.
  systems.push_back({"ramp",
                     1,
                     1,
                     record(1, 1, [](auto t, const auto&, const auto& p, auto& dx) { dx[0] = t * t * t * p[0]; }),
                     {0.3, 0.9},
                     [](const Precise& t, const Vector& x) { return Vector{x[0] + x[1] * t * t * t * t / 4}; }});
  return systems;
}

class LinearFlow : public ::testing::TestWithParam<Linear> {};

/// The solution of every start tried lies inside at every output time; returns the greatest width met.
double expectSolutionInside(const Linear& system, const Box& box, const FlowOptions& options, double horizon,
                            Points& points) {
  std::vector<double> times;
  for (int i = 1; i <= 4; ++i) times.push_back(horizon * i / 4.3);
  const Tube tube = Flow(system.f, options).enclose(box, horizon, times);
  EXPECT_EQ(tube.why(), "");
  double widest = 0;
  for (int sample = 0; sample < 4; ++sample) {
    const Vector start = sample < 3 ? points.corner(box) : points.inside(box);
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
      const Vector truth =  // at the start exactly itself, else rounded to 128 bits
          i == 0 ? Vector(start.begin(), start.begin() + system.states)
                 : system.solution(Precise(tube.times()[i]), start);
      for (std::size_t s = 0; s < truth.size(); ++s) {
        EXPECT_THAT(tube.states(i)[s], Encloses(truth[s])) << "at " << tube.times()[i] << ", state " << s;
        widest = std::max(widest, width(tube.states(i)[s]));
      }
    }
  }
  return widest;
}

Box around(const std::vector<double>& nominal, double relative) {
  Box box;
  for (double value : nominal) box.push_back(value * Interval(1 - relative, 1 + relative));
  return box;
}

TEST_P(LinearFlow, HoldsTheSolutionForEveryOrderAndDegree) {
  Points points(1);
  for (int order : {4, 6, 10, 15, 20, 30})
    for (int degree : {0, 1, 2, 4, 8, 12}) {
      SCOPED_TRACE("order " + std::to_string(order) + ", degree " + std::to_string(degree));
      FlowOptions options;
      options.order = order;
      options.tolerance = order < 10 ? 1e-9 : 0;
      if (degree > 0) options.degree = GetParam().nominal.size() > 2 ? std::min(degree, 4) : degree;
      options.split = false;
      expectSolutionInside(GetParam(), around(GetParam().nominal, degree == 0 ? 0 : 0.1), options, 1.5, points);
      if (HasFailure()) return;
    }
}

TEST_P(LinearFlow, HoldsTheSolutionWhateverTheStep) {
  Points points(2);
  for (double tolerance : {1e-17, 1e-13, 1e-9, 1e-5, 1e-2})
    for (double horizon : {1e-6, 0.3, 5.0, 20.0})
      for (double relative : {0.0, 1e-14, 0.02}) {
        if (GetParam().name == "coupled" && relative > 0 && horizon > 5) continue;
        SCOPED_TRACE("tolerance " + std::to_string(tolerance) + ", horizon " + std::to_string(horizon));
        FlowOptions options;
        options.order = 12;
        options.tolerance = tolerance;
        options.split = false;
        options.maxWidth = 1e30;
        options.degree = relative > 0 ? 2 : -1;
        expectSolutionInside(GetParam(), around(GetParam().nominal, relative), options, horizon, points);
        if (HasFailure()) return;
      }
}

TEST_P(LinearFlow, HoldsTheSolutionOnEveryPieceAndFrame) {
  Points points(3);
  for (int frameDegree : {0, 1, 2, 3, 4})
    for (double splitDefect : {1e-6, 1e-12}) {
      FlowOptions options;
      options.frameDegree = frameDegree;
      options.degree = 4;
      options.splitDefect = splitDefect;
      options.maxPieces = 12;
      expectSolutionInside(GetParam(), around(GetParam().nominal, 0.2), options, 1.0, points);
      if (HasFailure()) return;
    }
}

TEST_P(LinearFlow, IsTightFromAThinStart) {
  Points points(4);
  const double widest = expectSolutionInside(GetParam(), around(GetParam().nominal, 0), {}, 2.0, points);
  EXPECT_LT(widest, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Flow, LinearFlow, ::testing::ValuesIn(linearSystems()),
                         [](const auto& system) { return system.param.name; });

}  // namespace
}  // namespace gamut::testing
