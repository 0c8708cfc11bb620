// An Assembly is a Mechanism made for one scalar: its frames, joints, links, masses and springs, ready to move.
// Scalars for which it is compiled: double, Interval, Samples, Fuzzy, Recorded.
//
//   Assembly<Interval> arm(mechanism);
//   arm.setState(box);
//   Interval height = arm.output("tip.position.z");
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mechanics/element.hpp"
#include "mechanics/mechanism.hpp"
#include "mechanics/system.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/samples.hpp"

namespace gamut {

template <class S>
class MassElement;

template <class S>
class Assembly {
 public:
  /// `values` has one value for each name in `freeParameters`; all other numbers keep their nominal value. The state is
  /// the initial one. Throws std::invalid_argument for an incomplete mechanism (Mechanism::check), for a name that is
  /// no parameter, and for a wrong number of values.
  explicit Assembly(const Mechanism& mechanism, const std::vector<std::string>& freeParameters = {},
                    std::span<const S> values = {});
  ~Assembly();
  Assembly(const Assembly&) = delete;
  Assembly& operator=(const Assembly&) = delete;

  /// The states x = [q; q̇] at the start.
  const std::vector<S>& initialState() const { return initialState_; }
  /// Sets x and moves all frames. Throws std::invalid_argument for a wrong number of values.
  void setState(std::span<const S> x);
  /// q̈ for the present state.
  std::vector<S> accelerations(Formulation formulation = Formulation::sparse) {
    return system_->accelerations(formulation);
  }
  /// The present value of one of Mechanism::outputQuantities(). Throws std::invalid_argument, naming the nearest, for
  /// any other.
  S output(const std::string& quantity) const;

  System<S>& system() { return *system_; }
  /// A frame by name. Throws std::invalid_argument, naming the nearest, if there is none.
  const Frame<S>& frame(const std::string& name) const;

 private:
  S value(const Expression& number) const;
  Vector3<S> vector(const ExpressionVector& numbers) const;
  template <class E, class... Arguments>
  E& make(Arguments&&... arguments);
  void add(const Revolute& joint);
  void add(const Prismatic& joint);
  void add(const Link& link);
  void add(const Mass& mass);
  void add(const Spring& spring);
  void add(const JointSpring& spring);

  std::vector<std::string> stateNames_, outputNames_;
  std::map<std::string, S> values_;  // of parameters and of initial values
  std::map<std::string, std::unique_ptr<Frame<S>>> frames_;
  std::deque<AngularVariable<S>> angles_;
  std::deque<LinearVariable<S>> displacements_;
  std::map<std::string, Variable<S>*> variableOf_;  // by joint
  typename System<S>::Variables variables_;         // in the order of the joints
  std::map<std::string, const MassElement<S>*> masses_;
  std::vector<std::unique_ptr<Element<S>>> elements_;
  Chain<S> chain_;
  std::unique_ptr<System<S>> system_;
  std::vector<S> initialState_;
};

extern template class Assembly<double>;
extern template class Assembly<Interval>;
extern template class Assembly<Samples>;
extern template class Assembly<Fuzzy>;
extern template class Assembly<Recorded>;

}  // namespace gamut
