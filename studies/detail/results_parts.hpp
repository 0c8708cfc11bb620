// The parts that a results file is made of: grids over times and outputs, and lists of records, one data set a field.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "studies/detail/hdf5.hpp"
#include "studies/results.hpp"

namespace gamut {

/// The unit of all, or the units one after the other, with commas between them.
std::string jointUnit(const std::vector<std::string>& units);

/// A list of numbers that is a dimension of others.
void writeScale(Hdf5Writer& group, const std::string& name, const std::vector<double>& values,
                const std::string& longName, const std::string& unit);

/// Grids with their scales and units.
class GridWriter {
 public:
  GridWriter(Hdf5Writer& group, const Results& results);

  void grid(const std::string& name, const Grid& grid, const std::string& longName);
  /// A grid of numbers without unit.
  void ratio(const std::string& name, const Grid& grid, const std::string& longName);
  void bounds(const std::string& name, const Bounds& bounds, const std::string& longName);
  /// `scale`: absolute path of the first dimension's scale.
  void stack(const std::string& name, const std::vector<const Grid*>& grids, const std::string& scale,
             const std::string& longName);
  void stack(const std::string& name, const std::vector<Bounds>& bounds, const std::string& scale,
             const std::string& longName);

 private:
  void grid(const std::string& name, const Grid& grid, const std::string& longName, const std::string& unit);

  Hdf5Writer* group_;
  const Results* results_;
  std::string unit_;
};

/// One column of a list of records.
template <class T, class Record>
std::vector<T> column(const std::vector<Record>& records, const std::function<T(const Record&)>& field) {
  std::vector<T> values;
  for (const Record& record : records) values.push_back(field(record));
  return values;
}

/// Columns of a list of records, one data set each. The dimension of all is called after the first one, unless its
/// scale is given as an absolute path.
template <class Record>
class ColumnWriter {
 public:
  ColumnWriter(Hdf5Writer& group, const std::vector<Record>& records, std::string scale = "")
      : group_(&group), records_(&records), scale_(std::move(scale)) {}

  void texts(const std::string& name, const std::function<std::string(const Record&)>& field,
             const std::string& longName) {
    group_->texts(name, column<std::string>(*records_, field), longName);
    setDimension(name);
  }
  void numbers(const std::string& name, const std::function<double(const Record&)>& field, const std::string& longName,
               const std::string& unit) {
    const std::vector<double> values = column<double>(*records_, field);
    group_->numbers(name, values.data(), {values.size()}, longName, unit);
    setDimension(name);
  }
  void integers(const std::string& name, const std::function<std::int64_t(const Record&)>& field,
                const std::string& longName) {
    group_->integers(name, column<std::int64_t>(*records_, field), longName);
    setDimension(name);
  }

 private:
  void setDimension(const std::string& name) {
    if (scale_.empty()) {
      group_->makeScale(name, name);
      scale_ = name;
    } else {
      group_->attachScales(name, {scale_});
    }
  }

  Hdf5Writer* group_;
  const std::vector<Record>* records_;
  std::string scale_;
};

/// Grids of a group, checked against the file's times and outputs.
class GridReader {
 public:
  GridReader(const Hdf5Reader& group, const Results& results)
      : group_(&group), times_(results.time.size()), outputs_(results.outputs.size()) {}

  /// Empty if there is none.
  Grid grid(const std::string& name) const;
  Bounds bounds(const std::string& name) const;
  std::vector<Grid> stack(const std::string& name, std::size_t levels) const;
  std::vector<Bounds> boundsStack(const std::string& name, std::size_t levels) const;

 private:
  const Hdf5Reader* group_;
  std::size_t times_, outputs_;
};

/// Throws Hdf5Error unless the bounds are those of an interval that is not empty, or one is NaN.
void requireBounds(double lower, double upper, const std::string& name);

/// A list of numbers; with `size` other than npos, of that length.
std::vector<double> readList(const Hdf5Reader& group, const std::string& name, std::size_t size = std::string::npos);
std::vector<std::string> readTexts(const Hdf5Reader& group, const std::string& name, std::size_t size);
std::vector<std::int64_t> readIntegers(const Hdf5Reader& group, const std::string& name, std::size_t size);

}  // namespace gamut
