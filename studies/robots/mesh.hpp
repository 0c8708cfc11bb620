// Convex shapes that hold meshes: the hull of few of a mesh's points, and all within a radius of it. Each point of the
// mesh is proved to lie within: it is no farther than that from a point of the hull, which is a mean of its points.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gamut {

struct MeshHull {
  std::vector<std::array<double, 3>> points;  ///< in the unit of the file; 40 at most, which do not lie in one plane
  double radius = 0;                          ///< likewise
};

/// Of the text of an STL file (of either kind) or an OBJ file, as its `name` ends; none for other formats. Throws
/// std::invalid_argument, with a sentence about the file, where it is broken, has no points, too many, or such as lie
/// in one plane.
std::optional<MeshHull> hullOfMesh(const std::string& text, const std::string& name);

/// One line of text, and back. The latter throws std::invalid_argument for what is no such line.
std::string writtenHull(const MeshHull& hull);
MeshHull hullIn(const std::string& text);

}  // namespace gamut
