// Fields in the same dimensions are columns of one table; outputs and quantities make columns, all else makes rows.
#include "reports/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "scalars/interval.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using Dimensions = std::vector<std::string_view>;

std::string cellOf(const std::string& text) { return csvHeading(text, ""); }

/// On which side of a bound its decimals may lie.
RoundedTo sideOf(std::string_view name) {
  return name == "lower" || name.ends_with("_lower")   ? RoundedTo::below
         : name == "upper" || name.ends_with("_upper") ? RoundedTo::above
                                                       : RoundedTo::nearest;
}

/// Of a value without dimensions.
std::string cellOf(const FieldValue& value, RoundedTo side) {
  return std::visit(
      Visitor{[&](double* x) { return exactDecimal(*x, side); }, [](std::int64_t* x) { return fmt::format("{}", *x); },
              [](std::uint64_t* x) { return fmt::format("{}", *x); },
              [](bool* x) { return std::string(*x ? "true" : "false"); }, [](std::string* x) { return cellOf(*x); },
              [](WholeText x) { return cellOf(*x.text); }, [](Choice x) { return cellOf(x.word()); },
              [](const auto&) { return std::string(); }},
      value);
}

bool isColumnar(std::string_view dimension) {
  return dimension == dimension::output || dimension == dimension::quantity;
}

std::size_t productOf(const GridShape& shape) {
  std::size_t product = 1;
  for (const std::size_t extent : shape) product *= extent;
  return product;
}

/// "requirements name" of "/requirements/name", "time" of "/interval/time": the last word, with the one before where
/// it says too little.
std::string wordsOf(std::string_view dimension) {
  const auto slash = dimension.rfind('/');
  const std::string last(dimension.substr(slash + 1));
  if (slash == 0 || (last != "name" && last != "number" && last != "of")) return last;
  const auto before = dimension.rfind('/', slash - 1);
  return std::string(dimension.substr(before + 1, slash - before - 1)) + " " + last;
}

/// The places of every dimension, in words or numbers.
class Scales {
 public:
  explicit Scales(const std::vector<Group>& groups) {
    for (const Group& group : groups) {
      if (group.size == 0) continue;
      for (const Field& field : group.isList() ? std::vector<Field>{group.fields(0).front()} : group.fields(0))
        if (group.isList())
          addList(group);
        else if (isScale(group, field))
          addNumbers(pathOf(group, field), field);
    }
  }

  std::string heading(std::string_view dimension) const {
    const auto found = units_.find(dimension);
    const std::string unit = found == units_.end() || found->second == unit::one ? "" : std::string(found->second);
    return csvHeading(wordsOf(dimension), unit);
  }
  std::string label(std::string_view dimension, std::size_t place) const {
    const auto found = labels_.find(dimension);
    return found == labels_.end() ? fmt::format("{}", place) : found->second.at(place);
  }

 private:
  void addList(const Group& group) {
    std::vector<std::string>& labels = labels_[std::string(group.dimension)];
    labels.clear();
    for (std::size_t i = 0; i < group.size; ++i) {
      const Field first = group.fields(i).front();
      const std::string* const text =
          std::holds_alternative<std::string*>(first.value) ? std::get<std::string*>(first.value) : nullptr;
      labels.push_back(text != nullptr ? *text : cellOf(first.value, RoundedTo::nearest));
    }
  }
  void addNumbers(const std::string& path, const Field& field) {
    std::vector<std::string>& labels = labels_[path];
    units_[path] = field.unit;
    if (const auto* numbers = std::get_if<Numbers>(&field.value))
      for (const double number : *numbers->lists().front()) labels.push_back(exactDecimal(number));
    else if (auto* const* whole = std::get_if<std::vector<std::int64_t>*>(&field.value))
      for (const std::int64_t number : **whole) labels.push_back(fmt::format("{}", number));
  }

  std::map<std::string, std::vector<std::string>, std::less<>> labels_;
  std::map<std::string, std::string_view, std::less<>> units_;
};

/// A field of a group with its dimensions, those of rows and those of columns.
struct Spread {
  std::size_t field = 0;  ///< number in the group
  Dimensions dimensions;
};

class Tables {
 public:
  explicit Tables(const Results& results)
      : results_(results), groups_(describe(results)), extents_(extentsOf(groups_)), scales_(groups_) {}

