// Elements say what is seen of them: frames that they move, and by what, bodies, springs.
#include "mechanics/skeleton.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "mechanics/assembly.hpp"
#include "mechanics/polyhedron.hpp"
#include "mechanics/rotation.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// What one element says that is seen of it.
class Seen final : public Onlooker {
 public:
  struct Moved {
    std::string from, to;
  };
  struct Body {
    FixedPoint centre;
    Expression mass;
    std::vector<Expression> inertia;
  };
  struct Line {
    FixedPoint from, to;
  };
  struct Spring {
    Line ends;
    SeenSpring is;
  };
  struct JointSpring {
    std::string coordinate;
    SeenSpring is;
  };
  struct Rubbing {
    std::string coordinate;
    SeenFriction is;
  };
  struct Gearing {
    std::string leader, follower;
    Expression ratio;
  };
  struct Plane {
    FixedPoint at;
    Axis normal;
    FixedPoint over;
    Expression radius;
  };
  struct Profile {
    std::string coordinate;
    Expression speed;
    Axis along;
  };
  struct Joint {
    FixedPoint at;
    int turns, slides;
  };
  struct JointAxis {
    std::string key, frame;
    Axis axis;
  };
  void movedFrame(const Word&, std::string& name, const std::string& from) override { moved.push_back({from, name}); }
  void carriesMass(const FixedPoint& centre, const Expression& mass, std::span<const Expression> inertia) override {
    bodies.push_back({centre, mass, {inertia.begin(), inertia.end()}});
  }
  void drawsSpring(const FixedPoint& from, const FixedPoint& to, const SeenSpring& spring) override {
    springs.push_back({{from, to}, spring});
  }
  void drawsJointSpring(const std::string& coordinate, const SeenSpring& spring) override {
    jointSprings.push_back({coordinate, spring});
  }
  void drawsMotor(const std::string& coordinate) override { motors.push_back(coordinate); }
  void drawsFriction(const std::string& coordinate, const SeenFriction& is) override {
    frictions.push_back({coordinate, is});
  }
  void drawsGear(const std::string& leader, const std::string& follower, const Expression& ratio) override {
    gears.push_back({leader, follower, ratio});
  }
  void drawsPlane(const FixedPoint& at, const Axis& normal, const FixedPoint& over, const Expression& radius) override {
    planes.push_back({at, normal, over, radius});
  }
  void drawsProfile(const std::string& coordinate, const Expression& speed, const Axis& along) override {
    profiles.push_back({coordinate, speed, along});
  }
  void drawsWheel(const Axis& axle, const Expression& itsRadius) override { wheel = {axle, itsRadius}; }
  void drawsLink(const FixedPoint& from, const FixedPoint& to) override { links.push_back({from, to}); }
  void drawsJoint(const FixedPoint& at, int itsTurns, int itsSlides) override {
    joints.push_back({at, itsTurns, itsSlides});
  }
  void jointAxis(const Word& word, Axis& axis, const std::string& frame) override {
    axes.push_back({word.key, frame, axis});
  }
  void drawsShape(const SeenShape& what) override { shape = what; }
  void drawsPlay(const Expression& clearance) override { play = clearance; }
  void coordinate(const Word& word, Expression&, Coordinate kind, const Word&, Expression&) override {
    ++(kind == Coordinate::angle ? turns : slides);
    position = word.key;
  }
  void speed(const Word& word, Expression&) override { ++(word.unit == "rad/s" ? turns : slides); }
  Coordinate coordinateOf(const Word&, std::string& name) override {
    at = name;
    return Coordinate::angle;
  }
  Coordinate drivenCoordinate(const Word& word, std::string& name) override {
    drives = true;
    return coordinateOf(word, name);
  }
  Coordinate followingCoordinate(const Word& word, std::string& name, const std::string&) override {
    return drivenCoordinate(word, name);
  }
  void signal(const Word&, Expression&) override { drives = true; }

