// POSIX: rename() replaces in one step when both names lie in one folder; fsync() before it keeps the order on disk.
#include "studies/atomic_file.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace gamut {
namespace {

namespace fs = std::filesystem;

fs::path folderOf(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw WriteError(path + ": cannot be written; " + why);
}

void flushToDisk(const std::string& written, const std::string& path) {
  const int file = ::open(written.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, std::strerror(errno));
  const int status = ::fsync(file);
  const int error = errno;
  ::close(file);
  // Some file systems cannot flush (EINVAL): the rename is still in order there.
  if (status != 0 && error != EINVAL) fail(path, std::strerror(error));
}

}  // namespace

void checkWritable(const std::string& path) {
  std::error_code error;
  const fs::path folder = folderOf(path);
  if (!fs::is_directory(folder, error)) fail(path, "the folder " + folder.string() + " does not exist");
  if (fs::is_directory(path, error)) fail(path, "it is a folder");
  // Permissions do not tell all (a read-only or virtual file system, a superuser): only trying does.
  std::string trial = (folder / ".gamut-XXXXXX").string();
  const int file = ::mkstemp(trial.data());
  if (file < 0) fail(path, "the folder " + folder.string() + " takes no files: " + std::strerror(errno));
  ::close(file);
  ::unlink(trial.c_str());
}

void replaceFile(const std::string& path, const std::function<void(const std::string&)>& write) {
  const fs::path target(path);
  const fs::path folder = folderOf(path);
  if (!fs::is_directory(folder)) fail(path, "the folder " + folder.string() + " does not exist");
  if (fs::is_directory(target)) fail(path, "it is a folder");
  const std::string temporary =
      (folder / ("." + target.filename().string() + "." + std::to_string(::getpid()) + ".part")).string();
  try {
    write(temporary);
    flushToDisk(temporary, path);
    std::error_code error;
    fs::rename(temporary, target, error);
    if (error) fail(path, error.message());
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
}

void replaceFileText(const std::string& path, const std::string& content) {
  replaceFile(path, [&](const std::string& temporary) {
    std::ofstream file(temporary, std::ios::binary);
    file << content;
    file.close();
    if (!file) fail(path, "writing failed (is the disk full, or the folder read-only?)");
  });
}

}  // namespace gamut
