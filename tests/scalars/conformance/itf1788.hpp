// Reads the ITF1788 test vectors (.itl): every statement of a file, or an exception that names the place. Grammar:
//   testcase NAME { operation operand... = result[, result...] [signal NAME]; ... }   with comments as in C++.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scalars/interval.hpp"

namespace gamut::testing {

/// An operand or a result. Decorations ("_com") are dropped: Interval has none.
struct ItfValue {
  enum class Kind { interval, notAnInterval, number, truth, text, list, word };
  Kind kind = Kind::word;
  Interval interval;   ///< kind interval; endpoints to nearest, as the vectors' own generators read them
  double number = 0;   ///< kind number
  bool truth = false;  ///< kind truth
  std::string text;    ///< kind text (without quotes), word, and the source of the others
};

struct ItfRow {
  std::string operation, signal;
  std::vector<ItfValue> operands, results;
  std::string where;  ///< "file.itl:12: sqr [1.0,2.0] = [1.0,4.0]"

  /// NaI, the decorated result of an invalid construction, is among the operands or results.
  bool isAboutNaI() const;
};

/// All rows of a file. Throws std::runtime_error, naming file and line, at anything that is not of this grammar.
std::vector<ItfRow> readItf(const std::filesystem::path& file);

}  // namespace gamut::testing
