// The skeleton of pages, with its named places filled.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace gamut {

/// What stands in the places of page.html, by their names; each is filled once, so text from a study is never searched.
using PagePlaces = std::map<std::string, std::string, std::less<>>;

/// Throws std::logic_error where the skeleton names a place that is not there.
std::string filledPage(const PagePlaces& places);

/// A script of the page.
std::string scriptElement(std::string_view text);

}  // namespace gamut
