// A layer of a plot, stated once: what it is called, how it looks and what it draws from. The drawing on paper, the
// interactive plot, their key and their style sheet are made from the same layers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "studies/results/results.hpp"

namespace gamut {

/// A number a time; NaN where there is none.
using Line = std::vector<double>;

/// Whether a number has a place in a drawing: those that have not, NaN and what no differences, squares or decimals can
/// be taken of, are drawn as infinite ones, which end at the edge.
inline bool isDrawn(double x) {
  constexpr double greatest = 1e300;
  return x >= -greatest && x <= greatest;
}

/// Lower and upper line of one band.
struct Band {
  Line lower, upper;
};

/// On light and on dark paper, "#rrggbb".
struct Colour {
  std::string_view light, dark;
};

namespace colour {
inline constexpr Colour blue{"#1f5f99", "#6fb1ec"}, violet{"#7a4fa3", "#c09be6"}, orange{"#c46a00", "#f0a03c"},
    black{"#37424e", "#ccd5de"}, grey{"#8a97a5", "#7d8b99"}, red{"#b3261e", "#ff8a80"}, green{"#1a7f4b", "#5cc98f"},
    pink{"#ad1457", "#f48fb1"};
}

struct Style {
  Colour colour = {};
  double fill = 0;   ///< opacity between the two lines of a band, 0 … 1
  double width = 0;  ///< of the lines; 0: none
  bool isDashed = false;
};

struct Layer {
  enum class Kind {
    band,
    line,    ///< of the band the lower line, unfilled also where bands of that name are filled
    stack,   ///< several bands, from the widest to the narrowest; the levels say which
    whisker  ///< of the band an upright stroke a time, across it one in its middle: an estimate and its interval
  };

  std::string name = {};     ///< one word, in the page's style sheet and for its switches
  std::string words = {};    ///< in the key
  std::string readout = {};  ///< in front of its numbers where somebody points at the plot; empty: they are not said
  Style style = {};
  Kind kind = Kind::band;
  bool isProved = false;   ///< stays outside what it replaces where it is thinned
  bool isInSpread = true;  ///< has a meaning around the middle
  std::vector<Band> bands = {};
  std::vector<double> levels = {};
  std::vector<std::string> labels = {};  ///< at the end of each band, none or one

  /// Numbers of the bands that are drawn over time: of a stack a few tell its shape, the widest and the narrowest among
  /// them.
  std::vector<std::size_t> shown() const;
};

/// One output of results as a line; empty if there are none.
Line lineOf(const Table& grid, std::size_t output);
Band bandOf(const Bounds& bounds, std::size_t output);

}  // namespace gamut
