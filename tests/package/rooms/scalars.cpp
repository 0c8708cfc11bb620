// The scalars alone: a fuzzy angle's sine. It fails unless the core holds the double nearest to sin(2).
#include <gamut/scalars/fuzzy.hpp>

int main() {
  const gamut::Fuzzy height = sin(gamut::Fuzzy::triangular(1.9, 2, 2.2, 5));
  return contains(height.core(), 0.90929742682568171) && isSubset(height.core(), height.support()) ? 0 : 1;
}
