// gamut report: the page of a results file, or of a sweep, is written again; or two results are put beside each other.
#include "reports/report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/table.hpp"
#include "reports/comparison_page.hpp"
#include "reports/sweep_page.hpp"
#include "studies/results/results_file.hpp"
#include "studies/sweeps/sweep_file.hpp"

namespace gamut::commands {
namespace {

struct ReportArguments {
  std::string results, other, page;
  bool force = false;
};

/// "arm.html", "arm-and-arm2.html".
std::string nameOfPage(const ReportArguments& arguments) {
  const std::filesystem::path first = std::filesystem::path(arguments.results).filename();
  if (arguments.other.empty()) return std::filesystem::path(first).replace_extension(".html").string();
  return first.stem().string() + "-and-" + std::filesystem::path(arguments.other).stem().string() + ".html";
}

std::string pageOfBoth(const ReportArguments& arguments) {
  for (const std::string& path : {arguments.results, arguments.other})
    if (isSweepFile(path)) throw UsageError(path + ": is of a sweep; expected two results of runs");
  const Results first = readResults(arguments.results), second = readResults(arguments.other);
  try {
    return renderComparison(compareResults(first, second), first, second, {arguments.results, arguments.other});
  } catch (const NotComparable& error) {
    throw UsageError(fmt::format("{} and {}: {}", arguments.results, arguments.other, error.what()));
  }
}

ExitCode report(const ReportArguments& arguments) {
  const std::string path = arguments.page.empty() ? nameOfPage(arguments) : arguments.page;
  if (std::error_code none; !arguments.other.empty() && std::filesystem::equivalent(path, arguments.other, none))
    throw UsageError(path + ": cannot be written; it is the input");
  OutputFile file = reserve(path, arguments.results, arguments.force);
  const std::string page = !arguments.other.empty()         ? pageOfBoth(arguments)
                           : isSweepFile(arguments.results) ? renderSweep(readSweep(arguments.results))
                                                            : renderReport(readResults(arguments.results));
  file.write(page);
  fmt::print("{}\n", path);
  return done;
}

}  // namespace

Action report(CLI::App& command) {
  const auto arguments = std::make_shared<ReportArguments>();
  addResults(command, arguments->results);
  command
      .add_option("other", arguments->other,
                  "Results file of another design or version, B: both on one page, and what of B is better or worse")
      ->type_name("B.h5");
  command
      .add_option("-o,--output", arguments->page,
                  "Report page; otherwise, in the current folder, named like the results, of two A-and-B.html")
      ->type_name("REPORT.html");
  command.add_flag("--force", arguments->force, "Overwrite an existing file");
  return [arguments] { return report(*arguments); };
}

}  // namespace gamut::commands
