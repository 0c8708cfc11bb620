// Which program this is, and with what it was built.
#pragma once

#include <string>
#include <vector>

#include "studies/results/origin.hpp"

namespace gamut {

/// "0.1.0"
std::string version();

/// The libraries that results depend on.
std::vector<LibraryInfo> libraryVersions();

/// The machine's name.
std::string hostName();

/// Now, in UTC: "2024-02-29T12:00:00Z".
std::string dateTime();

}  // namespace gamut
