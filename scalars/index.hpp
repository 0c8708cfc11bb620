// Programs count nodes, states and monomials by int, since a node may be missing (-1); containers count by std::size_t,
// which an index that is not negative becomes by itself. Where sizes are multiplied or compared they are made so.
#pragma once

#include <cstddef>

namespace gamut::detail {

/// A number that is not negative, as the index of a container.
constexpr std::size_t at(int number) { return static_cast<std::size_t>(number); }

}  // namespace gamut::detail
