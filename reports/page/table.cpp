// Cells are escaped one by one.
#include "reports/page/table.hpp"

#include <fmt/format.h>

#include "reports/words.hpp"

namespace gamut {

TableText::TableText(std::string_view caption, const std::vector<std::string>& heads)
    : html_("<div class=\"table\"><table>\n") {
  html_ += fmt::format("<caption>{}</caption>\n<thead><tr>", escapeHtml(caption));
  for (const std::string& head : heads) html_ += fmt::format("<th scope=\"col\">{}</th>", escapeHtml(head));
  html_ += "</tr></thead>\n<tbody>\n";
}

void TableText::row(std::string_view name, const std::vector<std::string>& cells) {
  html_ += fmt::format("<tr><th scope=\"row\">{}</th>", escapeHtml(name));
  for (const std::string& cell : cells) html_ += fmt::format("<td>{}</td>", escapeHtml(cell));
  html_ += "</tr>\n";
}

std::string withUnit(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? name : name + " (" + unit + ")";
}

}  // namespace gamut
