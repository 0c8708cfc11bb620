// Interval + - * / sqr sqrt on arrays, beside Boost.Interval as it comes (which saves, sets and restores the
// processor's rounding mode in each operation). Intervals of both signs and around zero, of one sign, and with an
// endpoint at zero; divisors hold no zero. Time per operation: items_per_second, or the time divided by 1024.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <boost/numeric/interval.hpp>
#include <random>
#include <string>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut::benchmarks {
namespace {

using Protected = boost::numeric::interval<double>;
constexpr int count = 1024;

Protected sqr(const Protected& x) { return square(x); }
struct Square {
  template <class I>
  I operator()(const I& x, const I&) const {
    return sqr(x);
  }
};
struct SquareRoot {
  template <class I>
  I operator()(const I& x, const I&) const {
    return sqrt(x);
  }
};

enum class Signs { mixed, same, zero };

/// Random intervals; without zero where they divide.
template <class I>
std::vector<I> intervals(Signs signs, bool divisors, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<> uniform(0.5, 2);
  std::bernoulli_distribution coin;
  std::vector<I> x;
  for (int i = 0; i < count; ++i) {
    double a = uniform(engine), b = uniform(engine);
    if (signs == Signs::mixed) {
      a = coin(engine) ? a : -a;
      b = divisors ? std::copysign(b, a) : coin(engine) ? b : -b;
    }
    if (signs == Signs::zero && !divisors) a = 0;
    x.push_back(I(std::min(a, b), std::max(a, b)));
  }
  return x;
}

template <class I, class Operation>
void measure(benchmark::State& state, Signs signs, Operation operation) {
  constexpr bool divides = std::is_same_v<Operation, std::divides<>>;
  const std::vector<I> x = intervals<I>(signs, false, 1), y = intervals<I>(signs, divides, 2);
  std::vector<I> z(count);
  for (auto _ : state) {
    for (std::size_t i = 0; i < count; ++i) z[i] = operation(x[i], y[i]);
    benchmark::DoNotOptimize(z.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * count);
}

template <class Operation>
void add(const std::string& name, Operation operation) {
  const std::pair<const char*, Signs> kinds[] = {{"mixed", Signs::mixed}, {"same", Signs::same}, {"zero", Signs::zero}};
  for (const auto& [kind, signs] : kinds) {
    if (std::is_same_v<Operation, SquareRoot> && signs == Signs::mixed) continue;  // Boost throws for negative ones
    const auto run = [signs = signs, operation](auto interval) {
      return [signs, operation, interval](benchmark::State& state) {
        measure<decltype(interval)>(state, signs, operation);
      };
    };
    benchmark::RegisterBenchmark((name + "/" + kind + "/gamut").c_str(), run(Interval()));
    benchmark::RegisterBenchmark((name + "/" + kind + "/boost").c_str(), run(Protected()));
  }
}

const bool added = [] {
  add("sum", std::plus<>());
  add("difference", std::minus<>());
  add("product", std::multiplies<>());
  add("quotient", std::divides<>());
  add("square", Square());
  add("squareRoot", SquareRoot());
  return true;
}();

}  // namespace
}  // namespace gamut::benchmarks
