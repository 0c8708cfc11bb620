// What is said of several at once, said of each.
#include "mechanics/description/fields.hpp"

#include "mechanics/description/orientation.hpp"

namespace gamut {
namespace {

Word part(const Word& word, const std::string& component) {
  return {word.key + "." + component, word.unit, word.meaning};
}

}  // namespace

void Fields::coordinates(const Word& position, ExpressionVector& initial, Coordinate kind, const Word& rate,
                         ExpressionVector& initialRates) {
  for (std::size_t i = 0; i < 3; ++i)
    coordinate(part(position, components[i]), initial[i], kind, part(rate, components[i]), initialRates[i]);
}

void Fields::orientation(const Word& word, std::vector<FixedRotation>& initial, const Word& rate,
                         ExpressionVector& initialRates) {
  rotations(word, initial);
  Quaternion<Expression> quaternion = quaternionOf(initial);
  for (std::size_t i = 0; i < 4; ++i)
    position({std::string("quaternion.") + quaternionComponents[i], "1", "of the orientation"}, quaternion[i]);
  for (std::size_t i = 0; i < 3; ++i) speed(part(rate, components[i]), initialRates[i]);
}

}  // namespace gamut
