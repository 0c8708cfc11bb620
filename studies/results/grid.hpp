// Numbers with several dimensions.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gamut {

/// How many places each of several dimensions has.
using GridShape = std::vector<std::size_t>;

/// A number for every combination of places in its dimensions, the last of which runs fastest; NaN where there is none.
struct Grid {
  GridShape extents;
  std::vector<double> data;

  Grid() = default;
  explicit Grid(GridShape shape) : extents(std::move(shape)) {
    data.assign(count(0), std::numeric_limits<double>::quiet_NaN());
  }
  Grid(GridShape shape, std::vector<double> numbers) : extents(std::move(shape)), data(std::move(numbers)) {}

  bool empty() const { return data.empty(); }

  /// Of places, one a dimension; std::out_of_range where there are none such.
  template <class... Places>
  double& operator()(Places... places) {
    return data[begin({static_cast<std::size_t>(places)...}, extents.size())];
  }
  template <class... Places>
  double operator()(Places... places) const {
    return data[begin({static_cast<std::size_t>(places)...}, extents.size())];
  }
  /// All of these places in the first dimensions.
  template <class... Places>
  std::span<double> row(Places... places) {
    return std::span(data).subspan(begin({static_cast<std::size_t>(places)...}, sizeof...(places)),
                                   count(sizeof...(places)));
  }
  template <class... Places>
  std::span<const double> row(Places... places) const {
    return std::span(data).subspan(begin({static_cast<std::size_t>(places)...}, sizeof...(places)),
                                   count(sizeof...(places)));
  }

 private:
  /// So many numbers there are of one place in the first dimensions.
  std::size_t count(std::size_t first) const {
    std::size_t product = 1;
    for (std::size_t d = first; d < extents.size(); ++d) product *= extents[d];
    return product;
  }
  std::size_t begin(std::initializer_list<std::size_t> places, std::size_t dimensions) const {
    std::size_t index = 0, d = 0;
    for (const std::size_t place : places) {
      if (d == extents.size() || place >= extents[d]) throw std::out_of_range("a grid has no such place");
      index = index * extents[d++] + place;
    }
    if (d != dimensions) throw std::out_of_range("a grid has other dimensions");
    return index * count(d);
  }
};

/// Lower and upper bounds.
struct BoundGrids {
  Grid lower, upper;

  BoundGrids() = default;
  explicit BoundGrids(const GridShape& shape) : lower(shape), upper(shape) {}
};

}  // namespace gamut
