// Interrupts are noted, or end the program: each in a process of its own.
#include "commands/interrupts.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include <cstdlib>

namespace gamut {
namespace {

using ::testing::ExitedWithCode;
using ::testing::KilledBySignal;

/// As below a shell, whatever this test was started by.
void startFresh() {
  for (const int kind : {SIGINT, SIGTERM, SIGHUP}) ::signal(kind, SIG_DFL);
}

TEST(Interrupts, AreNotedOnceAndEndTheProgramTheSecondTime) {
  for (const int kind : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(
        {
          startFresh();
          noteInterrupts();
          if (interrupted()) std::_Exit(1);
          ::raise(kind);
          std::_Exit(interrupted() ? 0 : 1);
        },
        ExitedWithCode(0), "");
    EXPECT_EXIT(
        {
          startFresh();
          noteInterrupts();
          ::raise(kind);
          ::raise(kind);
          std::_Exit(0);
        },
        KilledBySignal(kind), "");
  }
}

TEST(Interrupts, EndTheProgramWhereNothingWouldBeKept) {
  EXPECT_EXIT(
      {
        startFresh();
        noteInterrupts();
        endOnInterrupt();
        ::raise(SIGTERM);
        std::_Exit(0);
      },
      KilledBySignal(SIGTERM), "");
}

TEST(Interrupts, ThatCameBeforeAreNotForgotten) {
  EXPECT_EXIT(
      {
        startFresh();
        noteInterrupts();
        ::raise(SIGHUP);
        endOnInterrupt();
        std::_Exit(0);
      },
      KilledBySignal(SIGHUP), "");
}

TEST(Interrupts, StayIgnoredBelowNohup) {
  EXPECT_EXIT(
      {
        startFresh();
        ::signal(SIGHUP, SIG_IGN);
        noteInterrupts();
        ::raise(SIGHUP);
        if (interrupted()) std::_Exit(1);
        endOnInterrupt();
        ::raise(SIGHUP);
        std::_Exit(0);
      },
      ExitedWithCode(0), "");
}

}  // namespace
}  // namespace gamut
