// The [mechanism] part of a study file.
#pragma once

#include "mechanics/description/mechanism.hpp"
#include "studies/reading/toml_source.hpp"

namespace gamut {

/// Reads gravity, parameters and elements of these types, in the order of the file. Throws StudyError.
Mechanism readMechanism(const TomlSource& source, const toml::table& table, const std::vector<Described>& types);

}  // namespace gamut
