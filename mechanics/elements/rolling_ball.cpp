// The centre in axes that do not turn, then the axes of the ball: a body that is the same in all axes is fixed to the
// first (spin.hpp), so that no quaternion is in its motion.
#include "mechanics/elements/rolling_ball.hpp"

#include <memory>

#include "mechanics/assembler.hpp"
#include "mechanics/rolling.hpp"

namespace gamut {

void RollingBall::describe(Fields& f) {
  f.frame({"from", "", "the frame whose x and y span the plane"}, from);
  f.movedFrame({"to", "", "the frame of the ball"}, to, from);
  f.number({"radius", "m", "of the ball", true}, radius);
  f.position({"x", "m", "at the start: where it touches the plane, in `from`"}, x);
  f.position({"y", "m", "likewise"}, y);
  f.orientation(
      {"orientation", "rad", "at the start: " + orientationForms}, orientation,
      {"rate", "rad/s", "`[x, y, z]` at the start: the angular velocity against `from`, in the axes of `from`"}, rate);
  f.measureSolved({"normal_force", "N", "of the plane on the ball"});
  f.measureSolved({"friction.x", "N", "of the plane on the ball, in the axes of `from`"});
  f.measureSolved({"friction.y", "N", "likewise"});
  f.measureSolved({"squared_grip", "1", "the square of the coefficient of friction that it needs, at least"});
}

std::vector<Fault> RollingBall::faults(const RangeOf& rangeOf) const {
  if (rangeOf(radius).lower() > 0) return {};
  return {{"radius", "the radius of '" + name + "' is not positive", "a radius above 0 m"}};
}

template <class S>
void RollingBall::assemble(Assembler<S>& a) const {
  const S size = a.number(radius);
  const std::array<Speed<S>*, 3> w = {&a.speed("rate.x"), &a.speed("rate.y"), &a.speed("rate.z")};
  // ė = ½ (0, w) ∘ e, each position as it is found; its own rate asks for all of them, which are there by then.
  auto e = std::make_shared<Quaternion<const S*>>();
  for (std::size_t i = 0; i < 4; ++i)
    (*e)[i] = &a.position(std::string("quaternion.") + quaternionComponents[i], [e, w, i] {
      const Quaternion<S> turning = {S(0.0), w[0]->rate, w[1]->rate, w[2]->rate};
      return S(0.5) * product(turning, Quaternion<S>{*(*e)[0], *(*e)[1], *(*e)[2], *(*e)[3]})[i];
    });
  const std::array<const S*, 2> place = {&a.position("x", [w, size] { return S(size * w[1]->rate); }),
                                         &a.position("y", [w, size] { return S(-(size * w[0]->rate)); })};
  Frame<S>& centre = a.hiddenFrame();
  a.template add<RollingBallJoint<S>>(a.frame(from), centre, w, place, size);
  a.template add<BallAxes<S>>(centre, a.frame(to), *e);
  a.measureSolved("normal_force", [&centre] { return S(-centre.f[2]); });
  a.measureSolved("friction.x", [&centre] { return S(-centre.f[0]); });
  a.measureSolved("friction.y", [&centre] { return S(-centre.f[1]); });
  a.measureSolved("squared_grip", [&centre] { return squaredGripOf<S>(centre.f); });
}

GAMUT_ASSEMBLE(RollingBall)

}  // namespace gamut
