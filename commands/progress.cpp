// Drawn at most ten times a second, over itself.
#include "commands/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace gamut {
namespace {

/// A terminal that knows of no escapes would show them.
bool drawsOverItself() {
  const char* kind = std::getenv("TERM");
  return kind != nullptr && *kind != '\0' && std::strcmp(kind, "dumb") != 0;
}

}  // namespace

std::string duration(double seconds) {
  const auto whole = static_cast<long>(std::ceil(std::clamp(seconds, 0.0, 1e9)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string progressLine(const std::string& task, double fraction, double elapsed) {
  constexpr int width = 30;
  const double done = std::isnan(fraction) ? 0.0 : std::clamp(fraction, 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::floor(done * width));
  std::string line = fmt::format("{:<12} [{}{}] {:3.0f} %", task, std::string(filled, '#'),
                                 std::string(width - filled, ' '), std::floor(100 * done));
  // Until a little has been done, or before a second has passed, the rate says nothing.
  if (done > 0.01 && elapsed > 1) line += fmt::format(", {} left", duration(elapsed * (1 - done) / done));
  return line;
}

ProgressBar::ProgressBar(bool enabled, std::FILE* stream)
    : stream_(stream), enabled_(enabled && ::isatty(::fileno(stream)) == 1 && drawsOverItself()) {}

ProgressBar::~ProgressBar() { wipe(); }

void ProgressBar::update(const std::string& task, double fraction) {
  if (!enabled_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (task != task_) {
    task_ = task;
    begun_ = now;
    drawn_ = {};
  }
  if (now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  visible_ = true;
  const double elapsed = std::chrono::duration<double>(now - begun_).count();
  show(fmt::format("\r{}\033[K", progressLine(task, fraction, elapsed)));
}

/// A terminal that was closed is no reason for a run to fail.
void ProgressBar::show(const std::string& text) {
  std::fputs(text.c_str(), stream_);
  std::fflush(stream_);
}

void ProgressBar::wipe() {
  const std::lock_guard lock(mutex_);
  wipeLocked();
}

void ProgressBar::wipeLocked() {
  if (!visible_) return;
  show("\r\033[K");
  visible_ = false;
}

}  // namespace gamut
