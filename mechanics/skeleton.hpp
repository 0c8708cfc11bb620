// What of a mechanism can be seen: points, and the parts between them. For pictures; no motion depends on it.
#pragma once

#include <string>
#include <vector>

#include "mechanics/axis.hpp"
#include "mechanics/description/mechanism.hpp"

namespace gamut {

template <class S>
class Assembly;

struct Skeleton {
  /// What a frame, a centre of mass or an end of a spring stands at; those that stand together whatever the motion are
  /// one point.
  struct Point {
    std::string name;         ///< of the first frame there, or "ELEMENT.WORD": "bob.centre"
    std::string frame;        ///< that carries it
    ExpressionVector offset;  ///< in that frame [m]
    bool isFixed = false;     ///< it has the same place in every motion
    bool isGround = false;    ///< the inertial frame carries it, by links and welds alone
  };

  enum class Kind {
    rigid,   ///< a link, a weld: `to` is fixed to `from`
    joint,   ///< `to` moves against `from`
    mass,    ///< `from` is the frame that it is fixed to, `to` its centre
    spring,  ///< a load between two points
    shape,   ///< all within `radius` of the line between two points: a sphere, a capsule, an edge of a box or a hull
    play,    ///< `to` lies off `from` within the clearance `radius`
    damper,  ///< a load between two points
    wheel,   ///< turns about `to`; its first axis is the axle, its second a spoke
    motor,   ///< at a joint
    friction,
    gear,    ///< between two joints, each with its axis and, if it turns, a spoke, the one that slides first; without
             ///< any where wheels would not tell what it does
    plane,   ///< through `from`, across its axis, which `to` moves over
    profile  ///< beneath `to`, whose height above `from` it is; its first axis is up, its second the way ahead
  };
  struct Part {
    std::string name, type;  ///< as in the study
    Kind kind = Kind::rigid;
    std::size_t from = 0, to = 0;  ///< points
    int turns = 0, slides = 0;     ///< of a joint, or of a load at one: how many speeds turn [rad/s] and slide [m/s]
    Expression mass = 0.0;         ///< kg
    Expression radius = 0.0;       ///< m; of a gear between what turns and what slides, of its wheel
    Expression ratio = 0.0;        ///< of a gear: by how much the joint that follows moves by the other
    Expression speed = 0.0;        ///< at which the machine goes over a profile [m/s]
    std::string height = {};       ///< of a profile: the quantity
  };
  /// A direction that belongs to a part.
  struct JointAxis {
    std::string name;  ///< "hinge.axis"
    std::size_t part = 0;
    std::string frame;  ///< in which the direction is fixed
    Axis axis = axisX;
  };

  std::vector<Point> points;
  std::vector<Part> parts;
  std::vector<JointAxis> axes;
};

/// In the order of the elements; empty for a mechanism of states alone. Points count as one only if they are for all
/// values of the free parameters. What elements do not say to be seen is no part.
Skeleton skeletonOf(const Mechanism& mechanism, const std::vector<std::string>& freeParameters = {});

/// x, y, z of every point [m], of their velocities [m/s], or of the axes' unit vectors, in the inertial frame.
template <class S>
std::vector<S> positionsOf(const Assembly<S>& assembly, const Skeleton& skeleton);
template <class S>
std::vector<S> velocitiesOf(const Assembly<S>& assembly, const Skeleton& skeleton);
template <class S>
std::vector<S> axesOf(const Assembly<S>& assembly, const Skeleton& skeleton);

}  // namespace gamut