  std::vector<Moved> moved;
  std::vector<Body> bodies;
  std::vector<Line> links;
  std::vector<Spring> springs;
  std::vector<JointSpring> jointSprings;
  std::vector<std::string> motors;  // coordinates
  std::vector<Rubbing> frictions;
  std::vector<Gearing> gears;
  std::vector<Plane> planes;
  std::vector<Profile> profiles;
  std::optional<std::pair<Axis, Expression>> wheel;
  std::vector<Joint> joints;
  std::vector<JointAxis> axes;
  std::optional<SeenShape> shape;
  std::optional<Expression> play;  // its clearance
  int turns = 0, slides = 0;
  std::string position;  // the last coordinate
  std::string at;        // the coordinate that it names
  bool drives = false;   // by a motion, or by a force of any kind
};

class Finder {
 public:
  Finder(const Mechanism& mechanism, const std::vector<std::string>& freeParameters)
      : mechanism_(mechanism), freeParameters_(freeParameters) {
    for (Described element : mechanism.elements()) take(element);
    for (const Disc& disc : discs_)
      if (isMeantToTurn(disc.frame))
        addWheel(disc.element, disc.type, disc.frame, disc.centre, turning_.at(disc.frame).axis, disc.radius);
  }

  Skeleton skeleton;

 private:
  void take(Described& element) {
    Seen seen;
    element.describe(seen);
    using enum Skeleton::Kind;
    const std::string& name = element.name();
    for (const auto& [from, to] : seen.moved) {
      const bool isJoint = seen.turns + seen.slides > 0;
      if (!isJoint && std::ranges::count(ground_, from) > 0) ground_.push_back(to);
      carrier_[to] = isJoint ? to : carrierOf(from);
      addAxes(name, seen);
      if (seen.shape) {
        addShape(element, *seen.shape);
        continue;
      }
      const std::size_t first = pointOf(from), second = pointOf(to);
      skeleton.parts.push_back({name, element.type(), seen.play ? play : (isJoint ? joint : rigid), first, second,
                                seen.turns, seen.slides, 0.0, seen.play.value_or(0.0)});
      if (seen.turns == 1 && seen.slides == 0 && seen.axes.size() == 1)
        turning_.emplace(to, Turning{name, from, seen.axes.front().axis});
      if (seen.turns + seen.slides == 1 && seen.axes.size() == 1)
        joints_.push_back({skeleton.parts.size() - 1, seen.axes.front().frame, to, seen.axes.front().axis,
                           name + "." + seen.position});
      if (seen.wheel) addWheel(name, element.type(), to, second, seen.wheel->first, seen.wheel->second);
    }
    for (const std::string& coordinate : {seen.drives ? seen.at : "", seen.gears.empty() ? "" : seen.gears[0].leader})
      if (const Skeleton::Part* joint = coordinate.empty() ? nullptr : jointOf(coordinate)) driven_.insert(joint->name);
    for (const Seen::Body& body : seen.bodies) addBody(element, body);
    for (const auto& [ends, is] : seen.springs) {
      if (!isNothing(is.stiffness)) addLine(element, spring, ends);
      if (!isNothing(is.damping)) addLine(element, damper, ends);
    }
    for (const Seen::Line& link : seen.links) addLine(element, rigid, link);
    for (const auto& [coordinate, is] : seen.jointSprings) {
      if (!isNothing(is.stiffness)) addAtJoint(element, spring, coordinate);
      if (!isNothing(is.damping)) addAtJoint(element, damper, coordinate);
    }
    for (const std::string& coordinate : seen.motors) addAtJoint(element, motor, coordinate);
    for (const auto& [coordinate, is] : seen.frictions)
      if (!isNothing(is.dry) || !isNothing(is.viscous)) addAtJoint(element, friction, coordinate);
    for (const Seen::Gearing& gearing : seen.gears) addGear(element, gearing);
    for (const Seen::Plane& contact : seen.planes) addPlane(element, contact);
    for (const Seen::Profile& road : seen.profiles)
      if (!isNothing(road.speed) || isFree(road.speed)) addProfile(element, road);
    for (const auto& [at, turns, slides] : seen.joints) {
      if (turns < 3) addAxes(name, seen);
      const std::size_t place = pointOf(name + ".at", at);
      skeleton.parts.push_back({name, element.type(), joint, place, place, turns, slides, 0.0});
    }
  }

