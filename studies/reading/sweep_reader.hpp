// The [[sweep]] part of a study file, and what of a study can be swept.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "studies/reading/toml_source.hpp"
#include "studies/sweep_plan.hpp"

namespace gamut {

/// What is stated in a study: the numbers of its mechanism by their names, and the file.
struct StatedPlaces {
  const TomlSource& source;
  const Mechanism& mechanism;
  const std::map<std::string, const toml::node*>& places;

  /// Where the number of this name stands. Throws Refusal if there is none that stands by itself.
  const toml::node& of(const std::string& name) const;
  /// Its SI unit; none where that is not known here.
  std::optional<std::string> unitOf(const std::string& name) const;
  /// Throws Refusal where an axis is no such number, or of another kind.
  void check(const SweepAxis& axis) const;
};

/// Each table an axis. Throws StudyError.
SweepPlan readSweep(const StatedPlaces& stated, const std::vector<const toml::table*>& tables);

/// What stands in the list of tables of this name; throws StudyError where it is none.
std::vector<const toml::table*> tablesIn(const TomlSource& source, std::string_view name);

}  // namespace gamut
