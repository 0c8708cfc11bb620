// A table of a page, as HTML, that is built row by row; every cell is escaped. On narrow screens it scrolls by itself.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gamut {

class TableText {
 public:
  TableText(std::string_view caption, const std::vector<std::string>& heads);

  void row(std::string_view name, const std::vector<std::string>& cells);
  /// With a drawing, as it is, before the words of a cell; as many as cells.
  void row(std::string_view name, const std::vector<std::string>& cells, const std::vector<std::string>& drawings);
  std::string html() const { return html_ + "</tbody></table></div>\n"; }

 private:
  std::string html_;
};

/// What a table leaves out, below it; empty if that is nothing.
std::string hintOfRows(std::size_t all, std::size_t shown);

/// The numbers of a figure, inside the page for those who want to copy them: columns with headings and units, as JSON
/// that no reader sees.
class NumbersText {
 public:
  enum class Rounded { nearest, down, up };

  void words(const std::string& head, const std::vector<std::string>& texts);
  void column(const std::string& head, const std::string& unit, const std::vector<double>& numbers,
              Rounded rounded = Rounded::nearest, int digits = 8);
  std::string html() const;

 private:
  std::string columns_;
};

}  // namespace gamut