  bool isNothing(const Expression& number) const {
    const Interval range = mechanism_.rangeOf(number);
    return range.lower() == 0 && range.upper() == 0;
  }

  bool isFree(const Expression& number) const {
    return std::ranges::any_of(freeParameters_,
                               [&](const std::string& name) { return mechanism_.dependsOn(number, name); });
  }

  void addLine(const Described& element, Skeleton::Kind kind, const Seen::Line& line) {
    const std::size_t first = pointOf(element.name() + ".from", line.from),
                      second = pointOf(element.name() + ".to", line.to);
    skeleton.parts.push_back({element.name(), element.type(), kind, first, second, 0, 0, 0.0});
  }

  /// A joint of one freedom, along or about one axis.
  struct SimpleJoint {
    std::size_t part;
    std::string from, to;  // frames
    Axis axis;
    std::string position;  // the coordinate
  };

  const Skeleton::Part* jointOf(const std::string& coordinate) const {
    const auto joint = std::ranges::find_if(skeleton.parts, [&](const Skeleton::Part& part) {
      return part.kind == Skeleton::Kind::joint && (part.name == coordinate || coordinate.starts_with(part.name + "."));
    });
    return joint == skeleton.parts.end() ? nullptr : &*joint;
  }
  const SimpleJoint* simpleJointOf(const std::string& coordinate) const {
    const Skeleton::Part* part = jointOf(coordinate);
    const auto joint =
        std::ranges::find_if(joints_, [&](const SimpleJoint& one) { return &skeleton.parts[one.part] == part; });
    return joint == joints_.end() ? nullptr : &*joint;
  }
  /// What a frame is fixed to, by links alone.
  std::string carrierOf(const std::string& frame) const {
    const auto found = carrier_.find(frame);
    return found == carrier_.end() ? frame : found->second;
  }

  /// Of a joint with one freedom: where there are several, one would lie upon the other.
  void addAtJoint(const Described& element, Skeleton::Kind kind, const std::string& coordinate) {
    const Skeleton::Part* joint = jointOf(coordinate);
    if (joint == nullptr || joint->turns + joint->slides != 1) return;
    skeleton.parts.push_back(
        {element.name(), element.type(), kind, joint->from, joint->to, joint->turns, joint->slides, 0.0});
  }

  void addBody(const Described& element, const Seen::Body& body) {
    const auto& [centre, mass, inertia] = body;
    const std::size_t first = pointOf(centre.frame), second = pointOf(element.name() + ".centre", centre);
    skeleton.parts.push_back({element.name(), element.type(), Skeleton::Kind::mass, first, second, 0, 0, mass});
    const auto turning = turning_.find(centre.frame);
    if (turning == turning_.end() || !turning->second.axis.isAligned() || inertia.empty() || isNothing(mass)) return;
    const auto axis = static_cast<std::size_t>(turning->second.axis.index());
    const Expression &about = inertia[axis], &across = inertia[(axis + 1) % 3], &other = inertia[(axis + 2) % 3];
    const bool isSymmetric = !isEmpty(intersection(mechanism_.rangeOf(across), mechanism_.rangeOf(other)));
    if (isNothing(about) || !isSymmetric ||
        !std::ranges::all_of(centre.place, [&](const Expression& x) { return isNothing(x); }))
      return;
    discs_.push_back({element.name(), element.type(), centre.frame, second, sqrt(Expression(2.0) * about / mass)});
  }

  /// What a motion, a motor, a gear or another force is given to turns, and what hangs on it with the same axis: others
  /// may but swing.
  bool isMeantToTurn(const std::string& frame) const {
    auto joint = turning_.find(frame);
    const Axis& axis = joint->second.axis;
    while (joint != turning_.end() && joint->second.axis.isParallelTo(axis)) {
      if (driven_.contains(joint->second.element)) return true;
      joint = turning_.find(carrierOf(joint->second.from));
    }
    return false;
  }

