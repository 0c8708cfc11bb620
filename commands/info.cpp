// gamut info: what a results file holds and where it comes from.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "studies/results/results_file.hpp"
#include "studies/summary.hpp"

namespace gamut::commands {

Action info(CLI::App& command) {
  const auto path = std::make_shared<std::string>();
  addResults(command, *path);
  return [path] {
    const Results results = readResults(*path);
    sayOut(infoText(results));
    if (results.comparison.present) fmt::print("  {}\n", judge(results).sentence);
    sayOut(contentText(results));
    return done;
  };
}

}  // namespace gamut::commands
