// Terms in the order in which they are told.
#include "reports/page/glossary.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/words.hpp"

namespace gamut {
namespace {

struct Term {
  std::string_view id, word, sections, meaning;
};

constexpr Term terms[] = {
    {"case", "case", "found",
     "One set of values of all uncertain quantities within their stated tolerances. \u201cIn every case\u201d means: "
     "whatever they are."},
    {"simulated", "simulated", "found",
     "Cases whose values were drawn from the stated distributions, or are extreme, and whose motions were followed one "
     "by "
     "one."},
    {"proved", "proved", "found",
     "Computed with bounds that hold for all values of the stated intervals at once, rounding errors of the computer "
     "included."},
    {"corner", "corner", "found",
     "An extreme combination of the tolerances: each quantity has the least or the greatest of its values."},
    {"shrink", "tolerances shrink", "found",
     "All quantities deviate from their nominal values by no more than this share of what is stated."},
    {"share", "share in the spread", "found",
     "The part of the output\u2019s variance that is gone where this quantity alone is known exactly (Sobol\u2019 "
     "index)."},
    {"possibility", "possibility", "found",
     "How possible it is, by the stated membership functions, that a requirement is violated: from 0 to 1. It is no "
     "probability."},
    {"necessity", "necessity", "found", "1 less the possibility of the opposite: 1 where nothing else is possible."},
    {"guaranteed", "guaranteed", "found outputs numbers",
     "Proved: whatever values the uncertain quantities have in their stated intervals, the output does not leave these "
     "bounds. Rounding errors of the computer are covered, too."},
    {"probable", "probable", "found outputs",
     "Where most outputs lie if the quantities follow their stated distributions: from simulated samples, or, where "
     "bounds are drawn, proved."},
    {"possible", "possible", "found outputs",
     "Where the output lies if each quantity is as possible as its stated membership function says."},
    {"alpha-cut", "alpha-cut", "outputs memberships",
     "All values whose membership is at least alpha: at 0 the widest, at 1 the values that are fully possible."},
    {"membership", "membership", "outputs memberships",
     "How possible a value is, from 0, not at all, to 1, fully. It is no probability: memberships need not add up to "
     "1."},
    {"median", "median", "outputs", "Half of the samples lie below it, half above."},
    {"overestimation", "overestimation", "outputs numbers",
     "How many times as wide the guaranteed bounds are as what samples span. 1 is the best: nothing is given away."},
    {"margin", "margin", "found numbers",
     "How far a requirement is from its limit: above zero it is met, below it is violated."},
    {"cumulative", "cumulative probability", "probabilities",
     "The probability that the output is not above a value: it rises from 0 to 1."},
    {"quantile", "quantile", "probabilities samples",
     "The 5 % quantile is the value that five of a hundred samples stay below."},
    {"confidence", "confidence", "probabilities samples sensitivities",
     "An interval with 95 % confidence: of a hundred that are found so, about 95 hold the true number."},
    {"sobol", "Sobol", "sensitivities",
     "Sobol\u2019 index: the share of an output\u2019s variance that a quantity is to blame for, from 0 to 1; a total "
     "index counts what it does together with others, too."},
    {"derivative", "derivative", "sensitivities",
     "How much the output changes where a quantity changes by one unit and nothing else does."},
    {"enclosure", "enclosure", "numbers samples", "The guaranteed bounds of all outputs over all of the motion."},
    {"seed", "seed", "origin", "The number that chooses the random samples: the same seed gives the same samples."}};

bool isOf(const Term& term, std::string_view section) {
  const std::string all = fmt::format(" {} ", term.sections), one = fmt::format(" {} ", section);
  return all.find(one) != std::string::npos;
}

std::string buttonOf(const Term& term) { return fmt::format("popovertarget=\"term-{}\"", term.id); }

}  // namespace

std::string termsOf(std::string_view section, std::string_view text) {
  std::string buttons;
  for (const Term& term : terms)
    if (isOf(term, section) && text.find(term.word) != std::string_view::npos)
      buttons += fmt::format("<button type=\"button\" {}>{}</button> ", buttonOf(term), term.word);
  return buttons.empty() ? "" : fmt::format("<p class=\"terms\">What is meant by {}</p>\n", buttons);
}

std::string meanings(std::string_view text) {
  std::string html;
  for (const Term& term : terms)
    if (text.find(buttonOf(term)) != std::string_view::npos)
      html += fmt::format("<div class=\"meaning\" popover id=\"term-{}\"><b>{}</b> {}</div>\n", term.id, term.word,
                          escapeHtml(term.meaning));
  return html;
}

}  // namespace gamut