  void addWheel(const std::string& name, const std::string& type, const std::string& frame, std::size_t centre,
                const Axis& axle, const Expression& radius) {
    addSpokes(name, frame, axle);
    skeleton.parts.push_back({name, type, Skeleton::Kind::wheel, centre, centre, 0, 0, 0.0, radius});
  }

  /// Wheels whose radii have the ratio, where both joints turn and one body carries them; and one of a known radius
  /// where a joint turns and the other slides.
  void addGear(const Described& element, const Seen::Gearing& gearing) {
    const Skeleton::Part *first = jointOf(gearing.leader), *second = jointOf(gearing.follower);
    if (first == nullptr || second == nullptr) return;
    Skeleton::Part gear{element.name(), element.type(), Skeleton::Kind::gear, first->to, second->to, 0, 0, 0.0};
    gear.ratio = gearing.ratio;
    const SimpleJoint *leader = simpleJointOf(gearing.leader), *follower = simpleJointOf(gearing.follower);
    const auto isSeen = [&](const SimpleJoint* joint) {
      return joint != nullptr && (skeleton.parts[joint->part].turns == 0 || joint->axis.isAligned());
    };
    if (isSeen(leader) && isSeen(follower) && !contains(mechanism_.rangeOf(gearing.ratio), 0)) {
      gear.turns = first->turns + second->turns;
      if (gear.turns == 1) gear.radius = first->turns == 1 ? gearing.ratio : Expression(1.0) / gearing.ratio;
      if (gear.turns == 1 && first->turns == 1) {
        std::swap(leader, follower);
        std::swap(gear.from, gear.to);
      }
      if (gear.turns == 1 || (gear.turns == 2 && carrierOf(leader->from) == carrierOf(follower->from)))
        for (const SimpleJoint* joint : {leader, follower}) addDirections(element.name(), *joint);
    }
    skeleton.parts.push_back(gear);
  }
  /// Of the part that comes next.
  void addDirections(const std::string& name, const SimpleJoint& joint) {
    const std::string which = name + "." + skeleton.parts[joint.part].name;
    if (skeleton.parts[joint.part].turns == 1)
      addSpokes(which, joint.to, joint.axis);
    else
      skeleton.axes.push_back({which + ".axis", skeleton.parts.size(), joint.from, joint.axis});
  }
  void addSpokes(const std::string& name, const std::string& frame, const Axis& axle) {
    const std::array next{axisY, axisZ, axisX};
    skeleton.axes.push_back({name + ".axle", skeleton.parts.size(), frame, axle});
    skeleton.axes.push_back(
        {name + ".spoke", skeleton.parts.size(), frame, next[static_cast<std::size_t>(axle.index())]});
  }

  void addPlane(const Described& element, const Seen::Plane& contact) {
    const std::string& name = element.name();
    const auto isAtOrigin = [&](const FixedPoint& point) {
      return std::ranges::all_of(point.place, [&](const Expression& x) { return isNothing(x); });
    };
    const auto placed = [&](const FixedPoint& point, const char* key) {
      return isAtOrigin(point) ? pointOf(point.frame) : pointOf(name + key, point);
    };
    const std::size_t at = placed(contact.at, ".from_point"), over = placed(contact.over, ".to_point");
    skeleton.axes.push_back({name + ".normal", skeleton.parts.size(), contact.at.frame, contact.normal});
    skeleton.parts.push_back({name, element.type(), Skeleton::Kind::plane, at, over, 0, 0, 0.0});
    if (!isNothing(contact.radius))
      skeleton.parts.push_back({name, element.type(), Skeleton::Kind::shape, over, over, 0, 0, 0.0, contact.radius});
  }

  static bool isAlong(const Axis& one, const Axis& other) {
    const std::array<double, 3> a = one.direction(), b = other.direction();
    return a[1] * b[2] == a[2] * b[1] && a[2] * b[0] == a[0] * b[2] && a[0] * b[1] == a[1] * b[0];
  }

