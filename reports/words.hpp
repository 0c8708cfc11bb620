// Text from studies inside pages: nothing that an author wrote is taken for markup. Numbers as in studies/words.hpp.
#pragma once

#include <string>
#include <string_view>

#include "studies/words.hpp"

namespace gamut {

/// Safe inside an HTML or SVG element and inside a quoted attribute; bytes that are not UTF-8 become U+FFFD.
std::string escapeHtml(std::string_view text);

/// A JSON string with its quotes, safe inside a <script> element too.
std::string jsonText(std::string_view text);

}  // namespace gamut
