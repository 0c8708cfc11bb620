// Line by line; cells keep the column at which they begin.
#include "studies/reading/table_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "mechanics/description/names.hpp"
#include "studies/printable.hpp"
#include "studies/study.hpp"

namespace gamut {
namespace {

constexpr std::uintmax_t maxTableBytes = 10'000'000;
constexpr std::size_t maxRows = 100'000;  // of what is no course in time

struct Cell {
  std::string text;
  std::size_t column = 1;  // in bytes, from 1
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<Cell> cellsOf(const std::string& line) {
  std::vector<Cell> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::size_t text = std::min(line.find_first_not_of(" \t", begin), end);
    cells.push_back({trimmed(line.substr(begin, end - begin)), text + 1});
    begin = end + 1;
  }
  return cells;
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  throw std::invalid_argument(fmt::format("the table '{}' cannot be read: {}", printable(path), why));
}

class TableReader {
 public:
  TableReader(const std::string& text, const std::string& path) : path_(path), text_(text) {}

  TableFiles::Columns columns(const std::vector<WantedColumn>& wanted) {
    if (!next()) refuse("it is empty");
    checkSeparators();
    const std::size_t width = cells_.size();
    std::vector<std::size_t> places;
    std::vector<Amount> scales(wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      places.push_back(find(wanted[i].name, 0));
      scales[i] = scaleOf(cells_[places[i]], wanted[i].unit);
    }
    TableFiles::Columns table;
    std::vector<std::vector<Amount>>& found = table.values;
    found.resize(wanted.size());
    while (next()) {
      checkWidth(width);
      table.lines.push_back(line_);
      if (found[0].size() == maxRows) failForRows(maxRows);
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        Amount value = scales[i];
        value.value *= number(cells_[places[i]]);
        found[i].push_back(value);
      }
    }
    if (found[0].empty()) refuse("it has no row of numbers");
    return table;
  }

  std::vector<WantedColumn> named() {
    if (!next()) refuse("it is empty");
    checkSeparators();
    std::vector<WantedColumn> columns;
    for (const Cell& cell : cells_) {
      const std::size_t open = placeOfUnit(cell.text);
      const bool hasUnit = open != std::string::npos;
      columns.push_back({nameIn(cell.text), hasUnit ? cell.text.substr(open + 1, cell.text.size() - open - 2) : ""});
      scaleOf(cell, columns.back().unit.empty() ? "1" : columns.back().unit);
    }
    return columns;
  }