  /// Of a joint that slides across the way ahead.
  void addProfile(const Described& element, const Seen::Profile& road) {
    const SimpleJoint* joint = simpleJointOf(road.coordinate);
    if (joint == nullptr || skeleton.parts[joint->part].slides != 1 || isAlong(joint->axis, road.along)) return;
    const Skeleton::Part& slide = skeleton.parts[joint->part];
    Skeleton::Part profile{element.name(), element.type(), Skeleton::Kind::profile, slide.from, slide.to, 0, 0, 0.0};
    profile.speed = road.speed;
    profile.height = joint->position;
    skeleton.axes.push_back({element.name() + ".up", skeleton.parts.size(), joint->from, joint->axis});
    skeleton.axes.push_back({element.name() + ".along", skeleton.parts.size(), joint->from, road.along});
    skeleton.parts.push_back(profile);
  }

  /// Of the part that comes next.
  void addAxes(const std::string& name, const Seen& seen) {
    for (const auto& [key, frame, axis] : seen.axes)
      skeleton.axes.push_back({name + "." + key, skeleton.parts.size(), frame, axis});
  }

  /// By lines between points of the shape's own frame: a segment, or the edges of a box or a polyhedron.
  void addShape(const Described& element, const SeenShape& shape) {
    const std::string& name = element.name();
    const ExpressionVector middle = {0.0, 0.0, 0.0};
    const auto add = [&](std::size_t from, std::size_t to) {
      skeleton.parts.push_back({name, element.type(), Skeleton::Kind::shape, from, to, 0, 0, 0.0, shape.radius});
    };
    if (shape.size) {
      std::array<std::size_t, 8> corners{};
      for (unsigned corner = 0; corner < 8; ++corner) {
        ExpressionVector place = middle;
        for (std::size_t i = 0; i < 3; ++i)
          place[i] = Expression((corner >> i & 1U) != 0 ? 0.5 : -0.5) * (*shape.size)[i];
        corners[corner] = pointOf(name + ".corner" + std::to_string(corner + 1), {name, place});
      }
      for (unsigned corner = 0; corner < 8; ++corner)
        for (unsigned along = 1; along < 8; along *= 2)
          if ((corner & along) == 0) add(corners[corner], corners[corner | along]);
      return;
    }
    if (!shape.points.empty()) {
      const auto exact = exactPoints(shape.points);
      if (!exact) return;
      const Polyhedron hull(*exact);
      std::vector<std::size_t> corners;
      for (const Polyhedron::Point& corner : hull.corners())
        corners.push_back(pointOf(name + ".corner" + std::to_string(corners.size() + 1),
                                  {name, {enclosureOf(corner[0]), enclosureOf(corner[1]), enclosureOf(corner[2])}}));
      for (const Polyhedron::Edge& edge : hull.edges()) add(corners[edge.from], corners[edge.to]);
      return;
    }
    std::array<ExpressionVector, 2> ends = {middle, middle};
    const std::array<Interval, 3> axis = shape.axis.enclosure();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t end = 0; end < 2; ++end)
        ends[end][i] = Expression(axis[i] * Interval(end == 0 ? -0.5 : 0.5)) * shape.length;
    const std::size_t first = pointOf(name + ".start", {name, ends[0]});
    add(first, pointOf(name + ".end", {name, ends[1]}));
  }

  std::size_t pointOf(const std::string& frame) {
    const auto found = std::ranges::find(skeleton.points, frame, &Skeleton::Point::name);
    if (found == skeleton.points.end()) return pointOf(frame, FixedPoint{frame});
    return static_cast<std::size_t>(found - skeleton.points.begin());
  }
  std::size_t pointOf(const std::string& name, const FixedPoint& at) {
    skeleton.points.push_back({name, at.frame, at.place, false, std::ranges::count(ground_, at.frame) > 0});
    return skeleton.points.size() - 1;
  }

  /// What turns a frame.
  struct Turning {
    std::string element, from;
    Axis axis;
  };
  /// A body that is the same all around the axis about which its frame turns: seen as a disc of its moment of inertia.
  struct Disc {
    std::string element, type, frame;
    std::size_t centre;
    Expression radius;
  };

  const Mechanism& mechanism_;
  const std::vector<std::string>& freeParameters_;
  std::vector<std::string> ground_{Mechanism::inertialFrame};  // frames
  std::map<std::string, Turning> turning_;                     // frames
  std::set<std::string> driven_;                               // elements of joints
  std::vector<Disc> discs_;
  std::map<std::string, std::string> carrier_;  // of frames: the outermost that they are fixed to
  std::vector<SimpleJoint> joints_;
};

