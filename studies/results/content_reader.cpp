// Group by group, in the order of the file, so that a dimension's extent is known when it is needed.
#include <algorithm>
#include <utility>
#include <variant>

#include "studies/results/detail/content.hpp"

namespace gamut {
namespace {

class ContentReader {
 public:
  explicit ContentReader(const Hdf5Reader& root) : root_(root) {}

  void read(const std::vector<Group>& groups) {
    for (const Group& group : groups) {
      const std::string path(group.path);
      if (path == "/") {
        readRecord(group, root_);
      } else if (!isThere(path)) {
        group.resize(0);
      } else if (group.isList()) {
        readColumns(group, Hdf5Reader(root_, path));
      } else {
        group.resize(1);
        readRecord(group, Hdf5Reader(root_, path));
      }
    }
  }

 private:
  bool isThere(const std::string& path) const {
    for (std::size_t end = path.find('/', 1); end != path.npos; end = path.find('/', end + 1))
      if (!root_.has(path.substr(0, end))) return false;
    return root_.has(path);
  }

  // ---- One record ---------------------------------------------------------------------------------------------------

  /// Numbers of the shape that the field's dimensions give them; of any length where it is a scale. None if they are
  /// not there.
  template <class Number, class Read>
  std::vector<Number> numbers(const Group& group, const Field& field, const std::string& name, const Hdf5Reader& in,
                              const Read& read) {
    if (!in.has(name)) return {};
    Hdf5Shape shape;
    std::vector<Number> values = read(name, shape);
    const std::vector<std::size_t> expected = shapeOf(field.dimensions, extents_);
    if (isScale(group, field) ? shape.size() != 1 : !std::ranges::equal(shape, expected))
      throw Hdf5Error(pathOf(group, field));
    if (isScale(group, field)) extents_.emplace(field.dimensions.front(), values.size());
    return values;
  }

  std::vector<double> doubles(const Group& group, const Field& field, std::string_view suffix, const Hdf5Reader& in) {
    return numbers<double>(group, field, std::string(field.name) + std::string(suffix), in,
                           [&](const std::string& name, Hdf5Shape& shape) { return in.numbers(name, shape); });
  }

  void readRecord(const Group& group, const Hdf5Reader& in) {
    for (const Field& field : group.fields(0)) {
      const std::string name(field.name);
      if (field.isNew && !in.hasAttribute(name)) continue;
      std::visit(Visitor{[&](double* x) { *x = in.number(name); }, [&](std::int64_t* x) { *x = in.integer(name); },
                         [&](std::uint64_t* x) { *x = in.natural(name); }, [&](bool* x) { *x = in.integer(name) != 0; },
                         [&](std::string* x) { *x = in.text(name); },
                         [&](Choice x) { takeWord(x, in.text(name), group, field); },
                         [&](WholeText x) { *x.text = in.wholeText(name); },
                         [&](const Numbers& n) {
                           for (std::size_t end = 0; end < n.ends().size(); ++end) {
                             std::vector<double> all = doubles(group, field, n.ends()[end], in);
                             n.take(end, shapeOf(field.dimensions, extents_), std::move(all));
                           }
                         },
                         [&](std::vector<std::int64_t>* v) {
                           *v = numbers<std::int64_t>(
                               group, field, name, in,
                               [&](const std::string& n, Hdf5Shape& shape) { return in.integers(n, shape); });
                         }},
                 field.value);
    }
  }

  static void takeWord(const Choice& choice, const std::string& word, const Group& group, const Field& field) {
    if (!choice.take(word)) throw Hdf5Error(pathOf(group, field));
  }

  // ---- Lists --------------------------------------------------------------------------------------------------------

  /// The values of one field of all records, to be put into them one by one.
  using Absent = std::monostate;
  using Column = std::variant<std::vector<double>, std::vector<std::int64_t>, std::vector<std::string>, Absent>;

  static Column columnOf(const Field& field, const Hdf5Reader& in, Hdf5Shape& shape) {
    const std::string name(field.name);
    const auto texts = [&]() -> Column {
      std::vector<std::string> all = in.texts(name);
      shape = {all.size()};
      return all;
    };
    return std::visit(Visitor{[&](std::string*) { return texts(); }, [&](Choice) { return texts(); },
                              [&](double*) -> Column { return in.numbers(name, shape); },
                              [&](const Numbers&) -> Column { return in.numbers(name, shape); },
                              [&](const auto&) -> Column { return in.integers(name, shape); }},
                      field.value);
  }

  void readColumns(const Group& group, const Hdf5Reader& in) {
    group.resize(1);  // for the names and kinds of the fields
    std::vector<Column> columns;
    std::size_t size = 0;
    for (const Field& field : group.fields(0)) {
      Hdf5Shape shape;
      std::vector<std::size_t> expected = shapeOf(field.dimensions, extents_);
      if (std::ranges::find(expected, 0U) != expected.end()) {  // nothing is written of no numbers
        columns.emplace_back(std::vector<double>());
        continue;
      }
      if (field.isNew && !in.has(std::string(field.name))) {
        columns.emplace_back(Absent());
        continue;
      }
      columns.push_back(columnOf(field, in, shape));
      if (columns.size() == 1 && shape.size() == 1) size = shape.front();
      expected.insert(expected.begin(), size);
      if (size == 0 || !std::ranges::equal(shape, expected)) throw Hdf5Error(pathOf(group, field));
    }
    extents_.emplace(group.dimension, size);
    group.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      const std::vector<Field> fields = group.fields(i);
      for (std::size_t f = 0; f < fields.size(); ++f)
        if (!std::holds_alternative<Absent>(columns[f])) put(columns[f], i, size, group, fields[f]);
    }
  }

  /// Value i of a column, or as many as there are for each of `size` records, into its field.
  static void put(const Column& column, std::size_t i, std::size_t size, const Group& group, const Field& field) {
    const auto integer = [&] { return std::get<std::vector<std::int64_t>>(column)[i]; };
    std::visit(Visitor{[&](double* x) { *x = std::get<std::vector<double>>(column)[i]; },
                       [&](std::int64_t* x) { *x = integer(); },
                       [&](std::uint64_t* x) { *x = static_cast<std::uint64_t>(integer()); },
                       [&](bool* x) { *x = integer() != 0; },
                       [&](std::string* x) { *x = std::get<std::vector<std::string>>(column)[i]; },
                       [&](Choice x) { takeWord(x, std::get<std::vector<std::string>>(column)[i], group, field); },
                       [&](const Numbers& n) {
                         const std::vector<double>& all = std::get<std::vector<double>>(column);
                         const auto each = static_cast<std::ptrdiff_t>(all.size() / size);
                         const auto from = all.begin() + static_cast<std::ptrdiff_t>(i) * each;
                         n.take(0, {static_cast<std::size_t>(each)}, {from, from + each});
                       },
                       [](const auto&) {}},
               field.value);
  }

  const Hdf5Reader& root_;
  Extents extents_;
};

}  // namespace

void readGroups(const Hdf5Reader& root, const std::vector<Group>& groups) { ContentReader(root).read(groups); }

Results readContent(const Hdf5Reader& root, const std::vector<Boxed<FurtherPart>>& further) {
  Results results;
  results.further = further;
  readGroups(root, describe(results));
  if (results.time.empty()) throw Hdf5Error("/time");
  if (results.outputs.empty()) throw Hdf5Error("/output");
  const std::vector<Group> groups = describe(results);
  for (const std::string& path : {misshapen(groups), senseless(groups)})
    if (!path.empty()) throw Hdf5Error(path);
  return results;
}

}  // namespace gamut