  TimeTable read(const std::string& column, const std::string& unit) {
    if (!next()) refuse("it is empty");
    checkSeparators();
    const std::size_t width = cells_.size(), wanted = find(column, 1);
    const Amount time = scaleOf(cells_[0], "s"), scale = scaleOf(cells_[wanted], unit);
    TimeTable table{path_, column, {}, {}, scale.piPower};
    while (next()) {
      checkWidth(width);
      const mpq_class at = number(cells_[0]) * time.value;
      if (!table.times.empty() && at <= table.times.back())
        fail(cells_[0], fmt::format("the time {} does not follow the one before", printable(cells_[0].text)),
             "times that rise");
      if (table.times.size() == maxTableRows) failForRows(maxTableRows);
      table.times.push_back(at);
      table.values.emplace_back(number(cells_[wanted]) * scale.value);
    }
    if (table.times.size() < 2) refuse("it has fewer than two rows of numbers");
    return table;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { gamut::refuse(path_, why); }
  [[noreturn]] void fail(const Cell& cell, const std::string& what, const std::string& expected) const {
    throw StudyError(fmt::format("{}:{}:{}", path_, line_, cell.column), what, expected);
  }

  /// Spreadsheets write semicolons where the decimal sign is a comma.
  void checkSeparators() const {
    for (const char* other : {";", "\t"})
      if (cells_.size() == 1 && cells_[0].text.find(other) != std::string::npos)
        fail(cells_[0], fmt::format("the cells are separated by {}", *other == ';' ? "semicolons" : "tabulators"),
             fmt::format("commas between the cells, and a {}", decimalPoint));
  }

  void checkWidth(std::size_t width) const {
    if (cells_.size() != width)
      fail(cells_.back(), fmt::format("the row has {} cells", cells_.size()),
           fmt::format("{} as in the first row{}{}", width, cells_.size() > width ? ", and a " : "",
                       cells_.size() > width ? decimalPoint : ""));
  }
  [[noreturn]] void failForRows(std::size_t most) const {
    fail(cells_[0], fmt::format("the table has more than {} rows", most), "fewer rows");
  }

  /// The next row that says something.
  bool next() {
    for (std::string text; std::getline(text_, text);) {
      ++line_;
      if (line_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
      if (const std::string content = trimmed(text); content.empty() || content.front() == '#') continue;
      cells_ = cellsOf(text);
      return true;
    }
    return false;
  }

  /// Where the unit of a heading begins, "[mm]", or "(mm)" behind a blank where that is a unit; npos without one.
  static std::size_t placeOfUnit(const std::string& heading) {
    if (heading.ends_with(']')) return heading.find('[');
    const std::size_t open = heading.find(" (");
    if (open == std::string::npos || !heading.ends_with(')')) return std::string::npos;
    try {
      const Amount one = parseAmount("1 " + heading.substr(open + 2, heading.size() - open - 3));
      return one.hasUnit || one.isRelative ? open + 1 : std::string::npos;
    } catch (const UnitError&) {
      return std::string::npos;
    }
  }

  static std::string nameIn(const std::string& heading) {
    return trimmed(heading.substr(0, std::min(heading.find('['), placeOfUnit(heading))));
  }

  /// One of the unit of a cell of the first row.
  Amount scaleOf(const Cell& cell, const std::string& unit) const {
    const std::size_t open = placeOfUnit(cell.text);
    const bool hasUnit = open != std::string::npos;
    const std::string stated = hasUnit ? cell.text.substr(open + 1, cell.text.size() - open - 2) : unit;
    Amount one;
    try {
      one = parseAmount(stated == "1" ? stated : "1 " + stated);
    } catch (const UnitError&) {
      fail(cell, fmt::format("'{}' is no unit", printable(stated)), "a unit such as " + unit);
    }
    if (!(one.dimension == dimensionOf(unit)))
      fail(cell, fmt::format("the column is in {}", printable(stated)),
           unit == "1" ? "a column without a unit" : "a column in " + unit);
    return one;
  }

  /// Among the columns from `first` on.
  std::size_t find(const std::string& column, std::size_t first) const {
    std::vector<std::string> names;
    std::optional<std::size_t> found;
    for (std::size_t i = first; i < cells_.size(); ++i) {
      const std::string& heading = cells_[i].text;
      names.push_back(nameIn(heading));
      if (names.back() != column && heading != column) continue;
      if (found)
        fail(cells_[i], fmt::format("a second column is named '{}'", printable(column)), "columns of different names");
      found = i;
    }
    if (found) return *found;
    for (const Cell& cell : cells_)
      if (!cell.text.empty() && (cell.text.front() == '"' || cell.text.front() == '\''))
        fail(cell, fmt::format("the name {} is in quotation marks", printable(cell.text)), "names without them");
    const bool hasOther = std::ranges::any_of(names, [&](const auto& name) { return name.starts_with(column + " ("); });
    throw UnknownName("column", column, names,
                      "in " + path_ + (hasOther ? ", whose headings name units as in \"length [mm]\"" : ""));
  }

  mpq_class number(const Cell& cell) const {
    try {
      const Amount amount = parseAmount(cell.text);
      if (!amount.hasUnit && amount.piPower == 0 && !amount.isRelative) return amount.value;
    } catch (const UnitError&) {
    }
    const bool isSeparated = cell.text.find(';') != std::string::npos;
    fail(cell, fmt::format("'{}' is no number", printable(cell.text)),
         isSeparated ? fmt::format("commas between the cells, and a {}", decimalPoint)
                     : "a decimal such as -1.5 or 2e-3");
  }

  static constexpr const char* decimalPoint = "decimal point, not a comma, in numbers";

  std::string path_;
  std::istringstream text_;
  std::size_t line_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace

std::string textOfTable(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) refuse(path, error.message());
  if (size > maxTableBytes) refuse(path, fmt::format("it has {} bytes; the most are {}", size, maxTableBytes));
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "it cannot be opened");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<WantedColumn> columnsOf(const std::string& text, const std::string& path) {
  return TableReader(text, path).named();
}

TableFiles::Columns readColumns(const std::string& text, const std::string& path,
                                const std::vector<WantedColumn>& wanted) {
  return TableReader(text, path).columns(wanted);
}

TimeTable readTable(const std::string& text, const std::string& path, const std::string& column,
                    const std::string& unit) {
  return TableReader(text, path).read(column, unit);
}

std::string TableFiles::pathOf(const std::string& name) const {
  return atHand_ ? name + " in " + source_.name() : (source_.folder() / name).string();
}

const std::string& TableFiles::textOf(const std::string& name) const {
  if (atHand_ && !atHand_->tables.contains(name)) throw std::invalid_argument("there is no table " + printable(name));
  std::string& text = texts_[name];
  if (text.empty()) text = atHand_ ? atHand_->tables.at(name) : textOfTable(pathOf(name));
  return text;
}

void TableFiles::fail(const toml::node& node, std::size_t line, const std::string& problem,
                      const std::string& expected) const {
  const std::string path = pathOf(node.value_or(std::string()));
  throw StudyError(fmt::format("{}:{}:1", path, line), problem, expected);
}

TableFiles::Columns TableFiles::columns(const toml::node& node, const std::string& what,
                                        const std::vector<WantedColumn>& wanted) const {
  const std::string name = source_.asText(node, what);
  try {
    return TableReader(textOf(name), pathOf(name)).columns(wanted);
  } catch (const UnknownName& error) {
    source_.fail(node, error.problem(), error.expected());
  } catch (const std::invalid_argument& error) {
    source_.failWith(node, error.what(), "a CSV file with a row of names");
  }
}

}  // namespace gamut
