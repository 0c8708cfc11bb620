// How long a study of many parts takes to be read and checked: a chain of revolute joints with links and masses, each
// mass uncertain by one pattern and each angle an output. The time is to grow as the parts do.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>

#include "studies/machine.hpp"

namespace gamut::benchmarks {
namespace {

std::string chainText(int joints, const char* head) {
  std::string text = fmt::format("[study]\n{}[mechanism]\ngravity = [0, 0, -9.81]\n", head), outputs;
  for (int i = 0; i < joints; ++i) {
    text += fmt::format(
        "[[mechanism.element]]\ntype = \"revolute\"\nname = \"j{0}\"\nfrom = \"{1}\"\nto = \"J{0}\"\naxis = \"x\"\n"
        "initial = {{ angle = \"1 deg\" }}\n"
        "[[mechanism.element]]\ntype = \"link\"\nname = \"l{0}\"\nfrom = \"J{0}\"\nto = \"K{0}\"\nvector = [0, 0, "
        "-0.1]\n"
        "[[mechanism.element]]\ntype = \"mass\"\nname = \"m{0}\"\nat = \"K{0}\"\nmass = 0.1\n",
        i, i == 0 ? "inertial" : fmt::format("K{}", i - 1));
    outputs += fmt::format("[[output]]\nquantity = \"j{}.angle\"\n", i);
  }
  return text + "[[uncertain]]\nquantity = \"m*.mass\"\ninterval = \"± 1 %\"\n" + outputs;
}

void readStudyOf(benchmark::State& state, const char* head) {
  const std::string text = chainText(static_cast<int>(state.range(0)), head);
  for (auto _ : state) benchmark::DoNotOptimize(Machine(readStudyText(text, "chain.toml")));
  state.SetComplexityN(state.range(0));
}

void kinematics(benchmark::State& state) {
  readStudyOf(state, "analysis = \"kinematics\"\ncompare = [\"interval\"]\n");
}
BENCHMARK(kinematics)->RangeMultiplier(4)->Range(100, 6400)->Unit(benchmark::kMillisecond)->Complexity();

void dynamics(benchmark::State& state) {
  readStudyOf(state, "analysis = \"dynamics\"\nhorizon = 1\noutput_step = 1\ncompare = [\"interval\"]\n");
}
BENCHMARK(dynamics)->RangeMultiplier(4)->Range(25, 400)->Unit(benchmark::kMillisecond)->Complexity();

}  // namespace
}  // namespace gamut::benchmarks

BENCHMARK_MAIN();
