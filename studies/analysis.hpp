// What a study may ask for beside the answers that `compare` names: an analysis says which section of the study file
// asks for it, what its part of the results holds, and how that is found. Each stands in files of its own in
// studies/analyses/; own ones may be handed to readStudyText().
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

class Settings;
struct Results;
struct Run;
struct Study;

class FurtherAnalysis {
 public:
  virtual ~FurtherAnalysis() = default;
  virtual std::unique_ptr<FurtherAnalysis> copy() const = 0;

  /// The name of its section, and what this is about.
  virtual std::string_view section() const = 0;
  virtual std::string_view meaning() const = 0;
  /// Its settings: members.
  virtual void describe(Settings& settings) = 0;
  virtual bool isAsked() const = 0;

  struct Refusal {
    std::string key, problem, expected;
  };
  /// Why a study cannot ask for this.
  virtual std::optional<Refusal> refusal(const Study& /*study*/) const { return {}; }

  /// An empty one.
  virtual std::unique_ptr<FurtherPart> part() const = 0;
  /// From the run's machine and what it has found before. What is spent, an interrupt and a lack of memory are noted by
  /// the run.
  virtual void find(Run& run, const Results& before, FurtherPart& part) const = 0;
};

/// One that finds a `Found`: Self has `void find(Run&, const Results&, Found&) const`.
template <class Self, class Found>
class AnalysisOf : public FurtherAnalysis {
 public:
  std::unique_ptr<FurtherAnalysis> copy() const override {
    return std::make_unique<Self>(static_cast<const Self&>(*this));
  }
  std::unique_ptr<FurtherPart> part() const override { return std::make_unique<Found>(); }
  void find(Run& run, const Results& before, FurtherPart& part) const final {
    static_cast<const Self&>(*this).find(run, before, static_cast<Found&>(part));
  }
};

using AnalysisType = std::unique_ptr<FurtherAnalysis> (*)();

/// All of studies/analyses/: listed by CMake.
std::vector<AnalysisType> analysisTypes();

/// One of each, that nothing asks for yet. Throws std::invalid_argument where two have one section.
std::vector<Boxed<FurtherAnalysis>> made(const std::vector<AnalysisType>& types);

}  // namespace gamut
