// gamut validate: a study is read and checked as for a run, and nothing more.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/table.hpp"
#include "reports/words.hpp"
#include "studies/printable.hpp"

namespace gamut::commands {
namespace {

struct ValidateArguments {
  std::string study;
  bool quiet = false;
};

ExitCode validate(const ValidateArguments& arguments) {
  const Machine machine = readMachine(arguments.study, arguments.quiet);
  const Study& study = machine.study;
  if (!arguments.quiet)
    fmt::print("{}: valid; {} with {}, {} uncertain {}, {}{}\n", printable(study.file), study.analysisName(),
               countText(static_cast<long long>(study.mechanism.elements().size()), "element"), study.uncertain.size(),
               study.uncertain.size() == 1 ? "quantity" : "quantities",
               countText(static_cast<long long>(study.outputs.size()), "output"),
               study.horizon > 0 ? fmt::format(" at {} times", study.times.size()) : "");
  return done;
}

}  // namespace

Action validate(CLI::App& command) {
  const auto arguments = std::make_shared<ValidateArguments>();
  addStudy(command, arguments->study);
  command.add_flag("--quiet", arguments->quiet, "Say nothing if it is valid");
  return [arguments] { return validate(*arguments); };
}

}  // namespace gamut::commands
