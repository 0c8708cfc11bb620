// The formulations of equations of motion in comparison (docs/formulations.md): operations, speed and width of what
// each makes of chains, trees and closed loops. Names: MACHINE/SIZE/FORMULATION/WHAT, where WHAT is
//
//     one, pack       one evaluation of all accelerations in doubles, alone and in a pack of samples (time a sample)
//     thin, percent   the validated flow by one piece: all known, over 2 s; three masses ± 1 %, over 0.5 s
//
// Counters: `operations` of one evaluation; `ratio` of its time to that of the first formulation of the same machine,
// the baseline of the same run; `off`, by how much accelerations differ from its own, of the greatest. Of flows:
// `reached` (s) within two seconds of counted work, `ms/s` of CPU time for a second of motion, `steps`, `width` of the
// position known least there (rad, m), and over that of `samples`, `loose`.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/roots/root_family.hpp"
#include "benchmarks/formulations/equations.hpp"
#include "benchmarks/formulations/machines.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/sample_pack.hpp"

namespace gamut::benchmarks {
namespace {

constexpr double horizon = 0.5, thinHorizon = 2;  // s
constexpr double tolerance = 0.01, budget = 2;    // relative; s of counted work

/// A machine in one of its formulations.
struct Formulated {
  std::string machine, name;
  Program motion;
  std::vector<double> start, masses;  // nominal
  std::vector<int> positions;         // of independent coordinates
  Box remainder;                      // of states in `dependents` at the start
  std::vector<int> dependents;
  bool isFirst = false;
  double difference = 0;  // from the first

