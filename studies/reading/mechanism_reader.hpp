// The [mechanism] part of a study file.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "studies/reading/toml_source.hpp"

namespace gamut {

/// A mechanism, and where its numbers, parameters and elements stand, by their names.
struct ReadMechanism {
  Mechanism mechanism;
  std::map<std::string, const toml::node*> places;
};

/// Reads gravity, parameters and elements of these types, in the order of the file. Throws StudyError.
ReadMechanism readMechanism(const TomlSource& source, const toml::table& table, const std::vector<Described>& types);

}  // namespace gamut
