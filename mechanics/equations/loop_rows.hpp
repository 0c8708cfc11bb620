// How loops close where a machine stands: the rows' Jacobian, how firmly the dependent coordinates hold them, and what
// inertia is felt along the motions that are left.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/equations/system.hpp"

namespace gamut {

/// J at the present positions, a column a speed: what it makes of the rows.
Eigen::MatrixXd jacobianOfLoops(System<double>& system);

/// Tᵀ M T with J T = 0 at the present positions: the inertia that the independent speeds move, dependent ones with
/// them; what is rounding alone is 0.
Eigen::MatrixXd inertiaAlongLoops(System<double>& system);

/// How firmly the dependent coordinates hold the loops closed at the present positions.
struct LoopGrip {
  double share;                    ///< of the firmness that the best choice has: 0 at a dead point
  std::vector<std::string> best;   ///< the coordinates of that choice; empty where no choice closes all rows
  double determinant;              ///< of J_d, not scaled: by its own scale a row that vanishes would not be seen to
  std::vector<std::string> loose;  ///< dependent coordinates that move most where they hold least
  double firmness = 0;             ///< of all speeds, least singular value over greatest: 0 where rows are dependent
};

/// By the least singular value of J_d, in units in which the greatest entry of each row is 1, and angles and
/// displacements move rows alike. The best choice is that of a pivoted orthogonalisation of the columns of J that
/// belong to coordinates.
LoopGrip gripOfLoops(const Mechanism& mechanism, System<double>& system);

/// Where dependent coordinates open the loops least, from where they stand.
struct NearestClosing {
  std::vector<double> at;    ///< of the dependent coordinates, rad or m
  std::vector<double> rows;  ///< g there
};

/// By Levenberg's and Marquardt's method; `place(at)` puts them there.
NearestClosing nearestClosing(System<double>& system, std::vector<double> at,
                              const std::function<void(const std::vector<double>&)>& place);

/// The elements of loops whose rows, times some numbers, add up to nothing, where J has lost its rank, or nearly.
std::vector<std::string> loopsAlike(const Mechanism& mechanism, System<double>& system);

/// Of loops that name no dependent coordinates: those that stand last, but for such as move what rows still leave open
/// by less than a tenth of what the firmest does at the present positions (elimination with threshold pivoting).
/// Without those that have an initial rate, strike a rigid end or are `given`. Empty where that closes not all rows.
DependentsOf firmDependents(const Mechanism& mechanism, System<double>& system, const std::set<std::string>& given);

/// Of constraints of whose rows so many are redundant, one entry each: which to leave out, so that those that are left
/// are as far from depending on each other as elimination with pivoting finds them at the present positions, where all
/// rows are held.
struct RowChoice {
  std::vector<std::vector<std::size_t>> leftOut;
  std::vector<std::size_t> others;  ///< of each constraint, rows left out that do not follow from those that are left
  bool isEnough = true;             ///< false: more rows depend on others than are redundant
};
RowChoice rowsToLeaveOut(const Mechanism& mechanism, System<double>& system, const std::vector<std::size_t>& redundant);

}  // namespace gamut
