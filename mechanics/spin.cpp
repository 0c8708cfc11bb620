// Which bodies are the same however they are turned, and frames for them that do not turn.
#include "mechanics/spin.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <unordered_set>

#include "mechanics/bodies.hpp"
#include "mechanics/load_on_axis.hpp"

namespace gamut {
namespace {

using Parts = std::vector<std::unique_ptr<Element<Recorded>>>;

/// The coordinate axis that has these components, if they are known to be 0, 0 and ±1.
std::optional<Axis> knownAxis(const Vector3<Recorded>& u) {
  std::array<double, 3> direction{};
  int ones = 0;
  for (int i = 0; i < 3; ++i) {
    const int node = u[i].node();
    const Recorder* recorder = Recorder::current();
    double& component = direction[i];
    component = recorder->isExactly(node, 1.0) ? 1.0 : recorder->isExactly(node, -1.0) ? -1.0 : 0.0;
    if (component == 0.0 && !isKnownZero(u[i])) return std::nullopt;
    ones += component != 0.0;
  }
  if (ones != 1) return std::nullopt;
  return Axis(direction[0], direction[1], direction[2]);
}

/// 1 where both point to one side, -1 otherwise, of two on one line.
double sameSide(const Axis& a, const Axis& b) {
  Interval product(0.0);
  for (std::size_t i = 0; i < 3; ++i) product += a.enclosure()[i] * b.enclosure()[i];  // 1 or -1, enclosed
  return product.lower() > 0 ? 1.0 : -1.0;
}

class Spinning {
 public:
  Spinning(Parts& parts, std::deque<Frame<Recorded>>& frames) : parts_(parts), frames_(frames) {
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (auto* transmission = dynamic_cast<Transmission<Recorded>*>(parts[i].get()))
        behind_[&transmission->from()].push_back({i, transmission});
      if (auto* inertia = dynamic_cast<Inertia<Recorded>*>(parts[i].get()))
        inertias_[&inertia->frame()].push_back(inertia);
    }
    // Outwards frames come later, so that inwards each has been seen when it is asked for.
    for (auto part = parts.rbegin(); part != parts.rend(); ++part)
      if (const auto* transmission = dynamic_cast<const Transmission<Recorded>*>(part->get()))
        if (carriesInertia(transmission->to())) carriers_.insert(&transmission->from());
  }

  void state() {
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (auto* joint = dynamic_cast<RevoluteJoint<Recorded>*>(parts_[i].get()))
        if (!unturned_.contains(&joint->to()) && carriesInertia(joint->to()) && isSymmetric(joint->to(), joint->axis()))
          restate(i, *joint, {&joint->from(), joint->axis(), {}});
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (const auto* axes = dynamic_cast<const BallAxes<Recorded>*>(parts_[i].get())) restate(i, *axes);
    Parts all;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      if (const auto ahead = ahead_.find(i); ahead != ahead_.end()) all.push_back(std::move(ahead->second));
      all.push_back(std::move(parts_[i]));
    }
    parts_ = std::move(all);
  }

  std::unordered_map<const Frame<Recorded>*, Unturned<Recorded>> unturned() && { return std::move(unturned_); }

 private:
  struct Behind {
    std::size_t part;
    Transmission<Recorded>* transmission;
  };

  bool carriesInertia(const Frame<Recorded>& frame) const {
    return inertias_.contains(&frame) || carriers_.contains(&frame);
  }

  /// Those that carry inertia.
  std::vector<Behind> behind(const Frame<Recorded>& frame) const {
    std::vector<Behind> result;
    if (const auto found = behind_.find(&frame); found != behind_.end())
      std::ranges::copy_if(found->second, std::back_inserter(result),
                           [&](const Behind& each) { return carriesInertia(each.transmission->to()); });
    return result;
  }
  std::vector<Inertia<Recorded>*> inertiasAt(const Frame<Recorded>& frame) const {
    const auto found = inertias_.find(&frame);
    return found == inertias_.end() ? std::vector<Inertia<Recorded>*>{} : found->second;
  }

  /// The axis of `link.from()` through its origin, as one of `link.to()` through its origin, if it is both.
  static std::optional<Axis> axisBehind(const RigidLink<Recorded>& link, const Axis& axis) {
    const auto isAlong = [&](int i) { return axis.isAligned() && i == axis.index(); };
    for (int i = 0; i < 3; ++i)
      if (!isAlong(i) && !isKnownZero(link.offset()[i])) return std::nullopt;
    if (link.rotation().isNone()) return axis;
    return axis.isAligned() ? knownAxis(link.rotation().toChild(axis.unit<Recorded>())) : std::nullopt;
  }

