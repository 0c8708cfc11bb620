// In the axes of `from`, with t₁, t₂ = n × t₁ along the plane and w the angular velocity of `to` against `from`:
//
//   u_t·t₁ = u·t₁ − r w·t₂     u_t·t₂ = u·t₂ + r w·t₁     moment about the centre  r (T₂ t₁ − T₁ t₂)
//
// both seen from the nearest frame that both hang on, so that joints further inwards are in none of it.
#include "mechanics/elements/plane_contact.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/assembler.hpp"
#include "mechanics/load_on_axis.hpp"
#include "mechanics/resisting.hpp"
#include "mechanics/seen.hpp"

namespace gamut {
namespace {

/// A direction at right angles to an axis: in the plane of its two greatest components.
Axis across(const Axis& axis) {
  const std::array<double, 3> d = axis.direction();
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::ranges::stable_sort(order, std::less{}, [&](std::size_t i) { return std::fabs(d[i]); });
  std::array<double, 3> result = {0.0, 0.0, 0.0};
  result[order[1]] = -d[order[2]];
  result[order[2]] = d[order[1]];
  return Axis(result[0], result[1], result[2]);
}

template <class S>
class PlaneContactLoad final : public Load<S>, public LoadOnAxis<S>, public Resisting<S> {
 public:
  struct Numbers {
    S radius, stiffness, damping, friction, slipRate;
    S reach;                                  ///< the radius times the length of the normal as it was given
    std::optional<S> fastest = std::nullopt;  ///< that length by the damping, where this is known to be above 0
    bool isDamped = true, slips = true;       ///< false: known not to be
  };

  PlaneContactLoad(Frame<S>& from, Vector3<S> fromPoint, const Axis& normal, Frame<S>& to, Vector3<S> toPoint,
                   Numbers numbers)
      : from_(from),
        to_(&to),
        fromPoint_(std::move(fromPoint)),
        toPoint_(std::move(toPoint)),
        length_(constant<S>(normal.length())),
        normal_(normal.unit<S>()),
        is_(std::move(numbers)) {
    const std::array<double, 3> along = normal.direction();
    direction_ = {S(along[0]), S(along[1]), S(along[2])};
    using VectorOfIntervals = Vector3<Interval>;
    const VectorOfIntervals first = across(normal).unit<Interval>(), second = normal.unit<Interval>().cross(first);
    for (int i = 0; i < 3; ++i) {
      tangents_[0][i] = constant<S>(first[i]);
      tangents_[1][i] = constant<S>(second[i]);
    }
  }

  S gap() const { return scaledGap(motion()) / length_; }
  S normalForce() const { return pushing(motion()); }
  /// On `to`, in the axes of `from`.
  Vector3<S> force() const {
    const Motion now = motion();
    return forceOf(now, pushing(now));
  }
  Vector3<S> slip() const {
    const std::array<S, 2> along = slipOf(motion());
    return tangents_[0] * along[0] + tangents_[1] * along[1];
  }
  S slipSpeed() const {
    using std::sqrt;
    const std::array<S, 2> along = slipOf(motion());
    return sqrt(S(square(along[0]) + square(along[1])));
  }
  S frictionForce() const {
    if (!is_.slips) return S(0.0);
    const Motion now = motion();
    using std::sqrt;
    const S squares = square(slipOf(now)[0]) + square(slipOf(now)[1]);
    return is_.friction * pushing(now) * S(sqrt(squares)) / S(sqrt(S(squares + square(is_.slipRate))));
  }
  S power() const {
    const Motion now = motion();
    const S normal = pushing(now);
    const std::array<S, 2> along = slipOf(now), friction = frictionOf(now, normal);
    return normal * rateOf(now) + friction[0] * along[0] + friction[1] * along[1];
  }

  S potentialEnergy(const Vector3<S>&) const override { return S(0.5) * (is_.stiffness * square(depthOf(motion()))); }

  /// Of the speed of entering, and of slip.
  std::vector<S> resistances() const override {
    const Motion now = motion();
    const S press = is_.stiffness * depthOf(now);
    std::vector<S> all;
    if (is_.isDamped) all.push_back(is_.damping * press);
    if (is_.slips) all.resize(all.size() + 2, is_.friction * pushing(now) / is_.slipRate);
    return all;
  }
  void release() override { is_.isDamped = is_.slips = false; }

