#include "mechanics/elements/joint_friction.hpp"

#include "mechanics/elements/coordinate_load.hpp"

namespace gamut {
namespace {

/// The words that both have. Returns the coordinate's kind.
Coordinate describeFriction(Fields& f, std::string& joint, Expression& coulomb, Expression& viscous) {
  const Coordinate kind = f.coordinateOf({"joint", "", "the joint, or one of its coordinates"}, joint);
  const std::string force = forceUnitOf(kind);
  f.number({"coulomb", force, "against the motion, whatever its speed", true}, coulomb);
  f.number({"viscous", force + " s/" + unitOf(kind), "against the motion, by its speed"}, viscous);
  f.drawsFriction(joint, {coulomb, viscous});
  return kind;
}

/// What drives a joint away from standstill is no friction; without smoothing its motion is not unique either.
std::vector<Fault> faultsOfFriction(const std::string& name, const Expression& coulomb, const RangeOf& rangeOf) {
  if (rangeOf(coulomb).lower() >= 0) return {};
  return {{"coulomb", "the Coulomb friction of '" + name + "' is negative", "at least 0"}};
}

template <class S>
class JointFrictionLoad final : public Load<S> {
 public:
  JointFrictionLoad(Variable<S>& variable, S dry, S wet)
      : variable_(variable), dry_(std::move(dry)), wet_(std::move(wet)) {}

  S force() const { return -(dry_ * variable_.direction()) - wet_ * variable_.rate; }
  S power() const { return force() * variable_.rate; }
  std::vector<DryFriction<S>> dryFriction() const override { return {{&variable_, dry_}}; }

 private:
  void applyForce() override { variable_.force += force(); }
  void applySmoothForce() override {
    if (variable_.leader == nullptr)
      applyForce();
    else
      variable_.force -= wet_ * variable_.rate;
  }

  Variable<S>& variable_;
  S dry_, wet_;
};

}  // namespace

void JointFriction::describe(Fields& f) { describeCoordinateLoad(f, describeFriction(f, joint, coulomb, viscous)); }

template <class S>
void JointFriction::assemble(Assembler<S>& a) const {
  const auto& load = a.template add<JointFrictionLoad<S>>(a.coordinate(joint), a.number(coulomb), a.number(viscous));
  a.measure("force", [&load] { return load.force(); });
  a.measure("power", [&load] { return load.power(); });
}

std::vector<Fault> JointFriction::faults(const RangeOf& rangeOf) const {
  return faultsOfFriction(name, coulomb, rangeOf);
}

void SmoothedJointFriction::describe(Fields& f) {
  const Coordinate kind = describeFriction(f, joint, coulomb, viscous);
  f.number({"slip_rate", std::string(unitOf(kind)) + "/s",
            "over which it is smoothed: at it, 76 % of `coulomb` are there, at three times it 99.5 %", true},
           slipRate);
  describeCoordinateLoad(f, kind);
}

template <class S>
void SmoothedJointFriction::assemble(Assembler<S>& a) const {
  const S dry = a.number(coulomb), wet = a.number(viscous), slip = a.number(slipRate);
  addCoordinateLoad(a, joint, [dry, wet, slip](const Variable<S>& q) {
    using std::tanh;
    return S(-(dry * tanh(S(q.rate / slip))) - wet * q.rate);
  });
}

std::vector<Fault> SmoothedJointFriction::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found = faultsOfFriction(name, coulomb, rangeOf);
  if (!(rangeOf(slipRate).lower() > 0))
    found.push_back({"slip_rate", "the slip rate of '" + name + "' is not positive", "a slow rate above 0"});
  return found;
}

GAMUT_ASSEMBLE(JointFriction)
GAMUT_ASSEMBLE(SmoothedJointFriction)

}  // namespace gamut
