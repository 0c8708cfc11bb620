// A write that fails drops what it could not write, so that a later flush has nothing to complain of: both are asked.
#include "commands/standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>

#include "studies/atomic_file.hpp"

namespace gamut {
namespace {

[[noreturn]] void fail() {
  throw WriteError(std::string("standard output: cannot be written; ") + std::strerror(errno));
}

}  // namespace

void occupyStandardStreams() {
  int file = 0;
  do file = ::open("/dev/null", O_RDWR);
  while (file >= 0 && file <= STDERR_FILENO);
  if (file >= 0) ::close(file);
}

std::string readIn() {
  std::string text, block(65536, '\0');
  for (;;) {
    const ssize_t count = ::read(STDIN_FILENO, block.data(), block.size());
    if (count == 0) return text;
    if (count > 0) text.append(block, 0, static_cast<std::size_t>(count));
    if (count < 0 && errno != EINTR) throw ReadError(std::strerror(errno));
  }
}

void sayOut(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail();
}

void flushOut() {
  if (std::fflush(stdout) != 0) fail();
}

}  // namespace gamut
