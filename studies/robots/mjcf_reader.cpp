// MJCF, as MuJoCo's manual states it (https://mujoco.readthedocs.io/en/stable/XMLreference.html): bodies within bodies,
// joints that stand in the body that they move, attributes that come from default classes, inertia that follows from
// geoms. The world is the root; what stands in it without a joint stands still.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "mechanics/description/names.hpp"
#include "mechanics/elements/inertia.hpp"
#include "studies/printable.hpp"
#include "studies/robots/mjcf_attributes.hpp"
#include "studies/robots/mjcf_geoms.hpp"
#include "studies/robots/mjcf_places.hpp"
#include "studies/robots/robot_formats.hpp"
#include "studies/robots/robot_parts.hpp"
#include "studies/robots/solids.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using Tag = XmlSource::Element;

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::count(words, word) != 0;
}

class MjcfReader {
 public:
  MjcfReader(const XmlSource& source, const NamedTexts& included, bool takesShapes)
      : source_(source), texts_(included), takesShapes_(takesShapes) {
    robot_.file = source.name();
    robot_.isWorld = true;
  }

  Robot read() {
    const MjcfNode root{&source_, &source_.root()};
    MjcfAttributes model(root);
    model.takeAll(root);
    lookAt(model, {"model"});
    robot_.name = model.text("model", "");
    robot_.gravity = {0.0, 0.0, Interval("-9.81")};
    const std::vector<MjcfNode> sections = childrenOf(root);
    for (const MjcfNode& section : sections) readFirst(section);
    robot_.links.push_back({"world", root.line()});
    names_.insert("world");
    for (const MjcfNode& section : sections)
      if (section.word() == "worldbody") readInside(section, {"world", "world", "main", 0, true, {}}, nullptr);
    if (robot_.joints.empty()) source_.fail(root.line(), "there is no <body> in <worldbody>", "one at least");
    for (const MjcfNode& section : sections)
      if (section.word() == "equality") readEqualities(section);
    setTotalMass();
    checkMimics(robot_);
    say();
    return std::move(robot_);
  }

 private:
  /// Where an element stands: its body, the frame that carries a body's first joint, the class of what states none.
  struct Place {
    std::string body, parent, childClass;
    int depth = 0;
    bool isStill = false;  ///< nothing moves it
    std::vector<Robot::Step> frames = {};
  };
  /// What a body consists of.
  struct Parts {
    std::vector<MjcfNode> joints;
    std::vector<std::pair<MjcfNode, Place>> geoms, inner;  ///< inner: bodies and where they stand
    const Tag* inertial = nullptr;
    MjcfNode inertialNode = {};
  };

  [[noreturn]] static void fail(const MjcfNode& node, const std::string& what, const std::string& expected) {
    node.source->fail(node.line(), what, expected);
  }
  std::string fileOf(const MjcfNode& node) const { return node.source == &source_ ? "" : node.source->name(); }

  // ---- Files --------------------------------------------------------------------------------------------------------

  /// Elements within, those of included files in their place.
  std::vector<MjcfNode> childrenOf(const MjcfNode& parent) {
    std::vector<MjcfNode> children;
    for (const Tag* e = parent.tag->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const MjcfNode child{parent.source, e};
      if (child.word() != "include") {
        children.push_back(child);
        continue;
      }
      const std::vector<MjcfNode> others = childrenOf(includedBy(child));
      children.insert(children.end(), others.begin(), others.end());
    }
    return children;
  }

  MjcfNode includedBy(const MjcfNode& include) {
    MjcfAttributes attributes(include);
    attributes.takeAll(include);
    const std::string file = attributes.require("file", "the name of a file").stated.text;
    const auto known = files_.find(file);
    if (known != files_.end() && known->second.first != include.tag)
      fail(include, fmt::format("'{}' is included a second time", shortened(file)), "a file once");
    if (known == files_.end()) {
      const auto text = texts_.find(file);
      if (text == texts_.end())
        fail(include, fmt::format("'{}' is included, but not there", shortened(file)), "a file beside this one");
      const std::string name = (std::filesystem::path(source_.name()).parent_path() / file).string();
      files_.emplace(file, std::pair(include.tag, std::make_unique<XmlSource>(text->second, name)));
    }
    const XmlSource& source = *files_.at(file).second;
    const MjcfNode root{&source, &source.root()};
    if (root.word() != "mujoco" && root.word() != "mujocoinclude")
      fail(root, fmt::format("the outermost element is <{}>", shortened(root.word())), "<mujoco> or <mujocoinclude>");
    return root;
  }

