// What readers of all formats share: directions, what follows what, and what is said of what they leave out.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "studies/robots/robot.hpp"
#include "studies/robots/xml_source.hpp"

namespace gamut {

inline constexpr std::size_t mostLinks = 1000;

template <class Named>
auto findNamed(const std::vector<Named>& all, const std::string& name) {
  return std::ranges::find(all, name, &Named::name);
}

/// A direction by whole numbers, where doubles hold them: 0.6 0 0.8 is exactly that of 3 0 4. The zero vector is none.
Axis directionOf(const std::vector<std::string>& decimals);

/// Throws StudyError "file:line: what; expected …"; `file` is empty where it is the robot's.
[[noreturn]] void refuse(const Robot& robot, const std::string& file, int line, const std::string& what,
                         const std::string& expected);

/// Throws StudyError unless each follows a joint with one coordinate, and none itself in the end.
void checkMimics(const Robot& robot);

/// Links and joints from the root outwards, branch by branch, in the file's order, with their depths. Throws StudyError
/// unless they are one tree.
void sortOutwards(Robot& robot);

/// What a file holds beyond what is read, by name, with the line of the first.
class LeftOut {
 public:
  void add(const std::string& word, int line, const XmlSource* source = nullptr);
  /// A note, if there is anything: "<a> (2), <b>" and `what`; of `otherwise` where no source was named.
  void say(const XmlSource& otherwise, const std::string& what, std::vector<std::string>& notes) const;

 private:
  std::map<std::string, int> counts_;
  int first_ = 0;
  const XmlSource* source_ = nullptr;
};

}  // namespace gamut
