// An element of MJCF with its attributes, some of which come from its class.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scalars/interval.hpp"
#include "studies/robots/xml_source.hpp"

namespace gamut {

/// An element, and the file in which it stands.
struct MjcfNode {
  const XmlSource* source = nullptr;
  const XmlSource::Element* tag = nullptr;

  int line() const { return tag->GetLineNum(); }
  std::string_view word() const { return tag->Name(); }
};

/// Attributes of an element, its own or those of its class. What they hold else than is asked for throws a StudyError.
class MjcfAttributes {
 public:
  struct Value {
    XmlSource::Stated stated;
    const XmlSource* source = nullptr;
  };

  explicit MjcfAttributes(MjcfNode of) : of_(of) {}

  /// Instead of those of the same names.
  void takeAll(const MjcfNode& node);
  void takeAll(const std::map<std::string, Value>& others);

  const std::map<std::string, Value>& all() const { return values_; }
  const Value* find(const std::string& name) const;
  bool has(const std::string& name) const { return find(name) != nullptr; }
  const Value& require(const std::string& name, const std::string& expected) const;

  std::string text(const std::string& name, const std::string& otherwise) const;
  /// One of the words.
  std::string choice(const std::string& name, const std::string& otherwise, const std::vector<std::string>& all) const;
  bool flag(const std::string& name, bool otherwise) const;
  /// Enclosures of those that stand there, `least` to `most`, of this unit if one is named.
  std::vector<Interval> numbers(const std::string& name, std::size_t least, std::size_t most,
                                const char* unit = "") const;
  std::vector<std::string> decimals(const std::string& name, std::size_t count) const;
  Interval number(const std::string& name, const Interval& otherwise, const char* unit = "") const;
  std::array<Interval, 3> vector(const std::string& name, const std::array<Interval, 3>& otherwise) const;
  /// At least 0; `what` has it.
  Interval size(const std::string& name, const Interval& otherwise, const std::string& what) const;

  /// Where this attribute stands, or the element.
  [[noreturn]] void fail(const std::string& name, const std::string& what, const std::string& expected) const;

 private:
  MjcfNode of_;
  std::map<std::string, Value> values_;
};

}  // namespace gamut
