// q = s(t), q̇ = s'(t), q̈ = s''(t): ahead of the joint, so that motion passes on through it.
#include "mechanics/elements/drive.hpp"

#include "mechanics/assembler.hpp"

namespace gamut {
namespace {

template <class S>
class PrescribedMotion final : public Load<S> {
 public:
  PrescribedMotion(Variable<S>& variable, TimeFunction<S> motion) : variable_(variable), motion_(std::move(motion)) {}

  void doMotion(MotionLevel level = MotionLevel::all) override {
    if (level == MotionLevel::acceleration) {
      variable_.acceleration = S(0.0);  // J u̇ is what speeds of the system bring about
      return;
    }
    const auto [position, rate, acceleration] = motion_();
    variable_.position = position;
    variable_.rate = rate;
    variable_.acceleration = acceleration;
  }

 private:
  void applyForce() override {}

  Variable<S>& variable_;
  TimeFunction<S> motion_;
};

}  // namespace

void Drive::describe(Fields& f) {
  const Coordinate kind = f.drivenCoordinate({"joint", "", "the joint, or one of its coordinates"}, joint);
  f.timeFunction({"position", unitOf(kind), "at time `t`", true}, position);
  f.measureSolved({"force", forceUnitOf(kind), "that it needs, in the direction in which the coordinate grows"});
  f.measureSolved({"power", "W", "that it brings in"});
}

template <class S>
void Drive::assemble(Assembler<S>& a) const {
  const Variable<S>& driven = a.coordinate(joint);
  a.template addFirst<PrescribedMotion<S>>(a.coordinate(joint), a.timeFunction(position));
  // All other forces on the coordinate, those of inertia among them, are held.
  a.measureSolved("force", [&driven] { return S(-driven.force); });
  a.measureSolved("power", [&driven] { return S(-driven.force * driven.rate); });
}

GAMUT_ASSEMBLE(Drive);

}  // namespace gamut
