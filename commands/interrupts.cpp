// POSIX: a handler may touch nothing but lock-free atomics.
#include "commands/interrupts.hpp"

#include <signal.h>

namespace gamut {
namespace {

constexpr int kinds[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> isNoted{false};
std::atomic<int> lastKind{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void note(int kind) {
  lastKind = kind;
  isNoted = true;
}

void handle(int kind, const struct sigaction& action) {
  struct sigaction before {};
  if (::sigaction(kind, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) ::sigaction(kind, &action, nullptr);
}

}  // namespace

void noteInterrupts() {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = SA_RESETHAND;
  for (const int kind : kinds) handle(kind, action);
}

const std::atomic<bool>& interrupted() { return isNoted; }

void endOnInterrupt() {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  for (const int kind : kinds) handle(kind, action);
  if (isNoted) ::raise(lastKind);
}

}  // namespace gamut
