// Interrupts that must wait: for moments in which what their handler looks at is not as it should be.
#pragma once

#include <signal.h>

#include <initializer_list>

namespace gamut {

/// SIGINT, SIGTERM and SIGHUP come when this ends; of several of a kind one. Of the calling thread alone: another may
/// take them, if there is one.
class HeldInterrupts {
 public:
  HeldInterrupts() {
    sigset_t held;
    ::sigemptyset(&held);
    for (const int kind : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&held, kind);
    ::pthread_sigmask(SIG_BLOCK, &held, &before_);
  }
  ~HeldInterrupts() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldInterrupts(const HeldInterrupts&) = delete;
  HeldInterrupts& operator=(const HeldInterrupts&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace gamut
