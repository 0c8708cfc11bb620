// gamut view: the page of a study at an address of this machine, which follows what is saved.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/live_run.hpp"
#include "commands/options.hpp"
#include "commands/page_server.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"

namespace gamut::commands {

extern const std::string_view livePage;

namespace {

struct ViewArguments : LiveArguments {
  std::uint16_t port = 0;
};

/// Before anything runs: that it can be read, and that results may be written where they are to be.
void refuseWhatCannotBe(const ViewArguments& arguments) {
  if (arguments.study == "-") throw UsageError("standard input cannot be watched; expected a study file");
  textOfStudy(arguments.study);
  if (arguments.results.empty()) return;
  for (const std::string& path : {arguments.results, pageBeside(arguments.results)})
    reserve(path, arguments.study, arguments.force);
}

Reply replyOf(const LiveRun& live, std::string_view path) {
  const auto whole = [](std::string_view text) { return std::make_shared<const std::string>(text); };
  if (path == "/")
    return {whole(livePage), "text/html; charset=utf-8",
            "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; connect-src 'self'; "
            "frame-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"};
  if (path == "/state") return {whole(live.state()), "application/json", "default-src 'none'"};
  if (path == "/report")
    return {
        live.page(), "text/html; charset=utf-8",
        "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
        "form-action 'none'; frame-ancestors 'self'"};
  return {};
}

ExitCode view(const ViewArguments& arguments) {
  refuseWhatCannotBe(arguments);
  std::unique_ptr<LiveRun> live;
  PageServer server = [&] {
    try {
      return PageServer(arguments.port, [&](std::string_view path) { return replyOf(*live, path); });
    } catch (const NoAddress& error) {
      throw UsageError(fmt::format("{}; expected another --port, or none for one that is free", error.what()));
    }
  }();
  noteInterrupts();
  sayOut(fmt::format("http://127.0.0.1:{}/\n", server.port()));
  flushOut();
  live = std::make_unique<LiveRun>(arguments);
  while (!interrupted()) {
    constexpr std::chrono::milliseconds betweenLooks{50};
    server.serve(betweenLooks);
    live->look();
    for (const auto& [line, isFault] : live->news())
      if (isFault)
        fmt::print(stderr, "{}\n", line);
      else if (!arguments.quiet)
        sayOut(line + "\n"), flushOut();
  }
  return done;
}

}  // namespace

Action view(CLI::App& command) {
  const auto arguments = std::make_shared<ViewArguments>();
  addWatchedStudy(command, arguments->study);
  command.add_option("--port", arguments->port, "Port of the address, 1 to 65535; otherwise one that is free")
      ->check(wholeNumber(1, 65535))
      ->type_name("N");
  command
      .add_option(
          "-o,--output", arguments->results,
          "Results file of each run that comes to its end, with its page beside it; otherwise no file is written")
      ->type_name("RESULTS.h5");
  addPlanOptions(command, arguments->seed, arguments->samples);
  addLimitOptions(command, *arguments);
  addJobs(command, *arguments);
  command.add_flag("--quiet", arguments->quiet, "The address, and faults of the study, no more");
  command.add_flag("--force", arguments->force, "Overwrite existing files");
  command.footer(
      "The page fills while the study runs. When its file is saved, or a table, or a robot with its meshes that "
      "it names, it runs again;\n"
      "until that has come to its end the page before it stays. Nobody but this machine can open the address. Ctrl-C "
      "ends it.");
  return [arguments] { return view(*arguments); };
}

}  // namespace gamut::commands
