// The nearest point of a hull is found as that of simplices of its corners, one corner more at a time (E. G. Gilbert,
// D. W. Johnson and S. S. Keerthi, IEEE J. Robotics and Automation 4 (1988), 193). Whatever weights λ ≥ 0 that finds,
// in doubles, Σ λ c / Σ λ is a point of the hull, and so |v − Σ λ c / Σ λ|, by intervals, no less than the distance of
// v.
#include "studies/robots/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <queue>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "mechanics/polyhedron.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/interval.hpp"

namespace gamut {
namespace {

using MeshPoint = std::array<double, 3>;
constexpr std::size_t mostMeshPoints = 100'000;

Eigen::Vector3d vectorOf(const MeshPoint& point) { return {point[0], point[1], point[2]}; }

double coordinateIn(std::string_view word) {
  double value = 0;
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
    throw std::invalid_argument(fmt::format("has '{}' for a coordinate", word.substr(0, 20)));
  return value;
}

/// Of lines that begin with this word, the three numbers behind it.
std::vector<MeshPoint> pointsBehind(const std::string& text, std::string_view word) {
  std::vector<MeshPoint> points;
  std::istringstream lines(text);
  for (std::string line, first; std::getline(lines, line);) {
    std::istringstream words(line);
    if (!(words >> first) || first != word) continue;
    MeshPoint& point = points.emplace_back();
    for (double& coordinate : point) {
      std::string number;
      if (!(words >> number)) throw std::invalid_argument("has a point of less than three coordinates");
      coordinate = coordinateIn(number);
    }
  }
  return points;
}

constexpr std::size_t stlHead = 84, stlFacet = 50;  // bytes

std::uint32_t wordAt(const std::string& bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

std::vector<MeshPoint> pointsOfStl(const std::string& text) {
  if (text.size() < stlHead || text.size() != stlHead + stlFacet * wordAt(text, stlHead - 4)) {
    if (text.starts_with("solid")) return pointsBehind(text, "vertex");
    throw std::invalid_argument(text.size() < stlHead ? "is too short for STL"
                                                      : fmt::format("says to have {} triangles, but has {} bytes",
                                                                    wordAt(text, stlHead - 4), text.size()));
  }
  std::vector<MeshPoint> points;
  for (std::size_t at = stlHead; at < text.size(); at += stlFacet)
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      MeshPoint& point = points.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        point[i] = std::bit_cast<float>(wordAt(text, at + 12 * corner + 4 * i));
        if (!std::isfinite(point[i])) throw std::invalid_argument("has a coordinate that is no number");
      }
    }
  return points;
}

/// Numbers ≥ 0, one for each of these points, of the mean that is nearest to the origin; by Cramer of their faces.
struct NearestMean {
  std::vector<double> weights;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
};

NearestMean nearestMean(const std::vector<Eigen::Vector3d>& points) {
  NearestMean best;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned some = 1; some < 1U << points.size(); ++some) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((some >> i & 1U) != 0) chosen.push_back(i);
    const auto n = static_cast<Eigen::Index>(chosen.size()) - 1;
    Eigen::MatrixXd edges(3, n);
    for (Eigen::Index k = 0; k < n; ++k)
      edges.col(k) = points[chosen[static_cast<std::size_t>(k) + 1]] - points[chosen[0]];
    const Eigen::VectorXd along =
        n == 0 ? Eigen::VectorXd()
               : Eigen::VectorXd(safelySolved(edges.transpose() * edges, -edges.transpose() * points[chosen[0]]));
    if (n > 0 && (!(along.minCoeff() >= 0) || !(along.sum() <= 1))) continue;
    const Eigen::Vector3d place = n == 0 ? points[chosen[0]] : Eigen::Vector3d(points[chosen[0]] + edges * along);
    if (!(place.squaredNorm() < least)) continue;
    least = place.squaredNorm();
    best = {std::vector<double>(points.size(), 0.0), place};
    best.weights[chosen[0]] = n == 0 ? 1 : std::max(0.0, 1 - along.sum());
    for (Eigen::Index k = 0; k < n; ++k) best.weights[chosen[static_cast<std::size_t>(k) + 1]] = along[k];
  }
  return best;
}