  // ---- What holds of the whole --------------------------------------------------------------------------------------

  void readFirst(const MjcfNode& section) {
    const std::string_view word = section.word();
    if (word == "compiler")
      readCompiler(section);
    else if (word == "option")
      readOption(section);
    else if (word == "default")
      readMainDefaults(section);
    else if (isOneOf(word, {"actuator", "tendon", "contact"}))
      leaveOut(driving_, section);
    else if (isOneOf(word, {"asset", "visual", "statistic", "size", "custom", "sensor", "keyframe"}))
      leaveOut(silent_, section);
    else if (word == "deformable")
      fail(section, "<deformable> is no rigid body", "bodies that are rigid");
    else if (!isOneOf(word, {"worldbody", "equality"}))
      leaveOut(unknown_, section);
  }

  static void leaveOut(LeftOut& list, const MjcfNode& node) {
    list.add(fmt::format("<{}>", shortened(node.word())), node.line(), node.source);
  }

  /// Notes attributes that nothing is known of.
  void lookAt(const MjcfAttributes& attributes, std::initializer_list<std::string_view> known) {
    for (const auto& [name, value] : attributes.all())
      if (!isOneOf(name, known)) unknown_.add(value.stated.what, value.stated.line, value.source);
  }

  void readCompiler(const MjcfNode& node) {
    MjcfAttributes attributes(node);
    attributes.takeAll(node);
    lookAt(
        attributes,
        {"angle",        "autolimits",       "eulerseq",      "coordinate",     "inertiafromgeom", "inertiagrouprange",
         "settotalmass", "boundmass",        "boundinertia",  "balanceinertia", "meshdir",         "texturedir",
         "assetdir",     "strippath",        "discardvisual", "convexhull",     "usethread",       "fusestatic",
         "fitaabb",      "exactmeshinertia", "alignfree",     "saveinertial",   "conflict"});
    const std::string unit = angles_.inDegrees ? "degree" : "radian";
    angles_.inDegrees = attributes.choice("angle", unit, {"degree", "radian"}) == "degree";
    if (attributes.choice("coordinate", "local", {"local", "global"}) == "global")
      attributes.fail("coordinate", "the coordinates are global, as MuJoCo no longer reads them",
                      "\"local\", as MuJoCo 2.3.3 or older saves the file");
    inertiaFromGeom_ = attributes.choice("inertiafromgeom", inertiaFromGeom_, {"auto", "true", "false"});
    if (attributes.has("settotalmass")) {
      totalMass_ = attributes.number("settotalmass", -1.0);
      totalMassNode_ = node;
    }
    for (const char* bound : {"boundmass", "boundinertia"})
      if (!isExactlyZero(attributes.number(bound, 0.0)))
        attributes.fail(bound, fmt::format("'{}' is given, which alters masses", bound), "0, and the masses meant");
    if (attributes.has("inertiagrouprange")) {
      const std::vector<Interval> range = attributes.numbers("inertiagrouprange", 2, 2);
      groups_ = {range[0].lower(), range[1].upper()};
    }
    angles_.order = attributes.text("eulerseq", angles_.order);
    const auto isAxis = [](char c) { return std::string_view("xyzXYZ").find(c) != std::string_view::npos; };
    if (angles_.order.size() != 3 || !std::ranges::all_of(angles_.order, isAxis))
      attributes.fail("eulerseq", fmt::format("'eulerseq' is \"{}\"", shortened(angles_.order)),
                      "three letters of x, y, z, X, Y, Z, such as \"xyz\"");
  }

