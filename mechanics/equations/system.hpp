// A mechanical system in minimal coordinates and its equations of motion, got from doMotion and doForce alone (the
// kinetostatic method: one pass with u̇ = 0, one with each unit acceleration).
//
// M u̇ = Q: the inertia matrix M from the inertia forces at unit accelerations, Q the forces that remain at u̇ = 0. Up to
// two speeds are eliminated (least_constraint.hpp); systems of more are solved joint by joint, in the fewest operations
// (articulated_bodies.hpp), or as wholes, cut at the joints for enclosures (sparse_equations.hpp). With constraints, M
// is bordered by their rows, or multipliers are unknowns of the latter. With gears, what a joint moves is more than
// what hangs on it, so that M takes the place of the way joint by joint. No path depends on a scalar's value.
//
// Of a machine that closes on itself some speeds depend on the others: with the constraints' rows g(q) = 0 and their
// Jacobian J = (J_i, J_d), u_d = −J_d⁻¹ (J_i u_i + g_t). Positions are states all of them, and those of dependent
// speeds are pulled to where the loop is closed, q̇_d = u_d − α J_d⁻¹ g, so that g decays as e^(−α t): on the loop the
// pull is exactly zero. Where det J_d vanishes, at a dead point, nothing of this has a value. Loops that are held by
// multipliers have no such points while J has full rank: all speeds are states, u_d follows at the start alone, and
// g̈ = −2 α ġ − α² g, which is exactly zero on the loop too.
#pragma once

#include <functional>
#include <stdexcept>
#include <vector>

#include "mechanics/element.hpp"
#include "mechanics/equations/formulation.hpp"
#include "scalars/algebra/linear_system.hpp"

namespace gamut {

template <class S>
class System;

/// Throws std::logic_error if a load depends on accelerations.
void checkLoads(System<Recorded>& system);
/// Throws std::domain_error if a speed moves no inertia.
void checkMoved(System<Recorded>& system);
/// sparse_equations.hpp
std::vector<Recorded> sparseAccelerations(System<Recorded>& system);

template <class S>
class System {
 public:
  using Speeds = std::vector<std::reference_wrapper<Speed<S>>>;

  /// `gravity`: the acceleration of free fall in the inertial frame `base` [m/s²], e.g. {0, 0, -9.81}. Everything named
  /// here must outlive the system. Speeds of joints that are not among `speeds` are driven: an element ahead of the
  /// joint sets them. Throws std::invalid_argument if an element moves `base`.
  System(Speeds speeds, Chain<S>& chain, Frame<S>& base, Vector3<S> gravity)
      : speeds_(std::move(speeds)), chain_(chain), base_(base), gravity_(std::move(gravity)) {
    if (base.origin) throw std::invalid_argument("the inertial frame " + base.name + " must not be moved");
  }

  /// The last of the speeds, as many as the constraints have rows, depend on the others; `areHeld`: at the start alone,
  /// from where multipliers hold the loops.
  void depend(std::size_t dependents, bool areHeld) {
    dependents_ = dependents;
    areHeld_ = areHeld;
  }
  std::size_t dependents() const { return dependents_; }
  /// At the present positions and independent rates: sets the rates of dependent speeds.
  void close();
  /// g, and J_d, of which every column is what a unit of a dependent speed makes of the rows, at the present positions;
  /// J_d⁻¹ g: by what dependent positions are off, to first order.
  std::vector<S> residuals() const {
    return ofConstraints([](const Constraint<S>& constraint) { return constraint.residuals(); });
  }
  LinearSystem<S> dependentRows();
  std::vector<S> opening();
  /// ġ at the present positions and rates.
  std::vector<S> openingRates() const {
    return ofConstraints([](const Constraint<S>& constraint) { return constraint.rates(); });
  }
  /// g̈ + 2 σ ġ + σ² g for the accelerations of the present motion, which are zero in it; σ is α where loops are held.
  std::vector<S> openingAccelerations() const;
  /// α [1/s].
  static constexpr double pull = 20;

  int degreesOfFreedom() const { return static_cast<int>(speeds_.size()); }
  bool isConstrained() const { return !chain_.constraints().empty(); }

  /// Moves every frame by the variables' present positions, rates and accelerations.
  void doMotion(MotionLevel level = MotionLevel::all);

  /// Clears all forces and pulls those of `kind` back to the variables' generalised forces.
  void doForce(ForceKind kind = ForceKind::all);

  /// The variables' generalised forces after doForce.
  std::vector<S> generalisedForces() const;

  /// The generalised forces that remain at u̇ = 0: with M u̇ = residual. With zero rates, the static forces.
  std::vector<S> residual();

  /// The inertia matrix M at the present positions, column by column: the inertia forces at unit accelerations.
  Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> inertiaMatrix();

  /// u̇ at the present positions and rates; the speeds keep it and all frames move with it.
  /// Throws std::domain_error, naming the speed, if one is known to move no inertia.
  std::vector<S> accelerations(Formulation formulation = Formulation::sparse);

  /// After accelerations(): the forces of this motion, those of its inertia among them, on all frames and speeds; then
  /// the accelerations of frames as the base sees them, without −g.
  void complete();

  /// The acceleration of a base that is shaken, as a function of the present time; all motion is relative to it.
  void shake(std::function<Vector3<S>()> acceleration) { shaking_ = std::move(acceleration); }

