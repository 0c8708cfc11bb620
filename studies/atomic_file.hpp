// Files that are whole or not there: written beside the target under another name, flushed, then renamed over it.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace gamut {

/// A file could not be written; what() is one line, "path: cannot be written; why".
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes nothing, but throws WriteError if a file could not be written at `path`, or not now: its folder is missing
/// or takes no files, or `path` is a folder.
void checkWritable(const std::string& path);

/// Calls `write` with a path in the folder of `path`, then renames what it wrote to `path`. If `write` throws, nothing
/// is left behind and an older file at `path` is untouched; so it is if the process is killed before the rename. Throws
/// WriteError.
void replaceFile(const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// As replaceFile, with the content at hand.
void replaceFileText(const std::string& path, const std::string& content);

}  // namespace gamut
