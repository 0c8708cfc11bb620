// What may end the process that does it is done in another one.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace gamut {

/// What `compute` gives in a child process that has little more memory than `memory` bytes beside what is in use, and
/// at most `seconds` of CPU time; none if that ended otherwise. Throws std::system_error if no process can be started.
/// Only for a process without other threads.
std::optional<std::string> resultApart(const std::function<std::string()>& compute, std::size_t memory,
                                       unsigned seconds);

}  // namespace gamut