  void readOption(const MjcfNode& node) {
    MjcfAttributes attributes(node);
    attributes.takeAll(node);
    lookAt(attributes, {"gravity",          "density",
                        "viscosity",        "wind",
                        "timestep",         "integrator",
                        "solver",           "iterations",
                        "tolerance",        "cone",
                        "jacobian",         "impratio",
                        "magnetic",         "ls_iterations",
                        "ls_tolerance",     "noslip_iterations",
                        "noslip_tolerance", "ccd_iterations",
                        "ccd_tolerance",    "sdf_iterations",
                        "sdf_initpoints",   "actuatorgroupdisable",
                        "o_margin",         "o_solref",
                        "o_solimp",         "o_friction",
                        "collision",        "apirate",
                        "mpr_iterations",   "mpr_tolerance",
                        "sleep_tolerance"});
    robot_.gravity = attributes.vector("gravity", *robot_.gravity);
    for (const char* fluid : {"density", "viscosity"})
      if (!isExactlyZero(attributes.number(fluid, 0.0)))
        attributes.fail(fluid, fmt::format("there is a medium, as its {} is not 0", fluid),
                        "none, and its forces as elements of the study");
    for (const MjcfNode& child : childrenOf(node)) {
      if (child.word() != "flag") continue;
      MjcfAttributes flags(child);
      flags.takeAll(child);
      const auto isOff = [&](const char* name) { return flags.text(name, "enable") == "disable"; };
      if (isOff("gravity")) robot_.gravity = {0.0, 0.0, 0.0};
      isDamped_ = isDamped_ && !isOff("passive") && !isOff("damper");
      isSprung_ = isSprung_ && !isOff("passive") && !isOff("spring");
      isRough_ = isRough_ && !isOff("frictionloss");
      isCoupled_ = isCoupled_ && !isOff("equality");
    }
  }

  using Class = std::map<std::string, std::map<std::string, MjcfAttributes::Value>>;  ///< attributes by elements

  /// What holds of all that state no class, whatever its name.
  void readMainDefaults(const MjcfNode& node) {
    MjcfAttributes own(node);
    own.takeAll(node);
    lookAt(own, {"class"});
    readDefaults(node, "main", classes_["main"]);
    classes_[own.text("class", "main")] = classes_["main"];
  }

  /// Of a class, and of those within it, which begin with what it states.
  void readDefaults(const MjcfNode& node, const std::string& name, const Class& outer) {
    if (name.empty()) fail(node, "<default> within another has no 'class'", "the name of the class");
    const bool isNew = !classes_.contains(name);
    Class& mine = classes_[name];
    if (isNew) mine = outer;
    const std::vector<MjcfNode> children = childrenOf(node);
    for (const MjcfNode& child : children) {
      if (child.word() == "default") continue;
      MjcfAttributes attributes(child);
      attributes.takeAll(child);
      for (const auto& [key, value] : attributes.all()) mine[std::string(child.word())][key] = value;
    }
    const Class stated = mine;
    for (const MjcfNode& child : children)
      if (child.word() == "default") {
        MjcfAttributes inner(child);
        inner.takeAll(child);
        lookAt(inner, {"class"});
        readDefaults(child, inner.text("class", ""), stated);
      }
  }

  /// Its own and those of its class.
  MjcfAttributes attributesOf(const MjcfNode& node, const std::string& childClass, const std::string& kind) {
    MjcfAttributes own(node), all(node);
    own.takeAll(node);
    const std::string name = own.text("class", childClass);
    const auto found = classes_.find(name);
    if (found == classes_.end() && name != "main") {
      std::vector<std::string> known;
      for (const auto& [other, elements] : classes_) known.push_back(other);
      own.fail("class", fmt::format("there is no default class {}", inQuotes(name)), expectedName(name, known));
    }
    if (found != classes_.end())
      if (const auto element = found->second.find(kind); element != found->second.end()) all.takeAll(element->second);
    all.takeAll(node);
    return all;
  }

  // ---- Bodies -------------------------------------------------------------------------------------------------------

