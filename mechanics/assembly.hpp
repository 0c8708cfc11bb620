// An Assembly is a Mechanism made for one scalar: its frames, joints, links, masses and springs, ready to move.
// Scalars for which it is compiled: double, Interval, Samples, Fuzzy, Recorded.
//
//   Assembly<Interval> arm(mechanism);
//   arm.setState(box);
//   Interval height = arm.output("tip.position.z");
#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "mechanics/angle_courses.hpp"
#include "mechanics/assembler.hpp"
#include "mechanics/equations/system.hpp"
#include "mechanics/equations/unfolding.hpp"
#include "mechanics/measurements.hpp"
#include "mechanics/spin.hpp"
#include "mechanics/triangle.hpp"

namespace gamut {

template <class S>
class Assembly {
 public:
  /// `values` has one value for each name in `freeParameters`; all other numbers keep their nominal value. The state is
  /// the initial one (of Recorded none, until one is set). Throws std::invalid_argument for an incomplete mechanism
  /// (Mechanism::check), for a name that is no parameter, and for a wrong number of values.
  explicit Assembly(const Mechanism& mechanism, const std::vector<std::string>& freeParameters = {},
                    std::span<const S> values = {});
  /// The same of nominal values with loops open: dependent coordinates start where their closed position is looked for.
  struct Open {};
  Assembly(const Mechanism& mechanism, Open open);
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  /// The states x = [q; u; z] at the start.
  const std::vector<S>& initialState() const { return initialState_; }
  /// Sets x and the time [s] and moves all frames. Throws std::invalid_argument for a wrong number of values.
  void setState(std::span<const S> x, const S& time = S(0.0));
  /// The same by the states of a recorded motion: one whose initial value follows from a free parameter
  /// (Mechanism::startsWith) is given as its difference from that, which is zero at the start, so that each parameter
  /// stands in one place; coordinates that close loops likewise, as differences from where Newton's steps come to from
  /// the nominal position, of which the start is the remainder; motions that strike rigid ends are unfolded
  /// (equations/unfolding.hpp).
  void setMotion(std::span<const S> x, const S& time = S(0.0));
  /// From the next motion on, loops that close as triangles do put their joints' angles too, which are then no states:
  /// each is where it is within half a turn of its course.
  void placeAngles(AngleCourses courses) { courses_ = std::move(courses); }
  /// Whether each loop stands where it closes, in closed form, since setMotion().
  bool areLoopsPlaced() const;
  /// Of a loop that is placed so: above zero wherever it closes, and, of the angle of a joint, wherever this is less
  /// than half a turn from its course. Where one is zero, the way in which it is assembled, or the angle's whole turns,
  /// are another one beyond.
  struct PlacedMargin {
    S value;
    std::size_t loop;   ///< in the order of Mechanism::loops()
    std::string angle;  ///< a coordinate; of the triangle itself: empty
  };
  const std::vector<PlacedMargin>& placedMargins() const { return placedMargins_; }
  /// The states at which the loops are closed at this time, found from these by Newton's steps, of which none turns by
  /// more than half a radian; empty where it is not found, or a triangle is not on its side. Of machines that move by
  /// nothing but drives and loops.
  std::vector<double> closedAt(std::vector<double> x, double time) requires std::same_as<S, double>;
  /// u̇ for the present state.
  std::vector<S> accelerations(Formulation formulation = Formulation::sparse);
  /// ẋ for the present state: rates of positions, accelerations, rates of own states.
  std::vector<S> rates(Formulation formulation = Formulation::sparse);
  /// The rates of the states x of a recorded motion, and what `what` tells of the machine that setMotion(x, time) has
  /// moved. Of a machine with rigid ends these are what they are on each side, as smooth there as without ends, times
  /// (1 ± σ)/2: affine in σ.
  std::vector<S> motionRates(std::span<const S> x, const S& time,
                             Formulation formulation) requires std::same_as<S, Recorded>;
  std::vector<S> ofMotion(std::span<const S> x, const S& time,
                          const std::function<std::vector<S>()>& what) requires std::same_as<S, Recorded>;
  /// The present value of one of Mechanism::outputQuantities(), or of an expression of these, of parameters and of time
  /// t. Throws std::invalid_argument for any other name, naming the nearest, and for what is no expression.
  S output(const std::string& quantity) const;
  S output(const Expression& quantity) const { return parts_.signal(quantity)(); }

  /// Whatever is done to it counts as another motion.
  System<S>& system() {
    known_ = Known::state;
    return *system_;
  }
  /// Newton's map at the start, about where the dependent coordinates are: δ − J⁻¹ g(. + δ), J at δ = 0. Its fixed
  /// points are what the loops are closed at.
  std::vector<S> closingMap(std::span<const S> delta);
  /// The same for their rates where loops are held, `positions` being what the coordinates are off by.
  std::vector<S> closingRatesMap(std::span<const S> delta, std::span<const S> positions);
  /// The loops' rows at the start, dependent coordinates being there.
  std::vector<S> rowsAtStart(std::span<const S> dependents);

