// What may end the process that does it, or is to be done beside others, is done in a process of its own.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

namespace gamut {

/// What a child process may use; 0: as much as its parent.
struct ChildLimits {
  std::size_t memory = 0;  ///< bytes beside what is in use when it starts
  unsigned seconds = 0;    ///< of CPU
};

/// A copy of this process that computes a text and hands it over. It ends with its parent, however that ends, and
/// leaves interrupts to it; of what its parent has open it keeps nothing.
class ChildProcess {
 public:
  /// Throws std::system_error if no process can be started. The child has the calling thread alone: `compute` must
  /// wait for no other one. What it throws ends the child.
  ChildProcess(const std::function<std::string()>& compute, const ChildLimits& limits);
  /// Hands a part of the text over at once; where nobody takes it any more, the child ends. By one thread at a time.
  using Say = std::function<void(std::string_view)>;
  /// Likewise of one that says parts of its text while it is at work: what `compute` returns comes last.
  ChildProcess(const std::function<std::string(const Say&)>& compute, const ChildLimits& limits);
  /// Ends a child that is still at work, and waits for its end.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Can be read, or waited for by poll(), when there is more, or the end.
  int pipe() const { return pipe_; }
  /// Takes what has come, and waits for it where nothing has; false at the end. Throws std::length_error beyond `most`
  /// bytes.
  bool read(std::size_t most);
  /// What has come and was not dropped.
  std::string_view soFar() const { return text_; }
  /// Forgets so many bytes, the first of what has come.
  void drop(std::size_t bytes) { text_.erase(0, bytes); }
  /// Of a child that has come to its end: whether all of its text arrived.
  bool isWhole() const { return text_.ends_with(mark); }
  /// The text of one that is whole.
  std::string text() const { return text_.substr(0, text_.size() - 1); }
  /// Waits for its end; the number of the signal that ended it, or 0.
  int signal();

 private:
  static constexpr char mark = '!';  // the last byte of a whole text: it tells where exit statuses are ignored

  int pipe_ = -1;
  pid_t child_ = -1;
  int status_ = 0;
  std::string text_;
};

}  // namespace gamut
