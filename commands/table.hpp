// The commands of the program: each is a row here, and a file of its name that declares its options and does it.
#pragma once

#include <functional>

#include "commands/exit_codes.hpp"

namespace CLI {
class App;
}

namespace gamut {

/// Does what a command was told to do.
using Action = std::function<ExitCode()>;

struct Command {
  const char* name;
  const char* help;  ///< one line
  /// Declares options and arguments. The action is for when they have been read.
  Action (*declare)(CLI::App& command);
};

namespace commands {

Action run(CLI::App& command);
Action view(CLI::App& command);
Action resume(CLI::App& command);
Action extend(CLI::App& command);
Action validate(CLI::App& command);
Action check(CLI::App& command);
Action compare(CLI::App& command);
Action report(CLI::App& command);
Action info(CLI::App& command);
Action replay(CLI::App& command);
Action sample(CLI::App& command);
Action exportTables(CLI::App& command);
Action tolerance(CLI::App& command);
Action sweep(CLI::App& command);
Action newStudy(CLI::App& command);
Action quantities(CLI::App& command);
Action schema(CLI::App& command);
Action completion(CLI::App& command);

inline constexpr Command table[] = {
    {"new", "Write a study to start from, which explains itself", newStudy},
    {"quantities", "What of a study can be uncertain, and what can be an output", quantities},
    {"run", "Run a study; write results and a report", run},
    {"view", "The page of a study in the browser, which runs again whenever the file is saved", view},
    {"resume", "A run that was killed goes on; it ends with the same results as one that was not", resume},
    {"extend", "More samples for results, which keep all that was proved", extend},
    {"validate", "Read and check a study file, no more", validate},
    {"check", "The verdict, from the stored numbers: do all samples stay inside?", check},
    {"compare", "Two results: do they contradict each other, and what became wider or narrower?", compare},
    {"tolerance", "How far the uncertain quantities may deviate so that all requirements are met", tolerance},
    {"sweep", "A study over a grid or a list of nominal values: its requirements' answers at each", sweep},
    {"report", "Write the report page of a results file, or of two beside each other", report},
    {"info", "What a results file holds and where it comes from; or the tree of a robot", info},
    {"replay", "One sample of a run again, bit for bit, as CSV", replay},
    {"sample", "Many samples of outputs without integrating, each with its proved error", sample},
    {"export", "Results as tables (CSV), for spreadsheets and other programs", exportTables},
    {"schema", "What a study file may hold, as JSON Schema: for editors, which complete and check it", schema},
    {"completion", "What bash, zsh or fish complete this program's commands and options by", completion},
};

}  // namespace commands
}  // namespace gamut
