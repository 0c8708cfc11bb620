// Why a file that somebody names as input cannot be read, for people.
#pragma once

#include <string>

namespace gamut {

/// "does not exist", "is a directory", "is no regular file", "cannot be read (Permission denied)"; empty if it can be.
std::string whyUnreadable(const std::string& path);

}  // namespace gamut
