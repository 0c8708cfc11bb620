// Texts of files by the names that a study has for them, and all of them in one text.
#pragma once

#include <map>
#include <string>

namespace gamut {

using NamedTexts = std::map<std::string, std::string>;

/// A JSON object; empty for none.
std::string inOneText(const NamedTexts& texts);
/// The texts again. Throws std::invalid_argument, with a sentence, for what is no such text.
NamedTexts namedTextsIn(const std::string& text);

}  // namespace gamut
