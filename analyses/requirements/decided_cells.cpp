#include "analyses/requirements/decided_cells.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <queue>
#include <utility>

#include "analyses/work.hpp"

namespace gamut {
namespace {

/// The larger one first, of equal ones the older.
struct Waiting {
  int halvings;
  std::size_t number;
  std::shared_ptr<const Cell> cell;
  bool operator<(const Waiting& other) const {
    return halvings != other.halvings ? halvings > other.halvings : number > other.number;
  }
};

/// How often the box was halved: halves of sides are powers of two.
int halvingsOf(const FlowPart& part) {
  int halvings = 0;
  for (const double half : part.half) halvings -= std::ilogb(half);
  return halvings;
}

}  // namespace

std::vector<DecidedCell> decidedCells(const FlowModels& models, const CellQuestion& question,
                                      const std::vector<CellQuantity>& quantities, const RequirementOptions& options) {
  const std::uint64_t began = Work::counted();
  Cells cells(models, withBesides(models, question, quantities));
  std::vector<DecidedCell> found;
  std::priority_queue<Waiting> open;
  std::size_t number = 0;
  double bytes = 0;
  const auto put = [&](std::shared_ptr<const Cell> cell) {
    if (cell->verdict() != Cell::Verdict::open) {
      found.push_back({cell->part(), cell->verdict()});
      return;
    }
    bytes += cell->bytes();
    open.push({halvingsOf(cell->part()), number++, std::move(cell)});
  };
  put(cells.whole());
  while (!open.empty()) {
    const std::shared_ptr<const Cell> cell = open.top().cell;
    open.pop();
    bytes -= cell->bytes();
    const bool mayGoOn = !(options.cancelled != nullptr && *options.cancelled) && bytes < options.mostBytes &&
                         found.size() + open.size() + 2 <= options.mostCells &&
                         static_cast<double>(Work::counted() - began) < options.mostWork;
    std::vector<std::unique_ptr<Cell>> halves;
    if (mayGoOn) halves = cells.halves(*cell);
    if (halves.empty()) found.push_back({cell->part(), Cell::Verdict::open});
    for (std::unique_ptr<Cell>& half : halves) put(std::move(half));
  }
  return found;
}

}  // namespace gamut
