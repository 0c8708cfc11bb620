// Tables for terminals.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gamut {

/// Rows of as many cells each as lines, indented by two blanks, the last one ended. Columns are as wide as their widest
/// cell (in code points), the first `left` ones left-aligned, the others right-aligned.
std::string textTable(const std::vector<std::vector<std::string>>& rows, std::size_t left = 1);

}  // namespace gamut
