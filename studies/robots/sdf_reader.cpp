// SDFormat, as its specification states it (http://sdformat.org/spec): links and joints with poses that may be relative
// to any frame of their model, models within models, worlds. libsdformat is no help here, as urdfdom is none: it keeps
// doubles where enclosures of the decimals are needed, and its graph of frames gives numbers where names are needed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "mechanics/description/names.hpp"
#include "mechanics/elements/inertia.hpp"
#include "studies/printable.hpp"
#include "studies/robots/robot_formats.hpp"
#include "studies/robots/robot_parts.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using SdfTag = XmlSource::Element;
using SdfWords = std::initializer_list<std::string_view>;

bool isAmong(std::string_view word, SdfWords words) { return std::ranges::count(words, word) != 0; }
bool isExactlyNought(const Interval& x) { return isEqual(x, Interval(0.0)); }

/// A frame by its name: where it stands against another, and which link it moves with.
struct SdfFrame {
  const SdfTag* tag = nullptr;
  std::string model;                ///< in which its names are looked for: "" or "arm."
  std::string relativeTo;           ///< whole name of a frame; empty for the world
  std::string attachedTo;           ///< the same, of what is no link
  std::optional<Robot::Step> step;  ///< none of a pose that is not stated
  bool isLink = false;
};

class SdfReader {
 public:
  SdfReader(const XmlSource& source, bool takesShapes) : source_(source), takesShapes_(takesShapes) {
    robot_.file = source.name();
    robot_.isWorld = true;
  }

