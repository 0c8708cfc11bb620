// An XML file with lines: every complaint says file:line, and a number is read from the characters that stand there.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <string_view>
#include <vector>

#include "scalars/interval.hpp"
#include "studies/study.hpp"

namespace gamut {

/// What a message says of a text that may be long: its beginning.
std::string shortened(std::string_view text);

/// The text of one XML file and its parsed tree. Entities other than XML's own five are not expanded, and what is
/// nested deeper than 100 elements is refused, so that the tree is no greater than the text says.
class XmlSource {
 public:
  using Element = tinyxml2::XMLElement;

  /// `name` is what messages call the file. Throws StudyError for text that is not XML in UTF-8.
  XmlSource(const std::string& text, std::string name);

  /// Throws StudyError if there is none, or more than one.
  const Element& root() const;

  /// Throws StudyError "file:line: what; expected …".
  [[noreturn]] void fail(int line, const std::string& what, const std::string& expected) const;
  /// "file:line: note: text", for what is no error.
  std::string note(int line, const std::string& text) const;

  /// The child of this name, or null. Throws StudyError if there are two.
  const Element* child(const Element& parent, const char* name) const;
  /// Throws StudyError if there is none.
  const Element& requiredChild(const Element& parent, const char* name, const std::string& expected) const;
  /// Throws StudyError if it is missing or empty, or holds what a name cannot hold: control characters and '.
  std::string requiredName(const Element& element, const char* attribute, const std::string& expected) const;
  /// The tightest enclosures of decimals, `count` of them separated by blanks; of an attribute that there must be.
  std::vector<Interval> numbers(const Element& element, const char* attribute, std::size_t count) const;
  /// The same of one; `otherwise` without the attribute.
  Interval number(const Element& element, const char* attribute, const Interval& otherwise) const;
  /// The texts of the numbers.
  std::vector<std::string> decimals(const Element& element, const char* attribute, std::size_t count) const;

  /// A text that holds numbers, and how messages call it.
  struct Stated {
    std::string text, what;
    int line = 0;
  };
  /// Its decimals, `least` to `most` of them.
  std::vector<std::string> decimals(const Stated& stated, std::size_t least, std::size_t most) const;
  /// The tightest enclosure of a decimal, of this unit if one is named; in SI units.
  Interval enclosure(const Stated& stated, const std::string& decimal, const char* unit = "") const;
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  tinyxml2::XMLDocument document_;
};

}  // namespace gamut