  /// What stands in the world, in a body or in a frame of these.
  void readInside(const MjcfNode& node, const Place& place, Parts* parts) {
    Parts own;
    Parts& all = parts == nullptr ? own : *parts;
    for (const MjcfNode& child : childrenOf(node)) {
      const std::string_view word = child.word();
      if (word == "geom") {
        all.geoms.emplace_back(child, place);
      } else if (word == "body") {
        all.inner.emplace_back(child, place);
      } else if (word == "frame") {
        readFrame(child, place, all);
      } else if (word == "joint" || word == "freejoint" || word == "inertial") {
        readOwn(child, place, all);
      } else if (isOneOf(word, {"composite", "flexcomp", "attach", "replicate", "flex"})) {
        fail(child, fmt::format("<{}> makes bodies, which only MuJoCo does", word),
             "the file that MuJoCo saves of this one, in which they stand");
      } else {
        leaveOut(isOneOf(word, {"site", "camera", "light"}) ? silent_ : unknown_, child);
      }
    }
    if (parts != nullptr) return;
    for (const auto& [geom, where] : all.geoms) readGeom(geom, where, nullptr, robot_.links.front());
    for (const auto& [body, where] : all.inner) readBody(body, where);
  }

  static void readOwn(const MjcfNode& node, const Place& place, Parts& all) {
    if (place.body == "world") fail(node, fmt::format("there is a <{}> in <worldbody>", node.word()), "it in a <body>");
    if (!place.frames.empty()) fail(node, fmt::format("there is a <{}> in a <frame>", node.word()), "it in the body");
    if (node.word() != "inertial") {
      all.joints.push_back(node);
    } else {
      if (all.inertial != nullptr) fail(node, fmt::format("{} has two <inertial>", inQuotes(place.body)), "one");
      all.inertial = node.tag;
      all.inertialNode = node;
    }
  }

  void readFrame(const MjcfNode& node, const Place& place, Parts& all) {
    MjcfAttributes attributes(node);
    attributes.takeAll(node);
    lookAt(attributes, {"name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"});
    Place inner = place;
    inner.childClass = attributes.text("childclass", place.childClass);
    const std::string name = nameOf(attributes, fmt::format("frame{}", ++frames_));
    inner.frames.push_back({"", name + ".frame", placeOf(attributes, angles_), false, true});
    readInside(node, inner, &all);
  }

  /// Names are free in MJCF: an unnamed one has `otherwise`.
  std::string nameOf(const MjcfAttributes& attributes, const std::string& otherwise) const {
    const std::string name = attributes.text("name", otherwise);
    if (name.empty() || hasControlCharacters(name) || name.find('\'') != std::string::npos || name.size() > 200)
      attributes.fail("name", fmt::format("'name' is \"{}\"", shortened(name)),
                      "a name without ' and control characters, of at most 200 bytes");
    return name;
  }

  void readBody(const MjcfNode& node, const Place& where) {
    MjcfAttributes attributes(node);
    attributes.takeAll(node);
    lookAt(attributes, {"name", "childclass", "mocap", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler",
                        "gravcomp", "user", "sleep"});
    Robot::Link link{nameOf(attributes, fmt::format("body{}", ++bodies_)), node.line(), fileOf(node)};
    if (!names_.insert(link.name).second)
      fail(node, fmt::format("there is a body {} already", inQuotes(link.name)), "a name for each");
    if (robot_.links.size() > mostLinks) fail(node, "there are too many bodies", fmt::format("at most {}", mostLinks));
    if (!isExactlyZero(attributes.number("gravcomp", 0.0)))
      attributes.fail("gravcomp", fmt::format("the weight of {} is compensated", inQuotes(link.name)),
                      "no 'gravcomp', and a force of the study");
    if (attributes.flag("mocap", false)) mocaps_.add(fmt::format("'{}'", link.name), node.line(), node.source);
    Parts parts;
    const Place inside{link.name,   link.name,     attributes.text("childclass", where.childClass),
                       where.depth, where.isStill, {}};
    readInside(node, inside, &parts);
    const bool isStill = where.isStill && parts.joints.empty();
    const std::size_t first = robot_.joints.size();
    addJoints(parts, inside, where, placeOf(attributes, angles_), node);
    readInertia(parts, isStill, link);
    robot_.links.push_back(std::move(link));
    const int depth = where.depth + static_cast<int>(robot_.joints.size() - first);
    for (auto& [body, place] : parts.inner) {
      place.depth = depth;
      place.isStill = isStill;
      readBody(body, place);
    }
  }

  // ---- Joints -------------------------------------------------------------------------------------------------------

