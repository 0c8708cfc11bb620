// Interrupts are noted, or end the program with its exit code, and nothing half is left: each in a process of its own.
#include "commands/interrupts.hpp"

#include <gmock/gmock.h>
#include <signal.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "studies/atomic_file.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::ExitedWithCode;

constexpr int ended = 3;

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
        ExitedWithCode(ended), "gamut: interrupted again; nothing was written\n");
  }
}

TEST(Interrupts, EndTheProgramWhereNothingWouldBeKept) {
  EXPECT_EXIT(
      {
        startFresh();
        endOnInterrupt();
        ::raise(SIGTERM);
        std::_Exit(0);
      },
      ExitedWithCode(ended), "^gamut: interrupted\n$");
}

TEST(Interrupts, SayWhatTheyCostWhereTheyEndTheProgram) {
  EXPECT_EXIT(
      {
        startFresh();
        noteInterrupts();
        sayOnInterrupt("interrupted early");
        ::raise(SIGHUP);
        sayOnInterrupt("interrupted late");
        if (!interrupted()) std::_Exit(1);
        ::raise(SIGHUP);
        std::_Exit(0);
      },
      ExitedWithCode(ended), "^gamut: interrupted late\n$");
}

TEST(Interrupts, SayOneLineHoweverLong) {
  EXPECT_EXIT(
      {
        startFresh();
        endOnInterrupt();
        for (const char letter : std::string("abcdefgh")) sayOnInterrupt(std::string(100000, letter));
        ::raise(SIGINT);
        std::_Exit(0);
      },
      ExitedWithCode(ended), "^gamut: h+\n$");
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

TEST(Interrupts, LeaveNoPartOfAnyFile) {
  const TemporaryFolder folder;
  folder.write("a.h5", "older");
  const auto writeAndEnd = [&] {
    startFresh();
    endOnInterrupt();
    OutputFile done(folder.path("done.h5"), OutputFile::Existing::isReplaced);
    done.write("whole");
    const OutputFile first(folder.path("a.h5"), OutputFile::Existing::isReplaced),
        second(folder.path("b.h5"), OutputFile::Existing::isReplaced);
    ::raise(SIGINT);
  };
  EXPECT_EXIT(writeAndEnd(), ExitedWithCode(ended), "");
  EXPECT_EQ(folder.count(), 2U);
  EXPECT_EQ(folder.read("a.h5"), "older");
  EXPECT_EQ(folder.read("done.h5"), "whole");
}

TEST(Interrupts, LeaveWhatAnotherProcessWrites) {
  const TemporaryFolder folder;
  const OutputFile ours(folder.path("a.h5"), OutputFile::Existing::isReplaced);
  const auto endAtOnce = [&] {
    const OutputFile own(folder.path("b.h5"), OutputFile::Existing::isReplaced);
    std::filesystem::remove(folder.path(".b.h5.gamut-part"));
    folder.write(".b.h5.gamut-part", "somebody else's");
    endNow(5);
  };
  EXPECT_EXIT(endAtOnce(), ExitedWithCode(5), "");
  EXPECT_EQ(folder.read(".b.h5.gamut-part"), "somebody else's");
  EXPECT_TRUE(folder.has(".a.h5.gamut-part"));
}

}  // namespace
}  // namespace gamut
