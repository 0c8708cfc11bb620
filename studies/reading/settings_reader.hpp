// Sections of a study file that describe themselves.
#pragma once

#include <string_view>

#include "studies/reading/toml_source.hpp"

namespace gamut {

/// The table `name` of the file: fills in what needs no reader of its own. Throws StudyError, for keys that the section
/// has not and in kinematics for those of motion too.
TomlSection readSettings(const TomlSource& source, const toml::table& table, std::string_view name, Study& study);

}  // namespace gamut
