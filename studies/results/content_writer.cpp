// One group a part, one attribute or data set a field. Units of outputs are one for all, or one an output with commas
// between them.
#include <algorithm>
#include <span>
#include <stdexcept>

#include "studies/results/detail/content.hpp"

namespace gamut {
namespace {

template <class Record>
std::string jointUnit(const std::vector<Record>& records) {
  const bool isOne = std::ranges::all_of(records, [&](const Record& r) { return r.unit == records.front().unit; });
  std::string joint;
  for (std::size_t i = 0; i < (isOne ? std::min<std::size_t>(records.size(), 1) : records.size()); ++i)
    joint += (i == 0 ? "" : ", ") + records[i].unit;
  return joint;
}

class ContentWriter {
 public:
  ContentWriter(hid_t file, const Results& results)
      : file_(file),
        groups_(describe(results)),
        extents_(extentsOf(groups_)),
        units_{{unit::ofOutput, jointUnit(results.outputs)}, {unit::ofQuantity, jointUnit(results.uncertain)}} {
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

  void writeNumbers(const Group& group, const Field& field, const std::string& suffix, const std::string& meaning,
                    const double* numbers, Hdf5Writer& out) const {
    const std::string name = std::string(field.name) + suffix;
    const std::vector<std::size_t> shape = shapeOf(dimensionsOf(group, field), extents_);
    out.numbers(name, numbers, {shape.begin(), shape.end()}, std::string(field.meaning) + meaning, unitOf(field),
                field.isNoise);
    place(group, field, name, out);
  }

  /// One table after the other.
  template <class Tables, class Part>
  void writeStack(const Group& group, const Field& field, const Tables& tables, const std::string& suffix,
                  const std::string& meaning, const Part& part, Hdf5Writer& out) const {
    std::vector<double> numbers;
    for (const auto& table : tables) numbers.insert(numbers.end(), part(table).data.begin(), part(table).data.end());
    if (!numbers.empty()) writeNumbers(group, field, suffix, meaning, numbers.data(), out);
  }

  template <class Envelopes>
  void writeBounds(const Group& group, const Field& field, const Envelopes& envelopes, Hdf5Writer& out) const {
    const auto lower = [](const Envelope& e) -> const Table& { return e.lower; };
    const auto upper = [](const Envelope& e) -> const Table& { return e.upper; };
    writeStack(group, field, envelopes, "_lower", ", lower bound", lower, out);
    writeStack(group, field, envelopes, "_upper", ", upper bound", upper, out);
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
                       [&](std::vector<double>* v) {
                         if (!v->empty()) writeNumbers(group, field, "", "", v->data(), out);
                       },
                       [&](std::vector<std::int64_t>* v) {
                         if (v->empty()) return;
                         out.integers(std::string(field.name), *v, std::string(field.meaning));
                         place(group, field, std::string(field.name), out);
                       },
                       [&](Table* t) {
                         if (!t->empty()) writeNumbers(group, field, "", "", t->data.data(), out);
                       },
                       [&](std::vector<Table>* v) {
                         writeStack(
                             group, field, *v, "", "", [](const Table& t) -> const Table& { return t; }, out);
                       },
                       [&](Envelope* e) { writeBounds(group, field, std::span(e, 1), out); },
                       [&](std::vector<Envelope>* v) { writeBounds(group, field, *v, out); }},
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

  void writeColumn(const Group& group, const std::vector<std::vector<Field>>& records, std::size_t f,
                   Hdf5Writer& out) const {
    const Field& field = records.front()[f];
    const std::string name(field.name), meaning(field.meaning);
    const auto writeNumberColumn = [&](const std::vector<double>& numbers) {
      writeNumbers(group, field, "", "", numbers.data(), out);
    };
    const auto writeIntegerColumn = [&](const std::vector<std::int64_t>& numbers) {
      out.integers(name, numbers, meaning);
      place(group, field, name, out);
    };
    std::visit(
        Visitor{[&](double*) { writeNumberColumn(column<double, double>(records, f)); },
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
                [&](std::vector<double>*) {
                  std::vector<double> numbers;
                  for (const auto& some : column<std::vector<double>, std::vector<double>>(records, f))
                    numbers.insert(numbers.end(), some.begin(), some.end());
                  if (!numbers.empty()) writeNumberColumn(numbers);  // none where nothing is uncertain, say
                },
                [&](const auto&) { throw std::logic_error(pathOf(group, field) + ": no record has such a field"); }},
        field.value);
  }

  hid_t file_;
  const std::vector<Group> groups_;
  const Extents extents_;
  const std::map<std::string_view, std::string> units_;
};

}  // namespace

void writeContent(hid_t file, const Results& results) { ContentWriter(file, results).write(); }

}  // namespace gamut
