// The distributions of independent quantities, cut into bins that every part of the box is made of.
#pragma once

#include <utility>
#include <vector>

#include "analyses/surrogate/surrogate.hpp"
#include "analyses/uncertainty.hpp"
#include "scalars/interval.hpp"

namespace gamut {

/// Probabilities of bins; Σ|error| is at most `error`.
struct BinMasses {
  std::vector<double> mass;
  double error = 0;
};
/// F at the edges between bins, enclosed: it rises, from 0 at the first (a value there counts in the first bin) to 1.
/// Holds until this thread asks for another's.
const std::vector<Interval>& edgesOf(const FlowSymbol& symbol, const Distribution& distribution);
/// Of one distribution, by the middles of what is known at edges.
BinMasses massesBetween(const std::vector<Interval>& edges);
/// |∫ (ξ - middle) dF| over each of its bins, at most, in halves of a bin's width, as the masses tell: what these are
/// off by in all, this is off by no more than twice in all.
std::vector<double> leansOf(const FlowSymbol& symbol, const Distribution& distribution,
                            const std::vector<double>& mass);

class QuantityMasses {
 public:
  static constexpr int bins = 4096;  ///< of [-1,1] in a symbol, a power of two

  /// Whether bins make up the part.
  static bool hold(const FlowPart& part);
  /// The bins of a symbol that make up a part that they hold: the first, and how many.
  static std::pair<long, long> of(const FlowPart& part, int symbol);

  /// One a quantity of the surrogate.
  QuantityMasses(const Surrogate& surrogate, const std::vector<const Uncertain*>& uncertain);

  /// The probabilities of a symbol's bins; Σ|error| is at most `error`.
  const std::vector<double>& mass(int symbol) const { return symbols_[symbol].mass; }
  double error(int symbol) const { return symbols_[symbol].error; }

  /// ∫ η^n ζ^m dF over the values of a symbol that lie in both parts, of which η and ζ, in [-1,1], are the own ones.
  Interval moment(int symbol, const FlowPart& eta, int n, const FlowPart& zeta, int m) const;

 private:
  struct Symbol {
    std::vector<double> mass;
    double error = 0;
    std::vector<double> lean;  // |∫ (ξ - middle) dF| over a bin, at most
  };
  std::vector<Symbol> symbols_;
};

}  // namespace gamut
