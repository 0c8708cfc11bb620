// With r, v, ω resolved in each frame and A = R₁ᵀ R₂:  x = A r₂ − r₁,  ẋ = A v₂ − v₁ − ω₁ × x,  cos φ = u·A u, sin φ =
// |u × A u|.
#include "mechanics/elements/relative_motion.hpp"

#include "mechanics/assembler.hpp"

namespace gamut {
namespace {

template <class S>
class Observer final : public Load<S> {
 public:
  Observer(Frame<S>& from, Frame<S>& to, const Axis& axis) : from_(from), to_(to), axis_(axis) {}

  Vector3<S> position() const { return seen(to_.r) - from_.r; }
  Vector3<S> velocity() const { return seen(to_.v) - from_.v - from_.omega.cross(position()); }
  S angle() const {
    using std::atan2, std::sqrt;
    const Vector3<S> u = axis_.template unit<S>(), other = seen(u), across = u.cross(other);
    return atan2(S(sqrt(square(across[0]) + square(across[1]) + square(across[2]))), S(u.dot(other)));
  }

 private:
  void applyForce() override {}
  Vector3<S> seen(const Vector3<S>& x) const { return from_.R.transpose() * Vector3<S>(to_.R * x); }

  Frame<S>& from_;
  Frame<S>& to_;
  Axis axis_;
};

}  // namespace

void RelativeMotion::describe(Fields& f) {
  f.frame({"from", "", "the frame that sees"}, from);
  f.otherFrame({"to", "", "the frame that is seen"}, to, from);
  f.axis({"axis", "", "whose directions in both frames are compared; `\"z\"` unless given"}, axis);
  for (const char* component : components) {
    f.measure({std::string("position.") + component, "m", "of `to`, in the axes of `from`"});
    f.measure({std::string("velocity.") + component, "m/s", "of `to`, as `from` sees it"});
  }
  f.measure({"angle", "rad", "between the axes, from 0 to π; not differentiable at its ends"});
}

template <class S>
void RelativeMotion::assemble(Assembler<S>& a) const {
  const auto& observer = a.template add<Observer<S>>(a.frame(from), a.frame(to), axis);
  for (int i = 0; i < 3; ++i) {
    const std::string component = components[static_cast<std::size_t>(i)];
    a.measure("position." + component, [&observer, i] { return observer.position()[i]; });
    a.measure("velocity." + component, [&observer, i] { return observer.velocity()[i]; });
  }
  a.measure("angle", [&observer] { return observer.angle(); });
}

GAMUT_ASSEMBLE(RelativeMotion);

}  // namespace gamut
