#include "studies/results/detail/apart.hpp"

#include <stdexcept>

#include "studies/child_process.hpp"

namespace gamut {

std::optional<std::string> resultApart(const std::function<std::string()>& compute, std::size_t memory,
                                       unsigned seconds) {
  ChildProcess child(compute, {memory, seconds});
  try {
    while (child.read(memory)) {
    }
  } catch (const std::length_error&) {
    return std::nullopt;
  }
  if (!child.isWhole()) return std::nullopt;
  return child.text();
}

}  // namespace gamut
