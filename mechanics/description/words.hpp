// The words of an element type as a list: for readers of files, which refuse other keys, and for the documentation.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/described.hpp"

namespace gamut {

struct ElementWords {
  struct Key {
    Word word;
    bool isInitial = false;    ///< within the table `initial`
    std::string example = {};  ///< a value of such
  };
  std::vector<Key> keys;
  std::vector<Word> measured;
};

/// What an element of this type says of itself; `kind` is that of a coordinate that it refers to.
ElementWords wordsOf(Described element, Coordinate kind = Coordinate::angle);

/// The types as sections of a page in Markdown: a heading, what it is, a table of keys, what can be measured.
std::string elementPage(const std::vector<Described>& types);

}  // namespace gamut
