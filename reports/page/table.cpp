// Cells are escaped one by one.
#include "reports/page/table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "reports/words.hpp"

namespace gamut {

TableText::TableText(std::string_view caption, const std::vector<std::string>& heads)
    : html_(fmt::format("<div class=\"table\" tabindex=\"0\" role=\"group\" aria-label=\"{0}\"><table>\n"
                        "<caption>{0}</caption>\n<thead><tr>",
                        escapeHtml(caption))) {
  for (const std::string& head : heads) html_ += fmt::format("<th scope=\"col\">{}</th>", escapeHtml(head));
  html_ += "</tr></thead>\n<tbody>\n";
}

void TableText::row(std::string_view name, const std::vector<std::string>& cells) {
  row(name, cells, std::vector<std::string>(cells.size()));
}

void TableText::row(std::string_view name, const std::vector<std::string>& cells,
                    const std::vector<std::string>& drawings) {
  html_ += fmt::format("<tr><th scope=\"row\">{}</th>", escapeHtml(name));
  for (std::size_t i = 0; i < cells.size(); ++i)
    html_ += fmt::format("<td>{}{}</td>", drawings[i], escapeHtml(cells[i]));
  html_ += "</tr>\n";
}

void NumbersText::words(const std::string& head, const std::vector<std::string>& texts) {
  columns_ += (columns_.empty() ? "[" : ",[") + jsonText(head);
  for (const std::string& text : texts) columns_ += "," + jsonText(text);
  columns_ += "]";
}

void NumbersText::column(const std::string& head, const std::string& unit, const std::vector<double>& numbers,
                         Rounded rounded, int digits) {
  columns_ += (columns_.empty() ? "[" : ",[") + jsonText(headingOf(head, unit));
  for (const double x : numbers) {
    const auto text = [&] {
      if (rounded == Rounded::nearest) return numberText(x, digits);
      const auto [below, above] = outwardText(x, x, digits);
      return rounded == Rounded::down ? below : above;
    };
    const std::string number = std::isfinite(x) ? text() : "null";
    columns_ += "," + (std::isinf(std::strtod(number.c_str(), nullptr)) ? "null" : number);  // rounded beyond all
  }
  columns_ += "]";
}

std::string NumbersText::html() const {
  return "<script type=\"application/json\" class=\"numbers\">[" + columns_ + "]</script>";
}

std::string hintOfRows(std::size_t all, std::size_t shown) {
  return all <= shown ? "" : fmt::format("<p class=\"hint\">And {} more; the results hold them.</p>\n", all - shown);
}

}  // namespace gamut
