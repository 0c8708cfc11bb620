// Files that are whole or not there: written beside the target under another name, flushed, then renamed over it.
#pragma once

#include <functional>
#include <string>

namespace gamut {

/// Calls `write` with a path in the folder of `path`, then renames what it wrote to `path`. If `write` throws, nothing
/// is left behind and an older file at `path` is untouched; so it is if the process is killed before the rename. Throws
/// std::runtime_error "path: cannot be written; …", one line.
void replaceFile(const std::string& path, const std::function<void(const std::string& temporary)>& write);

/// As replaceFile, with the content at hand.
void replaceFileText(const std::string& path, const std::string& content);

}  // namespace gamut
