// Where coordinates have to be for one frame to stand at another: equations F(q, p) = 0 of the coordinates and the
// mechanism's free parameters.
//
// With T and G the orientations of the frame and of its goal, and t_k, g_k their axes,
//
//   a = Σ_k g_k × t_k = 2 sin(θ) n         of the turn by θ about n that is left from G to T
//
// is zero where nothing is left, regular there (∂a = 2 ∂θ for a small turn), and zero besides at half turns alone,
// where trace(Gᵀ T) = 1 + 2 cos θ is -1, not 3. The axis t_3 alone is where it shall be where t_3·g_1 = t_3·g_2 = 0 and
// t_3·g_3 > 0. So there are as many equations as freedoms that the goal takes, and a sign tells the roots that are
// meant; what holds at these besides (T = G, or t_3 = g_3) takes nothing from the proof, but narrows where they are
// looked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// What of a frame shall be as of its goal.
enum class PostureMatch { position, axis, pose };

struct PostureGoal {
  std::string frame, goal;
  PostureMatch match;
};

/// All of the coordinates [rad, m] as states, in the order of Mechanism::stateNames(), and of the free parameters.
struct PostureEquations {
  std::vector<std::string> coordinates;
  Program roots;  ///< of closed loops their rows; of a goal those that are not zero whatever the coordinates are
  Program also;   ///< zero at all roots that are meant; these among them
  std::optional<Program> meant;  ///< of a goal with orientation: above 0 at a root that is meant, below 0 at any other
};

/// `parameters`: the box of the free ones. Throws UnfitPart where coordinates do not say the position (balls, free
/// frames, what rolls, own states), where a row of the goal is not zero and no coordinate changes it, and where there
/// are more or fewer equations than coordinates.
PostureEquations postureEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                                  const Box& parameters, const std::optional<PostureGoal>& goal);

/// Expressions where the mechanism stands still at its coordinates, as states, then the rows of its loops; of the free
/// parameters.
Program placesOf(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                 const std::vector<Expression>& expressions);

/// Throws UnfitPart where coordinates do not say the position.
void requireCoordinates(const Mechanism& mechanism, const std::string& what);

/// Of each coordinate, whether the program is the same where it is a whole turn on: it stands in sines and cosines
/// alone, by itself or with a whole factor.
std::vector<bool> turningStates(const Program& program);

}  // namespace gamut
