// What the file says of the outputs' polynomials.
#include "studies/results/surrogate.hpp"

#include <cmath>

namespace gamut {
namespace {

std::vector<Field> fieldsOf(SurrogateResult& s) {
  using namespace dimension;
  constexpr std::string_view part = "/surrogate/part", term = "/surrogate/term", number = "/surrogate/number";
  return s.fieldsAnd(
      {{"centre",
        &s.centre,
        unit::ofQuantity,
        "a value of the quantity is centre + half xi; 0 of one that the outputs do not depend on",
        {quantity}},
       {"half", &s.half, unit::ofQuantity, "likewise", {quantity}},
       {"part", &s.part, unit::none, "numbers of parts of the box", {part}, allowed::count},
       {"term", &s.term, unit::none, "numbers of terms", {term}, allowed::count},
       {"number", &s.number, unit::none, "numbers of coefficients", {number}, allowed::count},
       {"row", &s.row, unit::none, "index of the output time that the part is of, rising", {part}, allowed::count},
       {"first_term", &s.firstTerm, unit::none, "first of its terms", {part}, allowed::count},
       {"part_centre",
        &s.partCentre,
        unit::one,
        "the part is xi = part_centre + part_half eta, every eta from -1 to 1",
        {part, quantity}},
       {"part_half", &s.partHalf, unit::one, "likewise", {part, quantity}, allowed::share},
       {"exponent", &s.exponent, unit::none, "of each eta in a term", {term, quantity}, allowed::count},
       {"first", &s.first, unit::none, "first coefficient of an output on a part", {part, output}, allowed::count},
       {"count",
        &s.count,
        unit::none,
        "how many; they are those of the part's first terms; 0: there is no polynomial",
        {part, output},
        allowed::count},
       {"radius",
        &s.radius,
        unit::ofOutput,
        "the output is not farther than this from the polynomial, proved for every eta; NaN without one",
        {part, output}},
       noise({"coefficient", &s.coefficient, unit::none, "in the unit of the output", {number}, allowed::finite})});
}

}  // namespace

void SurrogateResult::describe(std::vector<Group>& groups) {
  groups.push_back(
      groupOf("/surrogate", "outputs as polynomials in the uncertain quantities, proved", *this, fieldsOf));
}

}  // namespace gamut
