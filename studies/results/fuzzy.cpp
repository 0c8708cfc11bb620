// What the file says of the alpha-cuts.
#include "studies/results/fuzzy.hpp"

#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(FuzzyResult& r) {
  using namespace dimension;
  return r.fieldsAnd(
      {{"alpha", &r.alpha, unit::one, "membership levels, the widest cut first", {alpha}, allowed::share},
       {"outer", &r.outer, unit::ofOutput, "proved alpha-cuts", {alpha, time, output}},
       {"inner",
        &r.inner,
        unit::ofOutput,
        "range of the samples, corners, centre, points and extremes whose quantities lie in the cuts of that level",
        {alpha, time, output}}});
}

std::vector<Field> fieldsOfTransformation(TransformationResult& r) {
  using namespace dimension;
  return {
      {"method", &r.method, unit::none,
       "\"reduced\": corners of the cuts; \"general\": values between their ends, too; \"extended\": these of "
       "quantities in which outputs turn"},
      {"stepped",
       &r.stepped,
       unit::none,
       "1 of a quantity that takes values between the ends of its cuts, else 0; absent where that was not found out",
       {quantity},
       {0, 1}},
      {"turns",
       &r.turns,
       unit::one,
       "extended: how far an output goes back while the quantity rises from one end to the other, at most, over the "
       "output's range at that time",
       {quantity},
       allowed::share},
      {"gap",
       &r.gap,
       unit::one,
       "width of the proved cut minus width of that of the samples, over the width of the widest proved cut, at the "
       "time at which that is greatest; NaN where no sample is so possible, or the widest cut too narrow to tell",
       {alpha, output}},
      {"gap_time", &r.gapTime, unit::second, "that time; NaN likewise", {alpha, output}}};
}

std::vector<Field> fieldsOfInfluence(InfluenceResult& r) {
  constexpr std::string_view when = "/fuzzy/influence/time";
  return {{"time", &r.time, unit::second, "some output times", {when}},
          {"share",
           &r.share,
           unit::one,
           "share of a quantity in what deviations by equal shares of the quantities' values do to the output "
           "(measures of influence after Hanss, from the corners of the cuts); NaN where none does anything",
           {when, dimension::output, dimension::quantity}}};
}

}  // namespace

std::string FuzzyResult::title() const { return "alpha-cuts"; }

std::string FuzzyResult::amount() const {
  return countText(static_cast<long long>(alpha.size()), "level") +
         (transformation.present ? "; samples by the " + transformation.method + " transformation method" : "");
}

void FuzzyResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/fuzzy", "what is possible: alpha-cuts of every output", *this, fieldsOf));
  groups.push_back(groupOf("/fuzzy/transformation", "where samples lie inside the alpha-cuts, and what they leave",
                           transformation, fieldsOfTransformation));
  groups.back().inJson = {{"stepped", ""}, {"turns", ""}, {"gap", "*/gap"}, {"gap_time", "*/time"}};
  groups.back().makesSense = [this](std::size_t) { return areShares(transformation.gap); };
  groups.push_back(groupOf("/fuzzy/influence", "how much each quantity matters", influence, fieldsOfInfluence));
  groups.back().makesSense = [this](std::size_t) { return areShares(influence.share); };
}

}  // namespace gamut
