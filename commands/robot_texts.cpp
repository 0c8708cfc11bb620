// What a study begins with: joints off 0, where many machines are in balance, within their limits.
#include "commands/robot_texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

#include "reports/text_table.hpp"
#include "studies/printable.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

std::string decimal(const Interval& number) { return fmt::format("{:.6g}", midpoint(number)); }

std::string unitOfCoordinate(const Robot::Joint& joint) { return joint.type == Robot::Type::prismatic ? "m" : "rad"; }

std::string limitsText(const Robot::Joint& joint) {
  if (!joint.limits) return "";
  const auto& [lower, upper, effort, velocity] = *joint.limits;
  const std::string unit = unitOfCoordinate(joint), force = unit == "m" ? "N" : "N m";
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (lower || upper) add(fmt::format("{:.6g} to {:.6g} {}", lower.value_or(0), upper.value_or(0), unit));
  if (effort) add(fmt::format("{:.6g} {}", *effort, force));
  if (velocity) add(fmt::format("{:.6g} {}/s", *velocity, unit));
  return text;
}

std::string jointText(const Robot::Joint& joint) {
  std::string text(wordOf(joint.type));
  if (hasCoordinate(joint)) text += fmt::format(" about ({})", joint.direction);
  if (joint.type == Robot::Type::prismatic || joint.type == Robot::Type::planar)
    text = fmt::format("{} {} ({})", wordOf(joint.type), joint.type == Robot::Type::planar ? "across" : "along",
                       joint.direction);
  if (joint.mimic) text += fmt::format(", follows {}", joint.mimic->joint);
  return text;
}

std::string massText(const Robot::Link& link) {
  return link.inertial ? decimal(link.inertial->mass) + " kg" : "no mass";
}

/// As a key or a text of TOML.
std::string textInToml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return quoted + "\"";
}
std::string keyInToml(const std::string& name) {
  const bool isPlain = std::ranges::all_of(name, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return isPlain ? name : textInToml(name);
}

std::string positionOf(const Robot::Joint& joint) {
  return joint.name + (joint.type == Robot::Type::prismatic ? ".displacement" : ".angle");
}

double startOf(const Robot::Joint& joint) {
  const double start = joint.type == Robot::Type::prismatic ? 0 : 0.2;
  if (!joint.limits || joint.type == Robot::Type::continuous) return start;
  const double lower = joint.limits->lower.value_or(0), upper = joint.limits->upper.value_or(0);
  return lower <= start && upper >= start ? start : (lower + upper) / 2;
}

/// The heaviest three of those that move, heaviest first.
std::vector<const Robot::Link*> heaviestOf(const Robot& robot) {
  std::map<std::string, bool> moves;
  std::vector<const Robot::Link*> links;
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Robot::Joint& joint = robot.joints[i];
    const Robot::Link& link = robot.links[i + 1];
    moves[link.name] = joint.type != Robot::Type::fixed || moves[joint.parent];
    if (moves[link.name] && link.inertial && link.inertial->mass.lower() > 0) links.push_back(&link);
  }
  std::ranges::stable_sort(links, [](const Robot::Link* a, const Robot::Link* b) {
    return midpoint(a->inertial->mass) > midpoint(b->inertial->mass);
  });
  links.resize(std::min<std::size_t>(links.size(), 3));
  return links;
}

}  // namespace

std::string summaryOf(const Robot& robot) {
  int freedom = 0;
  std::map<std::string_view, int> kinds;
  Interval mass(0.0);
  for (const Robot::Joint& joint : robot.joints) {
    freedom += freedomOf(joint);
    ++kinds[wordOf(joint.type)];
  }
  for (const Robot::Link& link : robot.links)
    if (link.inertial) mass += link.inertial->mass;
  std::string joints;
  for (const auto& [kind, count] : kinds) joints += fmt::format("{}{} {}", joints.empty() ? "" : ", ", count, kind);
  std::string text = fmt::format("{}: {}, {} {}{}{}, {} kg\n", robot.name.empty() ? "robot" : printable(robot.name),
                                 countText(static_cast<long long>(robot.links.size()), "link"), freedom,
                                 freedom == 1 ? "degree of freedom" : "degrees of freedom",
                                 joints.empty() ? "" : ", joints: ", joints, decimal(mass));

  std::vector<std::vector<std::string>> rows = {{robot.root().name, massText(robot.root()), "", "", ""}};
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const Robot::Joint& joint = robot.joints[i];
    const std::string indent(2 * static_cast<std::size_t>(std::min(joint.depth + 1, 30)), ' ');
    rows.push_back(
        {indent + joint.child, massText(robot.links[i + 1]), joint.name, jointText(joint), limitsText(joint)});
  }
  for (std::vector<std::string>& row : rows)
    for (std::string& cell : row) cell = printable(cell);
  return text + textTable(rows, 5);
}

