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
        "range of the samples, corners and centre whose quantities lie in the cuts of that level",
        {alpha, time, output}}});
}

}  // namespace

std::string FuzzyResult::title() const { return "alpha-cuts"; }

std::string FuzzyResult::amount() const { return countText(static_cast<long long>(alpha.size()), "level"); }

void FuzzyResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/fuzzy", "what is possible: alpha-cuts of every output", *this, fieldsOf));
}

}  // namespace gamut
