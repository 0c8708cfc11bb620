// What the file system says, in a few words.
#include "studies/readable.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

namespace gamut {

std::string whyUnreadable(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status)) return "is a directory";
  if (status.type() == std::filesystem::file_type::not_found) return "does not exist";
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return "is no regular file";
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::string("cannot be read (") + std::strerror(errno) + ")";
  ::close(file);
  return "";
}

}  // namespace gamut
