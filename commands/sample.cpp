// gamut sample: as many samples as somebody wants, from the polynomials that the results keep of every output.
#include "commands/files.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/surrogate_samples.hpp"

namespace gamut::commands {
namespace {

struct SampleArguments : SurrogateRequest {
  SampleArguments() { jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

  std::string results, output;
  bool force = false;
};

ExitCode sample(const SampleArguments& arguments) {
  const Results results = readResults(arguments.results);
  const Study study = studyOf(results, arguments.results);
  const auto bytes = [&] {
    try {
      SampleTable table = sampleSurrogate(results, study, arguments);
      table.results = arguments.results;
      return arguments.output.ends_with(".h5") ? hdf5Of(table) : csvOf(table);
    } catch (const std::invalid_argument& error) {
      throw UsageError(arguments.results + ": " + error.what());
    }
  };
  if (arguments.output.empty() || arguments.output == "-")
    sayOut(bytes());
  else
    reserve(arguments.output, arguments.results, arguments.force).write(bytes());
  return done;
}

}  // namespace

Action sample(CLI::App& command) {
  const auto arguments = std::make_shared<SampleArguments>();
  addResults(command, arguments->results);
  command.add_option("--samples", arguments->samples, "How many")
      ->required()
      ->check(wholeNumber(1, 100000000))
      ->type_name("N");
  command.add_option("--plan", arguments->plan, "random, sobol, latin-hypercube, halton or grid")
      ->capture_default_str();
  command.add_option("--seed", arguments->seed, "Of the random numbers")
      ->check(wholeNumber(0, INT64_MAX))
      ->type_name("N");
  command
      .add_option("--at", arguments->times,
                  "Output times, s or \"500 ms\"; otherwise all of which there are polynomials")
      ->transform(outputTime())
      ->type_name("TIME");
  command.add_option("--outputs", arguments->outputs, "Names of outputs; otherwise all")->type_name("NAME");
  command.add_option("-j,--jobs", arguments->jobs, "Threads")->check(wholeNumber(1, 1024))->type_name("N");
  command
      .add_option("-o,--output", arguments->output,
                  "Table: HDF5 if its name ends in .h5, otherwise CSV; without a name CSV on standard output")
      ->type_name("SAMPLES.h5");
  command.add_flag("--force", arguments->force, "Overwrite an existing file");
  command.footer(
      "Values of the quantities are drawn from their distributions; outputs come from the polynomials that the\n"
      "results keep, each with a proved bound of its error.");
  return [arguments] { return sample(*arguments); };
}

}  // namespace gamut::commands
