// How probable and how possible the values of an uncertain quantity are: the keys `distribution` and `membership`.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "studies/reading/table_reader.hpp"
#include "studies/reading/toml_source.hpp"
#include "studies/study.hpp"

namespace gamut {

/// How a deviation to both sides begins.
constexpr std::array<std::string_view, 3> deviationSigns{"±", "+-", "+/-"};

// `section`: of the quantity; `types`: what both may be of. Each throws StudyError.

/// What its distribution and membership are stated on; empty if neither says so.
Interval supportsOf(const TomlSource& source, const TomlSection& section, const TableFiles& files,
                    const ShapeTypes& types, const UncertainQuantity& quantity);

/// Reads both into the quantity, whose range and nominal value are known: of what is not stated, uniform and
/// triangular.
void readShapes(const TomlSource& source, const TomlSection& section, const TableFiles& files, const ShapeTypes& types,
                UncertainQuantity& quantity);

/// The tables of docs/study-file.md.
std::string shapesGuide(const ShapeTypes& types);

/// [lower, upper] as the hull of both enclosures.
Interval readPair(const TomlSource& source, const toml::node& node, const std::string& what,
                  const Dimension& dimension);

}  // namespace gamut
