// How the mechanism moves in its modes: a column each.
#include <string>
#include <vector>

#include "reports/page/page.hpp"
#include "reports/page/table.hpp"
#include "studies/analyses/modes.hpp"

namespace gamut {

std::string modesSection(const Report& report) {
  const ModesResult& modes = report.results.of<ModesResult>();
  if (!modes.present || modes.number.empty()) return {};
  std::vector<std::string> heads{"coordinate"};
  for (std::size_t k = 0; k < modes.number.size(); ++k) heads.push_back(modes.nameOf(k));
  TableText table("Shapes of modes", heads);
  const std::vector<std::string> names = modes.names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::vector<std::string> cells;
    for (std::size_t k = 0; k < modes.number.size(); ++k) cells.push_back(modes.boundsOf(k, i));
    table.row(names[i], cells);
  }
  return table.html() +
         "<p class=\"hint\">Proved for all values of the uncertain quantities. Each shape is 1 at the coordinate that "
         "takes most energy in it; all others in rad or m by its rad or m.</p>\n";
}

}  // namespace gamut
