// The sampled ensemble of the double pendulum to 3 s, its first angle uniform within ± 1 %. Baselines of the same run:
//
// - plainRungeKutta: as many trajectories in plain doubles by the classical Runge-Kutta method with steps of 1 ms.
// - oneEach: one CVODE problem a sample, with equations by hand (cvode_pendulum.hpp), at the tolerance of the packs, or
//   at that with which it is as accurate as they are. `ofLibrary`: with SUNDIALS' own vectors.
//
// `ensemble` is the whole: the packs, corners, the measurement of the witness's error and the statistics; `packs` is
// the integration of the samples alone. `oneEach`, `packs` and `ensembleOfStates` are of the four states at 300 output
// times; `ensemble` is of one output.
//
// Errors are those of all four states of all samples at 3 s, the greatest and the root of the mean square. The truth
// is a motion in long double by extrapolation of the midpoint rule (W. B. Gragg, SIAM J. Numer. Anal. 2, 1965);
// `doubt`: its greatest difference from the 128-bit series of `arbitrate`, of 16 samples. Which tolerance makes the
// baseline as accurate as the packs: its error (root of the mean square) is measured at nine tolerances, relative and
// absolute by one factor, from 1/4 to 4 of the packs'; since it rises with them by fits and starts, a power law is
// fitted, and solved for the packs' error. (Its greatest error is then greater than the packs', whose samples all take
// the steps of the one that needs the shortest.)
//
// items_per_second: trajectories a second of real time, not counting corners and the measurement of the witness's
// error, though their cost and that of the statistics is in the time of the whole. `cpu`: the least CPU time of an
// iteration, all threads together, s. `faster`: the same of the equally accurate baseline on as many threads over this.
//
// Of 4096 samples on one thread of an EPYC with AVX-512, which others used too: at equal accuracy packs are 11 times as
// fast as the baseline, the whole ensemble 6 times; 23 and 13 times as fast as with the library's vectors as Debian 12
// compiles them. Where all of SUNDIALS is compiled for the machine (-O3 -march=native) both gain: 6 and 4 times.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <thread>

#include "analyses/samples/arbiter.hpp"
#include "analyses/samples/pack_witness.hpp"
#include "analyses/workers.hpp"
#include "benchmarks/cvode_pendulum.hpp"
#include "benchmarks/sampled_pendulum.hpp"

