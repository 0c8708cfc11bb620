// The formats that robots are read from.
#pragma once

#include <string_view>

#include "studies/named_texts.hpp"
#include "studies/robots/robot.hpp"
#include "studies/robots/xml_source.hpp"

namespace gamut {

/// Throw StudyError. The shapes by which links touch are taken if they are asked for.
/// `meshes`: by the names by which it names them, what holds each (writtenHull), or, behind `brokenMesh`, what is
/// wrong.
inline constexpr std::string_view brokenMesh = "! ";
Robot readUrdf(const XmlSource& source, const NamedTexts& meshes, bool takesShapes);
Robot readSdf(const XmlSource& source, bool takesShapes);
/// `included`: texts of the files that it includes, by the names by which it does.
Robot readMjcf(const XmlSource& source, const NamedTexts& included, bool takesShapes);

}  // namespace gamut
