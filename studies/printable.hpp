// Texts that come from files go to terminals: what a terminal would obey is shown instead.
#pragma once

#include <string>
#include <string_view>

namespace gamut {

/// Whether control characters (Unicode's category Cc, line breaks and tabs among them) are in a UTF-8 text.
bool hasControlCharacters(std::string_view text);

/// Whether the bytes are UTF-8: of Unicode's code points, each in its shortest form.
bool isUtf8(std::string_view text);

/// The text with every control character written as an escape: "\n", "\u001b".
std::string printable(std::string_view text);

}  // namespace gamut
