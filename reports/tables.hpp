// Results as tables, for spreadsheets and programs that read CSV: of all that results say of themselves.
//
// Single numbers and texts are rows of one table. Of lists each is a table, with a row a record. Of numbers that have
// dimensions those are one table that have the same: a row for each combination of places, such as a time, and a column
// for each output and uncertain quantity, with its unit.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

struct ResultTable {
  std::string name;     ///< "interval.time": the group of the results file, and what the rows are
  std::string meaning;  ///< of the group
  std::size_t rows = 0, columns = 0;
  /// As CSV (RFC 4180), with a line of headings. What is not there is empty.
  std::function<std::string()> csv;
};

/// Tables refer to the results, which must outlive them.
std::vector<ResultTable> tablesOf(const Results& results);

enum class RoundedTo { nearest, below, above };
/// Decimals that give the same double back: the shortest, or the shortest of 17 and more digits that lie not above it,
/// or not below it, so that they still bound what it bounds. "inf", "-inf"; of NaN nothing.
std::string exactDecimal(double number, RoundedTo side = RoundedTo::nearest);

}  // namespace gamut
