// The joint distribution of the quantities, or what is known of it, cut into bins that every part of the box is made
// of: groups of quantities, each group with focal elements (bins of its symbols, and the probability that the values
// are in these). Of a known distribution these are single bins; of p-boxes and evidence they overlap; those of a copula
// are boxes of several symbols. Groups are independent, or nothing is known of how they depend on each other.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "analyses/dependence.hpp"
#include "analyses/flow/models.hpp"
#include "analyses/probability/convolution.hpp"
#include "analyses/probability/copula_masses.hpp"
#include "analyses/uncertainty.hpp"

namespace gamut {

/// What is known of the distribution of all quantities together.
class JointMasses {
 public:
  /// A part of the joint distribution: which elements, and the bins in which they lie.
  struct Part {
    std::vector<long> first, count;  ///< [symbol]
    /// [group] elements; null: all that lie there.
    std::vector<std::shared_ptr<const std::vector<std::uint32_t>>> elements;
    std::vector<std::shared_ptr<const std::vector<CopulaMasses::Box>>> boxes;  ///< [group] likewise, of a copula
  };

  /// `quantities` tells the symbols of the uncertain ones, one by one; others are symbols of which nothing is known.
  JointMasses(int symbols, const std::vector<FlowSymbol>& quantities, const std::vector<const Uncertain*>& uncertain,
              const QuantityDependence& dependence = {});

  int symbols() const { return symbols_; }
  /// Whether all are independent, and every distribution is one: bounds can come as near to each other as is wanted.
  bool isPlain() const { return isPlain_; }

  Part whole() const;
  static FlowPart boxOf(const Part& part);
  /// Which together are the part: on either side of an edge between bins, and what lies on both sides. The part alone
  /// where it cannot be cut so.
  std::vector<Part> cut(const Part& part, int symbol, long edge) const;
  /// Of elements on either side of the middle, and of those that are wide; or the part alone.
  std::vector<Part> halves(const Part& part, int symbol) const;

  double massOf(const Part& part) const;
  /// About how many bins or elements a quantity has.
  std::size_t elements() const;
  /// How many boxes of copulas it has.
  static std::size_t boxesIn(const Part& part) {
    std::size_t count = 0;
    for (const auto& boxes : part.boxes) count += boxes ? boxes->size() : 0;
    return count;
  }
  /// Of all masses of a part, Σ|error| is at most that.
  double error() const { return error_; }
  /// By so much is a sum of probabilities of parts off by its roundings.
  double roundings() const;

  /// Which copula tells of the symbol; -1: none.
  int copulaOf(int symbol) const;

  /// Of Σ f_l(η_l) + terms + rest, as multiples of a step, `error()` included in its error: `f` [symbol][power], powers
  /// above 0, of the part's own η; every term of symbols of one copula alone. Of independent symbols all
  /// but two are replaced by numbers that are neither below nor above them (swapped.hpp), if that brings both sides
  /// closer and is allowed: it says nothing of probabilities as small as what it shifts them by.
  GridSum sumOf(const Part& part, const std::vector<std::vector<double>>& f, const std::vector<MixedTerm>& terms,
                Interval rest, double step, bool maySwap = true) const;
  /// By how many steps both sides will be apart.
  double stepsApart(const std::vector<std::vector<double>>& f) const;

 private:
  struct Group {
    std::vector<int> symbols;
    std::vector<double> mass;                // of the bins, or of elements
    std::vector<std::uint16_t> from, until;  // [element]: of bins; none: elements are the bins
    std::optional<CopulaMasses> copula{};    // instead
    // Of bins: Σ|error| of their masses, how far ξ leans from their middles (leansOf), and the density of ξ.
    double error = 0;
    std::vector<double> lean{};
    Distribution::DensityBound density{};
  };
  void addBox(Group& group, const std::vector<Interval>& below);
  void addEvidence(Group& group, const FlowSymbol& symbol, const Distribution& distribution);
  const Group& groupOf(int symbol) const;
  static bool isOfBins(const Group& group) { return group.from.empty() && !group.copula; }
  bool isAlone(int symbol) const;
  template <class Side>
  std::vector<Part> apart(const Part& part, int symbol, double least, const Side& sideOf) const;
  Part with(const Part& part, std::size_t group, std::vector<std::uint32_t> elements) const;
  Part with(const Part& part, std::size_t group, std::vector<CopulaMasses::Box> boxes) const;
  template <class Take>
  void forEach(const Part& part, std::size_t group, const Take& take) const;
  std::vector<CopulaMasses::Box> boxesOf(const Part& part, std::size_t group) const;
  double massOf(const Part& part, std::size_t group) const;
  class Sides;
  GridBounds boundsOfBins(const Part& part, std::size_t group, const std::vector<std::vector<double>>& f,
                          const Interval& rest, double step, long finer) const;
  GridSum boundsOf(const Part& part, std::size_t group, const std::vector<std::vector<double>>& f,
                   const std::vector<MixedTerm>& terms, const Interval& rest, double step) const;

  void swap(const Part& part, const std::vector<std::vector<double>>& f, Interval& rest, double step,
            std::vector<const std::vector<std::size_t>*>& varying, std::vector<GridBounds>& kept,
            std::vector<GridMasses>& swapped, double& shift) const;

  int symbols_;
  std::vector<Group> groups_;
  std::vector<int> groupOf_;                      // [symbol]; -1: none
  std::vector<std::vector<std::size_t>> blocks_;  // of groups of which nothing is known together; mostly of one
  double error_ = 0;
  bool isPlain_ = true;
};

}  // namespace gamut
