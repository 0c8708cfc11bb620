#include "studies/robots/robot_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "mechanics/description/names.hpp"
#include "mechanics/description/units.hpp"
#include "studies/study.hpp"
#include "studies/words.hpp"

namespace gamut {

Axis directionOf(const std::vector<std::string>& decimals) {
  mpq_class parts[3];
  mpz_class common = 1, divisor = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    parts[i] = parseAmount(decimals[i]).value;
    common = lcm(common, parts[i].get_den());
  }
  for (const mpq_class& part : parts) divisor = gcd(divisor, mpq_class(part * common).get_num());
  double direction[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const mpz_class whole = mpq_class(parts[i] * common).get_num() / divisor;
    direction[i] = whole.get_d();
    if (mpz_class(direction[i]) != whole || std::abs(direction[i]) > 0x1p53) {  // the nearest doubles, then
      for (std::size_t k = 0; k < 3; ++k) direction[k] = nearest(parseAmount(decimals[k]));
      break;
    }
  }
  return {direction[0], direction[1], direction[2]};
}

void refuse(const Robot& robot, const std::string& file, int line, const std::string& what,
            const std::string& expected) {
  throw StudyError(fmt::format("{}:{}", file.empty() ? robot.file : file, std::max(line, 1)), what, expected);
}

void checkMimics(const Robot& robot) {
  std::vector<std::string> known;
  std::map<std::string, const Robot::Joint*> named;
  for (const Robot::Joint& joint : robot.joints) {
    if (hasCoordinate(joint)) known.push_back(joint.name);
    named[joint.name] = &joint;
  }
  for (const Robot::Joint& joint : robot.joints) {
    if (!joint.mimic) continue;
    const auto fail = [&](const std::string& what, const std::string& expected) {
      refuse(robot, joint.mimic->file, joint.mimic->line, what, expected);
    };
    if (!hasCoordinate(joint))
      fail(fmt::format("{} is {} and follows another joint", inQuotes(joint.name), wordOf(joint.type)),
           "<mimic> in a joint that is revolute, continuous or prismatic");
    if (std::ranges::count(known, joint.mimic->joint) == 0)
      fail(fmt::format("there is no joint {} to follow", inQuotes(joint.mimic->joint)),
           expectedName(joint.mimic->joint, known));
    const Robot::Joint* leader = &joint;
    for (std::size_t i = 0; leader != nullptr && leader->mimic && i <= named.size(); ++i)
      leader = named[leader->mimic->joint];  // null where that joint is still to be looked at, and refused
    if (leader != nullptr && leader->mimic)
      fail(fmt::format("{} follows joints that follow one another in a circle", inQuotes(joint.name)),
           "a joint in the end that follows none");
  }
}

void sortOutwards(Robot& robot) {
  std::map<std::string, std::vector<const Robot::Joint*>> carried;  // by link
  std::map<std::string, const Robot::Joint*> carrying;
  for (const Robot::Joint& joint : robot.joints) {
    carried[joint.parent].push_back(&joint);
    carrying[joint.child] = &joint;
  }
  const Robot::Link* root = nullptr;
  for (const Robot::Link& link : robot.links) {
    if (carrying.contains(link.name)) continue;
    if (root != nullptr)
      refuse(robot, link.file, link.line,
             fmt::format("{} has no parent, and {} of line {} has none either", inQuotes(link.name),
                         inQuotes(root->name), root->line),
             "one root");
    root = &link;
  }
  std::vector<Robot::Link> links;
  std::vector<Robot::Joint> joints;
  if (root != nullptr) links.push_back(*root);
  std::vector<std::pair<const Robot::Joint*, int>> open;  // with their depths
  const auto lookBehind = [&](const std::string& link, int depth) {
    const auto& next = carried[link];
    for (auto joint = next.rbegin(); joint != next.rend(); ++joint) open.emplace_back(*joint, depth);
  };
  if (root != nullptr) lookBehind(root->name, 0);
  while (!open.empty()) {
    const auto [joint, depth] = open.back();
    open.pop_back();
    joints.push_back(*joint);
    joints.back().depth = depth;
    links.push_back(*findNamed(robot.links, joint->child));
    lookBehind(joint->child, depth + 1);
  }
  for (const Robot::Joint& joint : robot.joints)
    if (findNamed(joints, joint.name) == joints.end())
      refuse(robot, joint.file, joint.line,
             fmt::format("the links {} and {} carry one another in a circle, with joints such as {}",
                         inQuotes(joint.parent), inQuotes(joint.child), inQuotes(joint.name)),
             "a tree (a `closure` in the study closes loops)");
  robot.links = std::move(links);
  robot.joints = std::move(joints);
}

void LeftOut::add(const std::string& word, int line, const XmlSource* source) {
  if (counts_.empty()) {
    first_ = line;
    source_ = source;
  }
  ++counts_[word];
}

void LeftOut::say(const XmlSource& otherwise, const std::string& what, std::vector<std::string>& notes) const {
  if (counts_.empty()) return;
  std::vector<std::string> words;
  for (const auto& [word, count] : counts_) {
    if (words.size() == 12) {
      words.emplace_back("…");
      break;
    }
    words.push_back(count == 1 ? word : fmt::format("{} ({})", word, count));
  }
  const XmlSource& source = source_ == nullptr ? otherwise : *source_;
  notes.push_back(source.note(first_, fmt::format("{}{}", fmt::join(words, ", "), what)));
}

}  // namespace gamut
