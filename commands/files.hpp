// The files that commands read and write.
#pragma once

#include <optional>
#include <string>

#include "studies/atomic_file.hpp"
#include "studies/machine.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// The text of a study, and what messages call the file that it stands in.
struct StudyText {
  std::string text, name;
};

/// Of a file, or of standard input if the path is "-". Throws StudyError.
StudyText readStudyFile(const std::string& path);

/// "double_pendulum" for double_pendulum/study.toml, "arm" for arm.toml, "study" for standard input.
std::string nameOfStudy(const std::string& path);

/// The machine of a study, likewise; says on standard error, unless `isQuiet`, what may be a mistake in the study,
/// and of a dead point of its loops that is ahead. `timeLimit`: as of prepared().
/// Throws StudyError.
Machine readMachine(const std::string& path, bool isQuiet, std::optional<double> timeLimit = {});

/// The study that results from `path` are of, with the files that it names, as they hold them. Throws StudyError, or
/// UsageError if they make no sense.
Study studyOf(const Results& results, const std::string& path);

/// The page of results: what was asked for, or else "arm.html" of arm.h5. Throws UsageError if that is the results.
std::string pageBeside(const std::string& results, const std::string& asked = {});

/// As a shell takes it.
std::string shellQuoted(const std::string& path);

/// Before any work is done: the file may be written, overwrites nothing that it must not, and is ours from now on.
/// Throws UsageError if it is the input, OutputRefused or WriteError as OutputFile does.
OutputFile reserve(const std::string& path, const std::string& input, bool force);

}  // namespace gamut
