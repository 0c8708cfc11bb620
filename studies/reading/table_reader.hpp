// Tables in CSV files: a row of names, then rows of numbers over time.
#pragma once

#include <string>

#include "mechanics/description/time_table.hpp"

namespace gamut {

/// The column of this name over the first column, which is time in s. A name may be followed by its unit, `hip [deg]`;
/// otherwise numbers are in `unit`. Empty lines, and those that begin with #, are passed over. `path`:
/// what messages call the file. Throws StudyError, "path:line:column: …", for what is wrong in the text; UnknownName
/// for the column; std::invalid_argument, with a sentence, for a text that is no table.
TimeTable readTable(const std::string& text, const std::string& path, const std::string& column,
                    const std::string& unit);

/// Throws std::invalid_argument, with a sentence, for a file that cannot be read.
std::string textOfTable(const std::string& path);

}  // namespace gamut
