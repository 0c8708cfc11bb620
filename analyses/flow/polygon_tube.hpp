// Where the set of a motion under inputs has grown so large that its polynomials say little: the tube of its states'
// polygons, met with what else is known. docs/flow.md, section 6.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/polygons/polygon_blocks.hpp"
#include "analyses/flow/polygons/polygon_range.hpp"
#include "analyses/flow/task.hpp"

namespace gamut {

class PolygonTube {
 public:
  /// Whether that may be: f smooth and not linear in what is not known of it, inputs of any course, and states of which
  /// no more than two depend on each other.
  static bool suits(const FlowQuestion& question, const Box& box);

  /// What `tube` and the polygons prove, both of the whole question.
  static Tube tighten(const FlowQuestion& question, const Box& box, Tube tube);

 private:
  PolygonTube(const FlowQuestion& question, const Box& box, const Tube& known);
  void follow();
  bool goTo(double time);
  std::string widestState() const;
  void gather();
  void endRow(std::size_t row);
  void end(FlowCause cause, double time);
  Tube finish(std::size_t levels);
  static std::shared_ptr<const FlowModels> modelsBeyond(const FlowQuestion& question, const Tube& tube,
                                                        const std::shared_ptr<const FlowModels>& known);

  const FlowQuestion& question_;
  Box parameters_;
  PolygonBlocks motion_;
  PolygonRange outputs_, asides_;
  Tube tube_;
  std::vector<Interval> statesOver_, outputsOver_;  // since the last output time
  double partFrom_ = 0;                             // s, of what the motion has not forgotten
  double spentBefore_;
};

}  // namespace gamut
