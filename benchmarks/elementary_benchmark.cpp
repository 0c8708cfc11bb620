// Elementary functions of intervals beside the same by MPFI and by MPFR's directed roundings, in ns a call.
//   elementary_benchmark --benchmark_min_time=0.3
// What to look at: sin and cos together against MPFI at 53 bits.
#include <benchmark/benchmark.h>
#include <mpfi.h>

#include <random>
#include <vector>

#include "scalars/elementary/elementary.hpp"
#include "scalars/elementary/mpfr_bounds.hpp"
#include "scalars/interval.hpp"

namespace {

using gamut::Interval;

constexpr std::size_t number = 4096;

/// Intervals in [lower, upper] of a given width.
std::vector<Interval> arguments(double lower, double upper, double width) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<> uniform(lower, upper - width);
  std::vector<Interval> all;
  for (std::size_t i = 0; i < number; ++i) {
    const double x = uniform(engine);
    all.emplace_back(x, x + width);
  }
  return all;
}

/// Calls of(x) for every argument in turn and reports the time of one call.
template <class Call>
void time(benchmark::State& state, double lower, double upper, double width, const Call& of) {
  const std::vector<Interval> all = arguments(lower, upper, width);
  std::size_t i = 0;
  for (auto _ : state) {
    auto result = of(all[i]);
    benchmark::DoNotOptimize(result);
    i = (i + 1) % number;
  }
}

/// MPFI's numbers, kept over all calls.
struct Mpfi {
  mpfi_t x, sin, cos;
  Mpfi() {
    for (mpfi_ptr each : {x, sin, cos}) mpfi_init2(each, 53);
  }
  ~Mpfi() {
    for (mpfi_ptr each : {x, sin, cos}) mpfi_clear(each);
  }
};

void sinCosByMpfi(benchmark::State& state, double width) {
  Mpfi mpfi;
  time(state, -10, 10, width, [&](const Interval& x) {
    mpfi_interv_d(mpfi.x, x.lower(), x.upper());
    mpfi_sin(mpfi.sin, mpfi.x);
    mpfi_cos(mpfi.cos, mpfi.x);
    return mpfi.sin[0].left._mpfr_exp;
  });
}

void sinCos(benchmark::State& state, double width) {
  time(state, -10, 10, width, [](const Interval& x) { return gamut::sinCos(x); });
}

struct Function {
  const char* name;
  Interval (*of)(const Interval&);
  gamut::detail::MpfrFunction byMpfr;
  double lower, upper;
};

constexpr Function functions[] = {{"sin", gamut::sin, mpfr_sin, -10, 10},   {"cos", gamut::cos, mpfr_cos, -10, 10},
                                  {"tan", gamut::tan, mpfr_tan, -10, 10},   {"exp", gamut::exp, mpfr_exp, -20, 20},
                                  {"log", gamut::log, mpfr_log, 0.01, 100}, {"atan", gamut::atan, mpfr_atan, -10, 10},
                                  {"asin", gamut::asin, mpfr_asin, -1, 1},  {"acos", gamut::acos, mpfr_acos, -1, 1}};

[[maybe_unused]] const bool registered = [] {
  for (const double width : {0.0, 0.01, 1.0}) {
    const std::string suffix = "/width:" + gamut::toString(width);
    benchmark::RegisterBenchmark(("sinCos" + suffix).c_str(), sinCos, width);
    benchmark::RegisterBenchmark(("mpfi_sin+mpfi_cos" + suffix).c_str(), sinCosByMpfi, width);
  }
  for (const Function& f : functions) {
    benchmark::RegisterBenchmark(f.name, [f](benchmark::State& state) { time(state, f.lower, f.upper, 0, f.of); });
    benchmark::RegisterBenchmark((std::string(f.name) + "/mpfr").c_str(), [f](benchmark::State& state) {
      time(state, f.lower, f.upper, 0, [f](const Interval& x) { return gamut::detail::evaluate(f.byMpfr, x.lower()); });
    });
  }
  return true;
}();

}  // namespace
