// Interrupts from outside: SIGINT (Ctrl-C), SIGTERM and SIGHUP. What was to be ignored, as by nohup, stays so.
#pragma once

#include <atomic>

namespace gamut {

/// From now on an interrupt is only noted, so that what was computed can be kept; a second one of its kind ends the
/// program.
void noteInterrupts();

/// Set by the first interrupt that is noted.
const std::atomic<bool>& interrupted();

/// From now on an interrupt ends the program; so does, at once, one that was noted before.
void endOnInterrupt();

}  // namespace gamut
