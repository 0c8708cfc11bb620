#include "mechanics/triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "mechanics/closing.hpp"
#include "mechanics/joints.hpp"
#include "mechanics/seen.hpp"

namespace gamut {
namespace {

/// A vector of the plane, or a direction in it: a complex number.
template <class S>
struct Planar {
  S x = S(0.0), y = S(0.0);

  friend Planar operator+(const Planar& a, const Planar& b) { return {a.x + b.x, a.y + b.y}; }
  friend Planar operator-(const Planar& a, const Planar& b) { return {a.x - b.x, a.y - b.y}; }
  friend Planar operator-(const Planar& a) { return {-a.x, -a.y}; }
  friend Planar operator*(const Planar& a, const S& b) { return {a.x * b, a.y * b}; }
  friend Planar operator*(const Planar& a, const Planar& b) { return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x}; }
  Planar conjugate() const { return {x, -y}; }
  S squared() const { return square(x) + square(y); }
};

template <class S>
S dot(const Planar<S>& a, const Planar<S>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class S>
S cross(const Planar<S>& a, const Planar<S>& b) {
  return a.x * b.y - a.y * b.x;
}
/// z of z a = r.
template <class S>
Planar<S> direction(const Planar<S>& a, const Planar<S>& r) {
  if (isKnownZero(a.y)) return r * S(S(1.0) / a.x);
  return r * a.conjugate() * S(S(1.0) / a.squared());
}

/// What is not known to be in the plane.
struct Spatial {};

template <class S>
void require(double number, const S& x) {
  if constexpr (std::is_same_v<S, Recorded>) {
    if (!Recorder::current()->isExactly(x.node(), number)) throw Spatial();
  } else if (x != number) {
    throw Spatial();
  }
}

/// A point of a frame, and the frame's axes.
template <class S>
struct Carried {
  Planar<S> at, turn;
  S height;  ///< above the plane
};

/// Looks at the plane across a coordinate axis of all frames of a loop.
template <class S>
class View {
 public:
  explicit View(int normal) : i_((normal + 1) % 3), j_((normal + 2) % 3), k_(normal) {}

  bool isAlong(const Axis& axis) const { return axis.isAligned() && axis.index() == k_; }

  /// As `base` sees it, which the frame hangs on.
  Carried<S> operator()(const Frame<S>& base, const CarriedPoint<S>& point) const {
    const auto [moving, turning] = seenFrom<S>(&base, point.frame, point.place);
    const Matrix3<S>& axes = turning.axes;
    require(1.0, axes(k_, k_));
    for (const int other : {i_, j_}) {
      require(0.0, axes(other, k_));
      require(0.0, axes(k_, other));
    }
    return {flat(moving.position), {axes(i_, i_), axes(j_, i_)}, moving.position[k_]};
  }
  Carried<S> operator()(const Frame<S>& base, Frame<S>& frame) const {
    return (*this)(base, CarriedPoint<S>{&frame, zeroVector<S>()});
  }
  Rotation<S> turned(const Planar<S>& z) const {
    const std::array<double, 3> normal = {k_ == 0 ? 1.0 : 0.0, k_ == 1 ? 1.0 : 0.0, k_ == 2 ? 1.0 : 0.0};
    return Rotation<S>(Axis(normal[0], normal[1], normal[2]), z.x, z.y);
  }
  Planar<S> along(const Axis& axis) const {
    const Vector3<S> unit = axis.unit<S>();
    require(0.0, unit[k_]);
    return flat(unit);
  }

 private:
  Planar<S> flat(const Vector3<S>& x) const { return {x[i_], x[j_]}; }

  int i_, j_, k_;
};

/// A joint that closes the loop: either of both.
template <class S>
struct Leg {
  RevoluteJoint<S>* hinge = nullptr;
  PrismaticJoint<S>* slide = nullptr;

  const Transmission<S>& joint() const {
    if (hinge != nullptr) return *hinge;
    return *slide;
  }
};

template <class S>
std::vector<Leg<S>> legsOf(std::span<Variable<S>* const> by, const Chain<S>& chain) {
  std::vector<Leg<S>> legs;
  for (const Variable<S>* variable : by)
    for (Element<S>* element : chain.elements()) {
      if (auto* hinge = dynamic_cast<RevoluteJoint<S>*>(element); hinge != nullptr && &hinge->angle() == variable)
        legs.push_back({hinge, nullptr});
      if (auto* slide = dynamic_cast<PrismaticJoint<S>*>(element); slide != nullptr && &slide->path() == variable)
        legs.push_back({nullptr, slide});
    }
  return legs;
}

/// Those that a frame hangs on, the innermost first.
template <class S>
std::vector<Leg<S>> carriersOf(const Frame<S>* frame, const std::vector<Leg<S>>& legs) {
  std::vector<Leg<S>> carriers;
  for (; frame->origin != nullptr; frame = &frame->origin->from())
    for (const Leg<S>& leg : legs)
      if (frame->origin == &leg.joint()) carriers.insert(carriers.begin(), leg);
  return carriers;
}

/// Points that a pin or a rod holds, the first of which the first joint carries, and what the other one does.
template <class S>
class PlanarTriangle final : public Triangle<S> {
 public:
  enum class Kind { sideBySide, inTurn, withRod };

  /// `views`: of planes that it may be in.
  PlanarTriangle(std::vector<View<S>> views, Kind kind, std::vector<Leg<S>> legs, std::array<CarriedPoint<S>, 2> points,
                 S rodLength)
      : views_(std::move(views)),
        view_(views_.front()),
        kind_(kind),
        legs_(std::move(legs)),
        points_(std::move(points)),
        rodLength_(std::move(rodLength)) {}

  std::vector<S> given() override {
    const auto isSeen = [this](const View<S>& view) {
      view_ = view;
      try {
        look();
        return true;
      } catch (const Spatial&) {
        return false;
      }
    };
    if (std::ranges::none_of(views_, isSeen)) return {};
    std::vector<S> all = {squaredLength_};
    for (const Planar<S>* each : {&a_, &b_, &c_, &d_, &e_, &on_[0], &on_[1]}) all.insert(all.end(), {each->x, each->y});
    return all;
  }

  S side() const override {
    using std::cos, std::sin, std::sqrt;
    if (const PrismaticJoint<S>* slide = slideOf())
      return (slide->path().position + dot(c_, d_)) / sqrt(squaredLength_);
    const RevoluteJoint<S>& hinge = *legs_[0].hinge;
    const S& angle = hinge.angle().position;
    const Planar<S> z = on_[0] * Planar<S>{cos(angle), S(hinge.axis().sign()) * sin(angle)};
    return cross(e_, z * a_) / sqrt(e_.squared() * a_.squared());
  }

  std::vector<S> margins() const override {
    using std::sqrt;
    const S l = sqrt(squaredLength_);
    if (slideOf() != nullptr) {
      const S distance = cross(c_, d_);
      return {squaredLength_, l - distance, l + distance};
    }
    const S a = sqrt(a_.squared()), e = sqrt(e_.squared());
    return {squaredLength_, a + l - e, e + l - a, e + a - l};
  }

  void place(double side) override {
    using std::sqrt;
    placed_.clear();
    if (PrismaticJoint<S>* slide = slideOf()) {
      const S s = S(side) * sqrt(squaredLength_ - square(cross(c_, d_))) - dot(c_, d_);
      slide->path().position = s;
      const Planar<S> arm = c_ + d_ * s;
      for (std::size_t i = 0; i < legs_.size(); ++i)
        if (legs_[i].hinge != nullptr) turn(i, isSlideOnHinge() ? direction(arm, e_) : direction(a_, arm), on_[i]);
      return;
    }
    const S squared = a_.squared(), inverse = S(1.0) / e_.squared();
    const S m = S(0.5) + S(0.5) * ((squared - squaredLength_) * inverse);
    const Planar<S> r = e_ * Planar<S>{m, S(side) * sqrt(squared * inverse - square(m))};
    const Planar<S> z = direction(a_, r);
    turn(0, z, on_[0]);
    if (kind_ != Kind::withRod) turn(1, direction(b_, e_ - r), kind_ == Kind::inTurn ? z * on_[1] : on_[1]);
  }

  const std::vector<PlacedHinge<S>>& placed() const override { return placed_; }

  void release() override {
    for (Leg<S>& leg : legs_)
      if (leg.hinge != nullptr) leg.hinge->standByAngle();
  }

 private:
  PrismaticJoint<S>* slideOf() const {
    for (const Leg<S>& leg : legs_)
      if (leg.slide != nullptr) return leg.slide;
    return nullptr;
  }
  bool isSlideOnHinge() const { return kind_ == Kind::inTurn && legs_[1].slide != nullptr; }

  void turn(std::size_t leg, const Planar<S>& z, const Planar<S>& on) {
    RevoluteJoint<S>& hinge = *legs_[leg].hinge;
    const Planar<S> by = z * on.conjugate();
    const S sine = S(hinge.axis().sign()) * by.y;
    hinge.standBy(by.x, sine, view_.turned(z).after(base_->R));
    placed_.push_back({&hinge.angle(), by.x, sine});
  }

  void look() {
    const Leg<S>& first = legs_[0];
    const Transmission<S>& joint = first.joint();
    const Transmission<S>* other = kind_ == Kind::withRod ? nullptr : &legs_[1].joint();
    base_ = commonBase<S>(&joint.from(), kind_ == Kind::sideBySide ? &other->from() : points_[1].frame);
    const Frame<S>& base = *base_;
    const Carried<S> foot = view_(base, joint.from());
    on_[0] = foot.turn;
    if (kind_ == Kind::sideBySide) {
      const Carried<S> otherFoot = view_(base, other->from());
      const Planar<S> arm = view_(joint.to(), points_[0]).at, otherArm = view_(other->to(), points_[1]).at;
      on_[1] = otherFoot.turn;
      if (legs_[1].slide != nullptr) {
        a_ = arm;
        c_ = otherFoot.at + on_[1] * otherArm - foot.at;
        d_ = on_[1] * view_.along(legs_[1].slide->axis());
        squaredLength_ = a_.squared();
      } else {
        a_ = arm;
        b_ = -otherArm;
        e_ = otherFoot.at - foot.at;
        squaredLength_ = b_.squared();
      }
      return;
    }
    const Carried<S> end = view_(base, points_[1]);
    if (kind_ == Kind::withRod) {
      const Carried<S> arm = view_(joint.to(), points_[0]);
      squaredLength_ = square(rodLength_) - square(foot.height + arm.height - end.height);
      if (first.slide != nullptr) {
        c_ = foot.at + on_[0] * arm.at - end.at;
        d_ = on_[0] * view_.along(first.slide->axis());
      } else {
        a_ = arm.at;
        e_ = end.at - foot.at;
      }
      return;
    }
    const Carried<S> elbow = view_(joint.to(), other->from());
    const Planar<S> arm = view_(other->to(), points_[0]).at;
    if (first.slide != nullptr) {
      on_[1] = on_[0] * elbow.turn;
      a_ = arm;
      c_ = end.at - foot.at - on_[0] * elbow.at;
      d_ = -(on_[0] * view_.along(first.slide->axis()));
      squaredLength_ = a_.squared();
      return;
    }
    on_[1] = elbow.turn;
    e_ = end.at - foot.at;
    if (legs_[1].slide != nullptr) {
      c_ = elbow.at + elbow.turn * arm;
      d_ = elbow.turn * view_.along(legs_[1].slide->axis());
      squaredLength_ = e_.squared();
    } else {
      a_ = elbow.at;
      b_ = arm;
      squaredLength_ = b_.squared();
    }
  }

  std::vector<View<S>> views_;
  View<S> view_;
  Kind kind_;
  std::vector<Leg<S>> legs_;
  std::array<CarriedPoint<S>, 2> points_;
  S rodLength_;
  const Frame<S>* base_ = nullptr;  // in whose plane all this is
  Planar<S> a_, b_, c_, d_, e_;
  S squaredLength_ = S(0.0);
  std::vector<PlacedHinge<S>> placed_;
  std::array<Planar<S>, 2> on_;  // directions of what carries the joints; of the outer of two in turn, on the inner one
};

}  // namespace

template <class S>
std::unique_ptr<Triangle<S>> Triangle<S>::of(const Constraint<S>& closing, std::span<Variable<S>* const> by,
                                             const Chain<S>& chain) {
  using Kind = typename PlanarTriangle<S>::Kind;
  const auto* pin = dynamic_cast<const Closing<S>*>(&closing);
  const auto* rod = dynamic_cast<const Rod<S>*>(&closing);
  const bool isPin = pin != nullptr && pin->isPin();
  const std::vector<Leg<S>> legs = legsOf(by, chain);
  if (legs.size() != by.size() || (isPin ? legs.size() != 2 : rod == nullptr || legs.size() != 1)) return nullptr;
  std::array<CarriedPoint<S>, 2> points = isPin ? pin->ends() : rod->ends();
  std::array<std::vector<Leg<S>>, 2> carriers = {carriersOf(points[0].frame, legs), carriersOf(points[1].frame, legs)};
  // The point that both joints carry first; of joints side by side the one that a hinge carries.
  const auto isBefore = [&](std::size_t i, std::size_t k) {
    if (carriers[i].size() != carriers[k].size()) return carriers[i].size() > carriers[k].size();
    return !carriers[i].empty() && carriers[i][0].hinge != nullptr && carriers[k][0].hinge == nullptr;
  };
  if (isBefore(1, 0)) {
    std::swap(points[0], points[1]);
    std::swap(carriers[0], carriers[1]);
  }
  std::vector<Leg<S>> ordered = carriers[0];
  ordered.insert(ordered.end(), carriers[1].begin(), carriers[1].end());
  if (ordered.size() != legs.size()) return nullptr;
  const auto hinge = std::ranges::find_if(ordered, [](const Leg<S>& leg) { return leg.hinge != nullptr; });
  std::vector<View<S>> views;
  if (hinge != ordered.end() && hinge->hinge->axis().isAligned()) views.emplace_back(hinge->hinge->axis().index());
  if (hinge == ordered.end() && !isPin)  // a slide and a rod: across the slide, either way
    for (const int normal : {0, 1, 2}) views.emplace_back(normal);
  if (views.empty()) return nullptr;
  for (const Leg<S>& leg : ordered)
    if (leg.hinge != nullptr && !views.front().isAlong(leg.hinge->axis())) return nullptr;
  if (isPin && !views.front().isAlong(pin->axis())) return nullptr;
  const Kind kind = !isPin ? Kind::withRod : carriers[1].empty() ? Kind::inTurn : Kind::sideBySide;
  return std::make_unique<PlanarTriangle<S>>(std::move(views), kind, std::move(ordered), std::move(points),
                                             isPin ? S(0.0) : rod->length());
}

template class Triangle<double>;
template class Triangle<Recorded>;

}  // namespace gamut
