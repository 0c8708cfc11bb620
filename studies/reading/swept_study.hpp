// A study whose stated numbers can be replaced by those of a sweep.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "studies/study.hpp"
#include "studies/sweep_plan.hpp"

namespace gamut {

/// The text of a study, in which numbers can be replaced.
class SweptStudy {
 public:
  /// Arguments as of readStudyText. Throws StudyError for a mechanism that cannot be read.
  SweptStudy(const std::string& text, const std::string& name, const std::vector<Described>& types = elementTypes(),
             const std::optional<FilesAtHand>& files = {});
  ~SweptStudy();
  SweptStudy(const SweptStudy&) = delete;
  SweptStudy& operator=(const SweptStudy&) = delete;

  /// Throws Refusal unless each axis is a number that the study states, by itself, of that kind: one of the mechanism,
  /// that of an uncertain quantity by the name of either, or a setting, "SECTION.KEY"; those of [study] by KEY alone
  /// too.
  void check(const SweepPlan& plan) const;
  /// A plan that was checked, with the numbers' own units.
  SweepPlan withUnits(SweepPlan plan) const;
  /// The study's text at a point of a plan that was checked.
  std::string at(const SweepPlan& plan, std::size_t point) const;

  /// What [[sweep]] states; no axis without it. Throws StudyError.
  SweepPlan plan() const;

 private:
  struct Read;
  std::unique_ptr<const Read> read_;
};

/// A list of points: the first row of a CSV file has the names, each followed by its unit if it has one, `rod.length
/// [mm]`; each other row is a point. `path`: what messages call the file. Throws StudyError, std::invalid_argument
/// with a sentence for a text that is no table.
SweepPlan sweepPoints(const std::string& text, const std::string& path);

}  // namespace gamut
