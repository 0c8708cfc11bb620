// The sections of a page, each from results to HTML. What analyses add to them is in reports/sections/.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "reports/drawing/plot.hpp"
#include "reports/page/detail.hpp"
#include "reports/verdict.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// The title, or the study's file.
std::string titleOf(const Results& results);

/// What was asked, in one line.
std::string summaryLine(const Results& results);

/// The verdict's notes as a list; empty without notes.
std::string notesList(const Verdict& verdict);

/// The plots of all outputs, with what they need elsewhere in the page.
struct OutputPlots {
  std::string html;   ///< a key and a section an output
  std::string style;  ///< CSS of the plots' layers
  std::string data;   ///< JSON: the times of the interactive plots; empty where nothing moves
};
OutputPlots outputPlots(const Results& results, const Detail& detail);

/// Cards with figures, and the CSS of their layers; empty where there are none.
struct PlotSection {
  std::string html, style;
};
/// Distribution functions, mean and quantiles.
PlotSection probabilityPlots(const Results& results, const Detail& detail);
/// Shares of the variance, derivatives and their like.
PlotSection sensitivityPlots(const Results& results, const Detail& detail);

/// Membership functions of all outputs at some times; empty where there are none.
std::string membershipFigures(const Results& results, const Detail& detail);

/// How the worst requirement that limits an output stands.
struct OutputState {
  int severity = 0;         ///< as severityOf
  std::string tone, words;  ///< its class in the style sheet: "violated"; "violated in simulation"
};
/// Nothing where none does.
std::optional<OutputState> stateOfOutput(const Results& results, std::size_t output);

/// What each quantity alone does at an output time to what is limited there, and its share; empty where the results do
/// not know it. Beside it, of the requirement, the tolerance that would do alone.
std::string whatToDo(const Results& results, const RequirementResult& requirement, std::size_t margin, std::size_t row,
                     bool isOpen);

/// "damper 76 %, body 24 %": the quantities with the greatest shares in an output's spread at a time (s), three at
/// most; the only one there is; empty where that is not known.
std::string leadingCauses(const Results& results, std::size_t output, double time);

/// The share of a quantity in an output's spread, at the time next to this one (s) at which it is known: "76 %", "about
/// 24 %"; empty where it is not.
std::string shareOfSpread(const Results& results, std::size_t output, std::size_t quantity, double time);

/// The output that is drawn first.
std::size_t foremostOutput(const Results& results);

/// What an essential plot shows, in words, so that it needs no key: "Grey: the ends between which it lies …; dashed
/// red: the limit."
std::string essentialsInWords(const Plot& plot);
/// Of an output what is known the best, a middle, and the limits of one requirement.
Plot essentialPlot(const Results& results, std::size_t output, std::optional<std::size_t> requirement);

/// What sections are made of.
struct Report {
  const Results& results;
  Detail detail;
  Verdict verdict;
  OutputPlots outputs;
  std::string memberships;
  PlotSection probabilities, sensitivities;
};

/// How many requirements can fail, and whether samples were checked to lie inside, each a link to more of it.
std::string chipsOf(const Report& report);

/// Where the slider of the page's time is put: it begins at the instant at which the foremost output is looked at.
std::string clockOf(const Results& results);

/// What holds in every case, whether the answers agree, and the one plot that matters.
std::string firstSection(const Report& report);

/// The requirements, a card each, the worst first; empty without requirements.
std::string requirementCards(const Report& report);

/// The uncertain quantities.
std::string askedSection(const Report& report);

/// The machine, drawn, with the numbers that make it move; empty where there is none.
std::string machineSection(const Report& report);

/// The samples that were kept, one by one, to be chosen among; empty where there are none.
std::string explorerSection(const Report& report);

/// The map of what outputs can reach; empty where nobody asked for it.
std::string workspaceSection(const Report& report);

/// Shapes of modes; empty where nobody asked for them.
std::string modesSection(const Report& report);

/// One row an output: what the analyses found at the last time that all of them reached. Then what each of them cost.
std::string figuresSection(const Report& report);

/// The plots of every output.
std::string outputsSection(const Report& report);

/// How possible their values are.
std::string membershipSection(const Report& report);

/// How probable their values are.
std::string probabilitySection(const Report& report);

/// Whose doing their spread is.
std::string sensitivitySection(const Report& report);

/// What the samples can tell, and what not.
std::string samplesSection(const Report& report);

/// Version, machine, date, seed, study file, libraries; the study word for word.
std::string provenanceSection(const Report& report);

}  // namespace gamut
