// Units as people wrote them, for those who tell numbers in the same.
#pragma once

#include <string>
#include <string_view>

namespace gamut {

/// The unit behind the one number of a text: "deg" of "-135 deg", "in" of "1/16 in", "km/h" of "50 km/h". Empty of
/// anything else: a plain number, a share in %, a multiple of pi, a formula.
std::string unitBehindNumber(std::string_view text);

}  // namespace gamut
