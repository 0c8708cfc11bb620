// Types of joints: their words, and the elements that they are.
#include "studies/robots/robot.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "mechanics/element_types.hpp"
#include "mechanics/elements/spherical.hpp"

namespace gamut {
namespace {

constexpr std::pair<Robot::Type, std::string_view> jointTypes[] = {
    {Robot::Type::revolute, "revolute"}, {Robot::Type::continuous, "continuous"}, {Robot::Type::prismatic, "prismatic"},
    {Robot::Type::fixed, "fixed"},       {Robot::Type::planar, "planar"},         {Robot::Type::floating, "floating"},
    {Robot::Type::ball, "ball"}};

/// By how many coordinates and speeds a joint of this type moves.
class Freedom final : public Onlooker {
 public:
  explicit Freedom(Robot::Type type) {
    Described element = elementOf(type);
    element.describe(*this);
  }

  int coordinates = 0, speeds = 0;

  void coordinate(const Word& /*position*/, Expression& /*initial*/, Coordinate /*kind*/, const Word& /*rate*/,
                  Expression& /*initialRate*/) override {
    ++coordinates;
    ++speeds;
  }
  void speed(const Word& /*word*/, Expression& /*initial*/) override { ++speeds; }
};

}  // namespace

std::string_view wordOf(Robot::Type type) {
  return std::ranges::find(jointTypes, type, &std::pair<Robot::Type, std::string_view>::first)->second;
}

const Described& elementOf(Robot::Type type) {
  static const std::vector<Described> elements = elementTypes();
  static const Described ball = Spherical{};
  if (type == Robot::Type::ball) return ball;
  const std::string word(wordOf(type));
  const auto found = std::ranges::find_if(
      elements, [&](const Described& one) { return std::ranges::count(one.urdfTypes(), word) > 0; });
  if (found == elements.end()) throw std::logic_error("no element is a joint of type " + word);
  return *found;
}

bool hasCoordinate(const Robot::Joint& joint) {
  const Freedom own(joint.type);
  return own.coordinates == 1 && own.speeds == 1;
}

int freedomOf(const Robot::Joint& joint) { return joint.mimic ? 0 : Freedom(joint.type).speeds; }

}  // namespace gamut
