// Lines, messages and numbers of an XML file.
#include "studies/robots/xml_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "mechanics/description/units.hpp"
#include "studies/printable.hpp"

namespace gamut {
namespace {

/// Document types: the home of entities, which would be expanded if they were read.
class DocumentTypes final : public tinyxml2::XMLVisitor {
 public:
  bool Visit(const tinyxml2::XMLUnknown& unknown) override {
    if (line == 0) line = std::max(unknown.GetLineNum(), 1);
    return line == 0;
  }
  int line = 0;
};

/// Of an error of the parser, in words.
std::string describe(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "there is nothing in it";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested too deeply";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element is not closed, or closed by another name";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not NAME=\"VALUE\", or there twice";
    default:
      return "it cannot be parsed";
  }
}

bool isDecimal(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

std::string tagOf(const XmlSource::Element& element) { return fmt::format("<{}>", shortened(element.Name())); }

}  // namespace

std::string shortened(std::string_view text) {
  constexpr std::size_t most = 60;
  if (text.size() <= most) return std::string(text);
  std::size_t end = most;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // no character is cut
  return std::string(text.substr(0, end)) + "…";
}

XmlSource::XmlSource(const std::string& text, std::string name) : name_(std::move(name)) {
  if (text.find('\0') != std::string::npos || !isUtf8(text)) fail(1, "is no text in UTF-8", "XML");
  if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    fail(document_.ErrorLineNum(), "not valid XML: " + describe(document_.ErrorID()),
         "elements such as <robot> … </robot>");
  DocumentTypes types;
  document_.Accept(&types);
  if (types.line != 0) fail(types.line, "a document type, or another <! … >", "XML without, as no entity is expanded");
}

const XmlSource::Element& XmlSource::root() const {
  const Element* root = document_.RootElement();
  if (root == nullptr) fail(1, "there is no element in it", "elements such as <robot> … </robot>");
  if (const Element* other = root->NextSiblingElement())
    fail(other->GetLineNum(), fmt::format("{} follows {}", tagOf(*other), tagOf(*root)), "one outermost element");
  return *root;
}

void XmlSource::fail(int line, const std::string& what, const std::string& expected) const {
  throw StudyError(fmt::format("{}:{}", name_, std::max(line, 1)), what, expected);
}

std::string XmlSource::note(int line, const std::string& text) const {
  return printable(fmt::format("{}:{}: note: {}", name_, std::max(line, 1), shortened(text, 1000)));
}

const XmlSource::Element* XmlSource::child(const Element& parent, const char* name) const {
  const Element* child = parent.FirstChildElement(name);
  if (child == nullptr) return nullptr;
  if (const Element* other = child->NextSiblingElement(name))
    fail(other->GetLineNum(), fmt::format("{} has two <{}>", tagOf(parent), name), "one");
  return child;
}

const XmlSource::Element& XmlSource::requiredChild(const Element& parent, const char* name,
                                                   const std::string& expected) const {
  const Element* found = child(parent, name);
  if (found == nullptr) fail(parent.GetLineNum(), fmt::format("{} has no <{}>", tagOf(parent), name), expected);
  return *found;
}

std::string XmlSource::requiredName(const Element& element, const char* attribute, const std::string& expected) const {
  const char* text = element.Attribute(attribute);
  const int line = element.GetLineNum();
  if (text == nullptr) fail(line, fmt::format("{} has no '{}'", tagOf(element), attribute), expected);
  const std::string name(text);
  if (name.find_first_not_of(' ') == std::string::npos)
    fail(line, fmt::format("'{}' of {} is empty", attribute, tagOf(element)), expected);
  if (hasControlCharacters(name) || name.find('\'') != std::string::npos || name.size() > 200)
    fail(line, fmt::format("'{}' of {} is \"{}\"", attribute, tagOf(element), shortened(name)),
         "a name without ' and control characters, of at most 200 bytes");
  return name;
}

std::vector<std::string> XmlSource::decimals(const Stated& stated, std::size_t least, std::size_t most) const {
  const std::string expected = most == 1       ? "a decimal number, such as 0.5"
                               : least == most ? fmt::format("{} decimal numbers", most)
                                               : fmt::format("{} to {} decimal numbers", least, most);
  const std::string blanks = " \t\r\n";
  const auto& [text, what, line] = stated;
  if (text.find("${") != std::string::npos || text.find("$(") != std::string::npos)
    fail(line, fmt::format("{} is \"{}\", which only xacro can read", what, shortened(text)),
         "the file that xacro makes of this one");
  std::vector<std::string> tokens;
  for (std::size_t at = text.find_first_not_of(blanks); at != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    std::string token = text.substr(at, end - at);
    if (token.front() == '+') token.erase(0, 1);
    if (!isDecimal(token)) fail(line, fmt::format("{} is \"{}\"", what, shortened(text)), expected);
    tokens.push_back(token);
    at = text.find_first_not_of(blanks, end);
  }
  if (tokens.size() < least || tokens.size() > most)
    fail(line, fmt::format("{} has {} {}", what, tokens.size(), tokens.size() == 1 ? "number" : "numbers"), expected);
  return tokens;
}

std::vector<std::string> XmlSource::decimals(const Element& element, const char* attribute, std::size_t count) const {
  const std::string what = fmt::format("'{}' of {}", attribute, tagOf(element));
  const char* value = element.Attribute(attribute);
  if (value == nullptr)
    fail(element.GetLineNum(), fmt::format("{} has no '{}'", tagOf(element), attribute),
         count == 1 ? "a decimal number, such as 0.5" : fmt::format("{} decimal numbers", count));
  return decimals({value, what, element.GetLineNum()}, count, count);
}

Interval XmlSource::enclosure(const Stated& stated, const std::string& decimal, const char* unit) const {
  try {
    return enclose(parseAmount(*unit == '\0' ? decimal : fmt::format("{} {}", decimal, unit)));
  } catch (const UnitError&) {
    fail(stated.line, fmt::format("{} is \"{}\"", stated.what, shortened(decimal)), "a decimal number, such as 0.5");
  }
}

std::vector<Interval> XmlSource::numbers(const Element& element, const char* attribute, std::size_t count) const {
  const std::string what = fmt::format("'{}' of {}", attribute, tagOf(element));
  std::vector<Interval> numbers;
  for (const std::string& decimal : decimals(element, attribute, count))
    numbers.push_back(enclosure({decimal, what, element.GetLineNum()}, decimal));
  return numbers;
}

Interval XmlSource::number(const Element& element, const char* attribute, const Interval& otherwise) const {
  return element.Attribute(attribute) == nullptr ? otherwise : numbers(element, attribute, 1).front();
}

}  // namespace gamut
