// Interrupts from outside: SIGINT (Ctrl-C), SIGTERM and SIGHUP. What was to be ignored, as by nohup, stays so. None
// leaves a file behind that is not whole.
#pragma once

#include <atomic>
#include <string>

namespace gamut {

/// From now on an interrupt ends the program at once, with the exit code that says so.
void endOnInterrupt();

/// From now on an interrupt is only noted, so that what was computed can be kept; a second one of its kind ends the
/// program.
void noteInterrupts();

/// What is said from now on where an interrupt ends the program: one line.
void sayOnInterrupt(const std::string& line);

/// Set by the first interrupt that is noted.
const std::atomic<bool>& interrupted();

/// Ends the program at once with this exit code: no file that is not whole is left.
[[noreturn]] void endNow(int exitCode) noexcept;

}  // namespace gamut
