#include "studies/robots/mjcf_attributes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mechanics/description/names.hpp"

namespace gamut {

void MjcfAttributes::takeAll(const MjcfNode& node) {
  for (const auto* a = node.tag->FirstAttribute(); a != nullptr; a = a->Next())
    values_[a->Name()] = {
        {a->Value(), fmt::format("'{}' of <{}>", shortened(a->Name()), shortened(node.tag->Name())), a->GetLineNum()},
        node.source};
}

void MjcfAttributes::takeAll(const std::map<std::string, Value>& others) {
  for (const auto& [name, value] : others) values_[name] = value;
}

const MjcfAttributes::Value* MjcfAttributes::find(const std::string& name) const {
  const auto found = values_.find(name);
  return found == values_.end() ? nullptr : &found->second;
}

const MjcfAttributes::Value& MjcfAttributes::require(const std::string& name, const std::string& expected) const {
  const Value* value = find(name);
  if (value == nullptr)
    of_.source->fail(of_.line(), fmt::format("<{}> has no '{}'", shortened(of_.word()), name), expected);
  return *value;
}

std::string MjcfAttributes::text(const std::string& name, const std::string& otherwise) const {
  const Value* value = find(name);
  return value == nullptr ? otherwise : value->stated.text;
}

std::string MjcfAttributes::choice(const std::string& name, const std::string& otherwise,
                                   const std::vector<std::string>& all) const {
  const std::string word = text(name, otherwise);
  if (std::ranges::count(all, word) == 0)
    fail(name, fmt::format("{} is \"{}\"", find(name)->stated.what, shortened(word)), expectedName(word, all));
  return word;
}

bool MjcfAttributes::flag(const std::string& name, bool otherwise) const {
  return choice(name, otherwise ? "true" : "false", {"true", "false"}) == "true";
}

std::vector<Interval> MjcfAttributes::numbers(const std::string& name, std::size_t least, std::size_t most,
                                              const char* unit) const {
  const Value& value = require(name, most == 1 ? "a decimal number, such as 0.5" : "decimal numbers");
  std::vector<Interval> numbers;
  for (const std::string& decimal : value.source->decimals(value.stated, least, most))
    numbers.push_back(value.source->enclosure(value.stated, decimal, unit));
  return numbers;
}

std::vector<std::string> MjcfAttributes::decimals(const std::string& name, std::size_t count) const {
  numbers(name, count, count);  // each is one
  const Value& value = *find(name);
  return value.source->decimals(value.stated, count, count);
}

Interval MjcfAttributes::number(const std::string& name, const Interval& otherwise, const char* unit) const {
  return has(name) ? numbers(name, 1, 1, unit).front() : otherwise;
}

std::array<Interval, 3> MjcfAttributes::vector(const std::string& name,
                                               const std::array<Interval, 3>& otherwise) const {
  if (!has(name)) return otherwise;
  const std::vector<Interval> numbers = this->numbers(name, 3, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

Interval MjcfAttributes::size(const std::string& name, const Interval& otherwise, const std::string& what) const {
  const Interval value = number(name, otherwise);
  if (value.upper() < 0) fail(name, fmt::format("the {} of {} is negative", name, what), "a number of at least 0");
  return value;
}

void MjcfAttributes::fail(const std::string& name, const std::string& what, const std::string& expected) const {
  const Value* value = find(name);
  if (value == nullptr) of_.source->fail(of_.line(), what, expected);
  value->source->fail(value->stated.line, what, expected);
}

}  // namespace gamut
