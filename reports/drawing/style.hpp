// How the layers of a page's plots look, as CSS: on paper, on the screen and in their key.
#pragma once

#include <set>
#include <string>

#include "reports/drawing/plot.hpp"

namespace gamut {

class StyleSheet {
 public:
  /// Layers of one name look alike.
  void add(const Plot& plot);
  std::string css() const;

 private:
  std::set<std::string> names_;
  std::string light_, dark_, rules_;
};

}  // namespace gamut