  /// Whether all that is moved by what moves the frame is the same however it is turned about its axis.
  bool isSymmetric(const Frame<Recorded>& frame, const Axis& axis) const {
    for (const Inertia<Recorded>* inertia : inertiasAt(frame)) {
      const auto* body = dynamic_cast<const MassElement<Recorded>*>(inertia);
      if (body == nullptr || !body->isKnownSymmetric(axis)) return false;
    }
    return std::ranges::all_of(behind(frame), [&](const Behind& each) {
      if (const auto* link = dynamic_cast<const RigidLink<Recorded>*>(each.transmission)) {
        const std::optional<Axis> next = axisBehind(*link, axis);
        return next && isSymmetric(link->to(), *next);
      }
      const auto* joint = dynamic_cast<const RevoluteJoint<Recorded>*>(each.transmission);
      return joint != nullptr && joint->axis().isParallelTo(axis) && isSymmetric(joint->to(), axis);
    });
  }

  /// Whatever moves `to` in K' moves a frame of its own in K°, with all bodies that are there. `before`: K° of K'.
  void restate(std::size_t part, Transmission<Recorded>& element, Unturned<Recorded> before) {
    Unturned<Recorded> here = before;
    here.frame = &frames_.emplace_back(element.to().name);
    if (auto* joint = dynamic_cast<RevoluteJoint<Recorded>*>(&element)) {
      joint->handOverSpeeds();
      here.turns.emplace_back(&joint->angle(), sameSide(joint->axis(), before.axis));
      ahead_[part] =
          std::make_unique<SpinningJoint<Recorded>>(*before.frame, *here.frame, joint->angle(), joint->axis());
    } else {
      const auto& link = static_cast<const RigidLink<Recorded>&>(element);
      here.axis = *axisBehind(link, before.axis);
      ahead_[part] = std::make_unique<RigidLink<Recorded>>(*before.frame, *here.frame, link.offset(), link.rotation());
    }
    for (Inertia<Recorded>* inertia : inertiasAt(element.to()))
      static_cast<MassElement<Recorded>*>(inertia)->moveTo(*here.frame);
    for (const auto& each : parts_)
      if (auto* load = dynamic_cast<LoadOnAxis<Recorded>*>(each.get()))
        load->moveAhead(element.to(), here.axis, *here.frame);
    unturned_.emplace(&element.to(), here);
    for (const Behind& each : behind(element.to())) restate(each.part, *each.transmission, here);
  }

  /// Bodies that are the same about all axes move in a frame of their own ahead of those of the ball, if they are all
  /// that it carries.
  void restate(std::size_t part, const BallAxes<Recorded>& axes) {
    const std::vector<Inertia<Recorded>*> inertias = inertiasAt(axes.to());
    const auto isBall = [](const Inertia<Recorded>* inertia) {
      const auto* body = dynamic_cast<const MassElement<Recorded>*>(inertia);
      return body != nullptr && body->isKnownBall();
    };
    if (carriers_.contains(&axes.to()) || inertias.empty() || !std::ranges::all_of(inertias, isBall)) return;
    Frame<Recorded>& here = frames_.emplace_back(axes.to().name);
    ahead_[part] = std::make_unique<RigidLink<Recorded>>(axes.from(), here, zeroVector<Recorded>());
    for (Inertia<Recorded>* inertia : inertias) static_cast<MassElement<Recorded>*>(inertia)->moveTo(here);
    unturned_.emplace(&axes.to(), Unturned<Recorded>{&here, axisZ, {}, &axes});
  }

  Parts& parts_;
  std::deque<Frame<Recorded>>& frames_;
  std::unordered_map<const Frame<Recorded>*, std::vector<Behind>> behind_;
  std::unordered_map<const Frame<Recorded>*, std::vector<Inertia<Recorded>*>> inertias_;
  std::unordered_set<const Frame<Recorded>*> carriers_;                        // of frames that carry inertia
  std::unordered_map<std::size_t, std::unique_ptr<Element<Recorded>>> ahead_;  // of these parts
  std::unordered_map<const Frame<Recorded>*, Unturned<Recorded>> unturned_;
};

}  // namespace

std::unordered_map<const Frame<Recorded>*, Unturned<Recorded>> stateAheadOfSpin(
    std::vector<std::unique_ptr<Element<Recorded>>>& parts, std::deque<Frame<Recorded>>& frames) {
  if (Recorder::current() == nullptr) return {};  // nothing is known of numbers
  Spinning spinning(parts, frames);
  spinning.state();
  return std::move(spinning).unturned();
}

}  // namespace gamut
