// Solutions that strike a place ever faster and come to rest there: infinitely many turns in a finite time, bounded
// together. docs/flow.md, section 7, "Rest".
#pragma once

#include <optional>
#include <vector>

#include "analyses/flow/step/jumps.hpp"
#include "analyses/flow/step/set.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {

/// From a set of which all solutions are about to come to rest to one in which they do. One a thread.
class Settling {
 public:
  explicit Settling(const FlowJumps& jumps)
      : jumps_(jumps), given_(jumps.given), results_(static_cast<std::size_t>(jumps.given.outputs())) {}

  /// How all solutions of the set come to rest at a pair's place.
  struct Found {
    std::size_t pair;
    bool isMixed = false;        ///< already now solutions may be on both sides, and on the way to either
    double seconds = 0;          ///< from now on, at most
    std::vector<double> share;   ///< of v - b, by which a state differs from what it would be at rest
    std::vector<double> beside;  ///< how far it may be from there
    std::vector<double> apart;   ///< how far each state may be from that of a motion at rest meanwhile
  };
  /// The pair that comes to rest first, within `longest` seconds; none if that is not proved of any. `held`: of each
  /// jump, as the set is.
  std::optional<Found> find(const FlowSet& set, const Monomials& monomials, const std::vector<char>& held,
                            double longest);
  /// The set as if they rested from now on, and what they are beside that.
  void rest(FlowSet& set, const Monomials& monomials, const std::vector<char>& held, const Found& found,
            double quantum) const;

 private:
  class Search;
  const std::vector<Interval>& rates(const Interval& time, const Box& box, const std::vector<Interval>& signs);

  const FlowJumps& jumps_;
  Evaluator<Interval> given_;
  Box parameters_;
  std::vector<Interval> results_;
};

}  // namespace gamut
