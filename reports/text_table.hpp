// Tables and sentences for terminals.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gamut {

/// Rows of as many cells each as lines, indented by two blanks, the last one ended. Columns are as wide as their widest
/// cell (in code points), the first `left` ones left-aligned, the others right-aligned.
std::string textTable(const std::vector<std::vector<std::string>>& rows, std::size_t left = 1);

/// A text in rows of so many columns (in code points), broken at blanks, indented by so many blanks, from the second
/// row on by two more; a word that is longer has a row of its own. 0 columns: one row.
std::vector<std::string> wrapped(const std::string& text, std::size_t indent, std::size_t columns);

}  // namespace gamut
