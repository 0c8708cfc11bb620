// What each analysis adds to the page: columns of the table of figures, layers of the plots. An
// analysis has its file here and its row in `analyses`.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "reports/drawing/plot.hpp"
#include "studies/results/verdict.hpp"

namespace gamut {

/// A column of the table of figures.
struct Column {
  std::string head;
  const Bounds* bounds = nullptr;  ///< of which the table shows one time; or
  std::vector<std::string> texts;  ///< one an output
};

/// Both give nothing where the analysis is absent.
struct Contribution {
  std::vector<Column> (*columns)(const Results& results, const Finding& finding);
  /// Adds what is there of one output.
  void (*draw)(const Results& results, std::size_t output, Plot& plot);
};

extern const Contribution guaranteed, possible, probable, compared, required;

/// Of which the page consists, from the back of the plots to the front.
inline const std::array analyses{&guaranteed, &possible, &probable, &compared, &required};

/// All layers of one output.
Plot plotOf(const Results& results, std::size_t output);

}  // namespace gamut