  /// From the body that carries it to the body: through all joints, one behind the other.
  void addJoints(const Parts& parts, const Place& inside, const Place& where, const Robot::Place& place,
                 const MjcfNode& body) {
    std::vector<Robot::Joint> joints;
    for (const MjcfNode& node : parts.joints)
      joints.push_back(readJoint(node, inside, parts.joints.size() == 1 ? "" : std::to_string(joints.size() + 1)));
    if (joints.empty()) {
      Robot::Joint fixed;
      fixed.name = jointName(inside.body + ".fixed", body);
      fixed.line = body.line();
      fixed.file = fileOf(body);
      joints.push_back(fixed);
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
      Robot::Joint& joint = joints[i];
      const bool isLast = i + 1 == joints.size();
      joint.parent = i == 0 ? where.body : joints[i - 1].child;
      joint.child = isLast ? inside.body : joint.name + ".behind";
      joint.depth = where.depth + static_cast<int>(i);
      if (i == 0) joint.origin = place;
      std::vector<Robot::Step> before;
      if (i == 0) before = where.frames;
      for (Robot::Step& step : before) step.frame = joint.name + "." + step.name;
      const std::vector<Robot::Step> anchor = std::exchange(joint.before, {});
      if (before.empty() && anchor.empty()) continue;
      before.push_back({joint.name + ".origin", joint.name + ".origin", joint.origin});
      before.insert(before.end(), anchor.begin(), anchor.end());
      joint.before = before;
      for (Robot::Step& step : joint.after) step.frame = joint.child;
    }
    for (std::size_t i = 0; i < joints.size(); ++i) {
      if (i > 0) robot_.links.push_back({joints[i - 1].child, joints[i - 1].line, joints[i - 1].file});
      robot_.joints.push_back(joints[i]);
    }
  }

  std::string jointName(const std::string& name, const MjcfNode& node) {
    if (!jointNames_.insert(name).second)
      fail(node, fmt::format("there is a joint {} already", inQuotes(name)), "a name for each");
    return name;
  }

  /// `number`: of an unnamed one among several.
  Robot::Joint readJoint(const MjcfNode& node, const Place& inside, const std::string& number) {
    const bool isFree = node.word() == "freejoint";
    MjcfAttributes attributes(node);
    if (isFree)
      attributes.takeAll(node);
    else
      attributes = attributesOf(node, inside.childClass, "joint");
    lookAt(attributes, {"name",
                        "class",
                        "type",
                        "pos",
                        "axis",
                        "stiffness",
                        "springref",
                        "springdamper",
                        "damping",
                        "armature",
                        "frictionloss",
                        "range",
                        "limited",
                        "ref",
                        "group",
                        "user",
                        "margin",
                        "solreflimit",
                        "solimplimit",
                        "solreffriction",
                        "solimpfriction",
                        "actuatorfrcrange",
                        "actuatorfrclimited",
                        "actuatorgravcomp",
                        "align"});
    Robot::Joint joint;
    joint.line = node.line();
    joint.file = fileOf(node);
    joint.name = jointName(nameOf(attributes, inside.body + ".joint" + number), node);
    const std::string type = isFree ? "free" : attributes.choice("type", "hinge", {"hinge", "slide", "ball", "free"});
    joint.type = type == "hinge"   ? Robot::Type::continuous
                 : type == "slide" ? Robot::Type::prismatic
                 : type == "ball"  ? Robot::Type::ball
                                   : Robot::Type::floating;
    if (type == "free" && !inside.isStill)
      fail(node, fmt::format("{} is free, but stands in a body that moves", inQuotes(inside.body)),
           "a free joint in a body of <worldbody>");
    if (type == "hinge" || type == "slide") {
      const std::vector<std::string> axis =
          attributes.has("axis") ? attributes.decimals("axis", 3) : std::vector<std::string>{"0", "0", "1"};
      joint.axis = directionIn(attributes, "axis", axis);
      joint.direction = fmt::format("{} {} {}", axis[0], axis[1], axis[2]);
    }
    readAnchor(attributes, type, joint);
    readLaws(attributes, type, joint);
    return joint;
  }

