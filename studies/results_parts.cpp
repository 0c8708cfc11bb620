// Grids are times x outputs; stacks of grids have a dimension more in front.
#include "studies/detail/results_parts.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gamut {

std::string jointUnit(const std::vector<std::string>& units) {
  const bool isOne = std::adjacent_find(units.begin(), units.end(), std::not_equal_to<>()) == units.end();
  std::string joint;
  for (std::size_t i = 0; i < (isOne ? std::min<std::size_t>(units.size(), 1) : units.size()); ++i)
    joint += (i == 0 ? "" : ", ") + units[i];
  return joint;
}

void writeScale(Hdf5Writer& group, const std::string& name, const std::vector<double>& values,
                const std::string& longName, const std::string& unit) {
  group.numbers(name, values.data(), {values.size()}, longName, unit);
  group.makeScale(name, name);
}

// ---- Writing --------------------------------------------------------------------------------------------------------

GridWriter::GridWriter(Hdf5Writer& group, const Results& results)
    : group_(&group),
      results_(&results),
      unit_(jointUnit(column<std::string, OutputInfo>(results.outputs, [](const OutputInfo& o) { return o.unit; }))) {}

void GridWriter::grid(const std::string& name, const Grid& grid, const std::string& longName) {
  this->grid(name, grid, longName, unit_);
}

void GridWriter::ratio(const std::string& name, const Grid& grid, const std::string& longName) {
  this->grid(name, grid, longName, "1");
}

void GridWriter::bounds(const std::string& name, const Bounds& bounds, const std::string& longName) {
  grid(name + "_lower", bounds.lower, longName + ", lower bound");
  grid(name + "_upper", bounds.upper, longName + ", upper bound");
}

void GridWriter::stack(const std::string& name, const std::vector<const Grid*>& grids, const std::string& scale,
                       const std::string& longName) {
  if (grids.empty()) return;
  const Grid& first = *grids.front();
  std::vector<double> values;
  values.reserve(grids.size() * first.data.size());
  for (const Grid* grid : grids) {
    if (grid->times != first.times || grid->outputs != first.outputs)
      throw std::logic_error(name + ": grids differ in shape");
    values.insert(values.end(), grid->data.begin(), grid->data.end());
  }
  group_->numbers(name, values.data(), {grids.size(), first.times, first.outputs}, longName, unit_);
  group_->attachScales(name, {scale, "/time", "/output"});
}

void GridWriter::stack(const std::string& name, const std::vector<Bounds>& bounds, const std::string& scale,
                       const std::string& longName) {
  std::vector<const Grid*> lower, upper;
  for (const Bounds& b : bounds) {
    lower.push_back(&b.lower);
    upper.push_back(&b.upper);
  }
  stack(name + "_lower", lower, scale, longName + ", lower bound");
  stack(name + "_upper", upper, scale, longName + ", upper bound");
}

void GridWriter::grid(const std::string& name, const Grid& grid, const std::string& longName, const std::string& unit) {
  if (grid.empty()) return;
  if (grid.times != results_->time.size() || grid.outputs != results_->outputs.size())
    throw std::logic_error(name + ": the grid's shape is not times x outputs");
  group_->numbers(name, grid.data.data(), {grid.times, grid.outputs}, longName, unit);
  group_->attachScales(name, {"/time", "/output"});
}

// ---- Reading --------------------------------------------------------------------------------------------------------

Grid GridReader::grid(const std::string& name) const {
  if (!group_->has(name)) return {};
  Hdf5Shape shape;
  Grid grid(times_, outputs_);
  grid.data = group_->numbers(name, shape);
  if (shape != Hdf5Shape{times_, outputs_}) throw Hdf5Error(name);
  return grid;
}

void requireBounds(double lower, double upper, const std::string& name) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (lower > upper || lower == infinity || upper == -infinity) throw Hdf5Error(name);
}

namespace {

Bounds boundsOf(Grid lower, Grid upper, const std::string& name) {
  if (lower.empty() != upper.empty()) throw Hdf5Error(name);
  for (std::size_t i = 0; i < lower.data.size(); ++i) requireBounds(lower.data[i], upper.data[i], name);
  Bounds bounds;
  bounds.lower = std::move(lower);
  bounds.upper = std::move(upper);
  return bounds;
}

}  // namespace

Bounds GridReader::bounds(const std::string& name) const {
  Grid lower = grid(name + "_lower"), upper = grid(name + "_upper");
  return boundsOf(std::move(lower), std::move(upper), name);
}

std::vector<Grid> GridReader::stack(const std::string& name, std::size_t levels) const {
  if (!group_->has(name)) return {};
  Hdf5Shape shape;
  const std::vector<double> values = group_->numbers(name, shape);
  if (shape != Hdf5Shape{levels, times_, outputs_}) throw Hdf5Error(name);
  std::vector<Grid> grids(levels, Grid(times_, outputs_));
  const auto size = static_cast<std::ptrdiff_t>(times_ * outputs_);
  for (std::size_t i = 0; i < levels; ++i) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(i) * size;
    grids[i].data.assign(begin, begin + size);
  }
  return grids;
}

std::vector<Bounds> GridReader::boundsStack(const std::string& name, std::size_t levels) const {
  std::vector<Grid> lower = stack(name + "_lower", levels), upper = stack(name + "_upper", levels);
  if (lower.size() != upper.size()) throw Hdf5Error(name);
  std::vector<Bounds> result;
  for (std::size_t i = 0; i < lower.size(); ++i)
    result.push_back(boundsOf(std::move(lower[i]), std::move(upper[i]), name));
  return result;
}

std::vector<double> readList(const Hdf5Reader& group, const std::string& name, std::size_t size) {
  Hdf5Shape shape;
  std::vector<double> values = group.numbers(name, shape);
  if (shape.size() != 1 || (size != std::string::npos && shape[0] != size)) throw Hdf5Error(name);
  return values;
}

std::vector<std::string> readTexts(const Hdf5Reader& group, const std::string& name, std::size_t size) {
  std::vector<std::string> values = group.texts(name);
  if (values.size() != size) throw Hdf5Error(name);
  return values;
}

std::vector<std::int64_t> readIntegers(const Hdf5Reader& group, const std::string& name, std::size_t size) {
  std::vector<std::int64_t> values = group.integers(name);
  if (values.size() != size) throw Hdf5Error(name);
  return values;
}

}  // namespace gamut
