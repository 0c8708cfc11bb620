// fork(): the child has all that the parent has, and what it does to itself stays with it. The result comes through a
// pipe; that it is whole is said by a last byte. Of what the parent has open the child keeps the pipe's writing end
// alone: whoever waits for the parent's output, or for its locks, does not wait for the child, which ends when nobody
// reads any more.
#include "studies/child_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

#include "studies/held_interrupts.hpp"

namespace gamut {
namespace {

// A sanitizer's own memory is terabytes of addresses.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool isSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool isSanitized = true;
#else
constexpr bool isSanitized = false;
#endif
#else
constexpr bool isSanitized = false;
#endif

void limit(__rlimit_resource resource, rlim_t value) {
  struct rlimit present {};
  ::getrlimit(resource, &present);
  if (present.rlim_max != RLIM_INFINITY && value > present.rlim_max) value = present.rlim_max;
  const struct rlimit wanted { value, present.rlim_max };
  ::setrlimit(resource, &wanted);
}

void setLimits(const ChildLimits& limits) {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  if (!isSanitized && pages > 0 && limits.memory > 0)
    limit(RLIMIT_AS, pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + limits.memory);
  if (limits.seconds > 0) limit(RLIMIT_CPU, limits.seconds);
  limit(RLIMIT_CORE, 0);
}

/// The child goes with its parent, however that ends: also one that ended before the child asked for it.
void endWithParent(pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
}

/// The parent's handlers are not the child's: faults end it at once. Interrupts are left to the parent, which knows
/// what they mean: half a transcript would look like a damaged file.
void forgetHandlers() {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGPIPE}) ::signal(number, SIG_DFL);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) ::signal(number, SIG_IGN);
}

/// All but the standard streams, which lead nowhere, and the pipe, whose number is told.
int keepOnly(int pipe) {
  constexpr int kept = STDERR_FILENO + 1;
  if (pipe != kept) ::dup2(pipe, kept);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (nowhere < 0 || ::dup2(nowhere, stream) < 0) ::close(stream);
  if (::syscall(SYS_close_range, kept + 1, ~0U, 0) != 0)  // kernels before 5.9 cannot
    for (int file = kept + 1, end = static_cast<int>(::sysconf(_SC_OPEN_MAX)); file < end; ++file) ::close(file);
  return kept;
}

bool writeAll(int pipe, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(pipe, bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

[[noreturn]] void computeInChild(const std::function<std::string(const ChildProcess::Say&)>& compute,
                                 const ChildLimits& limits, char mark, int pipe) {
  bool isDone = false;
  try {
    pipe = keepOnly(pipe);
    setLimits(limits);
    const auto say = [pipe](std::string_view part) {
      if (!writeAll(pipe, part)) ::_exit(1);
    };
    isDone = writeAll(pipe, compute(say)) && writeAll(pipe, {&mark, 1});
  } catch (...) {  // then it is not done
  }
  ::_exit(isDone ? 0 : 1);
}

}  // namespace

ChildProcess::ChildProcess(const std::function<std::string()>& compute, const ChildLimits& limits)
    : ChildProcess([&](const Say&) { return compute(); }, limits) {}

ChildProcess::ChildProcess(const std::function<std::string(const Say&)>& compute, const ChildLimits& limits) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "no pipe to a child");
  const pid_t parent = ::getpid();
  child_ = [&] {
    const HeldInterrupts held;  // the child must not act as its parent on one
    const pid_t forked = ::fork();
    if (forked == 0) {
      forgetHandlers();
      endWithParent(parent);
    }
    return forked;
  }();
  if (child_ < 0) {
    const int error = errno;
    ::close(ends[0]);
    ::close(ends[1]);
    throw std::system_error(error, std::generic_category(), "no child process");
  }
  if (child_ == 0) computeInChild(compute, limits, mark, ends[1]);
  ::close(ends[1]);
  pipe_ = ends[0];
}

ChildProcess::~ChildProcess() {
  if (child_ > 0) ::kill(child_, SIGKILL);
  signal();
  ::close(pipe_);
}

bool ChildProcess::read(std::size_t most) {
  std::vector<char> block(1 << 16);
  for (;;) {
    const ssize_t count = ::read(pipe_, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text_.append(block.data(), static_cast<std::size_t>(count));
    if (text_.size() > most) throw std::length_error("a child process says too much");
    return true;
  }
}

int ChildProcess::signal() {
  if (child_ > 0) {
    while (::waitpid(child_, &status_, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
  }
  return WIFSIGNALED(status_) ? WTERMSIG(status_) : 0;
}

}  // namespace gamut