  /// Where it stands in the body: turns go through there.
  void readAnchor(const MjcfAttributes& attributes, const std::string& type, Robot::Joint& joint) const {
    if (type != "hinge" && type != "ball") return;
    Robot::Place anchor;
    anchor.xyz = attributes.vector("pos", {0.0, 0.0, 0.0});
    if (std::ranges::all_of(anchor.xyz, isExactlyZero)) return;
    anchor.turns.emplace();
    const std::string name = joint.name + ".anchor";
    joint.before = {{name, name, anchor}};
    joint.after = {{"", name, anchor, true, true}};
    joint.before.front().isShared = true;
  }

  void readLaws(const MjcfAttributes& attributes, const std::string& type, Robot::Joint& joint) {
    const bool hasAngle = type == "hinge", hasOne = hasAngle || type == "slide";
    const char* const unit = hasAngle ? angles_.unit() : "";
    const std::string what = inQuotes(joint.name);
    joint.damping = attributes.size("damping", 0.0, what);
    joint.friction = attributes.size("frictionloss", 0.0, what);
    joint.stiffness = attributes.size("stiffness", 0.0, what);
    joint.armature = attributes.size("armature", 0.0, what);
    if (attributes.has("springdamper") && !std::ranges::all_of(attributes.numbers("springdamper", 2, 2), isExactlyZero))
      attributes.fail("springdamper", "'springdamper' follows from inertia, which only MuJoCo finds",
                      "'stiffness' and 'damping'");
    if (!hasOne) {
      for (const char* law : {"damping", "frictionloss", "stiffness", "armature"})
        if (attributes.has(law) && !isExactlyZero(attributes.number(law, 0.0)))
          attributes.fail(law, fmt::format("the {} of {}, a {} joint, is not 0", law, what, type),
                          fmt::format("0, as only hinges and slides have {}", law));
      return;
    }
    if (!isDamped_) joint.damping = 0.0;
    if (!isRough_) joint.friction = 0.0;
    if (!isSprung_) joint.stiffness = 0.0;
    const Interval ref = attributes.number("ref", 0.0, unit);
    if (!isExactlyZero(ref)) refs_.add(what, attributes.find("ref")->stated.line, attributes.find("ref")->source);
    const Interval springRef = attributes.number("springref", 0.0, unit);
    joint.rest = isExactlyZero(ref) ? springRef : springRef - ref;
    if (!attributes.has("range")) return;
    const std::vector<Interval> range = attributes.numbers("range", 2, 2, unit);
    joint.limits.emplace();
    joint.limits->lower = midpoint(range[0] - ref);
    joint.limits->upper = midpoint(range[1] - ref);
    if (hasAngle) joint.type = Robot::Type::revolute;
    limits_.add("'range'", attributes.find("range")->stated.line, attributes.find("range")->source);
  }

  // ---- Inertia ------------------------------------------------------------------------------------------------------

  void readInertia(const Parts& parts, bool isStill, Robot::Link& link) {
    const bool takesGeoms = inertiaFromGeom_ == "true" || (inertiaFromGeom_ == "auto" && parts.inertial == nullptr);
    Composed composed;
    unweighed_ = {};
    for (const auto& [geom, where] : parts.geoms) readGeom(geom, where, takesGeoms ? &composed : nullptr, link);
    if (!takesGeoms) {
      if (parts.inertial != nullptr) link.inertial = readInertial(parts.inertialNode, link.name);
      return;
    }
    if (unweighed_.tag != nullptr && !isStill)
      fail(unweighed_, fmt::format("{} weighs what a mesh does, which is not read", inQuotes(link.name)),
           "an <inertial> of the body, or 'mass' 0 of what is only seen");
    if (unweighed_.tag != nullptr && firstUnweighed_.tag == nullptr) firstUnweighed_ = unweighed_;
    if (unweighed_.tag == nullptr) link.inertial = composed.inertial();
    if (link.inertial)
      if (const std::string fault = impossibilityOf(link.inertial->inertia); !fault.empty())
        refuse(robot_, link.file, link.line, fmt::format("the inertia of {} {}", inQuotes(link.name), fault),
               "an inertia that a body can have");
  }