std::string studyOf(const Robot& robot, const std::string& path) {
  const auto has = [&](auto what) { return std::ranges::any_of(robot.joints, what); };
  const bool hasFriction = has([](const Robot::Joint& joint) { return joint.friction.upper() > 0; });
  std::string text = fmt::format(
      "# How a robot moves when nothing drives it: a study to start from. `gamut quantities` lists what in it can be\n"
      "# uncertain, and what can be looked at.\n\n"
      "[study]\ntitle = {}\nanalysis = \"dynamics\"\nhorizon = 0.2       # s\noutput_step = 0.01  # s\n\n"
      "[mechanism]\nrobot = {}  # its path from here\n{}{}"
      "damping = true   # of the joints, as the robot's file has it\n"
      "friction = {}\nmimic = true     # joints that follow others do so\n",
      textInToml(robot.name.empty() ? "robot" : robot.name), textInToml(path),
      robot.isWorld ? "" : "base = \"fixed\"  # or \"free\"\n",
      robot.gravity ? "# gravity = [0, 0, -9.81]  # instead of what the robot's file has\n"
                    : "gravity = [0, 0, -9.81]\n",
      hasFriction ? "false # dry friction; true: as the robot's file has it" : "true  # likewise");

  std::vector<const Robot::Joint*> free;
  for (const Robot::Joint& joint : robot.joints)
    if (hasCoordinate(joint) && !joint.mimic) free.push_back(&joint);
  if (!free.empty()) text += "\n[mechanism.initial]  # of every joint, and its .rate: 0 unless given\n";
  for (const Robot::Joint* joint : free)
    text += fmt::format("{}.{} = \"{:.4g} {}\"\n", keyInToml(joint->name),
                        positionOf(*joint).substr(joint->name.size() + 1), startOf(*joint), unitOfCoordinate(*joint));

  text +=
      "\n# A motor that drives a joint, and something in the hand:\n"
      "# [[mechanism.element]]\n# type = \"joint-force\"\n# name = \"motor\"\n";
  const std::string some = free.empty() ? "JOINT" : free.front()->name;
  text += fmt::format("# joint = {}\n# force = \"-20 N m s/rad * '{}.rate'\"\n", textInToml(some), some);
  text += fmt::format("# [[mechanism.element]]\n# type = \"mass\"\n# name = \"load\"\n# at = {}\n# mass = \"1 kg\"\n",
                      textInToml(robot.links.back().name));

  const auto addUncertain = [&](const std::string& quantity, const char* interval) {
    text += fmt::format("\n[[uncertain]]\nquantity = {}\ninterval = \"{}\"\n", textInToml(quantity), interval);
  };
  const std::vector<const Robot::Link*> heaviest = heaviestOf(robot);
  for (const Robot::Link* link : heaviest) addUncertain(link->name + ".mass", "± 1 %");
  if (heaviest.empty() && !free.empty())
    addUncertain(positionOf(*free.front()), free.front()->type == Robot::Type::prismatic ? "± 1 mm" : "± 1 deg");

  constexpr std::size_t most = 12;
  for (std::size_t i = 0; i < std::min(free.size(), most); ++i)
    text += fmt::format("\n[[output]]\nquantity = {}\n", textInToml(positionOf(*free[i])));
  return text + "\n[[output]]\nquantity = \"energy\"\n";
}

}  // namespace gamut