  void moveAhead(const Frame<S>& turned, const Axis& axis, Frame<S>& unturned) override {
    for (int i = 0; i < 3; ++i)
      if (!(axis.isAligned() && axis.index() == i) && !isKnownZero(toPoint_[i])) return;
    if (to_ == &turned) to_ = &unturned;
  }

 private:
  /// Of the centre against the plane, in the axes of `from`.
  struct Motion {
    Vector3<S> place, velocity, omega;
    Matrix3<S> fromAxes, toAxes;  // of both, in the frame that both hang on
  };

  Motion motion() const {
    const Frame<S>* base = commonBase<S>(&from_, to_);
    const SeenFrame<S> plane = seenFrom<S>(base, &from_, fromPoint_), sphere = seenFrom<S>(base, to_, toPoint_);
    const Vector3<S> x = sphere.point.position - plane.point.position;
    const Vector3<S> u = sphere.point.velocity - plane.point.velocity - plane.turning.omega.cross(x);
    const Matrix3<S>& a = plane.turning.axes;
    return {a.transpose() * x, a.transpose() * u,
            a.transpose() * Vector3<S>(sphere.turning.omega - plane.turning.omega), a, sphere.turning.axes};
  }

  /// The gap times the length of the normal as it was given: linear in states without rounding where the place is.
  S scaledGap(const Motion& now) const { return direction_.dot(now.place) - is_.reach; }
  S depthOf(const Motion& now) const {
    using std::max;
    return S(max(S(-scaledGap(now)), S(0.0))) / length_;
  }
  S rateOf(const Motion& now) const { return normal_.dot(now.velocity); }
  S pushing(const Motion& now) const {
    using std::max;
    const S press = is_.stiffness * depthOf(now);
    if (!is_.isDamped) return press;
    if (is_.fastest)
      return press * (is_.damping / length_ * S(max(S(*is_.fastest - direction_.dot(now.velocity)), S(0.0))));
    return press * S(max(S(S(1.0) - is_.damping * rateOf(now)), S(0.0)));
  }
  std::array<S, 2> slipOf(const Motion& now) const {
    return {tangents_[0].dot(now.velocity) - is_.radius * tangents_[1].dot(now.omega),
            tangents_[1].dot(now.velocity) + is_.radius * tangents_[0].dot(now.omega)};
  }
  std::array<S, 2> frictionOf(const Motion& now, const S& normal) const {
    if (!is_.slips) return {S(0.0), S(0.0)};
    using std::sqrt;
    const std::array<S, 2> along = slipOf(now);
    const S factor = is_.friction * normal / S(sqrt(S(square(along[0]) + square(along[1]) + square(is_.slipRate))));
    return {S(-(factor * along[0])), S(-(factor * along[1]))};
  }
  Vector3<S> forceOf(const Motion& now, const S& normal) const {
    const std::array<S, 2> friction = frictionOf(now, normal);
    return normal_ * normal + tangents_[0] * friction[0] + tangents_[1] * friction[1];
  }

  void applyForce() override {
    const Motion now = motion();
    const S normal = pushing(now);
    const std::array<S, 2> friction = frictionOf(now, normal);
    const Vector3<S> f = forceOf(now, normal);
    const Vector3<S> touching = now.place + fromPoint_ - normal_ * is_.radius;
    from_.f -= f;
    from_.tau -= touching.cross(f);
    const Vector3<S> about = (tangents_[0] * friction[1] - tangents_[1] * friction[0]) * is_.radius;
    const auto behind = [&](const Vector3<S>& x) {
      return Vector3<S>(now.toAxes.transpose() * Vector3<S>(now.fromAxes * x));
    };
    const Vector3<S> local = behind(f);
    to_->f += local;
    to_->tau += behind(about) + toPoint_.cross(local);
  }