  std::string values() const {
    std::string text = "path,value,unit,meaning\n";
    forValues([&](const Group& group, const Field& field) {
      text += fmt::format("{},{},{},{}\n", cellOf(pathOf(group, field)), cellOf(field.value, sideOf(field.name)),
                          cellOf(std::string(field.unit)), cellOf(std::string(field.meaning)));
    });
    return text;
  }
  template <class Action>
  void forValues(const Action& action) const {
    for (const Group& group : groups_)
      if (!group.isList() && group.size > 0)
        for (const Field& field : group.fields(0))
          if (field.dimensions.empty()) action(group, field);
  }

  std::string records(std::size_t number) const {
    const Group& group = groups_[number];
    std::vector<std::string> headings;
    for (const Field& field : group.fields(0))
      if (isSingle(field)) headings.push_back(headingOf(field));
    std::string text = fmt::format("{}\n", fmt::join(headings, ","));
    for (std::size_t i = 0; i < group.size; ++i) {
      std::vector<std::string> cells;
      for (const Field& field : group.fields(i))
        if (isSingle(field)) cells.push_back(cellOf(field.value, sideOf(field.name)));
      text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
  }

  std::string spread(std::size_t number, const Dimensions& rows, const std::vector<std::size_t>& fields) const {
    const Group& group = groups_[number];
    std::string text;
    for (std::size_t i = 0; i < group.size; ++i) {
      const Block block(*this, group, i, rows, fields);
      if (text.empty()) text = block.headings();
      block.addRows(text);
    }
    return text;
  }

  /// The fields of a group that have dimensions, by those that make rows.
  std::vector<std::pair<Dimensions, std::vector<std::size_t>>> spreads(const Group& group) const {
    std::vector<std::pair<Dimensions, std::vector<std::size_t>>> all;
    const std::vector<Field> fields = group.fields(0);
    for (std::size_t f = 0; f < fields.size(); ++f) {
      if (isSingle(fields[f]) || isScale(group, fields[f]) || isNowhere(group, f)) continue;
      const Dimensions rows = rowsOf(group, fields[f]);
      auto found = std::ranges::find(all, rows, &std::pair<Dimensions, std::vector<std::size_t>>::first);
      if (found == all.end()) found = all.insert(all.end(), {rows, {}});
      found->second.push_back(f);
    }
    return all;
  }

  std::size_t rowCount(const Group& group, const Dimensions& rows) const {
    return group.size * productOf(shapeOf(rows, extents_));
  }
  std::size_t columnCount(const Group& group, const Dimensions& rows, const std::vector<std::size_t>& fields) const {
    return Block(*this, group, 0, rows, fields).columns() + rows.size() + (group.isList() ? 1 : 0);
  }

  const std::vector<Group>& groups() const { return groups_; }
  static bool isSingle(const Field& field) { return field.dimensions.empty(); }

 private:
  /// Whether no record has any number of it.
  static bool isNowhere(const Group& group, std::size_t number) {
    for (std::size_t i = 0; i < group.size; ++i) {
      const std::vector<Field> fields = group.fields(i);
      const bool isEmpty =
          std::visit(Visitor{[](const Numbers& n) { return n.empty(); },
                             [](std::vector<std::int64_t>* v) { return v->empty(); }, [](const auto&) { return true; }},
                     fields[number].value);
      if (!isEmpty) return false;
    }
    return true;
  }

  /// All but outputs and quantities; of one record that has only these the first of them.
  static Dimensions rowsOf(const Group& group, const Field& field) {
    Dimensions rows;
    for (const std::string_view dimension : field.dimensions)
      if (!isColumnar(dimension)) rows.push_back(dimension);
    if (rows.empty() && !group.isList()) rows.push_back(field.dimensions.front());
    return rows;
  }

  static std::string headingOf(const Field& field) {
    const bool isOfRow = field.unit == unit::ofOutput || field.unit == unit::ofQuantity;  // which another column says
    return csvHeading(field.name.starts_with('/') ? "name" : std::string(field.name),
                      field.unit == unit::one || isOfRow ? "" : std::string(field.unit));
  }

  /// One record's rows.
  class Block {
   public:
    Block(const Tables& tables, const Group& group, std::size_t record, const Dimensions& rows,
          const std::vector<std::size_t>& fields)
        : tables_(tables), group_(group), record_(record), rows_(rows), shape_(shapeOf(rows, tables.extents_)) {
      all_ = group.fields(record);
      rooms_.resize(2 * fields.size());
      for (std::size_t k = 0; k < fields.size(); ++k) addColumns(all_[fields[k]], 2 * k);
    }

    std::size_t columns() const { return columns_.size(); }

    std::string headings() const {
      std::vector<std::string> names;
      if (group_.isList()) names.push_back(tables_.scales_.heading(group_.dimension));
      for (const std::string_view dimension : rows_) names.push_back(tables_.scales_.heading(dimension));
      for (const Column& column : columns_) names.push_back(column.heading);
      return fmt::format("{}\n", fmt::join(names, ","));
    }

    void addRows(std::string& text) const {
      const std::string record =
          group_.isList() ? cellOf(tables_.scales_.label(group_.dimension, record_)) + "," : std::string();
      const std::size_t count = productOf(shape_);
      std::vector<std::size_t> places(shape_.size(), 0);
      for (std::size_t row = 0; row < count; ++row) {
        for (std::size_t d = shape_.size(), rest = row; d-- > 0; rest /= shape_[d]) places[d] = rest % shape_[d];
        text += record;
        for (std::size_t d = 0; d < rows_.size(); ++d)
          text += (d == 0 ? "" : ",") + cellOf(tables_.scales_.label(rows_[d], places[d]));
        for (std::size_t c = 0; c < columns_.size(); ++c) {
          if (c > 0 || !rows_.empty()) text += ',';
          text += cell(columns_[c], places);
        }
        text += '\n';
      }
    }

   private:
    struct Column {
      std::string heading;
      std::span<const double> numbers;
      const std::vector<std::int64_t>* whole = nullptr;
      RoundedTo side = RoundedTo::nearest;
      std::size_t begin = 0;             ///< of the first row
      std::vector<std::size_t> strides;  ///< by the dimensions of rows
    };

    std::string cell(const Column& column, const std::vector<std::size_t>& places) const {
      std::size_t at = column.begin;
      for (std::size_t d = 0; d < places.size(); ++d) at += places[d] * column.strides[d];
      if (column.whole != nullptr) return at < column.whole->size() ? fmt::format("{}", (*column.whole)[at]) : "";
      return at < column.numbers.size() ? exactDecimal(column.numbers[at], column.side) : "";
    }

    void addColumns(const Field& field, std::size_t room) {
      const GridShape shape = shapeOf(field.dimensions, tables_.extents_);
      std::vector<std::size_t> strides(shape.size(), 1);
      for (std::size_t d = shape.size(); d-- > 1;) strides[d - 1] = strides[d] * shape[d];
      Dimensions inColumns;
      GridShape inColumnsShape;
      std::vector<std::size_t> inColumnsStrides, inRowsStrides;
      for (std::size_t d = 0; d < shape.size(); ++d) {
        const bool isRow = std::ranges::count(rows_, field.dimensions[d]) > 0;
        (isRow ? inRowsStrides : inColumnsStrides).push_back(strides[d]);
        if (isRow) continue;
        inColumns.push_back(field.dimensions[d]);
        inColumnsShape.push_back(shape[d]);
      }
      const auto* numbers = std::get_if<Numbers>(&field.value);
      auto* const* whole = std::get_if<std::vector<std::int64_t>*>(&field.value);
      const std::size_t ends = numbers == nullptr ? 1 : numbers->ends().size();
      for (std::size_t i = 0; i < productOf(inColumnsShape); ++i)
        for (std::size_t end = 0; end < ends; ++end) {
          Column column;
          const std::string name =
              std::string(field.name) + (numbers == nullptr ? "" : std::string(numbers->ends()[end]));
          column.strides = inRowsStrides;
          column.side = sideOf(name);
          if (numbers != nullptr) column.numbers = numbers->all(end, rooms_[room + end]);
          if (whole != nullptr) column.whole = *whole;
          std::string labels;
          std::string_view unit = field.unit == unit::one ? unit::none : field.unit;
          for (std::size_t d = inColumns.size(), rest = i; d-- > 0; rest /= inColumnsShape[d]) {
            const std::size_t place = rest % inColumnsShape[d];
            column.begin += place * inColumnsStrides[d];
            labels = tables_.scales_.label(inColumns[d], place) + ": " + labels;
            if (inColumns[d] == dimension::output && field.unit == unit::ofOutput)
              unit = tables_.results_.outputs.at(place).unit;
            if (inColumns[d] == dimension::quantity && field.unit == unit::ofQuantity)
              unit = tables_.results_.uncertain.at(place).unit;
          }
          column.heading = csvHeading(labels + name, std::string(unit));
          columns_.push_back(std::move(column));
        }
    }

    const Tables& tables_;
    const Group& group_;
    std::size_t record_;
    const Dimensions& rows_;
    GridShape shape_;
    std::vector<Field> all_;
    std::vector<std::vector<double>> rooms_;
    std::vector<Column> columns_;
  };

  const Results& results_;
  const std::vector<Group> groups_;
  const Extents extents_;
  const Scales scales_;
};

std::string nameOf(std::string_view path) {
  std::string name(path.substr(1));
  std::ranges::replace(name, '/', '.');
  return name.empty() ? "study" : name;
}

/// The nearest decimal of so many digits, or, if that is not right, the next one towards where they are.
template <class IsRight>
std::string besideDecimal(double number, int digits, const IsRight& isRight) {
  char room[64];
  const double size = std::abs(number);
  const auto [end, error] = std::to_chars(room, room + sizeof room, size, std::chars_format::scientific, digits - 1);
  std::string mantissa(room, end);
  const std::size_t e = mantissa.find('e');
  const int exponent = std::stoi(mantissa.substr(e + 1));
  std::string whole = mantissa.substr(0, 1) + mantissa.substr(2, e - 2);
  const auto written = [&](std::int64_t m) {
    const std::string all = std::to_string(m);
    return fmt::format("{}{}.{}e{:+03}", number < 0 ? "-" : "", all.substr(0, 1), all.substr(1),
                       exponent + static_cast<int>(all.size()) - digits);
  };
  const std::int64_t nearest = std::stoll(whole);
  for (const std::int64_t m : {nearest, nearest + 1, nearest - 1})
    if (const std::string decimal = written(m); isRight(decimal)) return decimal;
  return written(nearest);
}

}  // namespace

