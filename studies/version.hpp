// Which program this is, and with what it was built.
#pragma once

#include <map>
#include <string>

namespace gamut {

/// "0.1.0"
std::string version();

/// Name → version of the libraries that results depend on.
std::map<std::string, std::string> libraryVersions();

/// The machine's name.
std::string hostName();

/// Now, in UTC: "2024-02-29T12:00:00Z".
std::string dateTime();

}  // namespace gamut
