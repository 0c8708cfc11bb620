#include "scalars/program/time_given.hpp"

#include <vector>

#include "scalars/program/recorder.hpp"

namespace gamut {

Program withTimeGiven(const Program& program) {
  Recorder recorder(program.states(), program.parameters() + 1);
  std::vector<int> instead(program.nodes().size(), -1), outputs;
  instead[static_cast<std::size_t>(program.states() + program.parameters())] = recorder.parameter(program.parameters());
  const std::vector<int> here = recorder.append(program, {}, instead);
  for (const int node : program.outputNodes()) outputs.push_back(here[static_cast<std::size_t>(node)]);
  return recorder.finish(outputs);
}

}  // namespace gamut
