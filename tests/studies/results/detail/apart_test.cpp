// A child process gives what it computed, and lives no longer than who asked for it.
#include "studies/results/detail/apart.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>

namespace gamut {
namespace {

constexpr std::size_t memory = 64 << 20;

TEST(Apart, GivesWhatWasComputed) {
  const std::string large(1 << 20, 'x');
  EXPECT_EQ(resultApart([&] { return large; }, memory, 10), large);
  EXPECT_EQ(resultApart([] { return std::string(); }, memory, 10), "");
}

TEST(Apart, GivesNothingWhereTheChildDidNotComeToItsEnd) {
  EXPECT_EQ(resultApart(
                []() -> std::string {
                  ::raise(SIGSEGV);
                  return "";
                },
                memory, 10),
            std::nullopt);
  EXPECT_EQ(resultApart([]() -> std::string { throw std::runtime_error("no"); }, memory, 10), std::nullopt);
}

TEST(Apart, DoesNotWaitForAChildThatSaysTooMuch) {
  EXPECT_EQ(resultApart([] { return std::string(8 << 20, 'x'); }, 1 << 10, 10), std::nullopt);
}

TEST(Apart, InterruptsAreLeftToTheParent) {
  const auto interrupt = [] {
    for (const int kind : {SIGINT, SIGTERM, SIGHUP}) ::raise(kind);
    return std::string("whole");
  };
  EXPECT_EQ(resultApart(interrupt, memory, 10), "whole");
}

/// Orphans come to this process, so that it sees them end.
class OrphanedApart : public ::testing::Test {
 protected:
  OrphanedApart() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }
  ~OrphanedApart() override { ::prctl(PR_SET_CHILD_SUBREAPER, 0); }

  /// A process that waits for a child without end; when it is killed, after that many microseconds, all that it had
  /// opened is closed, and the child is gone.
  static void expectNobodyLeft(bool awaitsChild, useconds_t delay) {
    std::array<int, 2> output{}, word{};
    ASSERT_EQ(::pipe(output.data()), 0);
    ASSERT_EQ(::pipe(word.data()), 0);
    const pid_t parent = ::fork();
    if (parent == 0) {
      ::dup2(output[1], STDOUT_FILENO);
      const pid_t own = ::getpid();
      const int file = word[1];
      resultApart(
          [=]() -> std::string {
            const std::string path = "/proc/" + std::to_string(own) + "/fd/" + std::to_string(file);
            const int back = ::open(path.c_str(), O_WRONLY);
            if (::write(back, "!", 1) == 1) ::close(back);
            for (;;) ::pause();
          },
          memory, 1000);
      ::_exit(0);
    }
    ::close(output[1]);
    ::close(word[1]);
    char begun = 0;
    if (awaitsChild) {
      ASSERT_EQ(::read(word[0], &begun, 1), 1);
    }
    ::usleep(delay);
    ::kill(parent, SIGKILL);
    ASSERT_EQ(::waitpid(parent, nullptr, 0), parent);
    for (const int end : {output[0], word[0]}) {
      pollfd reading{end, POLLIN, 0};
      char rest = 0;
      do ASSERT_EQ(::poll(&reading, 1, 60000), 1) << "the child keeps it";
      while (::read(end, &rest, 1) > 0);
      ::close(end);
    }
    const auto isLeft = [] {
      const pid_t found = ::waitpid(-1, nullptr, WNOHANG);
      return found != -1 || errno != ECHILD;
    };
    for (int tries = 0; tries < 60000 && isLeft(); ++tries) ::usleep(1000);
    EXPECT_FALSE(isLeft()) << "the child lives on";
  }
};

TEST_F(OrphanedApart, EndsWithItsParent) { expectNobodyLeft(true, 0); }

TEST_F(OrphanedApart, EndsWithAParentThatEndsAtAnyMoment) {
  for (useconds_t delay = 0; delay < 3000; delay += 50) expectNobodyLeft(false, delay);
}

}  // namespace
}  // namespace gamut
