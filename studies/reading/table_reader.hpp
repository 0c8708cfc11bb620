// Tables in CSV files: a row of names, then rows of numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/description/time_table.hpp"
#include "mechanics/description/units.hpp"
#include "studies/reading/toml_source.hpp"
#include "studies/study.hpp"

namespace gamut {

/// The column of this name over the first column, which is time in s. A name may be followed by its unit, `hip [deg]`;
/// otherwise numbers are in `unit`. Empty lines, and those that begin with #, are passed over. `path`:
/// what messages call the file. Throws StudyError, "path:line:column: …", for what is wrong in the text; UnknownName
/// for the column; std::invalid_argument, with a sentence, for a text that is no table.
TimeTable readTable(const std::string& text, const std::string& path, const std::string& column,
                    const std::string& unit);

/// A column that is looked for.
struct WantedColumn {
  std::string name, unit;
};

/// The CSV files that a study names: where they lie, or at hand.
class TableFiles {
 public:
  /// Of what is read the words are put into `texts`. All of them must outlive this.
  TableFiles(const TomlSource& source, NamedTexts& texts, const std::optional<FilesAtHand>& atHand)
      : source_(source), texts_(texts), atHand_(atHand) {}

  /// What messages call the file.
  std::string pathOf(const std::string& name) const;
  /// Throws std::invalid_argument, with a sentence, for a file that cannot be read.
  const std::string& textOf(const std::string& name) const;
  struct Columns {
    std::vector<std::vector<Amount>> values;  ///< [column][row]
    std::vector<std::size_t> lines;           ///< of the rows in the file, from 1
  };
  /// These columns, row by row, of the file that is named at a node, which messages call `what`. Throws StudyError.
  Columns columns(const toml::node& node, const std::string& what, const std::vector<WantedColumn>& wanted) const;
  /// Throws the StudyError that says what is wrong in a line of the file that is named at a node.
  [[noreturn]] void fail(const toml::node& node, std::size_t line, const std::string& problem,
                         const std::string& expected) const;

 private:
  const TomlSource& source_;
  NamedTexts& texts_;
  const std::optional<FilesAtHand>& atHand_;
};

/// All columns that the first row names, with the unit that stands behind each; empty without one. `path`: what
/// messages call the file. Throws as readTable does.
std::vector<WantedColumn> columnsOf(const std::string& text, const std::string& path);

/// These columns, row by row. Throws as readTable does.
TableFiles::Columns readColumns(const std::string& text, const std::string& path,
                                const std::vector<WantedColumn>& wanted);

/// The text of a file that holds a table. Throws std::invalid_argument, with a sentence.
std::string textOfTable(const std::string& path);

}  // namespace gamut
