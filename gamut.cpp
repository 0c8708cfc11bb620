// The program's front door: finds the command that was asked for, lets it do its work (commands/), and says in the exit
// code how it went.
#include <fmt/format.h>
#include <signal.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "commands/interrupts.hpp"
#include "commands/mpi_communicator.hpp"
#include "commands/options.hpp"
#include "commands/ranks.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "mechanics/description/names.hpp"
#include "studies/atomic_file.hpp"
#include "studies/printable.hpp"
#include "studies/results/results_file.hpp"
#include "studies/study.hpp"
#include "studies/version.hpp"
#include "studies/watch.hpp"

namespace {

using namespace gamut;

[[noreturn]] void refuseUnknown(const std::string& kind, const std::string& name,
                                const std::vector<std::string>& known) {
  const UnknownName unknown(kind, name, known);
  throw UsageError(fmt::format("{}; expected {}", unknown.problem(), unknown.expected()));
}

void refuseUnknownCommand(int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const Command& command : commands::table) known.emplace_back(command.name);
  refuseUnknown("command", argv[1], known);
}

/// A long option that the command does not have is refused with those that come near.
void refuseUnknownOption(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i], name = argument.substr(0, argument.find('='));
    if (name == "--") return;
    if (name.starts_with("--") && std::ranges::find(known, name) == known.end())
      refuseUnknown("option", std::string(name), known);
  }
}

/// What the parser complains of, in the words of the help.
std::string complaintOf(const CLI::ParseError& error, const CLI::App& command) {
  if (error.get_name() == "RequiredError")
    for (const CLI::Option* option : command.get_options())
      if (option->get_required() && option->count() == 0)
        return fmt::format("{} is missing", option->get_positional() ? option->get_type_name() : option->get_name());
  return error.what();
}

/// What the command line asks for; without an action there is nothing more to do, as where it asks for help.
Action actionOf(int argc, char** argv) {
  CLI::App app("Gamut: guaranteed, probable and possible motion of uncertain mechanisms.");
  app.set_version_flag("--version", "gamut " + version());
  app.require_subcommand(1);
  app.footer(exitCodesText);
  Action action;
  for (const Command& row : commands::table) {
    CLI::App& options = *app.add_subcommand(row.name, row.help);
    options.callback([&, act = row.declare(options)] { action = act; });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      app.exit(error);
      return {};
    }
    const auto asked = app.get_subcommands();
    if (asked.empty())
      refuseUnknownCommand(argc, argv);
    else
      refuseUnknownOption(*asked.front(), argc, argv);
    const std::string what = !asked.empty() ? complaintOf(error, *asked.front())
                             : argc < 2     ? "a command is missing"
                                            : error.what();
    throw UsageError(fmt::format("{}; see gamut {}--help", what, asked.empty() ? "" : asked.front()->get_name() + " "));
  }
  return action;
}

ExitCode parseAndRun(int argc, char** argv) {
  const Action action = actionOf(argc, argv);
  return action ? action() : done;
}

#ifdef GAMUT_MPI
/// What all understand, or none, then do together. Ranks but the first say nothing.
ExitCode parseAndRunAsRank(int argc, char** argv) {
  int onOneMachine = 1;
  const std::unique_ptr<Communicator> all = startedByMpi(onOneMachine);
  if (!all->isFirst()) fallSilent();
  shareMemory(onOneMachine);
  setRanks(all.get());
  const auto act = [&] {
    try {
      Action action;
      onAllRanks([&] { action = actionOf(argc, argv); });
      return action ? action() : done;
    } catch (const std::exception& error) {  // an exit code of another ends the first before it has said why
      if (all->isFirst() || !isRefusal(error)) throw;
      return done;
    }
  };
  const ExitCode code = act();
  setRanks(nullptr);
  return code;
}
#endif

/// Among others that were started with it some commands are done together, others by the first alone.
ExitCode parseAndRunAmongOthers(int argc, char** argv, const StartedAs& started) {
  const std::string_view name = argc > 1 ? argv[1] : "";
  constexpr std::array together{"run", "resume", "extend", "sweep"};
  if (std::ranges::find(together, name) == together.end()) return started.rank == 0 ? parseAndRun(argc, argv) : done;
#ifdef GAMUT_MPI
  return parseAndRunAsRank(argc, argv);
#else
  throw UsageError(fmt::format("was started as {} processes, and built without MPI; expected one, or a build with MPI",
                               started.count));
#endif
}

/// Whether anybody reads it changes nothing.
ExitCode complain(ExitCode code, const std::string& line) {
  constexpr std::size_t most = 8000;  // characters: more than any line that quotes what it complains of in part
  std::fputs((printable(shortened(line, most)) + "\n").c_str(), stderr);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  endOnInterrupt();
  occupyStandardStreams();
  ::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error of writing, not the end
  const std::string name = "gamut: ";
  try {
    const StartedAs started = startedAs();
    const ExitCode code = started.count > 1 ? parseAndRunAmongOthers(argc, argv, started) : parseAndRun(argc, argv);
    flushOut();
    return code;
  } catch (const UsageError& error) {
    return complain(badInput, name + error.what());
  } catch (const StudyError& error) {
    return complain(badInput, error.what());
  } catch (const ResultsFileError& error) {
    return complain(badInput, error.what());
  } catch (const OutputRefused& error) {
    return complain(badInput, name + error.what());
  } catch (const WriteError& error) {
    return complain(failed, name + error.what());
  } catch (const RankFailed& error) {
    return complain(failed, name + error.what());
  } catch (const std::system_error& error) {
    return complain(failed, name + error.what());
  } catch (const std::bad_alloc&) {
    return complain(failed, name + "out of memory; fewer outputs, output times or pieces need less");
  } catch (const std::exception& error) {
    return complain(failed, name + "internal failure: " + error.what());
  }
}
