// gamut check: the verdict is found again from the stored numbers; with --requirements, what was proved of these
// counts.
#include <memory>
#include <string>

#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/summary_style.hpp"
#include "commands/table.hpp"
#include "reports/report.hpp"
#include "reports/requirements.hpp"
#include "studies/results/results_file.hpp"

namespace gamut::commands {

Action check(CLI::App& command) {
  const auto path = std::make_shared<std::string>();
  const auto countsRequirements = std::make_shared<bool>(false), isVerbose = std::make_shared<bool>(false);
  addResults(command, *path);
  command.add_flag("--requirements", *countsRequirements,
                   "Count requirements: 1 if one is violated, for some values at least, 3 if one is neither proved nor "
                   "refuted");
  addVerbose(command, *isVerbose);
  command.footer(exitCodesText);
  return [path, countsRequirements, isVerbose] {
    const Results results = readResults(*path);
    if (*countsRequirements && results.requirements.empty())
      throw UsageError(*path + ": holds no requirements; expected results of a study with [[requirement]]");
    const Verdict verdict = judge(results);
    sayOut(verdictSummary(results, verdict, results.requirements.empty() ? "" : leadOf(results, verdict),
                          summaryStyle(stdout, *isVerbose)));
    const ExitCode ofSamples = exitCode(verdict);
    if (!*countsRequirements || ofSamples == refuted) return ofSamples;
    const Decision word = wordOfRequirements(results);
    return word == Decision::violated ? refuted : word == Decision::open ? endedEarly : ofSamples;
  };
}

}  // namespace gamut::commands
