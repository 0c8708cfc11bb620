// URDF, element by element. urdfdom is no help here: it keeps doubles where enclosures of the decimals are needed, says
// no lines, drops an inertial that it cannot read, refuses joints without limits, and its parser has no bound on depth.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "mechanics/description/names.hpp"
#include "mechanics/elements/inertia.hpp"
#include "studies/robots/mesh.hpp"
#include "studies/robots/robot_formats.hpp"
#include "studies/robots/robot_parts.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using Tag = XmlSource::Element;

constexpr std::pair<std::string_view, Robot::Type> urdfTypes[] = {
    {"revolute", Robot::Type::revolute}, {"continuous", Robot::Type::continuous}, {"prismatic", Robot::Type::prismatic},
    {"fixed", Robot::Type::fixed},       {"planar", Robot::Type::planar},         {"floating", Robot::Type::floating}};

class UrdfReader {
 public:
  UrdfReader(const XmlSource& source, const NamedTexts& meshes, bool takesShapes)
      : source_(source), texts_(meshes), takesShapes_(takesShapes) {
    robot_.file = source.name();
  }

  Robot read() {
    const Tag& root = source_.root();
    lookAt(root, {"name", "version"}, {"link", "joint"});
    if (root.Attribute("name") != nullptr) robot_.name = source_.requiredName(root, "name", "the robot's name");
    for (const Tag* e = root.FirstChildElement("link"); e != nullptr; e = e->NextSiblingElement("link")) readLink(*e);
    for (const Tag* e = root.FirstChildElement("joint"); e != nullptr; e = e->NextSiblingElement("joint"))
      readJoint(*e);
    if (robot_.links.empty()) source_.fail(root.GetLineNum(), "<robot> has no <link>", "one at least");
    checkMimics(robot_);
    sortOutwards(robot_);
    say();
    return std::move(robot_);
  }

 private:
  /// Notes attributes and elements that are not read. Throws StudyError for what must not be overlooked.
  void lookAt(const Tag& element, std::initializer_list<std::string_view> attributes,
              std::initializer_list<std::string_view> children) {
    const auto knows = [](const auto& words, std::string_view word) { return std::ranges::count(words, word) != 0; };
    for (const tinyxml2::XMLAttribute* a = element.FirstAttribute(); a != nullptr; a = a->Next())
      if (!knows(attributes, a->Name()) && !std::string_view(a->Name()).starts_with("xmlns"))
        attributes_.add(fmt::format("'{}' of <{}>", shortened(a->Name()), element.Name()), a->GetLineNum());
    for (const Tag* e = element.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string_view word = e->Name();
      if (word.starts_with("xacro:"))
        source_.fail(e->GetLineNum(), fmt::format("<{}> is of xacro", shortened(word)),
                     "the file that xacro makes of this one: xacro FILE.xacro > FILE.urdf");
      if (!knows(children, word))
        (word == "visual" || (word == "collision" && !takesShapes_) ? shapes_ : elements_)
            .add(fmt::format("<{}>", shortened(word)), e->GetLineNum());
    }
  }

  void say() {
    shapes_.say(source_, ": shapes and meshes are left out", robot_.notes);
    meshes_.say(source_,
                ": left out of <collision>, of which boxes, spheres, cylinders and meshes of STL and OBJ files at hand "
                "are taken",
                robot_.notes);
    hulls_.say(
        source_,
        fmt::format(": taken as convex hulls of 40 points at most with all within {:.2g} mm of these, which hold "
                    "all of them: distances are those or less, and coming closer is not proved by them",
                    1e3 * farthest_),
        robot_.notes);
    cylinders_.say(source_, ": taken as capsules that hold them, with half a sphere more at either end", robot_.notes);
    elements_.say(source_, ": left out, as they say nothing of how bodies and joints move", robot_.notes);
    attributes_.say(source_, ": left out, as URDF knows no such attribute", robot_.notes);
    limits_.say(source_, ": kept for information; motions may go beyond", robot_.notes);
  }

