// Shapes, bounds and bits of values, whatever they are.
#include "studies/results/fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace gamut {
namespace {

using Shape = std::vector<std::size_t>;

/// A value has the shape, or, if it may, is not there.
bool hasShape(const FieldValue& value, const Shape& shape, bool mayBeEmpty) {
  const std::size_t places = std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  const auto isTable = [](const Table& t, const std::size_t* extent) {
    return t.times == extent[0] && t.outputs == extent[1] && t.data.size() == extent[0] * extent[1];
  };
  const auto isEnvelope = [&](const Envelope& e, const std::size_t* extent) {
    return isTable(e.lower, extent) && isTable(e.upper, extent);
  };
  const auto isStack = [&](const auto& tables, const auto& isOne) {
    return tables.empty() ||
           (shape.size() == 3 && tables.size() == shape[0] &&
            std::ranges::all_of(tables, [&](const auto& table) { return isOne(table, shape.data() + 1); }));
  };
  return std::visit(
      Visitor{[&](std::vector<double>* v) { return (mayBeEmpty && v->empty()) || v->size() == places; },
              [&](std::vector<std::int64_t>* v) { return (mayBeEmpty && v->empty()) || v->size() == places; },
              [&](Table* t) { return t->empty() || (shape.size() == 2 && isTable(*t, shape.data())); },
              [&](Envelope* e) {
                return (e->lower.empty() && e->upper.empty()) || (shape.size() == 2 && isEnvelope(*e, shape.data()));
              },
              [&](std::vector<Table>* v) { return isStack(*v, isTable); },
              [&](std::vector<Envelope>* v) { return isStack(*v, isEnvelope); },
              [&](const auto&) { return shape.empty(); }},
      value);
}

bool areIntervals(const Envelope& envelope) {
  for (std::size_t i = 0; i < envelope.lower.data.size(); ++i)
    if (!isInterval(envelope.lower.data[i], envelope.upper.data[i])) return false;
  return true;
}

/// Scales of numbers rise.
bool rises(const FieldValue& scale) {
  const auto isRising = [](auto* v) { return std::ranges::adjacent_find(*v, std::greater_equal<>()) == v->end(); };
  return std::visit(
      Visitor{[&](std::vector<double>* v) { return isRising(v); },
              [&](std::vector<std::int64_t>* v) { return isRising(v); }, [](const auto&) { return true; }},
      scale);
}

std::size_t sizeOf(const FieldValue& scale) {
  return std::visit(
      Visitor{[](std::vector<double>* v) { return v->size(); }, [](std::vector<std::int64_t>* v) { return v->size(); },
              [](const auto&) { return std::size_t{0}; }},
      scale);
}

bool makesSense(const Field& field, const Extents& extents) {
  if (field.allowed.least == allowed::anything.least && field.allowed.greatest == allowed::anything.greatest)
    return std::visit(Visitor{[](Envelope* e) { return areIntervals(*e); },
                              [](std::vector<Envelope>* v) { return std::ranges::all_of(*v, areIntervals); },
                              [](const auto&) { return true; }},
                      field.value);
  double greatest = field.allowed.greatest;
  if (!field.indexOf.empty()) {
    const auto extent = extents.find(field.indexOf);
    greatest = (extent == extents.end() ? 0.0 : static_cast<double>(extent->second)) - 1;
  }
  const auto isAllowed = [&](auto number) {
    return static_cast<double>(number) >= field.allowed.least && static_cast<double>(number) <= greatest;
  };
  return std::visit(Visitor{[&](double* x) { return isAllowed(*x); }, [&](std::int64_t* x) { return isAllowed(*x); },
                            [&](std::uint64_t* x) { return isAllowed(*x); },
                            [&](std::vector<double>* v) { return std::ranges::all_of(*v, isAllowed); },
                            [&](std::vector<std::int64_t>* v) { return std::ranges::all_of(*v, isAllowed); },
                            [](const auto&) { return true; }},
                    field.value);
}

bool isSameList(const std::vector<double>& one, const std::vector<double>& other) {
  return one.size() == other.size() &&
         (one.empty() || std::memcmp(one.data(), other.data(), one.size() * sizeof(double)) == 0);
}

bool isSameTable(const Table& one, const Table& other) {
  return one.times == other.times && one.outputs == other.outputs && isSameList(one.data, other.data);
}

bool isSameEnvelope(const Envelope& one, const Envelope& other) {
  return isSameTable(one.lower, other.lower) && isSameTable(one.upper, other.upper);
}

}  // namespace

