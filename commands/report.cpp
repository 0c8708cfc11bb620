// gamut report: the page of a results file, or of a sweep, is written again.
#include "reports/report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/table.hpp"
#include "reports/sweep_page.hpp"
#include "studies/results/results_file.hpp"
#include "studies/sweeps/sweep_file.hpp"

namespace gamut::commands {
namespace {

struct ReportArguments {
  std::string results, page;
  bool force = false;
};

ExitCode report(const ReportArguments& arguments) {
  const std::string path = arguments.page.empty()
                               ? std::filesystem::path(arguments.results).filename().replace_extension(".html").string()
                               : arguments.page;
  const std::string page = isSweepFile(arguments.results) ? renderSweep(readSweep(arguments.results))
                                                          : renderReport(readResults(arguments.results));
  reserve(path, arguments.results, arguments.force).write(page);
  fmt::print("{}\n", path);
  return done;
}

}  // namespace

Action report(CLI::App& command) {
  const auto arguments = std::make_shared<ReportArguments>();
  addResults(command, arguments->results);
  command
      .add_option("-o,--output", arguments->page,
                  "Report page; otherwise, in the current folder, named like the results")
      ->type_name("REPORT.html");
  command.add_flag("--force", arguments->force, "Overwrite an existing file");
  return [arguments] { return report(*arguments); };
}

}  // namespace gamut::commands
