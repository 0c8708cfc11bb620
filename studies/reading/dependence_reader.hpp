// [[dependence]]: how uncertain quantities hang together.
#pragma once

#include <vector>

#include "studies/reading/toml_source.hpp"
#include "studies/study.hpp"

namespace gamut {

/// Of a study whose uncertain quantities are known. Throws StudyError.
void readDependence(const TomlSource& source, const std::vector<const toml::table*>& tables, Study& study);

}  // namespace gamut
