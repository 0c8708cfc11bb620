// A terminal says how wide it is.
#include "commands/summary_style.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>

namespace gamut {
namespace {

/// 0 where it is no terminal, or one that does not say.
std::size_t columnsOf(std::FILE* stream) {
  winsize size{};
  const int file = ::fileno(stream);
  return ::isatty(file) == 1 && ::ioctl(file, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

}  // namespace

void addVerbose(CLI::App& command, bool& isVerbose) {
  command.add_flag("--verbose", isVerbose, "All that there is to say, not the first twenty lines");
}

SummaryStyle summaryStyle(std::FILE* stream, bool isVerbose, std::size_t added) {
  SummaryStyle style;
  style.isVerbose = isVerbose;
  style.columns = columnsOf(stream);
  style.rows -= added;
  return style;
}

}  // namespace gamut
