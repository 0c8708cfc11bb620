#include "studies/study.hpp"

#include <utility>

#include "studies/printable.hpp"

namespace gamut {

StudyError::StudyError(std::string place, std::string problem, std::string expected)
    : std::runtime_error(complaintAt(place, problem, expected)),
      place_(std::move(place)),
      problem_(std::move(problem)),
      expected_(std::move(expected)) {}

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
