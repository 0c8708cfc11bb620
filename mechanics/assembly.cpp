// From the description to frames and elements, once for each scalar.
#include "mechanics/assembly.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "mechanics/bodies.hpp"
#include "mechanics/joints.hpp"
#include "mechanics/names.hpp"
#include "mechanics/springs.hpp"

namespace gamut {
namespace {

template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

}  // namespace

template <class S>
Assembly<S>::Assembly(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      std::span<const S> values)
    : stateNames_(mechanism.stateNames()), outputNames_(mechanism.outputQuantities()) {
  mechanism.check();
  if (values.size() != freeParameters.size())
    throw std::invalid_argument(std::to_string(freeParameters.size()) + " free parameters need as many values, not " +
                                std::to_string(values.size()));
  std::vector<std::string> parameters;
  for (const Mechanism::NamedValue& parameter : mechanism.parameters()) {
    parameters.push_back(parameter.name);
    values_.emplace(parameter.name, constant<S>(parameter.nominal));
  }
  for (const Mechanism::NamedValue& initial : mechanism.initialValues())
    values_.emplace(initial.name, constant<S>(initial.nominal));
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!mechanism.isParameter(freeParameters[i]))
      throw std::invalid_argument(unknownName("parameter", freeParameters[i], parameters));
    if (std::count(freeParameters.begin(), freeParameters.end(), freeParameters[i]) > 1)
      throw std::invalid_argument("the free parameter '" + freeParameters[i] + "' is named twice");
    values_.at(freeParameters[i]) = values[i];
  }
  for (const Mechanism::Derived& derived : mechanism.derived()) values_.emplace(derived.name, value(derived.formula));

  for (const std::string& name : mechanism.frames()) frames_.emplace(name, std::make_unique<Frame<S>>(name));
  for (const ElementDescription& element : mechanism.elements())
    std::visit([this](const auto& description) { this->add(description); }, element);
  system_ = std::make_unique<System<S>>(variables_, chain_, *frames_.at(Mechanism::inertialFrame),
                                        mechanism.gravity() ? vector(*mechanism.gravity()) : zeroVector<S>());
  for (const Expression& initial : mechanism.initialState()) initialState_.push_back(value(initial));
  setState(initialState_);
}

template <class S>
Assembly<S>::~Assembly() = default;

template <class S>
S Assembly<S>::value(const Expression& number) const {
  return number.evaluate<S>([this](const std::string& name) { return values_.at(name); });
}

template <class S>
Vector3<S> Assembly<S>::vector(const ExpressionVector& numbers) const {
  return Vector3<S>(value(numbers[0]), value(numbers[1]), value(numbers[2]));
}

template <class S>
template <class E, class... Arguments>
E& Assembly<S>::make(Arguments&&... arguments) {
  auto element = std::make_unique<E>(std::forward<Arguments>(arguments)...);
  E& made = *element;
  elements_.push_back(std::move(element));
  chain_ << made;
  return made;
}

template <class S>
void Assembly<S>::add(const Revolute& joint) {
  AngularVariable<S>& angle = angles_.emplace_back(joint.name + ".angle");
  variables_.push_back(angle);
  variableOf_.emplace(joint.name, &angle);
  make<RevoluteJoint<S>>(*frames_.at(joint.from), *frames_.at(joint.to), angle, joint.axis);
}

template <class S>
void Assembly<S>::add(const Prismatic& joint) {
  LinearVariable<S>& displacement = displacements_.emplace_back(joint.name + ".displacement");
  variables_.push_back(displacement);
  variableOf_.emplace(joint.name, &displacement);
  make<PrismaticJoint<S>>(*frames_.at(joint.from), *frames_.at(joint.to), displacement, joint.axis);
}

template <class S>
void Assembly<S>::add(const Link& link) {
  Rotation<S> rotation;
  for (const FixedRotation& r : link.rotation)
    rotation = rotation.then(Rotation<S>(r.axis, value(r.angle), r.quarterTurns));
  make<RigidLink<S>>(*frames_.at(link.from), *frames_.at(link.to), vector(link.vector), rotation);
}

template <class S>
void Assembly<S>::add(const Mass& mass) {
  std::array<S, 6> entries;
  std::transform(mass.inertia.begin(), mass.inertia.end(), entries.begin(), [this](const auto& q) { return value(q); });
  const auto& [xx, yy, zz, xy, yz, zx] = entries;
  Matrix3<S> inertia;
  inertia << xx, xy, zx, xy, yy, yz, zx, yz, zz;
  masses_.emplace(mass.name,
                  &make<MassElement<S>>(*frames_.at(mass.at), value(mass.mass), vector(mass.centre), inertia));
}

template <class S>
void Assembly<S>::add(const Spring& spring) {
  make<SpringDamper<S>>(*frames_.at(spring.from), *frames_.at(spring.to), value(spring.stiffness),
                        value(spring.restLength), value(spring.damping), vector(spring.fromPoint),
                        vector(spring.toPoint));
}

template <class S>
void Assembly<S>::add(const JointSpring& spring) {
  make<JointSpringDamper<S>>(*variableOf_.at(spring.joint), value(spring.stiffness), value(spring.rest),
                             value(spring.damping));
}

template <class S>
void Assembly<S>::setState(std::span<const S> x) {
  if (x.size() != 2 * variables_.size())
    throw std::invalid_argument("the mechanism has " + std::to_string(2 * variables_.size()) + " states, not " +
                                std::to_string(x.size()));
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    Variable<S>& variable = variables_[i];
    variable.position = x[i];
    variable.rate = x[variables_.size() + i];
    variable.acceleration = S(0.0);
  }
  system_->doMotion();
}

template <class S>
const Frame<S>& Assembly<S>::frame(const std::string& name) const {
  const auto found = frames_.find(name);
  if (found == frames_.end()) throw std::invalid_argument(unknownName("frame", name, keys(frames_)));
  return *found->second;
}

template <class S>
S Assembly<S>::output(const std::string& quantity) const {
  if (const auto state = std::find(stateNames_.begin(), stateNames_.end(), quantity); state != stateNames_.end()) {
    const auto i = static_cast<std::size_t>(state - stateNames_.begin()), f = variables_.size();
    return i < f ? variables_[i].get().position : variables_[i - f].get().rate;
  }
  if (quantity == "energy") return system_->energy();
  if (quantity == "energy.kinetic") return system_->kineticEnergy();
  if (quantity == "energy.potential") return system_->potentialEnergy();
  if (std::find(outputNames_.begin(), outputNames_.end(), quantity) == outputNames_.end())
    throw std::invalid_argument(unknownName("output quantity", quantity, outputNames_));
  const std::size_t component = quantity.rfind('.'), what = quantity.rfind('.', component - 1);
  const std::string place = quantity.substr(0, what);
  const auto mass = masses_.find(place);
  const MovingPoint<S> point = mass != masses_.end() ? mass->second->position() : frame(place).inInertial({});
  const Vector3<S>& vector = quantity.substr(what, component - what) == ".position" ? point.position : point.velocity;
  return vector[quantity.back() - 'x'];
}

template class Assembly<double>;
template class Assembly<Interval>;
template class Assembly<Samples>;
template class Assembly<Fuzzy>;
template class Assembly<Recorded>;

}  // namespace gamut
