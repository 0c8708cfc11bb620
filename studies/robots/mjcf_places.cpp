// Right angles are exact where the file says them exactly: in degrees, or by a quaternion of equal numbers.
#include "studies/robots/mjcf_places.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mechanics/description/fields.hpp"
#include "mechanics/description/units.hpp"
#include "studies/robots/robot_parts.hpp"

namespace gamut {
namespace {

using Triple = std::array<Interval, 3>;

Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Triple unitAlong(const Triple& a) {
  const Interval length = sqrt(squareOf(a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

Robot::Turn turnBy(const Axis& axis, const std::string& angle, const MjcfAngles& angles) {
  Robot::Turn turn;
  turn.axis = axis;
  const Amount amount = parseAmount(angles.inDegrees ? angle + " deg" : angle);
  const mpq_class quarters = amount.value * 2;  // of rational * pi
  if (amount.piPower == 1 && quarters.get_den() == 1 && quarters.get_num().fits_sint_p())
    turn.quarterTurns = static_cast<int>(quarters.get_num().get_si() % 4);
  else
    turn.angle = enclose(amount);
  return turn;
}

/// About axes that turn along, or stay, which then come in front of those before.
std::vector<Robot::Turn> byEuler(const MjcfAttributes& attributes, const MjcfAngles& angles) {
  const std::vector<std::string> decimals = attributes.decimals("euler", 3);
  std::vector<Robot::Turn> turns;
  for (std::size_t i = 0; i < 3; ++i) {
    const char letter = angles.order[i];
    const bool stays = letter <= 'Z';
    const int index = letter - (stays ? 'X' : 'x');
    Robot::Turn next = turnBy(index == 0 ? axisX : index == 1 ? axisY : axisZ, decimals[i], angles);
    const bool isOnly = std::ranges::count(angles.order, letter) == 1;
    next.key = isOnly ? std::string(components[static_cast<std::size_t>(index)]) : std::to_string(i + 1);
    turns.insert(stays ? turns.begin() : turns.end(), next);
  }
  return turns;
}

Robot::Turn byQuaternion(const MjcfAttributes& attributes) {
  const std::vector<std::string> decimals = attributes.decimals("quat", 4);
  const std::vector<Interval> numbers = attributes.numbers("quat", 4, 4);
  mpq_class e[4];
  for (std::size_t i = 0; i < 4; ++i) e[i] = parseAmount(decimals[i]).value;
  std::vector<std::size_t> along;
  for (std::size_t i = 1; i < 4; ++i)
    if (e[i] != 0) along.push_back(i);
  Robot::Turn turn;
  if (along.empty() && e[0] == 0)
    attributes.fail("quat", "the quaternion is zero", "four numbers of which one is not zero");
  if (along.empty()) return turn;
  const mpq_class v = e[along[0]];
  if (along.size() == 1 && (e[0] == 0 || e[0] == v || e[0] == -v)) {
    turn.axis = along[0] == 1 ? axisX : along[0] == 2 ? axisY : axisZ;
    turn.quarterTurns = e[0] == 0 ? 2 : e[0] == v ? 1 : -1;
  } else {
    turn.quaternion = {numbers[0], numbers[1], numbers[2], numbers[3]};
  }
  return turn;
}

/// Of the columns of a rotation: four times one of its quaternion's components times all of them, of one that is not
/// small.
std::array<Interval, 4> quaternionOf(const std::array<Triple, 3>& columns) {
  const auto r = [&](std::size_t i, std::size_t j) { return columns[j][i]; };
  const Interval one(1.0);
  if (midpoint(r(0, 0)) + midpoint(r(1, 1)) + midpoint(r(2, 2)) > 0)
    return {one + r(0, 0) + r(1, 1) + r(2, 2), r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1)};
  std::size_t i = 0;
  for (const std::size_t other : {1U, 2U})
    if (midpoint(r(other, other)) > midpoint(r(i, i))) i = other;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  std::array<Interval, 4> e;
  e[0] = r(k, j) - r(j, k);
  e[i + 1] = one + r(i, i) - r(j, j) - r(k, k);
  e[j + 1] = r(i, j) + r(j, i);
  e[k + 1] = r(i, k) + r(k, i);
  return e;
}

/// x as it is, y made square to it, z = x × y.
Robot::Turn byAxes(const MjcfAttributes& attributes) {
  const std::vector<Interval> n = attributes.numbers("xyaxes", 6, 6);
  const Triple x = {n[0], n[1], n[2]}, z = cross(x, {n[3], n[4], n[5]});
  if (!(squareOf(z).lower() > 0)) attributes.fail("xyaxes", "the two axes are on one line", "two directions");
  Robot::Turn turn;
  turn.quaternion = quaternionOf({unitAlong(x), unitAlong(cross(z, x)), unitAlong(z)});
  return turn;
}

Robot::Turn byAxis(const MjcfAttributes& attributes) {
  const std::vector<Interval> n = attributes.numbers("zaxis", 3, 3);
  const Triple z = {n[0], n[1], n[2]};
  if (!(squareOf(z).lower() > 0)) attributes.fail("zaxis", "the axis is the zero vector", "a direction");
  return turnOfZ(z);
}

/// None are roll, pitch and yaw of 0.
std::optional<std::vector<Robot::Turn>> turnsOf(const MjcfAttributes& attributes, const MjcfAngles& angles) {
  std::string form;
  for (const char* word : {"quat", "axisangle", "xyaxes", "zaxis", "euler"}) {
    if (!attributes.has(word)) continue;
    if (!form.empty()) attributes.fail(word, fmt::format("'{}' beside '{}'", word, form), "one orientation");
    form = word;
  }
  if (form == "quat") return std::vector{byQuaternion(attributes)};
  if (form == "euler") return byEuler(attributes, angles);
  if (form == "xyaxes") return std::vector{byAxes(attributes)};
  if (form == "zaxis") return std::vector{byAxis(attributes)};
  if (form.empty()) return std::nullopt;
  std::vector<std::string> axis = attributes.decimals(form, 4);
  const std::string angle = axis.back();
  axis.pop_back();
  return std::vector{turnBy(directionIn(attributes, form, axis), angle, angles)};
}

}  // namespace

bool isExactlyZero(const Interval& x) { return isEqual(x, Interval(0.0)); }

Interval squareOf(const std::array<Interval, 3>& v) { return sqr(v[0]) + sqr(v[1]) + sqr(v[2]); }

Robot::Place placeOf(const MjcfAttributes& attributes, const MjcfAngles& angles) {
  Robot::Place place;
  place.xyz = attributes.vector("pos", {0.0, 0.0, 0.0});
  place.turns = turnsOf(attributes, angles);
  return place;
}

Axis directionIn(const MjcfAttributes& attributes, const std::string& name, const std::vector<std::string>& decimals) {
  if (std::ranges::all_of(decimals, [](const std::string& decimal) { return parseAmount(decimal).value == 0; }))
    attributes.fail(name, attributes.find(name)->stated.what + " is the zero vector", "a direction");
  return directionOf(decimals);
}

/// (|v| + z, −y, x, 0), where z is below 0 without cancellation: |v| + z = (x² + y²) / (|v| − z).
Robot::Turn turnOfZ(const std::array<Interval, 3>& v) {
  Robot::Turn turn;
  if (isExactlyZero(v[0]) && isExactlyZero(v[1])) {
    turn.quarterTurns = v[2].lower() > 0 ? 0 : 2;
    return turn;
  }
  const Interval length = sqrt(squareOf(v));
  const Interval w = v[2].upper() < 0 ? (sqr(v[0]) + sqr(v[1])) / (length - v[2]) : length + v[2];
  turn.quaternion = {w, -v[1], v[0], Interval(0.0)};
  return turn;
}

}  // namespace gamut
