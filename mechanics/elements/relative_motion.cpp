// cos φ = u·A u, sin φ = |u × A u| of the angle between the axes; the rest in measurements.hpp.
#include "mechanics/elements/relative_motion.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/measurements.hpp"

namespace gamut {

void RelativeMotion::describe(Fields& f) {
  f.frame({"from", "", "the frame that sees"}, from);
  f.otherFrame({"to", "", "the frame that is seen"}, to, from);
  f.vector({"from_point", "m", "the point of `from` from which is measured"}, fromPoint);
  f.vector({"to_point", "m", "the point of `to` that is seen"}, toPoint);
  f.axis({"axis", "", "whose directions in both frames are compared; `\"z\"` unless given"}, axis);
  const auto vector = [&](const std::string& kind, const char* unit, const char* meaning, bool isSolved = false) {
    for (const char* component : components) {
      const Word word{kind + "." + component, unit, meaning};
      isSolved ? f.measureSolved(word) : f.measure(word);
    }
  };
  vector("position", "m", "of `to_point`, in the axes of `from`");
  vector("velocity", "m/s", "of `to_point`, as `from` sees it");
  vector("acceleration", "m/s^2", "of `to_point`, as `from` sees it", true);
  vector("angular_velocity", "rad/s", "of `to`, as `from` sees it");
  vector("angular_acceleration", "rad/s^2", "of `to`, as `from` sees it", true);
  vector("rotation_vector", "rad",
         "of `to` against `from`: axis times angle, each from -π to π; singular at the angle π");
  f.measure({"orientation.roll", "rad", "of `to` against `from`: first, about x of `from`"});
  f.measure({"orientation.pitch", "rad", "then about y of `from`; at ± π/2 all three are singular"});
  f.measure({"orientation.yaw", "rad", "then about z of `from`"});
  f.measure({"angle", "rad", "between the axes, from 0 to π; not differentiable at its ends"});
}

template <class S>
void RelativeMotion::assemble(Assembler<S>& a) const {
  const RelativeMotionOf<S> motion(a.frame(from), a.vector(fromPoint), a.frame(to), a.vector(toPoint));
  const auto vector = [&](const std::string& kind, auto of, bool isSolved = false) {
    for (int i = 0; i < 3; ++i) {
      const std::string key = kind + "." + components[i];
      const Signal<S> value = [motion, of, i] { return S(of(motion)[i]); };
      isSolved ? a.measureSolved(key, value) : a.measure(key, value);
    }
  };
  using Motion = RelativeMotionOf<S>;
  vector("position", std::mem_fn(&Motion::position));
  vector("velocity", std::mem_fn(&Motion::velocity));
  vector("acceleration", std::mem_fn(&Motion::acceleration), true);
  vector("angular_velocity", std::mem_fn(&Motion::angularVelocity));
  vector("angular_acceleration", std::mem_fn(&Motion::angularAcceleration), true);
  vector("rotation_vector", [](const Motion& seen) { return rotationVector(seen.orientation()); });
  for (int i = 0; i < 3; ++i)
    a.measure(std::string("orientation.") + rollPitchYawNames[i],
              [motion, i] { return S(rollPitchYaw(motion.orientation())[i]); });
  a.measure("angle", [motion, along = axis] {
    using std::atan2, std::sqrt;
    const Vector3<S> u = along.template unit<S>(), other = motion.seen(u), across = u.cross(other);
    return S(atan2(S(sqrt(square(across[0]) + square(across[1]) + square(across[2]))), S(u.dot(other))));
  });
}

GAMUT_ASSEMBLE(RelativeMotion)

}  // namespace gamut
