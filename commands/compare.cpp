// gamut compare: two results of the same outputs, such as of two versions of Gamut, of other settings or of another
// machine. Do they contradict each other, and what became wider or narrower?
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "commands/comparison_json.hpp"
#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "reports/comparison_lines.hpp"
#include "studies/comparing/difference.hpp"
#include "studies/results/results_file.hpp"

namespace gamut::commands {
namespace {

struct CompareArguments {
  std::string first, second, tolerances;
  bool json = false;
};

/// What tolerances may be stated of.
std::vector<std::string> outputsOf(const Results& first, const Results& second) {
  std::vector<std::string> names;
  for (const Results* results : {&first, &second})
    for (std::size_t i = 0; i < results->outputs.size(); ++i)
      if (const std::string& name = results->outputs[i].name;
          !isMargin(*results, i) && std::ranges::find(names, name) == names.end())
        names.push_back(name);
  return names;
}

ExitCode compare(const CompareArguments& arguments) {
  const Results first = readResults(arguments.first), second = readResults(arguments.second);
  const Tolerances tolerances =
      arguments.tolerances.empty() ? Tolerances() : readTolerances(arguments.tolerances, outputsOf(first, second));
  const Difference difference = [&] {
    try {
      return compareResults(first, second, tolerances);
    } catch (const NotComparable& error) {
      throw UsageError(fmt::format("{} and {}: {}", arguments.first, arguments.second, error.what()));
    }
  }();
  const Both<std::string> files{arguments.first, arguments.second};
  sayOut(arguments.json ? comparisonJson(difference, first, second, files) + "\n"
                        : comparisonText(difference, first, second, files));
  return difference.word == Difference::Word::agree ? done : refuted;
}

}  // namespace

Action compare(CLI::App& command) {
  const auto arguments = std::make_shared<CompareArguments>();
  command.add_option("first", arguments->first, "Results file, A: what is compared with")
      ->required()
      ->type_name("A.h5");
  command.add_option("second", arguments->second, "Results file, B: what is judged")->required()->type_name("B.h5");
  command
      .add_option("--tolerances", arguments->tolerances,
                  "File that says how much worse B may be (docs/results-file.md); otherwise 1 % wider, bounds of "
                  "probabilities 0.01 farther apart, no shorter")
      ->type_name("FILE.toml");
  command.add_flag("--json", arguments->json, "One JSON object on standard output");
  command.footer(
      "Exit codes:\n"
      "  0  nothing contradicts, and B is worse by no more than is tolerated\n"
      "  1  A and B contradict each other, or B is worse: wider, shorter, a requirement not guaranteed any more, a\n"
      "     worse verdict\n"
      "  2  bad input or usage, or nothing that both have\n"
      "  4  an internal failure");
  return [arguments] { return compare(*arguments); };
}

}  // namespace gamut::commands
