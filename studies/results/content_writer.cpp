// One group a part, one attribute or data set a field. Units of outputs are one for all, or one an output with commas
// between them.
#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

#include "studies/results/detail/content.hpp"

namespace gamut {
namespace {

class ContentWriter {
 public:
  ContentWriter(hid_t file, std::vector<Group> groups, JointUnits units)
      : file_(file), groups_(std::move(groups)), extents_(extentsOf(groups_)), units_(std::move(units)) {
    if (const std::string path = misshapen(groups_); !path.empty())
      throw std::logic_error(path + ": its shape is not that of its dimensions");
  }

  void write() {
    for (const Group& group : groups_) {
      if (group.size == 0) continue;
      Hdf5Writer out = group.path == "/" ? Hdf5Writer(file_) : Hdf5Writer(file_, std::string(group.path));
      if (!group.meaning.empty()) out.attribute("long_name", std::string(group.meaning));
      if (group.isList()) {
        writeColumns(group, out);
      } else {
        for (const Field& field : group.fields(0)) writeField(group, field, out);
      }
    }
  }

 private:
  std::string unitOf(const Field& field) const {
    const auto joint = units_.find(field.unit);
    return joint == units_.end() ? std::string(field.unit) : joint->second;
  }

  /// Gives a data set that was written its scales, or makes it one.
  void place(const Group& group, const Field& field, const std::string& name, Hdf5Writer& out) const {
    const std::vector<std::string_view> dimensions = dimensionsOf(group, field);
    if (isScale(group, field)) {
      const std::string path = pathOf(group, field);
      out.makeScale(name, path.substr(path.rfind('/') + 1));
    } else {
      out.attachScales(name, {dimensions.begin(), dimensions.end()});
    }
  }

  /// None where nothing is uncertain, say.
  void writeNumbers(const Group& group, const Field& field, std::string_view suffix, std::span<const double> numbers,
                    Hdf5Writer& out) const {
    if (numbers.empty()) return;
    const std::string name = std::string(field.name) + std::string(suffix);
    const std::string end = suffix == "_lower" ? ", lower bound" : suffix == "_upper" ? ", upper bound" : "";
    const GridShape shape = shapeOf(dimensionsOf(group, field), extents_);
    out.numbers(name, numbers.data(), {shape.begin(), shape.end()}, std::string(field.meaning) + end, unitOf(field),
                field.isNoise);
    place(group, field, name, out);
  }

  /// The unit of an attribute stands beside it.
  template <class Value>
  void writeAttribute(const Field& field, const Value& value, Hdf5Writer& out) const {
    const std::string name(field.name);
    out.attribute(name, value);
    if (!field.unit.empty() && field.unit != unit::one) out.attribute(name + "_units", std::string(field.unit));
  }

  void writeField(const Group& group, const Field& field, Hdf5Writer& out) const {
    std::visit(Visitor{[&](double* x) { writeAttribute(field, *x, out); },
                       [&](std::int64_t* x) { writeAttribute(field, *x, out); },
                       [&](std::uint64_t* x) { writeAttribute(field, *x, out); },
                       [&](bool* x) { writeAttribute(field, std::int64_t{*x}, out); },
                       [&](std::string* x) { writeAttribute(field, *x, out); },
                       [&](Choice x) { writeAttribute(field, x.word(), out); },
                       [&](WholeText x) { out.text(std::string(field.name), *x.text, std::string(field.meaning)); },
                       [&](const Numbers& n) {
                         std::vector<double> room;
                         for (std::size_t end = 0; end < n.ends().size(); ++end)
                           writeNumbers(group, field, n.ends()[end], n.all(end, room), out);
                       },
                       [&](std::vector<std::int64_t>* v) {
                         if (v->empty()) return;
                         out.integers(std::string(field.name), *v, std::string(field.meaning));
                         place(group, field, std::string(field.name), out);
                       }},
               field.value);
  }

  // ---- Lists --------------------------------------------------------------------------------------------------------

  void writeColumns(const Group& group, Hdf5Writer& out) const {
    std::vector<std::vector<Field>> records;
    for (std::size_t i = 0; i < group.size; ++i) records.push_back(group.fields(i));
    for (std::size_t f = 0; f < records.front().size(); ++f) writeColumn(group, records, f, out);
  }

  template <class Value, class To>
  static std::vector<To> column(const std::vector<std::vector<Field>>& records, std::size_t f) {
    std::vector<To> values;
    for (const std::vector<Field>& fields : records)
      values.push_back(static_cast<To>(*std::get<Value*>(fields[f].value)));
    return values;
  }

  static bool isSomeEmpty(const std::vector<std::vector<Field>>& records, std::size_t f) {
    return std::ranges::any_of(
        records, [f](const std::vector<Field>& fields) { return std::get<Numbers>(fields[f].value).empty(); });
  }

  void writeColumn(const Group& group, const std::vector<std::vector<Field>>& records, std::size_t f,
                   Hdf5Writer& out) const {
    const Field& field = records.front()[f];
    const std::string name(field.name), meaning(field.meaning);
    const auto writeIntegerColumn = [&](const std::vector<std::int64_t>& numbers) {
      out.integers(name, numbers, meaning);
      place(group, field, name, out);
    };
    std::visit(
        Visitor{[&](double*) { writeNumbers(group, field, "", column<double, double>(records, f), out); },
                [&](std::int64_t*) { writeIntegerColumn(column<std::int64_t, std::int64_t>(records, f)); },
                [&](std::uint64_t*) { writeIntegerColumn(column<std::uint64_t, std::int64_t>(records, f)); },
                [&](bool*) { writeIntegerColumn(column<bool, std::int64_t>(records, f)); },
                [&](std::string*) {
                  out.texts(name, column<std::string, std::string>(records, f), meaning);
                  place(group, field, name, out);
                },
                [&](Choice) {
                  std::vector<std::string> texts;
                  for (const std::vector<Field>& fields : records)
                    texts.push_back(std::get<Choice>(fields[f].value).word());
                  out.texts(name, texts, meaning);
                  place(group, field, name, out);
                },
                [&](const Numbers&) {
                  std::vector<double> numbers;
                  for (const std::vector<Field>& fields : records)
                    for (const std::vector<double>* some : std::get<Numbers>(fields[f].value).lists())
                      numbers.insert(numbers.end(), some->begin(), some->end());
                  if (field.isNew && isSomeEmpty(records, f)) return;  // of records that an older file held
                  writeNumbers(group, field, "", numbers, out);
                },
                [&](const auto&) { throw std::logic_error(pathOf(group, field) + ": no record has such a field"); }},
        field.value);
  }

  hid_t file_;
  const std::vector<Group> groups_;
  const Extents extents_;
  const JointUnits units_;
};

}  // namespace

void writeGroups(hid_t file, std::vector<Group> groups, JointUnits units) {
  ContentWriter(file, std::move(groups), std::move(units)).write();
}

void writeContent(hid_t file, const Results& results) {
  writeGroups(file, describe(results),
              {{unit::ofOutput, jointUnit(results.outputs)}, {unit::ofQuantity, jointUnit(results.uncertain)}});
}

}  // namespace gamut
