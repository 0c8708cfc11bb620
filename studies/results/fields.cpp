// Shapes, bounds and bits of values, whatever they are.
#include "studies/results/fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace gamut {
namespace {

std::size_t placesIn(const GridShape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

/// Every end of what a stack of tables or of bounds holds, or one of these alone.
template <class Holder>
auto& halfOf(Holder& holder, std::size_t end) {
  if constexpr (requires { holder.upper; })
    return end == 0 ? holder.lower : holder.upper;
  else
    return holder;
}

/// A value has the shape, or, if it may, is not there.
bool hasShape(const FieldValue& value, const GridShape& shape, bool mayBeEmpty) {
  return std::visit(
      Visitor{[&](const Numbers& numbers) { return numbers.hasShape(shape, mayBeEmpty); },
              [&](std::vector<std::int64_t>* v) { return (mayBeEmpty && v->empty()) || v->size() == placesIn(shape); },
              [&](const auto&) { return shape.empty(); }},
      value);
}

/// Scales of numbers rise.
bool rises(const FieldValue& scale) {
  const auto isRising = [](const auto& v) { return std::ranges::adjacent_find(v, std::greater_equal<>()) == v.end(); };
  return std::visit(
      Visitor{[&](const Numbers& n) { return isRising(*n.lists().front()); },
              [&](std::vector<std::int64_t>* v) { return isRising(*v); }, [](const auto&) { return true; }},
      scale);
}

std::size_t sizeOf(const FieldValue& scale) {
  return std::visit(
      Visitor{[](const Numbers& n) { return n.lists().front()->size(); },
              [](std::vector<std::int64_t>* v) { return v->size(); }, [](const auto&) { return std::size_t{0}; }},
      scale);
}

bool areIntervals(const Numbers& numbers) {
  std::vector<double> lowerRoom, upperRoom;
  const auto lower = numbers.all(0, lowerRoom), upper = numbers.all(numbers.ends().size() - 1, upperRoom);
  for (std::size_t i = 0; i < std::min(lower.size(), upper.size()) && numbers.ends().size() == 2; ++i)
    if (!isInterval(lower[i], upper[i])) return false;
  return true;
}

bool makesSense(const Field& field, const Extents& extents) {
  double greatest = field.allowed.greatest;
  if (!field.indexOf.empty()) {
    const auto extent = extents.find(field.indexOf);
    greatest = (extent == extents.end() ? 0.0 : static_cast<double>(extent->second)) - 1;
  }
  const bool isAnything = field.allowed.least == allowed::anything.least && greatest == allowed::anything.greatest;
  const auto isAllowed = [&](auto number) {  // NaN where anything is
    return isAnything ||
           (static_cast<double>(number) >= field.allowed.least && static_cast<double>(number) <= greatest);
  };
  return std::visit(Visitor{[&](double* x) { return isAllowed(*x); }, [&](std::int64_t* x) { return isAllowed(*x); },
                            [&](std::uint64_t* x) { return isAllowed(*x); },
                            [&](const Numbers& n) {
                              return areIntervals(n) && std::ranges::all_of(n.lists(), [&](const auto* v) {
                                       return std::ranges::all_of(*v, isAllowed);
                                     });
                            },
                            [&](std::vector<std::int64_t>* v) { return std::ranges::all_of(*v, isAllowed); },
                            [](const auto&) { return true; }},
                    field.value);
}

bool isSameList(std::span<const double> one, std::span<const double> other) {
  return one.size() == other.size() &&
         (one.empty() || std::memcmp(one.data(), other.data(), one.size() * sizeof(double)) == 0);
}

}  // namespace

std::vector<std::string_view> Numbers::ends() const {
  if (std::holds_alternative<Envelope*>(holder_) || std::holds_alternative<std::vector<Envelope>*>(holder_))
    return {"_lower", "_upper"};
  return {""};
}

std::vector<std::vector<double>*> Numbers::lists(std::size_t end) const {
  std::vector<std::vector<double>*> lists;
  const auto addAll = [&](auto& stack) {
    for (auto& each : stack) lists.push_back(&halfOf(each, end).data);
  };
  std::visit(
      Visitor{[&](std::vector<double>* v) { lists = {v}; }, [&](std::vector<Table>* v) { addAll(*v); },
              [&](std::vector<Envelope>* v) { addAll(*v); }, [&](auto* one) { lists = {&halfOf(*one, end).data}; }},
      holder_);
  return lists;
}

std::span<const double> Numbers::all(std::size_t end, std::vector<double>& room) const {
  const std::vector<std::vector<double>*> parts = lists(end);
  if (parts.size() == 1) return *parts.front();
  room.clear();
  for (const std::vector<double>* part : parts) room.insert(room.end(), part->begin(), part->end());
  return room;
}

bool Numbers::empty() const {
  return std::ranges::all_of(lists(), [](const std::vector<double>* list) { return list->empty(); });
}

bool Numbers::hasShape(const GridShape& shape, bool mayBeEmpty) const {
  const auto isTable = [&](const Table& t) {
    return t.times == *(shape.end() - 2) && t.outputs == shape.back() && t.data.size() == t.times * t.outputs;
  };
  const auto areTables = [&](auto& each) { return isTable(halfOf(each, 0)) && isTable(halfOf(each, 1)); };
  const auto isStack = [&](auto& v) {
    return v.empty() || (shape.size() == 3 && v.size() == shape[0] && std::ranges::all_of(v, areTables));
  };
  return std::visit(
      Visitor{[&](std::vector<double>* v) { return (mayBeEmpty && v->empty()) || v->size() == placesIn(shape); },
              [&](Grid* g) { return g->empty() || (g->extents == shape && g->data.size() == placesIn(shape)); },
              [&](std::vector<Table>* v) { return isStack(*v); }, [&](std::vector<Envelope>* v) { return isStack(*v); },
              [&](auto* one) {
                return (halfOf(*one, 0).empty() && halfOf(*one, 1).empty()) || (shape.size() == 2 && areTables(*one));
              }},
      holder_);
}

void Numbers::take(std::size_t end, const GridShape& shape, std::vector<double> numbers) const {
  if (numbers.size() != placesIn(shape)) return;  // they are not there; none of a dimension without places are
  const auto put = [&](Table& table, std::size_t level) {
    table.times = *(shape.end() - 2);
    table.outputs = shape.back();
    const auto count = static_cast<std::ptrdiff_t>(table.times * table.outputs);
    const auto from = numbers.begin() + static_cast<std::ptrdiff_t>(level) * count;
    table.data.assign(from, from + count);
  };
  const auto putAll = [&](auto& stack) {
    stack.resize(shape.front());
    for (std::size_t level = 0; level < stack.size(); ++level) put(halfOf(stack[level], end), level);
  };
  std::visit(Visitor{[&](std::vector<double>* v) { *v = std::move(numbers); },
                     [&](Grid* g) { *g = Grid(shape, std::move(numbers)); }, [&](std::vector<Table>* v) { putAll(*v); },
                     [&](std::vector<Envelope>* v) { putAll(*v); }, [&](auto* one) { put(halfOf(*one, end), 0); }},
             holder_);
}

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

GridShape shapeOf(const std::vector<std::string_view>& dimensions, const Extents& extents) {
  GridShape shape;
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

bool areShares(const Grid& lower, const Grid& upper) {
  for (std::size_t i = 0; i < lower.data.size(); ++i) {
    const double low = lower.data[i], high = upper.data[i];
    const bool isNothing = std::isnan(low) && std::isnan(high);
    if (!isNothing && !(0 <= low && low <= high && high <= 1)) return false;
  }
  return true;
}

bool areShares(const Grid& numbers) { return areShares(numbers, numbers); }

std::string misshapen(const std::vector<Group>& groups) {
  const Extents extents = extentsOf(groups);
  for (const Group& group : groups)
    for (std::size_t i = 0; i < group.size; ++i)
      for (const Field& field : group.fields(i))
        if (!hasShape(field.value, shapeOf(field.dimensions, extents), !group.isList() || field.isNew))
          return pathOf(group, field);
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
  return std::visit(Visitor{[&](double* x) {
                              return isSameAs(x, [](double a, double b) { return isSameList({&a, 1}, {&b, 1}); });
                            },
                            [&](WholeText x) { return *x.text == *std::get<WholeText>(other).text; },
                            [&](Choice x) { return *x.value == *std::get<Choice>(other).value; },
                            [&](const Numbers& x) {
                              const auto& y = std::get<Numbers>(other);
                              std::vector<double> room, otherRoom;
                              for (std::size_t end = 0; end < x.ends().size(); ++end)
                                if (!isSameList(x.all(end, room), y.all(end, otherRoom))) return false;
                              return true;
                            },
                            [&](auto* x) { return isSameAs(x, std::equal_to<>()); }},
                    one);
}

}  // namespace gamut
