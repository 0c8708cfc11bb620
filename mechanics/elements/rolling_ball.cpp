// The centre in axes that do not turn, then the axes of the ball: a body that is the same in all axes is fixed to the
// first (spin.hpp), so that no quaternion is in its motion.
#include "mechanics/elements/rolling_ball.hpp"

#include "mechanics/assembler.hpp"
#include "mechanics/elements/touching.hpp"
#include "mechanics/joints.hpp"

namespace gamut {
namespace {

/// Carries frame `to` in the centre of a ball that rolls, in axes that do not turn with it: by the angular velocity w
/// against the plane, in the axes of `from`. With r its radius: A = 1, d = (x, y, r), and it moves by r (w_y, −w_x, 0).
template <class S>
class RollingBallJoint final : public Joint<S> {
 public:
  /// `orientation` with rates in the axes of `from`; `radius`: r [m].
  RollingBallJoint(Frame<S>& from, Frame<S>& to, const Orientation<S>& orientation, PlaceInPlane<S> place, S radius)
      : Joint<S>(from, to, {orientation.speeds.begin(), orientation.speeds.end()}),
        place_(place),
        radius_(std::move(radius)) {}

 private:
  Place<S> place() const override { return {{}, {*place_[0], *place_[1], radius_}}; }
  std::vector<Twist<S>> motions() const override {
    const Vector3<S> x = axisX.unit<S>(), y = axisY.unit<S>();
    return {{x, y * S(-radius_)}, {y, x * radius_}, {axisZ.unit<S>()}};
  }

  PlaceInPlane<S> place_;
  S radius_;
};

}  // namespace

void RollingBall::describe(Fields& f) {
  f.frame({"from", "", "the frame whose x and y span the plane"}, from);
  f.movedFrame({"to", "", "the frame of the ball"}, to, from);
  f.number({"radius", "m", "of the ball", true}, radius);
  describePlace(f, "where it touches the plane", x, y);
  f.orientation(
      {"orientation", "rad", "at the start: " + orientationForms}, orientation,
      {"rate", "rad/s", "`[x, y, z]` at the start: the angular velocity against `from`, in the axes of `from`"}, rate);
  describeTouching(f);
  f.drawsPlane({from}, axisZ, {to}, radius);
  f.measureSolved({"friction.x", "N", "of the plane on the ball, in the axes of `from`"});
  f.measureSolved({"friction.y", "N", "likewise"});
}

std::vector<Fault> RollingBall::faults(const RangeOf& rangeOf) const {
  if (rangeOf(radius).lower() > 0) return {};
  return {{"radius", "the radius of '" + name + "' is not positive", "a radius above 0 m"}};
}

template <class S>
void RollingBall::assemble(Assembler<S>& a) const {
  const S size = a.number(radius);
  const Orientation<S> own = a.orientation("rate", RatesIn::from);
  const PlaceInPlane<S> place = placeOf<S>(
      a, [own, size] { return S(size * own.rate()[1]); }, [own, size] { return S(-size * own.rate()[0]); });
  Frame<S>& centre = a.hiddenFrame();
  a.template add<RollingBallJoint<S>>(a.frame(from), centre, own, place, size);
  a.template add<BallAxes<S>>(centre, a.frame(to), own);
  measureTouching(a, centre);
  a.measureSolved("friction.x", [&centre] { return S(-centre.f[0]); });
  a.measureSolved("friction.y", [&centre] { return S(-centre.f[1]); });
}

GAMUT_ASSEMBLE(RollingBall)

}  // namespace gamut