  Robot::Inertial readInertial(const MjcfNode& node, const std::string& body) {
    MjcfAttributes attributes(node);
    attributes.takeAll(node);
    lookAt(attributes, {"pos", "mass", "diaginertia", "fullinertia", "quat", "axisangle", "xyaxes", "zaxis", "euler"});
    Robot::Inertial inertial;
    attributes.require("pos", "the centre of mass");
    attributes.require("mass", "the mass, in kg");
    inertial.place = placeOf(attributes, angles_);
    inertial.mass = attributes.size("mass", 0.0, inQuotes(body));
    if (attributes.has("diaginertia")) {
      const std::vector<Interval> moments = attributes.numbers("diaginertia", 3, 3);
      std::ranges::copy(moments, inertial.inertia.begin());
    }
    if (attributes.has("fullinertia")) {
      for (const char* other : {"diaginertia", "quat", "axisangle", "xyaxes", "zaxis", "euler"})
        if (attributes.has(other))
          attributes.fail(other, fmt::format("'{}' beside 'fullinertia'", other), "one of the two");
      const std::vector<Interval> entries = attributes.numbers("fullinertia", 6, 6);
      constexpr std::array<std::size_t, 6> order = {0, 1, 2, 3, 5, 4};  // of xx, yy, zz, xy, xz, yz
      for (std::size_t i = 0; i < 6; ++i) inertial.inertia[i] = entries[order[i]];
    }
    if (const std::string fault = impossibilityOf(inertial.inertia); !fault.empty())
      fail(node, fmt::format("the inertia of {} {}", inQuotes(body), fault), "an inertia that a body can have");
    return inertial;
  }

  /// A solid is added to `composed`, a shape to the link, each if it is asked for.
  void readGeom(const MjcfNode& node, const Place& where, Composed* composed, Robot::Link& link) {
    const MjcfAttributes attributes = attributesOf(node, where.childClass, "geom");
    lookAt(attributes, {"name",   "class",    "type",        "pos",       "quat",     "axisangle", "xyaxes",
                        "zaxis",  "euler",    "fromto",      "size",      "mass",     "density",   "shellinertia",
                        "group",  "contype",  "conaffinity", "condim",    "priority", "friction",  "solmix",
                        "solref", "solimp",   "margin",      "gap",       "material", "rgba",      "hfield",
                        "mesh",   "fitscale", "fluidshape",  "fluidcoef", "user",     "surfacevel"});
    const MjcfGeom geom(attributes, angles_);
    if (composed != nullptr && geom.isInGroups(groups_) && !geom.isWeightless()) {
      std::vector<Robot::Place> frames;
      for (const Robot::Step& frame : where.frames) frames.push_back(frame.place);
      if (geom.isSolid())
        geom.addTo(*composed, frames);
      else if (unweighed_.tag == nullptr)
        unweighed_ = node;
    }
    if (!takesShapes_)
      leaveOut(shapes_, node);
    else if (geom.touches())
      addShape(node, geom, where, link);
  }

  void addShape(const MjcfNode& node, const MjcfGeom& geom, const Place& where, Robot::Link& link) {
    std::optional<Robot::Shape> shape;
    if (geom.isSolid() && where.frames.empty()) shape = geom.shape();
    if (!shape) {
      untaken_.add(fmt::format("<geom> ({}{})", geom.type(), where.frames.empty() ? "" : " in a <frame>"), node.line(),
                   node.source);
      return;
    }
    shape->line = node.line();
    shape->file = fileOf(node);
    if (shape->kind == Robot::Shape::Kind::cylinder) cylinders_.add("<geom> (cylinder)", node.line(), node.source);
    link.shapes.push_back(*shape);
  }

  /// Every mass by one factor, as MuJoCo does it.
  void setTotalMass() {
    if (!totalMass_ || totalMass_->upper() <= 0) return;
    if (firstUnweighed_.tag != nullptr)
      fail(firstUnweighed_, "'settotalmass' needs what all bodies weigh, one of which weighs what a mesh does",
           "an <inertial> of the body");
    Interval sum(0.0);
    for (const Robot::Link& link : robot_.links)
      if (link.inertial) sum += link.inertial->mass;
    if (!(sum.lower() > 0)) fail(totalMassNode_, "'settotalmass' is given, but nothing weighs anything", "masses");
    const Interval factor = *totalMass_ / sum;
    for (Robot::Link& link : robot_.links) {
      if (!link.inertial) continue;
      link.inertial->mass *= factor;
      for (Interval& entry : link.inertial->inertia) entry *= factor;
    }
  }

