// Texts that come from files go to terminals: what a terminal would obey is shown instead, and of what is endless a
// part.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gamut {

/// Whether characters that are not seen but change what is seen are in a UTF-8 text: control characters (Unicode's
/// category Cc, line breaks and tabs among them), marks of writing direction, separators of lines and what is invisible
/// altogether (U+202E, U+2028, U+200B). Joiners within words are none.
bool hasControlCharacters(std::string_view text);

/// Whether the bytes are UTF-8: of Unicode's code points, each in its shortest form.
bool isUtf8(std::string_view text);

/// The text with every such character written as an escape: "\n", "\u001b", "\u202e".
std::string printable(std::string_view text);
/// The same but for line breaks and tabs, which stay.
std::string printableLines(std::string_view text);

/// The text, or, if it is longer than `most` bytes, its begin and its end, and how long it is.
std::string shortened(std::string_view text, std::size_t most);

/// A sentence as what a line has in front of its one semicolon: its own ones become commas.
std::string withoutSemicolons(std::string sentence);

/// "PLACE: WHAT; expected EXPECTED", printable and not too long to be read, whatever of a file is quoted in it.
std::string complaintAt(std::string_view place, std::string_view what, std::string_view expected);

}  // namespace gamut
