// A pendulum whose first angle is known to a tenth of a radian. It fails unless the exact angles after 1 s of the
// least, the middle and the largest start lie in the enclosure and the enclosure is not much wider than they need.
#include <gamut/flow.hpp>
#include <iostream>

using namespace gamut;

int main() {
  Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = x[1], dx[1] = -sin(x[0]); });
  Flow flow(f);
  Tube tube = flow.enclose(Box{Interval(0.9, 1.1), 0.0}, 1.0, {0.5, 1.0});
  const Interval angle = tube.at(1.0)[0];
  std::cout << "angle(1 s) in " << angle << ", proved up to " << tube.reached() << " s " << tube.why() << '\n';

  // theta(t) = 2 asin(k cd(t, k)), k = sin(theta(0) / 2), as the doubles nearest to them.
  constexpr double least = 0.52997008172902005, middle = 0.60008536612750644, largest = 0.67366092853158532;
  const bool inside = contains(angle, least) && contains(angle, middle) && contains(angle, largest);
  return inside && tube.reached() == 1.0 && tube.why().empty() && width(angle) < 1.01 * (largest - least) ? 0 : 1;
}