  /// The rows of motion R(v, v̇, v̈) of v = [q; z; λ], all numbers of which are free: of each coordinate its generalised
  /// force, inertia and multipliers λ of the loops included; of each own state by what its rate exceeds ż; the loops'
  /// rows g. Every position has to be a coordinate.
  std::vector<S> rowsOfMotion(std::span<const S> v, std::span<const S> rates, std::span<const S> accelerations,
                              const S& time);

  /// A row of a closure that is assumed to follow from all others (Closure::redundant), in words.
  struct AssumedRow {
    std::string element, row;
  };
  std::vector<AssumedRow> assumedRows() const;
  /// How far these are from being closed at the present positions [m, or as the sine of an angle].
  std::vector<S> assumedResiduals() const;
  /// By how much a unit of the speed that moves it most moves each of these.
  std::vector<double> assumedScales() requires std::same_as<S, double>;
  /// Of all rows that are held.
  std::vector<S> residuals() const { return system_->residuals(); }

  /// Further quantities that are known from elsewhere (Mechanism::measureModes).
  void tell(const std::string& quantity, Signal<S> value) { parts_.measured_[quantity] = std::move(value); }

  /// A number of the mechanism: a formula over its parameters.
  S number(const Expression& number) const { return parts_.number(number); }
  /// A frame by name. Throws std::invalid_argument, naming the nearest, if there is none.
  const Frame<S>& frame(const std::string& name) const;

 private:
  template <class Other>
  friend class Assembly;

  Assembly(const Mechanism& mechanism, const std::vector<std::string>& freeParameters, std::span<const S> values,
           bool closesLoops);
  /// Of a dependent coordinate of loops that are held, its rate among the states.
  std::size_t rateOfDependent(std::size_t i) const {
    return states_.size() - ownRates_.size() - dependents_.size() + i;
  }
  void takeNumbers(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                   std::span<const S> values);
  void makeStates(const Mechanism& mechanism);
  typename System<S>::Speeds takeStates(const Mechanism& mechanism);
  std::vector<S> withOrigin(std::span<const S> x) const;
  void setUnfolded(std::vector<S> states, const std::vector<S>& signs, const S& time, bool isSmooth = false);
  void unfoldEnds(const Mechanism& mechanism);
  void closeLoops(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                  std::span<const S> values);
  void closeNominally(const Mechanism& mechanism, bool areRowsOpen) requires std::same_as<S, double>;
  std::vector<S> closedNear(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                            std::span<const S> values);
  std::vector<S> openingAt(const std::vector<S>& dependents, bool areRowsOpen = false);
  void closeRates();
  std::vector<std::size_t> redundantRows(const Mechanism& mechanism) const;
  void leaveOutAs(const Assembly<double>& nominal);
  void leaveOutRedundant(const Mechanism& mechanism, bool isClosed);
  void findTriangles(const Mechanism& mechanism);
  void placeTriangles();
  void releaseTriangles();
  void placeLoop(std::size_t number);
  void endWhereOpen();
  std::vector<S> opening();
  void placeAtStart();
  void measureFrames();
  void measureReactions(const Mechanism& mechanism);
  void measureWhole();
  /// f(frame)[i] as NAME.x … of an owned frame.
  template <class Of>
  void measureVector(const std::string& name, bool isSolved, const Of& of,
                     const std::array<const char*, 3>& keys = components);
  Momentum<S> momentum() const;
  void solve();

  /// Of the present motion.
  enum class Known { state, solving, accelerations, forces };

  Assembler<S> parts_;
  std::unordered_map<const Frame<S>*, Unturned<S>> unturned_;  // of frames whose bodies are stated ahead of their spin
  Chain<S> chain_;
  std::unique_ptr<System<S>> system_;
  std::unique_ptr<Unfolding<S>> unfolding_;
  std::vector<S*> states_;                 // in the order of Mechanism::stateNames()
  std::vector<Variable<S>*> coordinates_;  // positions of them
  std::vector<Signal<S>> positionRates_, ownRates_;
  std::vector<std::size_t> dependents_;  // states: the positions of coordinates that close loops, in their order
  std::vector<bool> dependentsTurn_;     // of these: angles
  std::vector<S> opening_;               // of the present state
  struct Loop {
    std::unique_ptr<Triangle<S>> triangle;  // null where it is none
    std::size_t first, rows;                // of dependents_
    double side = 0;                        // of the nominal machine
    bool isPlaced = false;
  };
  std::vector<Loop> loops_;
  AngleCourses courses_;
  std::vector<PlacedMargin> placedMargins_;
  bool placesTriangles_ = false;          // by the next states
  bool areLoopsHeld_ = false;             // by multipliers: rates of dependent coordinates are states too
  std::vector<S> initialState_, origin_;  // the second: what differences of states are from; else zero
  Known known_ = Known::state;
};

GAMUT_COMPILED_ELSEWHERE(Assembly)

}  // namespace gamut