namespace gamut::benchmarks {
namespace {

using State = std::array<double, 4>;
constexpr std::size_t samples = 4096;

void plainRungeKutta(benchmark::State& state) {
  for (auto _ : state)
    for (int sample = 0; sample < state.range(0); ++sample) benchmark::DoNotOptimize(plainTrajectory(sampledHorizon));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(plainRungeKutta)->Arg(1024)->Unit(benchmark::kMillisecond);

void ensemble(benchmark::State& state) {
  const UncertainMotion pendulum =
      sampledPendulum(record(4, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; }));
  EnsembleOptions options;
  options.samples = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    EnsembleRun run(pendulum, options);
    run.integrateFirst();
    run.integrateOthers();
    benchmark::DoNotOptimize(run.statistics());
    if (!run.why().empty()) {
      state.SkipWithError(run.why().c_str());
      return;
    }
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(ensemble)->Arg(1024)->Arg(4096)->Unit(benchmark::kMillisecond);

/// The pendulum whose outputs are its states.
const UncertainMotion& pendulumOfStates() {
  static const UncertainMotion pendulum =
      sampledPendulum(record(4, 0, 4, [](auto, const auto& x, const auto&, auto& y) {
        for (std::size_t i = 0; i < 4; ++i) y[i] = x[i];
      }));
  return pendulum;
}

const std::vector<double>& times() { return pendulumOfStates().motion.times; }

/// As the ensemble's samples.
const std::vector<std::vector<double>>& starts() {
  static const auto all = [] {
    const UncertainMotion& pendulum = pendulumOfStates();
    const EnsembleOptions options;
    Sampling sampling(options.plan, 1, samples, options.seed);
    std::vector<std::vector<double>> values;
    for (std::size_t i = 0; i < samples; ++i) values.push_back(pendulum.start(sampling.values(i, pendulum.uncertain)));
    return values;
  }();
  return all;
}

/// The state at the horizon: 120 steps, of each of which 2, 4, … 20 parts are taken by the midpoint rule.
std::array<long double, 4> extrapolated(const std::vector<double>& start) {
  using Long = std::array<long double, 4>;
  constexpr int steps = 120, rows = 10;
  constexpr long double g = 9.81;  // the double
  Long x{};
  std::ranges::copy(start, x.begin());
  for (int step = 0; step < steps; ++step) {
    std::array<Long, rows> table;
    Long rate, first;
    doublePendulum(g, x, first);
    for (int row = 0; row < rows; ++row) {
      const int parts = 2 * (row + 1);
      const long double h = static_cast<long double>(sampledHorizon) / steps / parts;
      Long before = x, now = x;
      for (std::size_t i = 0; i < 4; ++i) now[i] += h * first[i];
      for (int part = 1; part < parts; ++part) {
        doublePendulum(g, now, rate);
        for (std::size_t i = 0; i < 4; ++i) before[i] += 2 * h * rate[i];
        std::swap(before, now);
      }
      table[row] = now;
      // Aitken and Neville's rule, in place: table[k] holds what rows k … row give together.
      for (int k = row - 1; k >= 0; --k) {
        const long double ratio = static_cast<long double>(row + 1) / (k + 1), by = 1 / (ratio * ratio - 1);
        Long& coarser = table[k];
        const Long& finer = table[static_cast<std::size_t>(k) + 1];
        for (std::size_t i = 0; i < 4; ++i) coarser[i] = finer[i] + (finer[i] - coarser[i]) * by;
      }
    }
    x = table[0];
  }
  return x;
}

struct Truth {
  std::vector<std::array<long double, 4>> states;
  double doubt = 0;
};

const Truth& truth() {
  static const Truth known = [] {
    Truth result;
    result.states.resize(samples);
    const int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    forEachIndex(jobs, samples, nullptr,
                 [&] { return [&](std::size_t i) { result.states[i] = extrapolated(starts()[i]); }; });
    Motion motion = pendulumOfStates().motion;
    motion.times = {sampledHorizon};
    for (std::size_t sample = 0; sample < samples; sample += samples / 16) {
      const PreciseTrajectory precise = arbitrate(motion, starts()[sample]);
      for (std::size_t i = 0; i < 4; ++i)
        result.doubt = std::max(
            result.doubt,
            std::abs(static_cast<double>(precise.values.at(i).convert_to<long double>() - result.states[sample][i])));
    }
    return result;
  }();
  return known;
}

struct Errors {
  double greatest = 0, rms = 0;
};

Errors errorsOf(const std::vector<State>& last) {
  Errors errors;
  long double sum = 0;
  for (std::size_t sample = 0; sample < samples; ++sample)
    for (std::size_t i = 0; i < 4; ++i) {
      const long double error = std::abs(last[sample][i] - truth().states[sample][i]);
      errors.greatest = std::max(errors.greatest, static_cast<double>(error));
      sum += error * error;
    }
  errors.rms = static_cast<double>(std::sqrt(sum / (4 * samples)));
  return errors;
}

/// All samples, one after the other; returns their last states.
std::vector<State> integrateOneEach(const Tolerance& tolerance, Vectors vectors, int jobs) {
  std::vector<State> last(samples);
  forEachIndex(jobs, samples, nullptr, [&] {
    return [&, pendulum = std::make_unique<CvodePendulum>(tolerance, vectors),
            trajectory = std::vector<double>(4 * times().size())](std::size_t i) mutable {
      pendulum->integrate(starts()[i], times(), trajectory);
      std::copy_n(trajectory.end() - 4, 4, last[i].begin());
    };
  });
  return last;
}

/// The same in packs, as the ensemble does.
std::vector<State> integratePacks(int jobs) {
  std::vector<State> last(samples);
  forEachIndex(jobs, samples / packWidth, nullptr, [&] {
    return [&, witness = PackWitness(pendulumOfStates().motion), start = std::vector<double>(4 * packWidth),
            trajectories = std::vector<double>(4 * packWidth * times().size())](std::size_t pack) mutable {
      for (std::size_t lane = 0; lane < packWidth; ++lane)
        for (std::size_t i = 0; i < 4; ++i) start[i * packWidth + lane] = starts()[pack * packWidth + lane][i];
      if (witness.integrate(start, Tolerance(), trajectories).times < times().size())
        throw std::runtime_error("a pack ended early");
      const auto end = trajectories.end() - 4 * packWidth;
      for (std::size_t lane = 0; lane < packWidth; ++lane)
        for (std::size_t i = 0; i < 4; ++i)
          last[pack * packWidth + lane][i] = end[static_cast<std::ptrdiff_t>(i * packWidth + lane)];
    };
  });
  return last;
}

/// The whole ensemble; returns its samples' last states.
std::vector<State> runEnsemble(int jobs) {
  std::vector<State> last(samples);
  EnsembleOptions options;
  options.samples = samples;
  options.jobs = jobs;
  EnsembleRun run(pendulumOfStates(), options);
  run.integrateFirst();
  run.integrateOthers({}, [&](const SampleBlock& block) {
    for (std::size_t i = 0; block.hasWeight() && i < block.size(); ++i)
      for (std::size_t state = 0; state < 4; ++state)
        last[block.first() + i][state] = block(i, times().size() - 1, state);
  });
  benchmark::DoNotOptimize(run.statistics());
  if (!run.why().empty()) throw std::runtime_error(run.why());
  return last;
}

Tolerance scaled(const Tolerance& tolerance, double factor) {
  return {tolerance.relative * factor, tolerance.absolute * factor};
}

/// The baseline's tolerance at which it is as accurate as the packs.
const Tolerance& equalTolerance() {
  static const Tolerance equal = [] {
    constexpr int trials = 9;
    const int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const double wanted = std::log(errorsOf(integratePacks(jobs)).rms);
    std::array<double, trials> factor{}, error{};  // logarithms
    double meanFactor = 0, meanError = 0;
    for (std::size_t i = 0; i < trials; ++i) {
      factor[i] = (static_cast<double>(i) - (trials - 1) / 2.0) / 2 * std::log(2);
      error[i] =
          std::log(errorsOf(integrateOneEach(scaled(Tolerance(), std::exp(factor[i])), Vectors::ofFour, jobs)).rms);
      meanFactor += factor[i] / trials;
      meanError += error[i] / trials;
    }
    double together = 0, alone = 0;
    for (std::size_t i = 0; i < trials; ++i) {
      together += (factor[i] - meanFactor) * (error[i] - meanError);
      alone += (factor[i] - meanFactor) * (factor[i] - meanFactor);
    }
    return scaled(Tolerance(), std::exp(meanFactor + (wanted - meanError) * alone / together));
  }();
  return equal;
}

double processCpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least CPU time of the equally accurate baseline in this run, of each number of threads, s.
std::map<int, double> leastOfBaseline;

/// Integrates again and again; returns the least CPU time, s.
template <class Integrate>
double measure(benchmark::State& state, const Integrate& integrate) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<State> last;
  for (auto _ : state) {
    const double began = processCpuSeconds();
    last = integrate();
    least = std::min(least, processCpuSeconds() - began);
  }
  const Errors errors = errorsOf(last);
  state.counters["greatest"] = errors.greatest;
  state.counters["rms"] = errors.rms;
  state.counters["doubt"] = truth().doubt;
  state.counters["cpu"] = least;
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(samples));
  return least;
}

void oneEach(benchmark::State& state, Vectors vectors, bool isEquallyAccurate) {
  const auto jobs = static_cast<int>(state.range(0));
  const Tolerance tolerance = isEquallyAccurate ? equalTolerance() : Tolerance();
  const double least = measure(state, [&] { return integrateOneEach(tolerance, vectors, jobs); });
  state.counters["tolerance"] = tolerance.relative;
  if (!isEquallyAccurate) return;
  const auto known = leastOfBaseline.try_emplace(jobs, least).first;
  known->second = std::min(known->second, least);
}

template <class Integrate>
void compare(benchmark::State& state, const Integrate& integrate) {
  const auto jobs = static_cast<int>(state.range(0));
  const double least = measure(state, [&] { return integrate(jobs); });
  state.counters["tolerance"] = Tolerance().relative;
  if (leastOfBaseline.contains(jobs)) state.counters["faster"] = leastOfBaseline[jobs] / least;
}
void packs(benchmark::State& state) { compare(state, integratePacks); }
void ensembleOfStates(benchmark::State& state) { compare(state, runEnsemble); }

void asMeasured(benchmark::internal::Benchmark* b) {
  b->ArgName("jobs")->Arg(1)->Arg(2)->Iterations(3)->MeasureProcessCPUTime()->UseRealTime();
  b->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(oneEach, ofLibrary, Vectors::ofLibrary, false)->Apply(asMeasured);
BENCHMARK_CAPTURE(oneEach, ofFour, Vectors::ofFour, false)->Apply(asMeasured);
BENCHMARK_CAPTURE(oneEach, equallyAccurate, Vectors::ofFour, true)->Apply(asMeasured);
BENCHMARK(packs)->Apply(asMeasured);
BENCHMARK(ensembleOfStates)->Apply(asMeasured);

}  // namespace
}  // namespace gamut::benchmarks