/// x, y, z of every vector that `vectorOf` makes of what is in the list.
template <class S, class List, class VectorOf>
std::vector<S> componentsOf(const List& list, const VectorOf& vectorOf) {
  std::vector<S> all;
  for (const auto& one : list) {
    const Vector3<S> vector = vectorOf(one);
    for (int i = 0; i < 3; ++i) all.push_back(vector[i]);
  }
  return all;
}

template <class S>
MovingPoint<S> movingPoint(const Assembly<S>& assembly, const Skeleton::Point& point) {
  Vector3<S> offset;
  for (int i = 0; i < 3; ++i) offset[i] = assembly.number(point.offset[i]);
  return assembly.frame(point.frame).inInertial({offset, zeroVector<S>()});
}

/// Points of the same nodes in the recorded program are one.
void join(Skeleton& skeleton, const Program& positions) {
  std::vector<Skeleton::Point> points;
  std::vector<std::vector<int>> known;
  std::vector<std::size_t> place;
  for (std::size_t i = 0; i < skeleton.points.size(); ++i) {
    const auto begin = positions.outputNodes().begin() + static_cast<std::ptrdiff_t>(3 * i);
    const std::vector<int> nodes(begin, begin + 3);
    const auto found = std::ranges::find(known, nodes);
    place.push_back(static_cast<std::size_t>(found - known.begin()));
    if (found != known.end()) {
      Skeleton::Point& first = points[place.back()];
      first.isGround = first.isGround || skeleton.points[i].isGround;
      continue;
    }
    known.push_back(nodes);
    points.push_back(skeleton.points[i]);
    points.back().isFixed = std::ranges::all_of(nodes, [&](int node) { return positions.isInvariant(node); });
  }
  skeleton.points = std::move(points);
  for (Skeleton::Part& part : skeleton.parts) part.from = place[part.from], part.to = place[part.to];
}

}  // namespace

Skeleton skeletonOf(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  Skeleton skeleton = Finder(mechanism, freeParameters).skeleton;
  if (skeleton.points.empty()) return skeleton;
  const int states = static_cast<int>(mechanism.stateNames().size()),
            parameters = static_cast<int>(freeParameters.size());
  join(skeleton, record(states, parameters, static_cast<int>(3 * skeleton.points.size()),
                        [&](auto t, const auto& x, const auto& p, auto& y) {
                          Assembly<Recorded> assembly(mechanism, freeParameters, p);
                          assembly.setMotion(x, t);
                          std::ranges::copy(positionsOf(assembly, skeleton), y.begin());
                        }));
  return skeleton;
}

template <class S>
std::vector<S> positionsOf(const Assembly<S>& assembly, const Skeleton& skeleton) {
  return componentsOf<S>(skeleton.points, [&](const auto& point) { return movingPoint(assembly, point).position; });
}

template <class S>
std::vector<S> velocitiesOf(const Assembly<S>& assembly, const Skeleton& skeleton) {
  return componentsOf<S>(skeleton.points, [&](const auto& point) { return movingPoint(assembly, point).velocity; });
}

template <class S>
std::vector<S> axesOf(const Assembly<S>& assembly, const Skeleton& skeleton) {
  return componentsOf<S>(skeleton.axes, [&](const Skeleton::JointAxis& of) -> Vector3<S> {
    return assembly.frame(of.frame).R * of.axis.unit<S>();
  });
}

#define GAMUT_COMPILE_FUNCTION(FUNCTION, S) template std::vector<S> FUNCTION(const Assembly<S>&, const Skeleton&);
GAMUT_FOR_EVERY_SCALAR(GAMUT_COMPILE_FUNCTION, positionsOf)
GAMUT_FOR_EVERY_SCALAR(GAMUT_COMPILE_FUNCTION, velocitiesOf)
GAMUT_FOR_EVERY_SCALAR(GAMUT_COMPILE_FUNCTION, axesOf)

}  // namespace gamut