  // ---- What couples joints ------------------------------------------------------------------------------------------

  /// Joints that follow others linearly; what else is held together is a matter of the study.
  void readEqualities(const MjcfNode& section) {
    for (const MjcfNode& node : childrenOf(section)) {
      const MjcfAttributes a = attributesOf(node, "main", "equality");
      if (node.word() != "joint" || a.text("active", "true") == "false" || !isCoupled_) {
        leaveOut(equalities_, node);
        continue;
      }
      lookAt(a, {"name", "class", "active", "joint1", "joint2", "polycoef", "solref", "solimp"});
      const std::string name = a.require("joint1", "the joint that follows").stated.text;
      const auto joint = std::ranges::find(robot_.joints, name, &Robot::Joint::name);
      if (joint == robot_.joints.end()) {
        std::vector<std::string> known;
        for (const Robot::Joint& one : robot_.joints) known.push_back(one.name);
        a.fail("joint1", fmt::format("there is no joint {}", inQuotes(name)), expectedName(name, known));
      }
      if (joint->mimic) fail(node, fmt::format("{} follows two joints", inQuotes(name)), "one at most");
      std::vector<Interval> curve = {0.0, 1.0};
      if (a.has("polycoef")) curve = a.numbers("polycoef", 1, 5);
      curve.resize(std::max<std::size_t>(curve.size(), 2), Interval(0.0));
      if (!std::all_of(curve.begin() + 2, curve.end(), isExactlyZero))
        a.fail("polycoef", fmt::format("{} follows another joint along a curve", inQuotes(name)),
               "a straight line, two numbers and zeros");
      joint->mimic = {a.require("joint2", "the joint that is followed").stated.text, curve[1], curve[0], node.line(),
                      fileOf(node)};
    }
  }

  void say() {
    std::vector<std::string>& notes = robot_.notes;
    shapes_.say(source_, ": taken for what they weigh at most, not as shapes", notes);
    untaken_.say(source_, ": left out of what touches, of which boxes, spheres, cylinders and capsules are taken",
                 notes);
    cylinders_.say(source_, ": taken as capsules that hold them, with half a sphere more at either end", notes);
    silent_.say(source_, ": left out, as they say nothing of how bodies and joints move", notes);
    driving_.say(source_, ": left out; what drives and touches is stated by elements of the study", notes);
    equalities_.say(
        source_, " of <equality>: left out; `closure` and `coupling` of the study hold what belongs together", notes);
    mocaps_.say(source_, ": stands still where the file has it ('mocap')", notes);
    refs_.say(source_, ": counts from 0 where the file has it at 'ref'", notes);
    unknown_.say(source_, ": left out, as it is not known here", notes);
    limits_.say(source_, ": kept for information; motions may go beyond", notes);
  }

  const XmlSource& source_;
  const NamedTexts& texts_;
  Robot robot_;
  bool takesShapes_;
  std::map<std::string, std::pair<const Tag*, std::unique_ptr<XmlSource>>> files_;  ///< by what includes them
  std::map<std::string, Class> classes_;
  std::set<std::string> names_, jointNames_;
  MjcfAngles angles_;
  std::string inertiaFromGeom_ = "auto";
  std::pair<double, double> groups_ = {0, 5};  ///< of geoms that weigh
  std::optional<Interval> totalMass_;          ///< kg
  MjcfNode totalMassNode_, unweighed_, firstUnweighed_;
  bool isDamped_ = true, isSprung_ = true, isRough_ = true, isCoupled_ = true;
  int bodies_ = 0, frames_ = 0;
  LeftOut shapes_, untaken_, cylinders_, silent_, driving_, equalities_, mocaps_, refs_, unknown_, limits_;
};

}  // namespace

Robot readMjcf(const XmlSource& source, const NamedTexts& included, bool takesShapes) {
  return MjcfReader(source, included, takesShapes).read();
}

}  // namespace gamut
