// Outputs at output times as polynomials in the uncertain quantities, each with its proved error: what distributions,
// sensitivities and samples are computed from, instead of integrating again.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <vector>

#include "analyses/flow/models.hpp"

namespace gamut {

/// The outputs on a part of the box: P(η) ± radius, ξ = centre + half·η.
struct SurrogatePart {
  FlowPart part;
  std::shared_ptr<const Monomials> monomials;  ///< in the surrogate's symbols
  std::vector<OutputModel> outputs;
};

struct Surrogate {
  /// Of the uncertain quantities: value = centre + half·ξ; what has no symbol may be anything that it may be.
  std::vector<FlowSymbol> quantities;
  int symbols = 0;                             ///< one a quantity, or none
  std::vector<std::size_t> rows;               ///< output times that it is of, rising
  std::vector<std::vector<SurrogatePart>> at;  ///< [rows]: parts that tile the box
};

/// Of the outputs numbered `from` … until-1 in the models; `components`: of the box, one a quantity. What depends on
/// other symbols counts as error. Of the rows of which there are models, until `cancelled`, if not null, is set.
Surrogate surrogateOf(const FlowModels& models, const std::vector<int>& components, std::size_t from, std::size_t until,
                      const std::atomic<bool>* cancelled = nullptr);

}  // namespace gamut
