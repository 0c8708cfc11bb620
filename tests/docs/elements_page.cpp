// Prints docs/elements.md.
#include <cstdio>

#include "mechanics/description/words.hpp"
#include "mechanics/elements/all.hpp"

int main() {
  std::printf(
      "# Elements\n\nThe types of elements of a mechanism, as `gamut` knows them; how they stand in a study: "
      "[study-file.md](study-file.md), how to\nwrite own ones: [own-elements.md](own-elements.md). Every element has a "
      "`type`, a `name` and, if need be, `parameters`. Numbers are in the\nunits given here unless they are text with "
      "a "
      "unit of their own.\n\n%s",
      gamut::elementPage(gamut::elementTypes()).c_str());
}
