// The words of an element type as a list: for readers of files, which refuse other keys, and for the documentation.
#pragma once

#include <string>
#include <vector>

#include "mechanics/description/described.hpp"

namespace gamut {

/// What is written behind a key of a file.
struct Written {
  enum class Kind {
    name,       ///< a text
    word,       ///< one of `words`
    direction,  ///< "x" … "-z", or three numbers
    rotation,   ///< { axis, angle }, a list of these, { roll, pitch, yaw } or { quaternion }
    whole,      ///< a whole number from `least` to `most`
    number,     ///< or a formula
    numbers,    ///< a list of such, so many
    points,     ///< a list of lists of three numbers
    names,      ///< a list of texts
  };
  Kind kind = Kind::number;
  std::vector<std::string> words = {};
  std::size_t least = 0, most = 0;
};

struct ElementWords {
  struct Key {
    Word word;
    Written written;
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