std::string pathOf(const Group& group, const Field& field) {
  if (field.name.starts_with('/')) return std::string(field.name);
  return std::string(group.path) + (group.path == "/" ? "" : "/") + std::string(field.name);
}

bool isScale(const Group& group, const Field& field) {
  const std::vector<std::string_view> dimensions = dimensionsOf(group, field);
  return dimensions.size() == 1 && dimensions.front() == pathOf(group, field);
}

std::vector<std::string_view> dimensionsOf(const Group& group, const Field& field) {
  std::vector<std::string_view> dimensions = field.dimensions;
  if (group.isList()) dimensions.insert(dimensions.begin(), group.dimension);
  return dimensions;
}

Extents extentsOf(const std::vector<Group>& groups) {
  Extents extents;
  for (const Group& group : groups) {
    if (group.isList()) {
      extents.emplace(group.dimension, group.size);
    } else if (group.size > 0) {
      for (const Field& field : group.fields(0))
        if (isScale(group, field)) extents.emplace(field.dimensions.front(), sizeOf(field.value));
    }
  }
  return extents;
}

std::vector<std::size_t> shapeOf(const std::vector<std::string_view>& dimensions, const Extents& extents) {
  Shape shape;
  for (const std::string_view name : dimensions) {
    const auto extent = extents.find(name);
    shape.push_back(extent == extents.end() ? 0 : extent->second);
  }
  return shape;
}

bool isInterval(double lower, double upper) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return !(lower > upper || lower == infinity || upper == -infinity);
}

bool areShares(const std::vector<double>& lower, const std::vector<double>& upper) {
  for (std::size_t i = 0; i < lower.size(); ++i) {
    const bool isNothing = std::isnan(lower[i]) && std::isnan(upper[i]);
    if (!isNothing && !(0 <= lower[i] && lower[i] <= upper[i] && upper[i] <= 1)) return false;
  }
  return true;
}

bool areShares(const std::vector<double>& numbers) { return areShares(numbers, numbers); }

std::string misshapen(const std::vector<Group>& groups) {
  const Extents extents = extentsOf(groups);
  for (const Group& group : groups)
    for (std::size_t i = 0; i < group.size; ++i)
      for (const Field& field : group.fields(i))
        if (!hasShape(field.value, shapeOf(field.dimensions, extents), !group.isList())) return pathOf(group, field);
  return "";
}

std::string senseless(const std::vector<Group>& groups) {
  const Extents extents = extentsOf(groups);
  for (const Group& group : groups)
    for (std::size_t i = 0; i < group.size; ++i) {
      for (const Field& field : group.fields(i))
        if (!makesSense(field, extents) || (isScale(group, field) && !rises(field.value))) return pathOf(group, field);
      if (!group.makesSense(i)) return std::string(group.path);
    }
  return "";
}

bool isSame(const FieldValue& one, const FieldValue& other) {
  if (one.index() != other.index()) return false;
  const auto isSameAs = [&other](auto* value, const auto& isSameOne) {
    return isSameOne(*value, **std::get_if<decltype(value)>(&other));
  };
  const auto isSameStack = [](const auto& isSameOne) {
    return [isSameOne](const auto& a, const auto& b) { return std::ranges::equal(a, b, isSameOne); };
  };
  return std::visit(
      Visitor{[&](double* x) { return isSameAs(x, [](double a, double b) { return isSameList({a}, {b}); }); },
              [&](WholeText x) { return *x.text == *std::get<WholeText>(other).text; },
              [&](Choice x) { return *x.value == *std::get<Choice>(other).value; },
              [&](std::vector<double>* x) { return isSameAs(x, isSameList); },
              [&](Table* x) { return isSameAs(x, isSameTable); },
              [&](Envelope* x) { return isSameAs(x, isSameEnvelope); },
              [&](std::vector<Table>* x) { return isSameAs(x, isSameStack(isSameTable)); },
              [&](std::vector<Envelope>* x) { return isSameAs(x, isSameStack(isSameEnvelope)); },
              [&](auto* x) { return isSameAs(x, std::equal_to<>()); }},
      one);
}

}  // namespace gamut
