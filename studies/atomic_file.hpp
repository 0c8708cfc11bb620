// Files that are whole or not there: written beside the target under another name, flushed, then renamed over it. The
// other file is locked while its writer lives, so that two runs never write one output and what a dead run left behind
// is told apart and removed.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace gamut {

/// A file could not be written; what() is one line, "path: cannot be written; why".
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// As WriteError, before any work was done: another name, or patience, would do.
class OutputRefused : public WriteError {
 public:
  using WriteError::WriteError;
};

/// The right to write one file, from construction on. A symbolic link stands for what it leads to.
class OutputFile {
 public:
  enum class Existing { isKept, isReplaced };

  /// Throws OutputRefused if no file can be written at `path` (its folder is missing or takes no files, a folder,
  /// device or anything but a regular file is there, links lead in a circle, the name is too long), if one is there
  /// that is to be kept, or if another process is about to write it; WriteError if the disk is full. Removes what
  /// writers that are dead left in the folder.
  OutputFile(const std::string& path, Existing existing);
  /// Without write() nothing is left behind.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Where the symbolic links of a path lead; the path itself where that is nowhere.
  static std::string targetOf(const std::string& path);
  /// As given.
  const std::string& path() const { return path_; }
  /// Where the symbolic links of path() lead.
  const std::string& target() const { return target_; }

  /// Whether something is there that is to be kept: another program put it there since this object was made.
  bool isTaken() const;

  /// Writes all of `content` and puts it at `path`; once. If it throws WriteError, or the process is killed, an older
  /// file there is untouched.
  void write(std::string_view content);

 private:
  [[noreturn]] void fail(int error) const;
  void fill(std::string_view content) const;
  void moveToTarget() const;

  std::string path_, target_, part_;
  Existing existing_;
  int file_ = -1;
  int listed_ = -1;  // where removeUnfinished() finds it
};

/// Removes what OutputFiles of this process have not finished; they write nothing any more. For the end of the process
/// alone. Safe in a handler of signals.
void removeUnfinished() noexcept;

/// Removes what writers that are dead left in the folder of `path`: after a process of ours was killed.
void removeAbandonedBeside(const std::string& path);

/// An older file at `path` is replaced in one step. Throws WriteError.
void replaceFile(const std::string& path, std::string_view content);

}  // namespace gamut