  Robot::Place readPlace(const Tag& parent) {
    Robot::Place place;
    const Tag* origin = source_.child(parent, "origin");
    if (origin == nullptr) return place;
    lookAt(*origin, {"xyz", "rpy"}, {});
    for (const auto& [attribute, numbers] : {std::pair("xyz", &place.xyz), std::pair("rpy", &place.rpy)})
      if (origin->Attribute(attribute) != nullptr)
        std::ranges::copy(source_.numbers(*origin, attribute, 3), numbers->begin());
    return place;
  }

  void readLink(const Tag& element) {
    if (takesShapes_)
      lookAt(element, {"name", "type"}, {"inertial", "collision"});
    else
      lookAt(element, {"name", "type"}, {"inertial"});
    Robot::Link link{source_.requiredName(element, "name", "the name of the link"), element.GetLineNum()};
    if (const auto other = findNamed(robot_.links, link.name); other != robot_.links.end())
      source_.fail(link.line, fmt::format("there is a link {} in line {} already", inQuotes(link.name), other->line),
                   "a name for each");
    if (const Tag* inertial = source_.child(element, "inertial")) link.inertial = readInertial(*inertial, link.name);
    const Tag* shape = takesShapes_ ? element.FirstChildElement("collision") : nullptr;
    for (; shape != nullptr; shape = shape->NextSiblingElement("collision")) readShape(*shape, link);
    robot_.links.push_back(std::move(link));
    if (robot_.links.size() > mostLinks)
      source_.fail(element.GetLineNum(), "there are too many links", fmt::format("at most {}", mostLinks));
  }

  void readShape(const Tag& element, Robot::Link& link) {
    lookAt(element, {"name"}, {"origin", "geometry"});
    Robot::Shape shape;
    shape.line = element.GetLineNum();
    shape.place = readPlace(element);
    const std::string expected = "<geometry> with a <box>, a <sphere>, a <cylinder> or a <mesh>";
    const Tag& geometry = source_.requiredChild(element, "geometry", expected);
    const Tag* form = geometry.FirstChildElement();
    const std::string_view word = form == nullptr ? "" : form->Name();
    if (word.empty() || form->NextSiblingElement() != nullptr)
      source_.fail(geometry.GetLineNum(),
                   fmt::format("a shape of {} is {}", inQuotes(link.name), word.empty() ? "nothing" : "more than one"),
                   expected);
    const auto lengths = [&](const char* attribute, std::size_t count) {
      const std::vector<Interval> numbers = source_.numbers(*form, attribute, count);
      for (const Interval& number : numbers)
        if (number.upper() < 0)
          source_.fail(form->GetLineNum(),
                       fmt::format("the {} of a shape of {} is negative", attribute, inQuotes(link.name)),
                       "a length of at least 0 m");
      return numbers;
    };
    if (word == "box") {
      lookAt(*form, {"size"}, {});
      std::ranges::copy(lengths("size", 3), shape.size.begin());
    } else if (word == "sphere") {
      lookAt(*form, {"radius"}, {});
      shape.kind = Robot::Shape::Kind::sphere;
      shape.radius = lengths("radius", 1).front();
    } else if (word == "cylinder") {
      lookAt(*form, {"radius", "length"}, {});
      cylinders_.add("<cylinder>", form->GetLineNum());
      shape.kind = Robot::Shape::Kind::cylinder;
      shape.radius = lengths("radius", 1).front();
      shape.length = lengths("length", 1).front();
    } else if (word == "mesh" && form->Attribute("filename") != nullptr &&
               texts_.contains(form->Attribute("filename"))) {
      lookAt(*form, {"filename", "scale"}, {});
      takeHull(*form, texts_.at(form->Attribute("filename")), shape);
    } else {
      meshes_.add(fmt::format("<{}>", shortened(word)), form->GetLineNum());
      return;
    }
    link.shapes.push_back(shape);
  }

