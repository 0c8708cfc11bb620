// gamut check: the verdict is found again from the stored numbers.
#include <memory>
#include <string>

#include "commands/options.hpp"
#include "commands/table.hpp"
#include "commands/verdict_lines.hpp"
#include "studies/results/results_file.hpp"

namespace gamut::commands {

Action check(CLI::App& command) {
  const auto path = std::make_shared<std::string>();
  addResults(command, *path);
  command.footer(exitCodesText);
  return [path] {
    const Verdict verdict = judge(readResults(*path));
    printVerdict(stdout, verdict);
    return exitCode(verdict);
  };
}

}  // namespace gamut::commands
