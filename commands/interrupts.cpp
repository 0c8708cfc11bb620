// POSIX: a handler may touch nothing but lock-free atomics, and call little but system calls.
#include "commands/interrupts.hpp"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "commands/exit_codes.hpp"
#include "studies/atomic_file.hpp"

namespace gamut {
namespace {

constexpr std::array kinds{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> isNoted{false}, isTerminal{false};
std::array<std::atomic<bool>, kinds.size()> isEnd{};  // of each kind: the next one ends the program
/// What is said then. A text is not written over by the next one: a handler may be reading it.
std::array<std::array<char, 2048>, 4> texts{};
std::atomic<std::size_t> lastText{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::size_t>::is_always_lock_free);

void say(const char* text) {
  // Nothing can be done where nobody reads it.
  if (::write(STDERR_FILENO, text, std::strlen(text)) < 0) return;
}

void handle(int kind) {
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] != kind) continue;
    if (!isEnd[i].exchange(true)) {
      isNoted = true;
      continue;
    }
    if (isTerminal) say("\r\033[K");  // where a progress bar may stand
    say(texts[lastText].data());
    endNow(endedEarly);
  }
}

void handleAll(bool endsAtOnce) {
  isTerminal = ::isatty(STDERR_FILENO) == 1;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    isEnd[i] = endsAtOnce;
    struct sigaction action {
    }, before{};
    action.sa_handler = handle;
    action.sa_flags = SA_RESTART;
    if (::sigaction(kinds[i], nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(kinds[i], &action, nullptr);
  }
}

}  // namespace

void endOnInterrupt() {
  sayOnInterrupt("interrupted");
  handleAll(true);
}

void noteInterrupts() {
  sayOnInterrupt("interrupted again; nothing was written");
  handleAll(false);
  // What nobody reads any more must not cost what was computed. Last: whoever sees it ignored knows that interrupts are
  // noted.
  ::signal(SIGPIPE, SIG_IGN);
}

void sayOnInterrupt(const std::string& line) {
  const std::string words = "gamut: " + line;
  const std::size_t next = (lastText + 1) % texts.size();
  const std::size_t size = std::min(words.size(), texts[next].size() - 2);
  std::copy_n(words.begin(), size, texts[next].begin());
  texts[next][size] = '\n';
  texts[next][size + 1] = '\0';
  lastText = next;
}

const std::atomic<bool>& interrupted() { return isNoted; }

void endNow(int exitCode) noexcept {
  removeUnfinished();
  ::_exit(exitCode);
}

}  // namespace gamut
