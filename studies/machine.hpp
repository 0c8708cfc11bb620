// The machine that a study describes, as programs: recorded once, and what of their numbers is uncertain, and how.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/samples/courses.hpp"
#include "analyses/samples/ensemble.hpp"
#include "analyses/uncertainty.hpp"
#include "mechanics/angle_courses.hpp"
#include "scalars/program/program.hpp"
#include "studies/study.hpp"

namespace gamut {

template <class S>
class Assembly;
class EigenvalueBounds;
class Recorded;
class Rest;

/// An uncertain quantity that is constant.
struct ConstantQuantity {
  std::size_t number;  ///< among the study's uncertain quantities
  int slot;            ///< its place among the numbers that programs take
};

/// Of what equations take: while all of it is above zero, outputs are of one motion, that of the start; beyond, they
/// may be of another one, or have no value. Samples end there by their rates.
struct Regular {
  Program values;                      ///< none: always
  std::vector<std::string> otherwise;  ///< what happens where one of these is zero, in words
};

/// Programs of a study take initial values, then free parameters: the uncertain quantities that no state starts with.
/// All other numbers are constants of the programs. In kinematics, programs have no states: these are parameters too.
/// In equilibria what the families of Rest leave open stands in their place.
struct Machine {
  /// Records the study's mechanism. Throws StudyError, with the place in its file, for a mechanism whose motion is not
  /// determined, or something of which has no value or finds no room: the equations of n joints in a chain take some
  /// 1100 n² bytes. `progress`: told from this thread what is done, "loops" as they are proved to close, and which
  /// share of it.
  using Progress = std::function<void(const std::string& task, double fraction)>;
  explicit Machine(Study of, const Progress& progress = {});

  Study study;
  double cpu = 0;  ///< s, that recording took
  std::size_t states = 0;
  std::vector<std::string> freeParameters;
  Box box;                                  ///< initial values, then free parameters; uncertain ones have their ranges
  std::vector<double> alpha;                ///< membership levels, 0 first; empty unless alpha-cuts are asked for
  std::vector<Box> levels;                  ///< the box with the alpha-cuts of the uncertain quantities, one a level
  std::vector<ConstantQuantity> constants;  ///< those that do not vary in time
  std::vector<VaryingParameter> varying;    ///< free parameters that vary in time
  std::vector<VaryingQuantity> courses;     ///< what of them the samples take, turning no slower and no faster than so
  double slowest = 0, fastest = 0;          ///< rad/s
  std::vector<int> remainders;   ///< what families leave open (FlowOptions::remainders): initial values of coordinates
                                 ///< that close loops, or, at rest, all there are
  std::vector<Program> closing;  ///< their Newton's maps: recordClosing(), or Rest::families()
  std::shared_ptr<const Rest> rest;                    ///< of equilibria
  std::shared_ptr<const EigenvalueBounds> vibrations;  ///< of undamped modes over the box
  Program plain;           ///< at rest equations().g as plain intervals know most of it; else none
  UncertainMotion motion;  ///< the equations as samples follow them: what varies in time takes the course that its
                           ///< number chooses
  Regular regular;         ///< of equations()
  std::optional<AngleCourses> placed;  ///< of driven loops that stand where closed forms put them (whole_turns.hpp)

  /// Time passes, but nothing is left to follow: programs have one state, which rests.
  bool isMotionGiven() const { return study.isMotionGiven() || placed; }
  /// In which what varies in time is a parameter; where no time passes: g of parameters alone.
  const Motion& equations() const { return courses.empty() ? motion.motion : motion.switching.motion; }
  /// A box of other ranges, for all values of which loops are proved to close, or position and modes of rest to exist.
  /// Throws StudyError where they are not.
  Box closed(Box other) const;
  /// A part of the box, with what is known there of undamped modes.
  Box within(Box part) const;
  /// As findImage takes it.
  const Program* plainly() const { return rest ? &plain : nullptr; }
  /// A program of states and free parameters as samples follow it: what varies in time takes its course.
  Program alongCourses(const Program& program) const;
};

/// Of equilibria; throws as Machine does.
std::shared_ptr<const Rest> restOf(const Study& study);

/// The programs of a study's mechanism, as Machine::equations; throws as Machine does. `rest`: restOf() if it has one.
/// `placed`: as Machine::placed.
Motion recordedMotion(const Study& study, const Rest* rest, const std::optional<AngleCourses>& placed = {});
inline Motion recordedMotion(const Study& study) { return recordedMotion(study, restOf(study).get()); }

/// `what(assembly)`, so many values, at a state and time of a study's motion: takes what Machine::equations take.
/// `withinEnds`: as of Rest::at.
Program recordedOf(const Study& study, const Rest* rest, std::size_t values,
                   const std::function<std::vector<Recorded>(const Assembly<Recorded>&)>& what, bool withinEnds = false,
                   const std::optional<AngleCourses>& placed = {});
inline Program recordedOf(const Machine& machine, std::size_t values,
                          const std::function<std::vector<Recorded>(const Assembly<Recorded>&)>& what) {
  return recordedOf(machine.study, machine.rest.get(), values, what, false, machine.placed);
}

/// What is looked at, each in its unit.
std::vector<Expression> outputExpressions(const Study& study);

}  // namespace gamut