  /// Motion and force once through the chain with these u̇. On the way `visit` sees, and may change, every component of
  /// what passes each joint: ω̇ and a of the frame behind it, then, inwards again, f and τ that act on this frame.
  template <class Visit>
  void pass(const std::vector<S>& accelerations, Visit visit) {
    const auto visitBoth = [&](Vector3<S>& first, Vector3<S>& second) {
      for (Vector3<S>* vector : {&first, &second})
        for (int i = 0; i < 3; ++i) visit((*vector)[i]);
    };
    setAccelerations(accelerations);
    base_.a = baseAtRest();
    for (Element<S>* element : chain_.elements()) {
      element->doMotion(MotionLevel::all);
      if (const auto* joint = jointAt(*element)) visitBoth(joint->to().omegaDot, joint->to().a);
    }
    base_.clearForces();
    chain_.clearForces();
    for (auto element = chain_.elements().rbegin(); element != chain_.elements().rend(); ++element) {
      if (const auto* joint = jointAt(**element)) visitBoth(joint->to().f, joint->to().tau);
      (*element)->doForce(ForceKind::all);
    }
  }

  S kineticEnergy() const;
  S potentialEnergy() const { return chain_.potentialEnergy(gravity_); }
  S gravityEnergy() const;
  /// Kinetic and potential energy of the present motion (after doMotion) [J].
  S energy() const { return kineticEnergy() + potentialEnergy(); }

  void setAccelerations(const std::vector<S>& values);
  const Speeds& speeds() const { return speeds_; }
  const Chain<S>& chain() const { return chain_; }

  /// Of the bodies, for these u̇ and without velocities, all components that an inertia resists.
  std::vector<S> resisted(const std::vector<S>& accelerations);

 private:
  Vector3<S> baseAtRest() const { return shaking_ ? Vector3<S>(shaking_() - gravity_) : Vector3<S>(-gravity_); }

  /// The element as one that is moved by a speed of the system, or null.
  const Transmission<S>* jointAt(Element<S>& element) const;

  /// f(constraint) of all constraints, one after another.
  template <class Rows>
  std::vector<S> ofConstraints(Rows rows) const {
    std::vector<S> all;
    for (Constraint<S>* constraint : chain_.constraints())
      for (S& row : rows(*constraint)) all.push_back(std::move(row));
    return all;
  }

  std::vector<S> zeros() const { return std::vector<S>(speeds_.size(), S(0.0)); }
  void moveUnit(std::size_t j);
  std::vector<S> bodyAccelerations() const;
  std::vector<S> bodyAccelerations(const std::vector<S>& values);
  /// Without those that are known zeros.
  std::vector<InertiaWeight<S>> inertiaWeights() const;

  /// The bodies' accelerations for each unit acceleration, none of which may be known to move no inertia.
  std::vector<std::vector<S>> unitColumns();

  std::vector<S> solved();
  std::vector<S> solvedByInertia();

  /// With the multipliers of the constraints: M u̇ − Gᵀ λ = Q, G u̇ = −g̈(u̇ = 0) − 2 σ ġ − σ² g; of Recorded sparsely.
  std::vector<S> constrained();
  std::vector<S> bordered();

  /// The same where all rows have a dependent speed: u̇ = T u̇_i + γ, with J T = 0, and Tᵀ M T u̇_i = Tᵀ (Q − M γ).
  std::vector<S> projected();

  /// Says of speeds which are multiples of one independent speed: by `along`, the columns of T, and what of dependent
  /// rates is there without these speeds.
  void lead(const std::vector<std::vector<S>>& along, const std::vector<S>& driven);

  /// Adds to the loads of independent speeds w_j the dry friction along all speeds r w_j that they lead,
  /// −(Σ strength |r|) sign w_j: at w_j = 0 all of it jumps at once, and where r is zero it has a kink alone.
  void holdDry(std::vector<S>& loads) const;

  /// The columns of T, got from unit accelerations whose dependent ones hold still what they can.
  std::vector<std::vector<S>> tangents(const LinearSystem<S>& rows);

  /// G u̇ of all rows for the j-th unit acceleration.
  std::vector<S> unitRows(std::size_t j);
  std::vector<S> rowsAt(MotionLevel level) {
    return ofConstraints([level](Constraint<S>& constraint) { return constraint.accelerations(level); });
  }

  std::vector<S> eliminated();

  /// Any u̇ is as good a start as 0. Where a row moves with u̇_j by a number that is not zero, and with no later
  /// variable, the u̇_j that holds it still is taken, from `first` on, if the row is then known to be zero: that is one
  /// component less to be carried through the rest of the recorded program. For scalars other than Recorded nothing is
  /// known, and u̇ stays what it is. `columns`: the rows of unit accelerations; `rowsAt`: of any.
  std::vector<S> holdingStill(std::vector<S> accelerations, std::size_t first,
                              const std::vector<std::vector<S>>& columns,
                              const std::function<std::vector<S>(const std::vector<S>&)>& rowsAt);

  static constexpr std::size_t mostEliminated = 2;  // speeds
  Speeds speeds_;
  Chain<S>& chain_;
  Frame<S>& base_;
  Vector3<S> gravity_;
  std::function<Vector3<S>()> shaking_;
  std::size_t dependents_ = 0;
  bool areHeld_ = false;
};

GAMUT_COMPILED_ELSEWHERE(System)

}  // namespace gamut