std::string exactDecimal(double number, RoundedTo side) {
  if (std::isnan(number)) return {};
  std::string text = fmt::format("{}", number);
  if (std::isinf(number) || side == RoundedTo::nearest) return text;
  // The tightest interval around a decimal tells on which side of the double it lies.
  const auto isRight = [&](const std::string& decimal) {
    const Interval around = Interval::parse(decimal);
    return side == RoundedTo::below ? around.upper() <= number : around.lower() >= number;
  };
  if (isRight(text)) return text;
  // One unit of the 17th digit is less than half the way to the next double, but from 10 to 16 and the like; one of the
  // 18th always is.
  for (const int digits : {17, 18}) {
    text = besideDecimal(number, digits, isRight);
    double back = 0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    if (back == number) break;
  }
  return text;
}

std::vector<ResultTable> tablesOf(const Results& results) {
  const auto tables = std::make_shared<const Tables>(results);
  std::vector<ResultTable> all;
  std::size_t values = 0;
  tables->forValues([&](const Group&, const Field&) { ++values; });
  all.push_back({"values", "all single numbers and texts", values, 4, [tables] { return tables->values(); }});
  for (std::size_t g = 0; g < tables->groups().size(); ++g) {
    const Group& group = tables->groups()[g];
    if (group.size == 0) continue;
    const std::vector<Field> fields = group.fields(0);
    if (group.isList())
      all.push_back({nameOf(group.path), std::string(group.meaning), group.size,
                     static_cast<std::size_t>(std::ranges::count_if(fields, &Tables::isSingle)),
                     [tables, g] { return tables->records(g); }});
    for (const auto& [rows, columns] : tables->spreads(group)) {
      std::string name = nameOf(group.path);
      for (const std::string_view dimension : rows) name += "." + wordsOf(dimension);
      if (rows.empty()) name += ".values";  // of each record
      std::ranges::replace(name, ' ', '-');
      while (std::ranges::find(all, name, &ResultTable::name) != all.end()) name += "-too";
      all.push_back({name, std::string(group.meaning), tables->rowCount(group, rows),
                     tables->columnCount(group, rows, columns),
                     [tables, g, rows, columns] { return tables->spread(g, rows, columns); }});
    }
  }
  return all;
}

}  // namespace gamut