  Robot read() {
    const SdfTag& root = source_.root();
    checkVersion(root);
    robot_.links.push_back({"world", root.GetLineNum()});
    std::vector<const SdfTag*> models = childrenOf(root, "model");
    for (const SdfTag* world : childrenOf(root, "world")) readWorld(*world, models);
    for (const SdfTag* e = root.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
      if (!isAmong(e->Name(), {"model", "world"})) leaveOut(*e);
    if (models.empty()) source_.fail(root.GetLineNum(), "there is no <model>", "one at least");
    if (models.size() == 1) robot_.name = source_.requiredName(*models[0], "name", "the model's name");
    for (const SdfTag* model : models) readModel(*model, "", "", models.size() > 1, false);
    for (const auto& [tag, model] : joints_) readJoint(*tag, model);
    addBases();
    checkMimics(robot_);
    sortOutwards(robot_);
    say();
    return std::move(robot_);
  }

 private:
  // ---- What stands in the file --------------------------------------------------------------------------------------

  void checkVersion(const SdfTag& root) const {
    const std::string version = root.Attribute("version") == nullptr ? "" : root.Attribute("version");
    int major = 0, minor = 0;
    const bool isVersion = std::sscanf(version.c_str(), "%d.%d", &major, &minor) == 2;
    if (!isVersion || major != 1 || minor < 5)
      source_.fail(root.GetLineNum(), fmt::format("the version of <sdf> is \"{}\"", shortened(version)),
                   "1.5 or later, as `gz sdf -p` writes it");
  }

  static std::vector<const SdfTag*> childrenOf(const SdfTag& parent, const char* word) {
    std::vector<const SdfTag*> children;
    for (const SdfTag* e = parent.FirstChildElement(word); e != nullptr; e = e->NextSiblingElement(word))
      children.push_back(e);
    return children;
  }

  void leaveOut(const SdfTag& tag) {
    const std::string_view word = tag.Name();
    if (word == "include")
      source_.fail(tag.GetLineNum(), "<include> names a model elsewhere",
                   "the file that `gz sdf -p` makes of this one");
    (isAmong(word, {"visual", "collision"}) ? shapes_ : elements_)
        .add(fmt::format("<{}>", shortened(word)), tag.GetLineNum());
  }
  void lookAt(const SdfTag& tag, SdfWords known) {
    for (const SdfTag* e = tag.FirstChildElement(); e != nullptr; e = e->NextSiblingElement())
      if (!isAmong(e->Name(), known)) leaveOut(*e);
  }

  void readWorld(const SdfTag& world, std::vector<const SdfTag*>& models) {
    lookAt(world, {"model", "gravity", "frame", "joint"});
    for (const char* word : {"joint", "frame"})
      if (const SdfTag* other = world.FirstChildElement(word))
        source_.fail(other->GetLineNum(), fmt::format("there is a <{}> in <world>", word), "it in a <model>");
    robot_.gravity = {0.0, 0.0, Interval("-9.8")};
    if (const SdfTag* gravity = source_.child(world, "gravity")) robot_.gravity = vectorIn(*gravity);
    for (const SdfTag* model : childrenOf(world, "model")) models.push_back(model);
  }

  XmlSource::Stated statedIn(const SdfTag& tag) const {
    return {tag.GetText() == nullptr ? "" : tag.GetText(), fmt::format("<{}>", shortened(tag.Name())),
            tag.GetLineNum()};
  }
  std::vector<Interval> numbersIn(const SdfTag& tag, std::size_t count, const char* unit = "") const {
    const XmlSource::Stated stated = statedIn(tag);
    std::vector<Interval> numbers;
    for (const std::string& decimal : source_.decimals(stated, count, count))
      numbers.push_back(source_.enclosure(stated, decimal, unit));
    return numbers;
  }
  std::array<Interval, 3> vectorIn(const SdfTag& tag) const {
    const std::vector<Interval> n = numbersIn(tag, 3);
    return {n[0], n[1], n[2]};
  }
  Interval numberOf(const SdfTag& parent, const char* word, const Interval& otherwise) const {
    const SdfTag* tag = source_.child(parent, word);
    return tag == nullptr ? otherwise : numbersIn(*tag, 1).front();
  }
  bool flagOf(const SdfTag& parent, const char* word, bool otherwise) const {
    const SdfTag* tag = source_.child(parent, word);
    if (tag == nullptr) return otherwise;
    const std::string text = tag->GetText() == nullptr ? "" : tag->GetText();
    if (!isAmong(text, {"true", "false", "1", "0"}))
      source_.fail(tag->GetLineNum(), fmt::format("<{}> is \"{}\"", word, shortened(text)), "true or false");
    return text == "true" || text == "1";
  }
  std::string textOf(const SdfTag& parent, const char* word, const std::string& otherwise) const {
    const SdfTag* tag = source_.child(parent, word);
    if (tag == nullptr) return otherwise;
    std::string text = tag->GetText() == nullptr ? "" : tag->GetText();
    const auto begin = text.find_first_not_of(" \t\r\n"), end = text.find_last_not_of(" \t\r\n");
    return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
  }

  // ---- Poses --------------------------------------------------------------------------------------------------------

  Robot::Place placeIn(const SdfTag& pose) const {
    const std::string format = pose.Attribute("rotation_format") == nullptr ? "" : pose.Attribute("rotation_format");
    const bool byQuaternion = format == "quat_xyzw";
    if (!byQuaternion && !format.empty() && format != "euler_rpy")
      source_.fail(pose.GetLineNum(), fmt::format("'rotation_format' is \"{}\"", shortened(format)),
                   "'euler_rpy' or 'quat_xyzw'");
    const char* degrees = pose.Attribute("degrees");
    const bool inDegrees = degrees != nullptr && isAmong(degrees, {"true", "1"});
    const XmlSource::Stated stated = statedIn(pose);
    const std::size_t count = byQuaternion ? 7 : 6;
    const std::vector<std::string> decimals = source_.decimals(stated, count, count);
    const auto number = [&](std::size_t i, const char* unit = "") {
      return source_.enclosure(stated, decimals[i], unit);
    };
    Robot::Place place;
    for (std::size_t i = 0; i < 3; ++i) place.xyz[i] = number(i);
    if (!byQuaternion) {
      for (std::size_t i = 0; i < 3; ++i) place.rpy[i] = number(i + 3, inDegrees ? "deg" : "");
      return place;
    }
    Robot::Turn turn;
    turn.quaternion = {number(6), number(3), number(4), number(5)};
    if (std::ranges::all_of(*turn.quaternion, isExactlyNought))
      source_.fail(pose.GetLineNum(), "the quaternion is zero", "four numbers of which one is not zero");
    place.turns = {turn};
    return place;
  }

  /// Declares a frame that its pose puts against `otherwise`, or what the pose names.
  void declare(const std::string& name, const SdfTag& tag, const std::string& model, const std::string& otherwise,
               const std::string& attachedTo, bool isLink) {
    SdfFrame frame{&tag, model, otherwise, attachedTo, {}, isLink};
    if (const SdfTag* pose = source_.child(tag, "pose")) {
      const char* other = pose->Attribute("relative_to");
      if (other != nullptr && *other != '\0') frame.relativeTo = inModel(other, model);
      if (pose->GetText() != nullptr) frame.step = {"", name + ".pose", placeIn(*pose), false, true};
    }
    if (!frames_.emplace(name, frame).second)
      source_.fail(tag.GetLineNum(), fmt::format("there is a frame {} already", inQuotes(name)), "a name for each");
  }

  /// "arm.hand" of "hand" in "arm.", "arm.gripper.left" of "gripper::left".
  static std::string whole(std::string name, const std::string& model) {
    if (name == "world") return "";
    for (auto at = name.find("::"); at != std::string::npos; at = name.find("::")) name.replace(at, 2, ".");
    return model + name;
  }

  const SdfFrame& frame(const std::string& name, int line) const {
    auto found = frames_.find(name);
    if (found == frames_.end()) found = frames_.find(name + ".__model__");  // a model's, by its name
    if (found != frames_.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [other, one] : frames_) known.push_back(other);
    source_.fail(line, fmt::format("there is no frame {}", inQuotes(name)), expectedName(name, known));
  }

  /// The steps from the world to a frame, when all joints are at 0.
  std::vector<Robot::Step> pathTo(const std::string& name, int line) const {
    std::vector<Robot::Step> path;
    std::string at = name;
    for (std::size_t i = 0; !at.empty(); ++i) {
      const SdfFrame& here = frame(at, line);
      if (i > frames_.size())
        source_.fail(here.tag->GetLineNum(), fmt::format("the pose of {} leads back to itself", inQuotes(at)),
                     "poses of which none does");
      if (here.step) path.insert(path.begin(), *here.step);
      at = here.relativeTo;
    }
    return path;
  }

  /// From one frame to another, without what both have in front.
  std::vector<Robot::Step> between(const std::string& from, const std::string& to, int line) const {
    std::vector<Robot::Step> back = pathTo(from, line), on = pathTo(to, line), steps;
    std::size_t common = 0;
    while (common < std::min(back.size(), on.size()) && back[common].name == on[common].name) ++common;
    for (std::size_t i = back.size(); i-- > common;) {
      steps.push_back(back[i]);
      steps.back().isBack = true;
    }
    steps.insert(steps.end(), on.begin() + static_cast<std::ptrdiff_t>(common), on.end());
    return steps;
  }

  /// The link that a frame moves with; "world" of what moves with nothing.
  std::string linkOf(const std::string& name, int line) const {
    std::string at = name;
    for (std::size_t i = 0; !at.empty(); ++i) {
      const SdfFrame& here = frame(at, line);
      if (here.isLink) return at;
      if (i > frames_.size())
        source_.fail(here.tag->GetLineNum(), fmt::format("{} is attached to itself", inQuotes(at)),
                     "a link in the end");
      at = here.attachedTo;
    }
    return "world";
  }

  // ---- Models -------------------------------------------------------------------------------------------------------

  std::string nameOf(const SdfTag& tag) const {
    const std::string name = source_.requiredName(tag, "name", "a name");
    if (name.find("::") != std::string::npos)
      source_.fail(tag.GetLineNum(), fmt::format("the name {} has '::' in it", inQuotes(name)), "a name without");
    return name;
  }

  /// `outer`: in front of the names in the model that holds it, whose frame is `within`; both empty in a world.
  void readModel(const SdfTag& tag, const std::string& outer, const std::string& within, bool isNamed, bool isStill) {
    const std::string name = nameOf(tag), scope = isNamed ? outer + name + "." : outer;
    lookAt(tag,
           {"link", "joint", "frame", "model", "pose", "static", "self_collide", "allow_auto_disable", "enable_wind"});
    for (const char* word : {"placement_frame"})
      if (tag.Attribute(word) != nullptr)
        source_.fail(tag.GetLineNum(), fmt::format("'{}' of <model>", word), "the pose of the model itself");
    const std::string own = scope.empty() ? "__model__" : scope + "__model__";
    declare(own, tag, outer, within, "", false);
    if (std::optional<Robot::Step>& step = frames_.at(own).step) step->name = outer + name + ".placement";
    modelOf_[scope] = own;
    const bool stays = isStill || flagOf(tag, "static", false);
    std::string canonical;
    for (const SdfTag* link : childrenOf(tag, "link")) {
      const std::string linkName = readLink(*link, scope, own);
      if (canonical.empty()) canonical = linkName;
      if (stays) still_.insert(linkName);
    }
    for (const SdfTag* e : childrenOf(tag, "frame")) {
      const char* to = e->Attribute("attached_to");
      const std::string attached = to == nullptr || *to == '\0' ? own : inModel(to, scope);
      declare(scope + nameOf(*e), *e, scope, attached, attached, false);
    }
    for (const SdfTag* e : childrenOf(tag, "joint")) {
      const std::string child = inModel(textOf(*e, "child", ""), scope);
      declare(scope + nameOf(*e), *e, scope, child, child, false);
      joints_.emplace_back(e, scope);
    }
    for (const SdfTag* e : childrenOf(tag, "model")) {
      readModel(*e, scope, own, true, stays);
      if (canonical.empty()) canonical = frames_.at(scope + nameOf(*e) + ".__model__").attachedTo;
    }
    frames_.at(own).attachedTo = canonical;
    if (canonical.empty())
      source_.fail(tag.GetLineNum(), fmt::format("{} has no <link>", inQuotes(name)), "one at least");
  }

  /// A name as it stands in a model, of a nested model its frame.
  std::string inModel(const std::string& name, const std::string& scope) const {
    const auto own = modelOf_.find(scope);
    if (name == "__model__") return own == modelOf_.end() ? "" : own->second;
    return whole(name, scope);
  }

  std::string readLink(const SdfTag& tag, const std::string& scope, const std::string& model) {
    lookAt(tag, {"pose", "inertial", "collision", "gravity", "enable_wind", "self_collide", "kinematic",
                 "must_be_base_link", "velocity_decay"});
    Robot::Link link{scope + nameOf(tag), tag.GetLineNum()};
    declare(link.name, tag, scope, model, "", true);
    if (!flagOf(tag, "gravity", true))
      source_.fail(tag.GetLineNum(), fmt::format("{} has no weight, by <gravity>", inQuotes(link.name)),
                   "gravity for all, and a force of the study");
    for (const char* word : {"kinematic"})
      if (flagOf(tag, word, false))
        source_.fail(tag.GetLineNum(), fmt::format("{} is <{}>", inQuotes(link.name), word),
                     "a link that moves by laws");
    link.inertial = readInertial(source_.child(tag, "inertial"), link);
    for (const SdfTag* e : childrenOf(tag, "collision")) readShape(*e, link);
    const std::string name = link.name;
    robot_.links.push_back(std::move(link));
    if (robot_.links.size() > mostLinks)
      source_.fail(tag.GetLineNum(), "there are too many links", fmt::format("at most {}", mostLinks));
    return name;
  }

  /// What is not stated is 1 kg and 1 kg m².
  Robot::Inertial readInertial(const SdfTag* tag, const Robot::Link& link) {
    Robot::Inertial inertial;
    inertial.mass = 1.0;
    for (std::size_t i = 0; i < 3; ++i) inertial.inertia[i] = 1.0;
    if (tag == nullptr) {
      unweighed_.add(inQuotes(link.name), link.line);
      return inertial;
    }
    lookAt(*tag, {"pose", "mass", "inertia"});
    if (tag->Attribute("auto") != nullptr && isAmong(tag->Attribute("auto"), {"true", "1"}))
      source_.fail(tag->GetLineNum(), fmt::format("{} weighs what its shapes do", inQuotes(link.name)),
                   "<mass> and <inertia>");
    if (const SdfTag* pose = source_.child(*tag, "pose")) {
      if (pose->Attribute("relative_to") != nullptr && *pose->Attribute("relative_to") != '\0')
        source_.fail(pose->GetLineNum(), "the <pose> of <inertial> is relative to another frame", "one in the link");
      if (pose->GetText() != nullptr) inertial.place = placeIn(*pose);
    }
    inertial.mass = numberOf(*tag, "mass", 1.0);
    if (inertial.mass.upper() < 0)
      source_.fail(tag->GetLineNum(), fmt::format("the mass of {} is negative", inQuotes(link.name)),
                   "a mass of at least 0 kg");
    if (const SdfTag* inertia = source_.child(*tag, "inertia")) {
      lookAt(*inertia, {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"});
      constexpr const char* entries[] = {"ixx", "iyy", "izz", "ixy", "iyz", "ixz"};
      for (std::size_t i = 0; i < 6; ++i) inertial.inertia[i] = numberOf(*inertia, entries[i], inertial.inertia[i]);
      if (const std::string fault = impossibilityOf(inertial.inertia); !fault.empty())
        source_.fail(inertia->GetLineNum(), fmt::format("the inertia of {} {}", inQuotes(link.name), fault),
                     "an inertia that a body can have");
    }
    return inertial;
  }

  void readShape(const SdfTag& tag, Robot::Link& link) {
    if (!takesShapes_) {
      leaveOut(tag);
      return;
    }
    Robot::Shape shape;
    shape.line = tag.GetLineNum();
    if (const SdfTag* pose = source_.child(tag, "pose")) {
      if (pose->Attribute("relative_to") != nullptr && *pose->Attribute("relative_to") != '\0')
        source_.fail(pose->GetLineNum(), "the <pose> of <collision> is relative to another frame", "one in the link");
      if (pose->GetText() != nullptr) shape.place = placeIn(*pose);
    }
    const SdfTag& geometry = source_.requiredChild(tag, "geometry", "<geometry> with a shape");
    const SdfTag* form = geometry.FirstChildElement();
    const std::string_view word = form == nullptr ? "" : form->Name();
    if (!isAmong(word, {"box", "sphere", "cylinder", "capsule"})) {
      meshes_.add(fmt::format("<{}>", word.empty() ? "geometry" : shortened(word)), geometry.GetLineNum());
      return;
    }
    shape.kind = word == "box"        ? Robot::Shape::Kind::box
                 : word == "sphere"   ? Robot::Shape::Kind::sphere
                 : word == "cylinder" ? Robot::Shape::Kind::cylinder
                                      : Robot::Shape::Kind::capsule;
    if (word == "box") shape.size = vectorIn(source_.requiredChild(*form, "size", "<size>x y z</size>"));
    if (word != "box") shape.radius = numbersIn(source_.requiredChild(*form, "radius", "<radius>"), 1).front();
    if (isAmong(word, {"cylinder", "capsule"}))
      shape.length = numbersIn(source_.requiredChild(*form, "length", "<length>"), 1).front();
    if (word == "cylinder") cylinders_.add("<cylinder>", form->GetLineNum());
    for (const Interval& length : {shape.size[0], shape.size[1], shape.size[2], shape.radius, shape.length})
      if (length.upper() < 0)
        source_.fail(form->GetLineNum(), fmt::format("a size of a shape of {} is negative", inQuotes(link.name)),
                     "a length of at least 0 m");
    link.shapes.push_back(shape);
  }

  // ---- Joints -------------------------------------------------------------------------------------------------------

  void readJoint(const SdfTag& tag, const std::string& scope) {
    lookAt(tag, {"parent", "child", "pose", "axis", "axis2"});
    const std::string name = scope + nameOf(tag);
    const std::string type = source_.requiredName(tag, "type", "its type, such as \"revolute\"");
    const std::vector<std::string> known = {"revolute", "continuous", "prismatic", "fixed", "ball", "universal"};
    if (std::ranges::count(known, type) == 0)
      source_.fail(tag.GetLineNum(), fmt::format("the joint {} is of the type \"{}\"", inQuotes(name), shortened(type)),
                   expectedName(type, known));
    for (const char* end : {"parent", "child"})
      if (textOf(tag, end, "").empty())
        source_.fail(tag.GetLineNum(), fmt::format("the joint {} has no <{}>", inQuotes(name), end),
                     "the name of a link");
    const std::string parent = inModel(textOf(tag, "parent", ""), scope),
                      child = inModel(textOf(tag, "child", ""), scope);
    const int line = tag.GetLineNum();
    Robot::Joint joint;
    joint.name = name;
    joint.line = line;
    joint.parent = linkOf(parent, line);
    joint.child = linkOf(child, line);
    if (joint.child == "world")
      source_.fail(line, fmt::format("the child of {} is the world", inQuotes(name)), "the world as the parent");
    if (const auto other = carried_.find(joint.child); other != carried_.end())
      source_.fail(line,
                   fmt::format("the link {} is the child of two joints, {} and {}", inQuotes(joint.child),
                               inQuotes(other->second), inQuotes(name)),
                   "a tree, in which each link has one parent (a `closure` in the study closes loops)");
    carried_[joint.child] = name;
    joint.type = type == "revolute"    ? Robot::Type::revolute
                 : type == "prismatic" ? Robot::Type::prismatic
                 : type == "fixed"     ? Robot::Type::fixed
                 : type == "ball"      ? Robot::Type::ball
                                       : Robot::Type::continuous;
    // A link's own frame moves with it, however its pose is stated.
    const std::string from = joint.parent == "world" ? "" : joint.parent;
    joint.before = between(from, name, line);
    joint.after = between(name, joint.child, line);
    std::vector<Robot::Joint> parts = {joint};
    if (type == "universal") parts = universal(joint, tag);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const SdfTag* axis = source_.child(tag, i == 0 ? "axis" : "axis2");
      const bool turnsOrSlides = hasCoordinate(parts[i]);
      if (axis == nullptr && turnsOrSlides && i == 1)
        source_.fail(line, fmt::format("the joint {} has no <axis2>", inQuotes(name)), "two axes");
      if (turnsOrSlides) readAxis(axis, scope, name, parts[i]);
      nameSteps(parts[i]);
      if (i > 0) robot_.links.push_back({parts[i].parent, line});
      robot_.joints.push_back(parts[i]);
    }
  }

  /// Two hinges, one behind the other, about axes of the joint's frame.
  static std::vector<Robot::Joint> universal(const Robot::Joint& joint, const SdfTag& /*tag*/) {
    Robot::Joint first = joint, second = joint;
    first.name += ".axis";
    second.name += ".axis2";
    first.child = second.parent = joint.name + ".cross";
    first.after.clear();
    second.before.clear();
    return {first, second};
  }

  void readAxis(const SdfTag* tag, const std::string& scope, const std::string& name, Robot::Joint& joint) {
    joint.axis = axisZ;
    joint.direction = "0 0 1";
    if (tag == nullptr) return;
    lookAt(*tag, {"xyz", "dynamics", "limit", "use_parent_model_frame", "mimic", "initial_position"});
    std::string in = flagOf(*tag, "use_parent_model_frame", false) ? "__model__" : "";
    if (const SdfTag* xyz = source_.child(*tag, "xyz")) {
      const XmlSource::Stated stated = statedIn(*xyz);
      if (std::ranges::all_of(numbersIn(*xyz, 3), isExactlyNought))
        source_.fail(xyz->GetLineNum(), fmt::format("the axis of {} is the zero vector", inQuotes(name)),
                     "a direction");
      const std::vector<std::string> decimals = source_.decimals(stated, 3, 3);
      joint.axis = directionOf(decimals);
      joint.direction = fmt::format("{}", fmt::join(decimals, " "));
      if (xyz->Attribute("expressed_in") != nullptr) in = xyz->Attribute("expressed_in");
    }
    if (!in.empty()) expressAxisIn(inModel(in, scope), name, joint);
    if (const SdfTag* limit = source_.child(*tag, "limit")) readLimits(*limit, joint);
    if (const SdfTag* dynamics = source_.child(*tag, "dynamics")) readDynamics(*dynamics, joint);
    if (const SdfTag* mimic = source_.child(*tag, "mimic")) {
      const std::string leader = scope + source_.requiredName(*mimic, "joint", "the joint that is followed");
      const Interval multiplier = numberOf(*mimic, "multiplier", 1.0), reference = numberOf(*mimic, "reference", 0.0);
      joint.mimic = {leader, multiplier, numberOf(*mimic, "offset", 0.0) - multiplier * reference, mimic->GetLineNum()};
    }
  }

  /// By turning to the axes of that frame in front of the joint, and back behind it.
  void expressAxisIn(const std::string& frame, const std::string& name, Robot::Joint& joint) const {
    std::vector<Robot::Step> there = between(name, frame, joint.line), back = between(frame, name, joint.line);
    for (std::vector<Robot::Step>* steps : {&there, &back})
      for (Robot::Step& step : *steps) step.turnsOnly = true;
    joint.before.insert(joint.before.end(), there.begin(), there.end());
    joint.after.insert(joint.after.begin(), back.begin(), back.end());
  }

  /// Each leads to a frame of its own, the last one behind the joint to the link.
  static void nameSteps(Robot::Joint& joint) {
    for (std::size_t i = 0; i < joint.before.size(); ++i)
      joint.before[i].frame = joint.name + ".origin" + (i + 1 == joint.before.size() ? "" : fmt::format(".{}", i + 1));
    for (std::size_t i = 0; i < joint.after.size(); ++i)
      joint.after[i].frame = i + 1 == joint.after.size() ? joint.child : fmt::format("{}.moved.{}", joint.name, i + 1);
  }

  void readLimits(const SdfTag& tag, Robot::Joint& joint) {
    joint.limits.emplace();
    const std::pair<const char*, std::optional<double>*> all[] = {{"lower", &joint.limits->lower},
                                                                  {"upper", &joint.limits->upper},
                                                                  {"effort", &joint.limits->effort},
                                                                  {"velocity", &joint.limits->velocity}};
    bool isLimited = false;
    for (const auto& [word, number] : all) {
      if (source_.child(tag, word) == nullptr) continue;
      const double limit = midpoint(numberOf(tag, word, 0.0));
      if (std::abs(limit) >= 1e15 || (limit < 0 && isAmong(word, {"effort", "velocity"}))) continue;  // none is meant
      *number = limit;
      isLimited = true;
    }
    if (isLimited)
      limits_.add("<limit>", tag.GetLineNum());
    else
      joint.limits.reset();
  }

  void readDynamics(const SdfTag& tag, Robot::Joint& joint) {
    lookAt(tag, {"damping", "friction", "spring_reference", "spring_stiffness"});
    for (const auto& [word, number] : {std::pair("damping", &joint.damping), std::pair("friction", &joint.friction),
                                       std::pair("spring_stiffness", &joint.stiffness)}) {
      *number = numberOf(tag, word, 0.0);
      if (number->upper() < 0)
        source_.fail(tag.GetLineNum(), fmt::format("the {} of {} is negative", word, inQuotes(joint.name)),
                     "a number of at least 0");
    }
    joint.rest = numberOf(tag, "spring_reference", 0.0);
  }

  /// What no joint carries falls freely, or stands still where its model is static.
  void addBases() {
    const std::vector<Robot::Link> links = robot_.links;
    for (const Robot::Link& link : links) {
      if (link.name == "world" || carried_.contains(link.name) || !frames_.contains(link.name)) continue;
      Robot::Joint base;
      base.name = link.name + ".base";
      base.line = link.line;
      base.type = still_.contains(link.name) ? Robot::Type::fixed : Robot::Type::floating;
      base.parent = "world";
      base.child = link.name;
      base.before = between("", link.name, link.line);
      nameSteps(base);
      robot_.joints.push_back(base);
    }
  }

  void say() {
    std::vector<std::string>& notes = robot_.notes;
    shapes_.say(source_, ": shapes and meshes are left out", notes);
    meshes_.say(source_, ": left out of <collision>, of which boxes, spheres, cylinders and capsules are taken", notes);
    cylinders_.say(source_, ": taken as capsules that hold them, with half a sphere more at either end", notes);
    unweighed_.say(source_, ": 1 kg and 1 kg m^2, as SDFormat has it of links without <inertial>", notes);
    elements_.say(source_, ": left out; what drives and touches is stated by elements of the study", notes);
    limits_.say(source_, ": kept for information; motions may go beyond", notes);
  }

  const XmlSource& source_;
  Robot robot_;
  bool takesShapes_;
  std::map<std::string, SdfFrame> frames_;
  std::map<std::string, std::string> modelOf_, carried_;  ///< by scope; the joint by its child
  std::set<std::string> still_;
  std::vector<std::pair<const SdfTag*, std::string>> joints_;
  LeftOut shapes_, meshes_, cylinders_, unweighed_, elements_, limits_;
};

}  // namespace

Robot readSdf(const XmlSource& source, bool takesShapes) { return SdfReader(source, takesShapes).read(); }

}  // namespace gamut
