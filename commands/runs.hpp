// What the commands that run a study, or go on with one, have in common: their options, what they write, what they say.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "commands/exit_codes.hpp"
#include "studies/atomic_file.hpp"
#include "studies/checkpoint_file.hpp"
#include "studies/running/run.hpp"

namespace gamut {

struct RunArguments {
  RunArguments();

  int jobs;                                      ///< as many as the machine has
  std::optional<double> timeLimit, memoryLimit;  ///< s of CPU; GB
  double interval = 600;                         ///< s between checkpoints; 0: none
  bool json = false, quiet = false, verbose = false, force = false;
};

void addRunOptions(CLI::App& command, RunArguments& arguments);
/// Of these, time and memory.
void addLimitOptions(CLI::App& command, RunArguments& arguments);
void addJobs(CLI::App& command, RunArguments& arguments);
/// Of these, what changes nothing of what is found.
void addTellOptions(CLI::App& command, RunArguments& arguments);
/// What of the sampling plan is instead of the study's.
void addPlanOptions(CLI::App& command, std::optional<std::uint64_t>& seed, std::optional<std::size_t>& samples);

/// With interrupts noted, without seed, samples and progress.
RunOptions runOptions(const RunArguments& arguments);

/// On standard error, "note: ...".
void sayNote(const std::string& line);

/// Throws UsageError if samples need more memory than there may be: a block's motions are kept until it was compared.
void checkMemory(const Study& study, const RunOptions& options);

/// Runs the study's analyses, shows how far they are, and keeps what they found as keepAndSay does; then a run that was
/// remembered is forgotten. `checkpoints`: null of one that is not.
ExitCode runAndKeep(const Machine& machine, RunOptions options, CheckpointFile* checkpoints, OutputFile& resultsFile,
                    OutputFile& reportFile, const RunArguments& arguments);

/// Likewise brings more samples to results, those of `input`.
ExitCode extendAndKeep(const Machine& machine, const Results& before, const std::string& input, RunOptions options,
                       CheckpointFile* checkpoints, OutputFile& resultsFile, OutputFile& reportFile,
                       const RunArguments& arguments);

/// Of a rank that is not the first, which says and keeps nothing. `before`: results to which samples come; null: it is
/// a run.
ExitCode takePart(const Machine& machine, RunOptions options, const Results* before = nullptr);

/// What of the plan of a run, or of an extension, does not depend on which of both it is.
CheckpointPlan planOf(const Study& study, const Limits& limits, const RunArguments& arguments,
                      const std::string& report);
/// What one before this would go on with is not lost unasked.
void refuseToForget(const OutputFile& results, const RunArguments& arguments);
void addCheckpoint(CLI::App& command, RunArguments& arguments);

/// Writes the results, then draws the page, and says what was found, as was asked for, and where it is. Throws
/// WriteError if one of both could not be written; what was found has been told then.
ExitCode keepAndSay(const Results& results, OutputFile& resultsFile, OutputFile& reportFile,
                    const RunArguments& arguments);

}  // namespace gamut
