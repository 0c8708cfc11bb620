// A study's file, and those that it names, robots with what these name, as far as they are there: whether somebody has
// saved one of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gamut {

class WatchedFiles {
 public:
  /// Of this study; begins with what is there now.
  explicit WatchedFiles(std::string study);

  /// Whether a file is another one than when this was asked for the last time, and has been left alone for a moment:
  /// what is half written is waited for. Files come, go and are replaced by others of their name.
  bool haveChanged();

 private:
  /// How a file looked: all zero where there is none.
  struct Look {
    std::uint64_t device = 0, inode = 0, size = 0, seconds = 0, nanoseconds = 0;
    bool operator==(const Look&) const = default;
  };
  static Look lookAt(const std::string& path);
  std::vector<Look> looks() const;
  void nameFiles();
  void nameFilesIn(const std::string& path, int deepest);

  const std::string study_;
  std::vector<std::string> files_;  // the study first
  std::vector<Look> seen_, settled_;
};

}  // namespace gamut
