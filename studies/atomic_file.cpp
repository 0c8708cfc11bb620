// POSIX: rename() replaces in one step when both names lie in one folder; fsync() before it keeps the order on disk. A
// lock by flock() ends with its process, however that ends.
#include "studies/atomic_file.hpp"

#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "studies/held_interrupts.hpp"

namespace gamut {
namespace {

namespace fs = std::filesystem;

/// ".NAME.gamut-part" is what becomes NAME: no other program calls its files so.
constexpr std::string_view suffix = ".gamut-part";

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

std::string sentence(const std::string& path, const std::string& why) { return path + ": cannot be written; " + why; }

[[noreturn]] void refuse(const std::string& path, const std::string& why) { throw OutputRefused(sentence(path, why)); }

bool isFull(int error) { return error == ENOSPC || error == EDQUOT; }

std::string inWords(int error) {
  const std::string system = std::strerror(error);
  if (error == ENOSPC) return "the disk is full (" + system + ")";
  if (error == EDQUOT) return "the user's share of the disk is used up (" + system + ")";
  if (error == EFBIG) return "files may not grow so large here, see ulimit -f (" + system + ")";
  if (error == ENAMETOOLONG) return "the name is too long";
  if (error == ELOOP) return "symbolic links lead in a circle";
  return system;
}

/// The end of the chain of symbolic links that starts at `path`; it need not exist.
fs::path endOfLinks(const std::string& path) {
  fs::path end(path);
  std::error_code error;
  for (int links = 0; fs::is_symlink(end, error); ++links) {
    if (links == 40) refuse(path, inWords(ELOOP));
    const fs::path next = fs::read_symlink(end, error);
    if (error) refuse(path, inWords(error.value()));
    end = folderOf(end) / next;
  }
  return end;
}

/// A file that can be replaced, or none, stands at `target`.
void checkTarget(const std::string& path, const std::string& target, OutputFile::Existing existing) {
  struct stat found {};
  if (::stat(target.c_str(), &found) != 0) {
    if (errno != ENOENT) refuse(path, inWords(errno));
    return;
  }
  if (S_ISDIR(found.st_mode)) refuse(path, "it is a folder");
  if (!S_ISREG(found.st_mode)) refuse(path, "it is a device, or another thing that is no regular file");
  if (existing == OutputFile::Existing::isKept)
    throw OutputRefused(path + ": exists already; expected another name, or --force");
}

/// Whether `file` is what `path` names: it may have been renamed or removed before it was locked.
bool isStill(int file, const char* path) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::lstat(path, &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

enum class Lock { taken, held, impossible };

/// Tries `attempts` times, 10 ms apart.
Lock lock(int file, int attempts) {
  for (int attempt = 1; ::flock(file, LOCK_EX | LOCK_NB) != 0; ++attempt) {
    if (errno != EWOULDBLOCK) return Lock::impossible;
    if (attempt >= attempts) return Lock::held;
    ::usleep(10000);
  }
  return Lock::taken;
}

/// A file that nobody holds a lock on has lost its writer. Where locks are impossible nothing is removed.
void removeIfAbandoned(const std::string& part) {
  const int file = ::open(part.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (file < 0) return;
  struct stat found {};
  const bool isRegular = ::fstat(file, &found) == 0 && S_ISREG(found.st_mode);
  if (isRegular && lock(file, 1) == Lock::taken && isStill(file, part.c_str())) ::unlink(part.c_str());
  ::close(file);
}

void removeAbandoned(const fs::path& folder) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with('.') && name.ends_with(suffix)) removeIfAbandoned(entry->path().string());
  }
}

/// Files that are being written, in memory that is never given back: a handler of signals may look at it at any moment.
struct Unfinished {
  enum State { isFree, isFilled, isListed };
  std::atomic<int> state{isFree};
  std::array<char, PATH_MAX> part{};
  int file = -1;
  pid_t writer = 0;  // a child of the process has the same list
};
static_assert(std::atomic<int>::is_always_lock_free);
constexpr std::size_t mostUnfinished = 8;
std::array<Unfinished, mostUnfinished> unfinished;

/// Where; -1 if there is no room. What a killed run leaves is removed by the next one all the same.
int list(const std::string& part, int file) {
  if (part.size() >= PATH_MAX) return -1;
  for (std::size_t i = 0; i < mostUnfinished; ++i) {
    int expected = Unfinished::isFree;
    if (!unfinished[i].state.compare_exchange_strong(expected, Unfinished::isFilled)) continue;
    std::copy_n(part.c_str(), part.size() + 1, unfinished[i].part.begin());
    unfinished[i].file = file;
    unfinished[i].writer = ::getpid();
    unfinished[i].state = Unfinished::isListed;
    return static_cast<int>(i);
  }
  return -1;
}

void unlist(int number) {
  if (number >= 0) unfinished[number].state = Unfinished::isFree;
}

}  // namespace