  /// With what its points are off from doubles, after scaling, in its radius.
  void takeHull(const Tag& mesh, const std::string& text, Robot::Shape& shape) {
    const std::string file = mesh.Attribute("filename");
    if (text.starts_with(brokenMesh))
      source_.fail(mesh.GetLineNum(), fmt::format("the mesh {} {}", inQuotes(file), text.substr(brokenMesh.size())),
                   "a mesh with points, not all in one plane, in an STL or OBJ file");
    std::vector<Interval> scale = {1.0, 1.0, 1.0};
    if (mesh.Attribute("scale") != nullptr) scale = source_.numbers(mesh, "scale", 3);
    double largest = 0, off = 0;
    for (const Interval& factor : scale) {
      if (contains(factor, 0.0))
        source_.fail(mesh.GetLineNum(), fmt::format("the scale of the mesh {} is zero", inQuotes(file)),
                     "three numbers that are not");
      largest = std::max(largest, magnitude(factor));
    }
    const MeshHull hull = hullIn(text);
    shape.kind = Robot::Shape::Kind::hull;
    for (const std::array<double, 3>& point : hull.points) {
      std::array<double, 3>& scaled = shape.points.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        const Interval exact = scale[i] * point[i];
        scaled[i] = midpoint(exact);
        off = std::max(off, magnitude(exact - scaled[i]));
      }
    }
    // √3 < 2: of three coordinates.
    shape.radius = Interval((Interval(hull.radius) * largest + Interval(2.0) * off).upper());
    farthest_ = std::max(farthest_, shape.radius.upper());
    hulls_.add("<mesh>", mesh.GetLineNum());
  }

  Robot::Inertial readInertial(const Tag& element, const std::string& link) {
    lookAt(element, {}, {"origin", "mass", "inertia"});
    Robot::Inertial inertial;
    inertial.place = readPlace(element);
    const Tag& mass = source_.requiredChild(element, "mass", "<mass value=\"…\"/>, in kg");
    lookAt(mass, {"value"}, {});
    inertial.mass = source_.numbers(mass, "value", 1).front();
    if (inertial.mass.upper() < 0)
      source_.fail(mass.GetLineNum(), fmt::format("the mass of {} is negative", inQuotes(link)),
                   "a mass of at least 0 kg");
    const Tag& inertia = source_.requiredChild(
        element, "inertia", "<inertia ixx=\"…\" ixy=\"…\" ixz=\"…\" iyy=\"…\" iyz=\"…\" izz=\"…\"/>");
    lookAt(inertia, {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {});
    constexpr const char* entries[] = {"ixx", "iyy", "izz", "ixy", "iyz", "ixz"};
    for (std::size_t i = 0; i < 6; ++i) inertial.inertia[i] = source_.numbers(inertia, entries[i], 1).front();
    if (const std::string fault = impossibilityOf(inertial.inertia); !fault.empty())
      source_.fail(inertia.GetLineNum(), fmt::format("the inertia of {} {}", inQuotes(link), fault),
                   "an inertia that a body can have");
    return inertial;
  }

  void readJoint(const Tag& element) {
    lookAt(element, {"name", "type"}, {"origin", "parent", "child", "axis", "limit", "dynamics", "mimic"});
    Robot::Joint joint;
    joint.line = element.GetLineNum();
    joint.name = source_.requiredName(element, "name", "the name of the joint");
    if (const auto other = findNamed(robot_.joints, joint.name); other != robot_.joints.end())
      source_.fail(joint.line, fmt::format("there is a joint {} in line {} already", inQuotes(joint.name), other->line),
                   "a name for each");
    joint.type = readType(element);
    joint.parent = readEnd(element, "parent");
    joint.child = readEnd(element, "child");
    for (const Robot::Joint& other : robot_.joints)
      if (other.child == joint.child)
        source_.fail(joint.line,
                     fmt::format("the link {} is the child of two joints, {} and {}", inQuotes(joint.child),
                                 inQuotes(other.name), inQuotes(joint.name)),
                     "a tree, in which each link has one parent (a `closure` in the study closes loops)");
    joint.origin = readPlace(element);
    if (const Tag* axis = source_.child(element, "axis")) readAxis(*axis, joint);
    if (const Tag* limit = source_.child(element, "limit")) joint.limits = readLimits(*limit);
    if (const Tag* dynamics = source_.child(element, "dynamics")) readDynamics(*dynamics, joint);
    if (const Tag* mimic = source_.child(element, "mimic")) joint.mimic = readMimic(*mimic);
    robot_.joints.push_back(std::move(joint));
  }

  Robot::Type readType(const Tag& element) const {
    const std::string word = source_.requiredName(element, "type", "its type, such as \"revolute\"");
    std::vector<std::string> words;
    for (const auto& [name, type] : urdfTypes) {
      if (word == name) return type;
      words.emplace_back(name);
    }
    source_.fail(element.GetLineNum(),
                 fmt::format("the joint is of the type \"{}\", which URDF does not have", shortened(word)),
                 expectedName(word, words));
  }

  std::string readEnd(const Tag& element, const char* end) {
    const Tag& found = source_.requiredChild(element, end, fmt::format("<{} link=\"…\"/>", end));
    lookAt(found, {"link"}, {});
    const std::string name = source_.requiredName(found, "link", "the name of a link");
    if (findNamed(robot_.links, name) == robot_.links.end()) {
      std::vector<std::string> known;
      for (const Robot::Link& link : robot_.links) known.push_back(link.name);
      source_.fail(found.GetLineNum(), fmt::format("there is no link {}", inQuotes(name)), expectedName(name, known));
    }
    return name;
  }

  void readAxis(const Tag& element, Robot::Joint& joint) {
    lookAt(element, {"xyz"}, {});
    const std::vector<Interval> numbers = source_.numbers(element, "xyz", 3);
    if (std::ranges::all_of(numbers, [](const Interval& x) { return isEqual(x, Interval(0.0)); })) {
      if (joint.type == Robot::Type::fixed) return;  // exporters write it so
      source_.fail(element.GetLineNum(), fmt::format("the axis of {} is the zero vector", inQuotes(joint.name)),
                   "a direction");
    }
    const std::vector<std::string> decimals = source_.decimals(element, "xyz", 3);
    joint.axis = directionOf(decimals);
    joint.direction = fmt::format("{}", fmt::join(decimals, " "));
  }

  Robot::Limits readLimits(const Tag& element) {
    lookAt(element, {"lower", "upper", "effort", "velocity"}, {});
    limits_.add("<limit>", element.GetLineNum());
    Robot::Limits limits;
    for (const auto& [attribute, number] :
         {std::pair("lower", &limits.lower), std::pair("upper", &limits.upper), std::pair("effort", &limits.effort),
          std::pair("velocity", &limits.velocity)})
      if (element.Attribute(attribute) != nullptr) *number = midpoint(source_.numbers(element, attribute, 1).front());
    return limits;
  }

  void readDynamics(const Tag& element, Robot::Joint& joint) {
    lookAt(element, {"damping", "friction"}, {});
    for (const auto& [attribute, number] :
         {std::pair("damping", &joint.damping), std::pair("friction", &joint.friction)}) {
      *number = source_.number(element, attribute, 0.0);
      if (number->upper() < 0)
        source_.fail(element.GetLineNum(), fmt::format("the {} of {} is negative", attribute, inQuotes(joint.name)),
                     "a number of at least 0");
    }
  }

  Robot::Mimic readMimic(const Tag& element) {
    lookAt(element, {"joint", "multiplier", "offset"}, {});
    return {source_.requiredName(element, "joint", "the joint that is followed"),
            source_.number(element, "multiplier", 1.0), source_.number(element, "offset", 0.0), element.GetLineNum()};
  }

  const XmlSource& source_;
  const NamedTexts& texts_;
  Robot robot_;
  bool takesShapes_;
  double farthest_ = 0;  ///< m, of radii of hulls
  LeftOut shapes_, meshes_, hulls_, cylinders_, elements_, attributes_, limits_;
};

}  // namespace

Robot readUrdf(const XmlSource& source, const NamedTexts& meshes, bool takesShapes) {
  return UrdfReader(source, meshes, takesShapes).read();
}

}  // namespace gamut