  std::string key() const { return machine + '/' + name; }
  Box box(double relative) const {
    Box box(start.begin(), start.end());
    for (std::size_t i = 0; i < dependents.size(); ++i) box[dependents[i]] += remainder[i];
    for (const double mass : masses) box.push_back(Interval(mass) * Interval(1 - relative, 1 + relative));
    return box;
  }
};

/// To that of the machine's first formulation; not a number where that was not measured.
double ratioToFirst(const Formulated& of, const char* what, double seconds) {
  static std::map<std::string, double> first;
  if (of.isFirst) first[of.machine + what] = seconds;
  const auto found = first.find(of.machine + what);
  return found == first.end() ? std::nan("") : seconds / found->second;
}

/// By how much independent accelerations differ from those of another formulation at the start, of the greatest.
double differenceOf(const Formulated& of, const Formulated& other, std::size_t positions) {
  const auto accelerations = [&](const Formulated& one) {
    Evaluator<double> evaluate(one.motion);
    evaluate.setParameters(one.masses);
    const std::vector<double> rates = evaluate(0.0, one.start);
    return std::vector<double>(rates.begin() + static_cast<std::ptrdiff_t>(positions),
                               rates.begin() + static_cast<std::ptrdiff_t>(positions + one.positions.size()));
  };
  const std::vector<double> a = accelerations(of), b = accelerations(other);
  double most = 0, size = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    most = std::max(most, std::abs(a[i] - b[i]));
    size = std::max(size, std::abs(b[i]));
  }
  return most / size;
}

template <class Evaluate>
void timed(benchmark::State& state, const Formulated& of, const char* what, double samples, const Evaluate& evaluate) {
  const std::clock_t began = std::clock();  // of the processor
  double count = 0;
  for (auto _ : state) {
    evaluate();
    ++count;
  }
  const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC / (count * samples);
  state.counters["ratio"] = ratioToFirst(of, what, seconds);
  state.counters["ns"] = 1e9 * seconds;
}

void one(benchmark::State& state, const Formulated& of) {
  Evaluator<double> evaluate(of.motion);
  evaluate.setParameters(of.masses);
  std::vector<double> rates(of.start.size());
  timed(state, of, "/one", 1, [&] {
    evaluate(0.0, std::span<const double>(of.start), std::span<double>(rates));
    benchmark::DoNotOptimize(rates.data());
    benchmark::ClobberMemory();
  });
  state.counters["off"] = of.difference;
  state.counters["operations"] = static_cast<double>(evaluate.tape().operations());
}

void pack(benchmark::State& state, const Formulated& of) {
  PackEvaluator evaluate(of.motion, usableUnits().back());
  const auto repeated = [](const std::vector<double>& numbers) {
    std::vector<double> all;
    for (const double each : numbers) all.insert(all.end(), packWidth, each);
    return all;
  };
  evaluate.setParameters(repeated(of.masses));
  const std::vector<double> x = repeated(of.start), t(packWidth, 0.0);
  std::vector<double> rates(x.size());
  timed(state, of, "/pack", static_cast<double>(packWidth), [&] {
    evaluate(t, x, rates);
    benchmark::DoNotOptimize(rates.data());
    benchmark::ClobberMemory();
  });
  state.SetLabel(nameOf(usableUnits().back()));
}

std::vector<double> timesTo(double end) {
  std::vector<double> all;
  for (int i = 1; i <= 10; ++i) all.push_back(i * end / 10);
  return all;
}

/// What samples of three masses reach, at timesTo(horizon): of each position. By the classical Runge-Kutta method.
std::vector<Box> sampledRanges(const Formulated& of) {
  constexpr int steps = 50, random = 24;  // of each tenth of the horizon
  Evaluator<double> evaluate(of.motion);
  const std::size_t n = of.start.size();
  const int corners = 1 << of.masses.size();
  std::vector<Box> ranges(timesTo(horizon).size(), Box(of.positions.size(), Interval::empty()));
  std::mt19937_64 engine(7);
  for (int sample = 0; sample < corners + random; ++sample) {
    std::vector<double> masses = of.masses, x = of.start;
    for (std::size_t i = 0; i < masses.size(); ++i)
      masses[i] *= 1 + tolerance * (sample >= corners        ? std::uniform_real_distribution<>(-1, 1)(engine)
                                    : (sample >> i) % 2 == 0 ? -1.0
                                                             : 1.0);
    evaluate.setParameters(masses);
    const auto moved = [&](const std::vector<double>& rate, double time) {
      std::vector<double> y = x;
      for (std::size_t i = 0; i < n; ++i) y[i] += time * rate[i];
      return y;
    };
    const double h = horizon / (10 * steps);
    for (Box& range : ranges) {
      for (int i = 0; i < steps; ++i) {
        const std::vector<double> k1 = evaluate(0.0, x), k2 = evaluate(0.0, moved(k1, h / 2)),
                                  k3 = evaluate(0.0, moved(k2, h / 2)), k4 = evaluate(0.0, moved(k3, h));
        for (std::size_t k = 0; k < n; ++k) x[k] += h / 6 * (k1[k] + 2 * k2[k] + 2 * k3[k] + k4[k]);
      }
      for (std::size_t k = 0; k < of.positions.size(); ++k) range[k] = hull(range[k], Interval(x[of.positions[k]]));
    }
  }
  return ranges;
}

void flow(benchmark::State& state, const Formulated& of, double relative,
          const std::shared_ptr<const std::vector<Box>>& sampled) {
  FlowOptions options;
  options.split = false;
  options.budget = budget;
  options.remainders = of.dependents;
  const Flow flow(of.motion, options);
  Tube tube;
  const double end = relative > 0 ? horizon : thinHorizon;
  for (auto _ : state) tube = flow.enclose(of.box(relative), end, timesTo(end));
  const std::size_t row = tube.reachedTimes() - 1;
  double widest = 0, loosest = 0;
  for (std::size_t k = 0; k < of.positions.size(); ++k) {
    const double own = width(tube.states(row)[of.positions[k]]);
    widest = std::max(widest, own);
    if (row > 0 && relative > 0) loosest = std::max(loosest, own / width((*sampled)[row - 1][k]));
  }
  state.counters["reached"] = tube.reached();
  state.counters["ms/s"] = 1e3 * tube.cpuSeconds() / tube.reached();
  state.counters["steps"] = static_cast<double>(tube.steps());
  state.counters["width"] = widest;
  state.counters["loose"] = loosest;
  state.SetLabel(tube.why());
}

/// `sampled` by the first formulation.
void registerAll(const std::vector<Formulated>& all, std::size_t positions, bool enclosed) {
  const auto sampled = std::make_shared<std::vector<Box>>();
  for (const Formulated& of : all) {
    const auto shared = std::make_shared<Formulated>(of);
    shared->isFirst = &of == &all.front();
    shared->difference = differenceOf(of, all.front(), positions);
    const auto add = [&](const char* what, auto run) {
      return benchmark::RegisterBenchmark((of.key() + '/' + what).c_str(), run);
    };
    add("one", [shared](benchmark::State& state) { one(state, *shared); });
    add("pack", [shared](benchmark::State& state) { pack(state, *shared); });
    if (!enclosed) continue;
    add("thin", [shared](benchmark::State& state) { flow(state, *shared, 0, nullptr); })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
    add("percent",
        [shared, sampled, first = all.front()](benchmark::State& state) {
          if (sampled->empty()) *sampled = sampledRanges(first);
          flow(state, *shared, tolerance, sampled);
        })
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
  }
}

std::vector<double> nominalMasses(const Machine& machine) {
  std::vector<double> masses;
  for (const std::string& name : machine.masses) masses.push_back(midpoint(machine.mechanism.nominal(name)));
  return masses;
}

/// The first is what samples take.
void addTree(const Machine& machine) {
  const std::vector<double> start = Assembly<double>(machine.mechanism).initialState();
  std::vector<Formulated> all;
  for (const auto& [name, solver] : std::vector<std::pair<const char*, Solver>>{{"articulated", articulated},
                                                                                {"unit accelerations", kinetostatic},
                                                                                {"Jacobians", byJacobians},
                                                                                {"composite", composite},
                                                                                {"least constraint", eliminated},
                                                                                {"cut at joints", cutAtJoints}}) {
    Formulated& of = all.emplace_back();
    of.machine = machine.name + '/' + std::to_string(machine.size);
    of.name = name;
    of.motion = motionOfTree(machine.mechanism, machine.masses, solver);
    of.start = start;
    of.masses = nominalMasses(machine);
    for (std::size_t i = 0; i < start.size() / 2; ++i) of.positions.push_back(static_cast<int>(i));
  }
  constexpr int mostEnclosed = 10;
  registerAll(all, start.size() / 2, machine.size <= mostEnclosed);
}

/// Likewise. States of dependent coordinates are differences from where loops close (Assembly::setMotion), but for
/// those of multipliers.
void addLoops(const Machine& machine) {
  const Mechanism& mechanism = machine.mechanism;
  Assembly<double> nominal(mechanism);
  const std::vector<std::string> names = mechanism.stateNames();
  std::vector<int> free, dependents;
  for (int i = 0; i < static_cast<int>(mechanism.positions()); ++i)
    (std::ranges::find(mechanism.dependents(), names[i]) == mechanism.dependents().end() ? free : dependents)
        .push_back(i);
  const std::vector<double> masses = nominalMasses(machine);
  const Box remainder =
      proveRoots(recordClosing(mechanism, machine.masses), Box(masses.begin(), masses.end()), -1, 1e-15).remainder;
  const auto formulated = [&](const char* name, Program motion) {
    Formulated of;
    of.machine = machine.name + '/' + std::to_string(machine.size);
    of.name = name;
    of.motion = std::move(motion);
    of.masses = masses;
    of.positions = free;
    of.start = nominal.initialState();
    return of;
  };
  const auto byRows = [&](const char* name, Formulation formulation) {
    Formulated of = formulated(name, recordMotion(mechanism, machine.masses, formulation));
    for (const std::string& dependent : mechanism.dependents()) {
      const auto place = static_cast<int>(std::ranges::find(names, dependent) - names.begin());
      of.dependents.push_back(place);
      of.start[place] = 0;
    }
    of.remainder = remainder;
    return of;
  };
  std::vector<Formulated> all{byRows("independent speeds", Formulation::articulated),
                              byRows("as enclosed", Formulation::sparse), byRows("bordered", Formulation::bordered)};
  Formulated& multipliers =
      all.emplace_back(formulated("multipliers, all speeds", motionByMultipliers(mechanism, machine.masses)));
  const auto& speeds = nominal.system().speeds();
  for (std::size_t i = speeds.size() - mechanism.dependents().size(); i < speeds.size(); ++i)
    multipliers.start.push_back(speeds[i].get().rate);
  constexpr int mostEnclosed = 3;
  registerAll(all, mechanism.positions(), machine.size <= mostEnclosed);
}

}  // namespace
}  // namespace gamut::benchmarks

int main(int argc, char** argv) {
  using namespace gamut::benchmarks;
  benchmark::Initialize(&argc, argv);
  for (const bool isInSpace : {false, true})
    for (const int bodies : {1, 2, 3, 5, 10, 20, 30}) addTree(chain(bodies, isInSpace));
  for (const int many : {2, 3}) addTree(arms(many));
  for (const int levels : {3, 4}) addTree(binaryTree(levels));
  for (const int loops : {1, 3, 10}) addLoops(ladder(loops));
  addLoops(stewartPlatform());
  benchmark::RunSpecifiedBenchmarks();
}
