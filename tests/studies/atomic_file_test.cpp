// Files are whole or not there, whatever ends their writers; nothing is replaced that is no regular file, nothing is
// written by two, and nothing of the dead stays.
#include "studies/atomic_file.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using Existing = OutputFile::Existing;

/// The complaint of `action`.
template <class Error>
std::string complaint(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no complaint";
}

/// Runs `action` in a child; its wait status.
int inChild(const std::function<void()>& action) {
  const pid_t child = ::fork();
  if (child == 0) {
    action();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

class AnOutputFile : public ::testing::Test {
 protected:
  std::string refusal(const std::string& path, Existing existing = Existing::isReplaced) const {
    return complaint<OutputRefused>([&] { OutputFile(path, existing); });
  }

  TemporaryFolder folder_;
  std::string path_ = folder_.path("a.h5");
};

TEST_F(AnOutputFile, IsWrittenWholeAndReplacesAnOlderOne) {
  replaceFile(path_, "old");
  replaceFile(path_, "new and longer");
  EXPECT_EQ(folder_.read("a.h5"), "new and longer");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(AnOutputFile, LeavesNothingWithoutContent) {
  { const OutputFile file(path_, Existing::isKept); }
  EXPECT_EQ(folder_.count(), 0U);
}

TEST_F(AnOutputFile, IsRefusedBeforeWorkWhereItCannotBe) {
  EXPECT_EQ(refusal("/nowhere/at/all/x.html"),
            "/nowhere/at/all/x.html: cannot be written; the folder /nowhere/at/all does not exist");
  EXPECT_EQ(refusal(folder_.path("")), folder_.path("") + ": cannot be written; it is a folder");
  const std::string irregular = ": cannot be written; it is a device, or another thing that is no regular file";
  EXPECT_EQ(refusal("/dev/null"), "/dev/null" + irregular);
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EXPECT_EQ(refusal(path_), path_ + irregular);
  std::filesystem::create_symlink("/dev/null", folder_.path("link"));
  EXPECT_EQ(refusal(folder_.path("link")), folder_.path("link") + irregular);
  std::filesystem::create_symlink("loop", folder_.path("loop"));
  EXPECT_EQ(refusal(folder_.path("loop")),
            folder_.path("loop") + ": cannot be written; symbolic links lead in a circle");
  for (const std::size_t length : {250U, 300U})
    EXPECT_THAT(refusal(folder_.path(std::string(length, 'a'))), HasSubstr("the name is too long"));
  EXPECT_EQ(folder_.count(), 3U);
}

TEST_F(AnOutputFile, KeepsWhatIsThereUnlessItMayBeReplaced) {
  folder_.write("a.h5", "precious");
  EXPECT_EQ(refusal(path_, Existing::isKept), path_ + ": exists already; expected another name, or --force");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(AnOutputFile, DoesNotReplaceWhatAppearedMeanwhile) {
  OutputFile file(path_, Existing::isKept);
  folder_.write("a.h5", "another program's");
  EXPECT_EQ(complaint<WriteError>([&] { file.write("ours"); }),
            path_ + ": cannot be written; another program has written it meanwhile");
  EXPECT_EQ(folder_.read("a.h5"), "another program's");
}

TEST_F(AnOutputFile, IsWrittenWhereASymbolicLinkLeads) {
  std::filesystem::create_directory(folder_.path("there"));
  std::filesystem::create_symlink("there/b.h5", folder_.path("link"));
  replaceFile(folder_.path("link"), "content");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_.path("link")));
  EXPECT_EQ(folder_.read("there/b.h5"), "content");
}

TEST_F(AnOutputFile, HasOneWriterAtATime) {
  OutputFile first(path_, Existing::isKept);
  for (const Existing existing : {Existing::isKept, Existing::isReplaced})
    EXPECT_EQ(refusal(path_, existing), path_ + ": cannot be written; another run is about to write it");
  first.write("content");
  EXPECT_EQ(folder_.read("a.h5"), "content");
  EXPECT_EQ(refusal(path_, Existing::isReplaced), "no complaint");
}

TEST_F(AnOutputFile, RemovesWhatTheDeadLeftAndNothingElse) {
  OutputFile alive(folder_.path("alive.h5"), Existing::isKept);
  for (const char* name : {"a.h5", "dead.h5"}) {
    const int status = inChild([&] {
      const OutputFile file(folder_.path(name), Existing::isKept);
      ::raise(SIGKILL);
    });
    ASSERT_TRUE(WIFSIGNALED(status));
  }
  folder_.write(".other.part", "another program's");
  EXPECT_EQ(folder_.count(), 3U);  // the second child removed what the first one left
  replaceFile(path_, "content");
  EXPECT_EQ(folder_.count(), 3U);
  EXPECT_FALSE(folder_.has(".dead.h5.gamut-part"));
  EXPECT_EQ(folder_.read(".other.part"), "another program's");
  alive.write("too");
  EXPECT_EQ(folder_.read("alive.h5"), "too");
}

TEST_F(AnOutputFile, SurvivesAnyKilledWriteOfANewOne) {
  replaceFile(path_, "old");
  const std::string content(1 << 22, 'x');
  for (int i = 0; i < 20; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      for (;;) replaceFile(path_, content);
    }
    ::usleep(static_cast<useconds_t>(500 + 1700 * i));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const std::string found = folder_.read("a.h5");
    EXPECT_TRUE(found == "old" || found == content) << "kill number " << i;
  }
  replaceFile(path_, "new");
  EXPECT_EQ(folder_.count(), 1U);
}

TEST_F(AnOutputFile, ThatIsLargerThanAllowedFailsAndLeavesNothing) {
  const int status = inChild([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const struct rlimit limit { 1000, 1000 };
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string found = complaint<WriteError>([&] { replaceFile(path_, std::string(5000, 'x')); });
    if (found != path_ + ": cannot be written; files may not grow so large here, see ulimit -f (File too large)")
      ::_exit(1);
  });
  EXPECT_EQ(status, 0);
  EXPECT_EQ(folder_.count(), 0U);
}

TEST_F(AnOutputFile, SaysThatTheDiskIsFull) {
  const std::string disk = folder_.path("disk");
  std::filesystem::create_directory(disk);
  if (::mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "only root can make a small disk";
  const std::string full = disk + "/a.h5: cannot be written; the disk is full (No space left on device)";
  EXPECT_EQ(complaint<WriteError>([&] { replaceFile(disk + "/a.h5", std::string(100000, 'x')); }), full);
  EXPECT_TRUE(std::filesystem::is_empty(disk));
  ::umount(disk.c_str());
}

}  // namespace
}  // namespace gamut