  Frame<S>& from_;
  Frame<S>* to_;
  Vector3<S> fromPoint_, toPoint_;
  S length_;
  Vector3<S> direction_, normal_;
  std::array<Vector3<S>, 2> tangents_;
  Numbers is_;
};

}  // namespace

void PlaneContact::describe(Fields& f) {
  f.frame({"from", "", "the frame that the plane is fixed in"}, from);
  f.otherFrame({"to", "", "the frame of the point or sphere"}, to, from);
  f.vector({"from_point", "m", "a point of the plane, in `from`"}, fromPoint);
  f.axis({"normal", "", "of the plane, in `from`, to the side that is free; `\"z\"` unless given"}, normal);
  f.vector({"to_point", "m", "the point, or the sphere's centre, in `to`"}, toPoint);
  f.number({"radius", "m", "of the sphere; 0, a point, unless given"}, radius);
  f.number({"stiffness", "N/m", "", true}, stiffness);
  f.number({"damping", "s/m", "of the stiffness, by the speed of entering"}, damping);
  f.number({"friction", "1", "its coefficient; needs `slip_rate`"}, friction);
  f.number({"slip_rate", "m/s",
            "over which it is smoothed: at it, 71 % of the friction are there, at three times it 95 %, at ten times "
            "99.5 %"},
           slipRate);
  f.drawsPlane({from, fromPoint}, normal, {to, toPoint}, radius);
  f.measure({"gap", "m", "between sphere and plane; below 0 where they touch"});
  f.measure({"normal_force", "N", "that pushes them apart"});
  f.measure({"friction_force", "N", "its size"});
  f.measure({"slip", "m/s", "the size of the slip"});
  for (const char* component : components) {
    f.measure({std::string("force.") + component, "N", "on `to`, in the axes of `from`"});
    f.measure({std::string("slip.") + component, "m/s", "of the sphere's point, in the axes of `from`"});
  }
  f.measure({"power", "W", "that it brings in"});
}

template <class S>
void PlaneContact::assemble(Assembler<S>& a) const {
  using Contact = PlaneContactLoad<S>;
  typename Contact::Numbers numbers{a.number(radius),   a.number(stiffness), a.number(damping),
                                    a.number(friction), a.number(slipRate),  a.number(radius)};
  // Numbers, where they are some: what a kink is linear in.
  const std::optional<Interval> size = a.known(radius), held = a.known(damping), slow = a.known(slipRate);
  const Interval length = normal.length();
  if (!normal.isAligned()) numbers.reach = size ? constant<S>(*size * length) : numbers.radius * constant<S>(length);
  if (held && held->lower() > 0) numbers.fastest = constant<S>(length / *held);
  const auto isNothing = [](const std::optional<Interval>& value) { return value && isEqual(*value, Interval(0.0)); };
  numbers.isDamped = !isNothing(held);
  numbers.slips = !isNothing(slow);
  const auto& load =
      a.template add<Contact>(a.frame(from), a.vector(fromPoint), normal, a.frame(to), a.vector(toPoint), numbers);
  a.measure("gap", [&load] { return load.gap(); });
  a.measure("normal_force", [&load] { return load.normalForce(); });
  a.measure("friction_force", [&load] { return load.frictionForce(); });
  a.measure("slip", [&load] { return load.slipSpeed(); });
  for (int i = 0; i < 3; ++i) {
    const std::string component = components[i];
    a.measure("force." + component, [&load, i] { return S(load.force()[i]); });
    a.measure("slip." + component, [&load, i] { return S(load.slip()[i]); });
  }
  a.measure("power", [&load] { return load.power(); });
}

std::vector<Fault> PlaneContact::faults(const RangeOf& rangeOf) const {
  std::vector<Fault> found;
  if (rangeOf(stiffness).lower() <= 0)
    found.push_back({"stiffness", "the stiffness of '" + name + "' is not positive", "a stiffness above 0 N/m"});
  const auto check = [&](const char* key, const Expression& number, const char* expected) {
    if (rangeOf(number).lower() < 0)
      found.push_back({key, std::string("the ") + key + " of '" + name + "' is negative", expected});
  };
  check("radius", radius, "a radius of at least 0 m");
  check("damping", damping, "a damping of at least 0 s/m");
  check("friction", friction, "a coefficient of at least 0");
  const Interval slow = rangeOf(slipRate);
  const bool isNeeded = !isEqual(rangeOf(friction), Interval(0.0)) || !isEqual(slow, Interval(0.0));
  if (isNeeded && slow.lower() <= 0)
    found.push_back({"slip_rate", "the slip rate of '" + name + "' is not positive", "a slow speed above 0 m/s", true});
  return found;
}

GAMUT_ASSEMBLE(PlaneContact)

}  // namespace gamut
