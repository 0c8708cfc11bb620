// What the words of a page mean, said where they stand: each is a button that shows it, without a script.
#pragma once

#include <string>
#include <string_view>

namespace gamut {

/// The terms of a section that its text uses, as buttons; empty where it uses none.
std::string termsOf(std::string_view section, std::string_view text);

/// What all terms whose buttons are in the text mean, as elements that their buttons show.
std::string meanings(std::string_view text);

}  // namespace gamut
