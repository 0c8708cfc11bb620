// The files that commands read and write.
#pragma once

#include <string>

#include "studies/atomic_file.hpp"
#include "studies/study.hpp"

namespace gamut {

/// Reads a study; says on standard error, unless `isQuiet`, what may be a mistake in it. Throws StudyError.
Study readStudyNoting(const std::string& path, bool isQuiet);

/// Before any work is done: the file may be written, overwrites nothing that it must not, and is ours from now on.
/// Throws UsageError if it is the input, OutputRefused or WriteError as OutputFile does.
OutputFile reserve(const std::string& path, const std::string& input, bool force);

}  // namespace gamut