/// No less than how far the point is from the hull of these.
double distanceBound(const MeshPoint& point, const std::vector<MeshPoint>& hull) {
  constexpr int most = 60;
  constexpr double digits = 1e-9;
  std::vector<std::size_t> simplex = {0};
  std::vector<double> weights = {1};
  Eigen::Vector3d place = vectorOf(hull[0]) - vectorOf(point);
  for (int step = 0; step < most; ++step) {
    std::size_t next = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.size(); ++i)
      if (const double along = place.dot(vectorOf(hull[i]) - vectorOf(point)); along < least) least = along, next = i;
    if (!(place.squaredNorm() - least > digits * place.squaredNorm()) || std::ranges::count(simplex, next) > 0) break;
    simplex.push_back(next);
    std::vector<Eigen::Vector3d> corners;
    for (const std::size_t i : simplex) corners.push_back(vectorOf(hull[i]) - vectorOf(point));
    const NearestMean mean = nearestMean(corners);
    if (!(mean.place.squaredNorm() < place.squaredNorm())) {
      simplex.pop_back();
      break;
    }
    place = mean.place;
    std::vector<std::size_t> kept;
    weights.clear();
    for (std::size_t i = 0; i < simplex.size(); ++i)
      if (mean.weights[i] > 0) kept.push_back(simplex[i]), weights.push_back(mean.weights[i]);
    simplex = std::move(kept);
    if (simplex.size() == 4) break;  // inside
  }
  Interval sum(0.0), square(0.0);
  std::array<Interval, 3> mean = {0.0, 0.0, 0.0};
  for (std::size_t k = 0; k < simplex.size(); ++k) {
    sum += weights[k];
    for (std::size_t i = 0; i < 3; ++i) mean[i] += weights[k] * Interval(hull[simplex[k]][i]);
  }
  for (std::size_t i = 0; i < 3; ++i) square += sqr(mean[i] / sum - point[i]);
  return sqrt(square).upper();
}

/// The farthest points along coordinate axes, and along diagonals of the faces and of the cube between them.
std::vector<std::size_t> extremesOf(const std::vector<MeshPoint>& points) {
  std::set<std::size_t> found;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        found.insert(static_cast<std::size_t>(
            std::ranges::max_element(points, {}, [&](const MeshPoint& p) { return x * p[0] + y * p[1] + z * p[2]; }) -
            points.begin()));
  return {found.begin(), found.end()};
}

/// Few of the points, one after the other the farthest from the hull of those before, and how far others are.
MeshHull fewOf(const std::vector<MeshPoint>& points) {
  MeshHull hull;
  if (points.size() <= Polyhedron::mostPoints) {
    hull.points = points;
    return hull;
  }
  for (const std::size_t i : extremesOf(points)) hull.points.push_back(points[i]);
  // Bounds only fall as points are added: the greatest is found anew until it is the greatest still.
  std::priority_queue<std::pair<double, std::size_t>> bounds;
  for (std::size_t i = 0; i < points.size(); ++i) bounds.emplace(distanceBound(points[i], hull.points), i);
  const auto greatest = [&] {
    for (;;) {
      const auto [bound, i] = bounds.top();
      const double now = distanceBound(points[i], hull.points);
      if (now >= bound) return std::pair(bound, i);
      bounds.pop();
      bounds.emplace(now, i);
    }
  };
  const double size = 0x1p-40 * greatest().first;
  for (; hull.points.size() < Polyhedron::mostPoints; hull.points.push_back(points[greatest().second]))
    if (greatest().first <= size) break;
  hull.radius = greatest().first;
  return hull;
}

bool isFlat(const MeshHull& hull) {
  std::vector<Polyhedron::Point> points;
  for (const MeshPoint& point : hull.points) points.push_back({point[0], point[1], point[2]});
  return points.size() < 4 || Polyhedron(points).faces().empty();
}

}  // namespace

std::optional<MeshHull> hullOfMesh(const std::string& text, const std::string& name) {
  std::string end = name.substr(std::min(name.size(), name.rfind('.')));
  std::ranges::transform(end, end.begin(), [](unsigned char c) { return c < 'A' || c > 'Z' ? c : c - 'A' + 'a'; });
  if (end != ".stl" && end != ".obj") return {};
  const bool isExact = end == ".stl" && !text.starts_with("solid");
  std::vector<MeshPoint> points = end == ".stl" ? pointsOfStl(text) : pointsBehind(text, "v");
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.empty()) throw std::invalid_argument("has no points");
  if (points.size() > mostMeshPoints)
    throw std::invalid_argument(fmt::format("has {} points, more than {}", points.size(), mostMeshPoints));
  MeshHull hull = fewOf(points);
  if (isFlat(hull)) throw std::invalid_argument("has points that lie in one plane");
  if (isExact) return hull;
  // Decimals are within half a unit in the last place of their doubles in each of three coordinates: 2⁻⁵³√3 < 2⁻⁵².
  double largest = 0;
  for (const MeshPoint& point : points)
    for (const double coordinate : point) largest = std::max(largest, std::abs(coordinate));
  hull.radius = (Interval(hull.radius) + Interval(0x1p-52) * largest).upper();
  return hull;
}

std::string writtenHull(const MeshHull& hull) {
  std::string text = fmt::format("{}", hull.radius);
  for (const MeshPoint& point : hull.points)
    for (const double coordinate : point) text += fmt::format(" {}", coordinate);
  return text;
}

MeshHull hullIn(const std::string& text) {
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) numbers.push_back(coordinateIn(word));
  if (numbers.size() % 3 != 1) throw std::invalid_argument("is no hull");
  MeshHull hull;
  hull.radius = numbers[0];
  for (std::size_t i = 1; i < numbers.size(); i += 3)
    hull.points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return hull;
}

}  // namespace gamut