void removeUnfinished() noexcept {
  for (Unfinished& one : unfinished)
    if (one.state == Unfinished::isListed && one.writer == ::getpid() && isStill(one.file, one.part.data()))
      ::unlink(one.part.data());
}

void removeAbandonedBeside(const std::string& path) { removeAbandoned(folderOf(endOfLinks(path))); }

std::string OutputFile::targetOf(const std::string& path) {
  try {
    return endOfLinks(path).string();
  } catch (const OutputRefused&) {
    return path;
  }
}

OutputFile::OutputFile(const std::string& path, Existing existing) : path_(path), existing_(existing) {
  const fs::path end = endOfLinks(path), folder = folderOf(end);
  target_ = end.string();
  std::error_code error;
  if (!fs::is_directory(folder, error)) refuse(path, "the folder " + folder.string() + " does not exist");
  checkTarget(path, target_, existing);
  removeAbandoned(folder);
  const HeldInterrupts held;  // a file that is there is listed
  part_ = (folder / ("." + end.filename().string() + std::string(suffix))).string();
  // Once more where the writer before ended between the two steps: its file is then no longer called so.
  for (bool isMine = false; !isMine;) {
    file_ = ::open(part_.c_str(), O_CREAT | O_RDWR | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (file_ < 0) {
      if (isFull(errno)) throw WriteError(sentence(path, inWords(errno)));
      const bool isName = errno == ENAMETOOLONG;
      refuse(path, isName ? inWords(errno) : "the folder " + folder.string() + " takes no files: " + inWords(errno));
    }
    // One that clears up holds it for a moment, one that writes for as long as it runs.
    if (lock(file_, 20) == Lock::held) {
      ::close(file_);
      refuse(path, "another run is about to write it");
    }
    isMine = isStill(file_, part_.c_str());
    if (!isMine) ::close(file_);
  }
  listed_ = list(part_, file_);
  // That writer may have put its file at the target since.
  try {
    checkTarget(path, target_, existing);
  } catch (...) {
    ::unlink(part_.c_str());
    unlist(listed_);
    ::close(file_);
    throw;
  }
}

OutputFile::~OutputFile() {
  if (file_ < 0) return;
  if (isStill(file_, part_.c_str())) ::unlink(part_.c_str());
  unlist(listed_);
  ::close(file_);
}

bool OutputFile::isTaken() const {
  struct stat found {};
  return existing_ == Existing::isKept && file_ >= 0 && ::lstat(target_.c_str(), &found) == 0;
}

void OutputFile::fail(int error) const { throw WriteError(sentence(path_, inWords(error))); }

void OutputFile::fill(std::string_view content) const {
  if (::ftruncate(file_, 0) != 0 || ::lseek(file_, 0, SEEK_SET) != 0) fail(errno);
  while (!content.empty()) {
    const ssize_t written = ::write(file_, content.data(), content.size());
    if (written < 0 && errno != EINTR) fail(errno);
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  // Some file systems cannot flush (EINVAL): the rename is still in order there.
  if (::fsync(file_) != 0 && errno != EINVAL) fail(errno);
}

void OutputFile::moveToTarget() const {
  if (!isStill(file_, part_.c_str())) throw WriteError(sentence(path_, "another program removed what was written"));
  if (existing_ == Existing::isKept) {
    // A name that appeared meanwhile is not ours to replace. File systems without this way of renaming say EINVAL.
    if (::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0) return;
    if (errno == EEXIST) throw WriteError(sentence(path_, "another program has written it meanwhile"));
    if (errno != EINVAL && errno != ENOSYS) fail(errno);
  }
  if (::rename(part_.c_str(), target_.c_str()) != 0) fail(errno);
}

void OutputFile::write(std::string_view content) {
  fill(content);
  moveToTarget();
  unlist(listed_);
  ::close(file_);
  file_ = -1;
}

void replaceFile(const std::string& path, std::string_view content) {
  OutputFile(path, OutputFile::Existing::isReplaced).write(content);
}

}  // namespace gamut
