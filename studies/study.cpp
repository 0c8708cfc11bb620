#include "studies/study.hpp"

namespace gamut {

Expression WantedOutput::inUnit() const {
  const Amount one = oneOfUnit(unit);
  return one.value == 1 && one.piPower == 0 ? expression : expression / Expression(one);
}

const std::string& StudyPlaces::of(std::string name) const {
  while (!named.contains(name) && name.find('.') != std::string::npos) name.resize(name.rfind('.'));
  const auto found = named.find(name);
  return found == named.end() ? mechanism : found->second;
}

}  // namespace gamut
