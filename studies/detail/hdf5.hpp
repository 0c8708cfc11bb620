// A few hands on HDF5's C interface: handles that close themselves, and reading and writing of the kinds of data that
// results are made of. Failures throw Hdf5Error with the object's name.
#pragma once

#include <hdf5.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gamut {

class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Owns an HDF5 identifier of any kind.
class Hdf5Handle {
 public:
  /// Throws Hdf5Error naming `what` if the identifier is invalid.
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what);
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: implicit on purpose, handles are passed to C functions

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// HDF5's own messages are silent while this lives.
class Hdf5Silence {
 public:
  Hdf5Silence();
  ~Hdf5Silence();
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

using Hdf5Shape = std::vector<hsize_t>;

/// A group of an open file, for writing.
class Hdf5Writer {
 public:
  /// The root group of a file.
  explicit Hdf5Writer(hid_t file);
  /// A new group.
  Hdf5Writer(hid_t parent, const std::string& name);

  hid_t id() const { return group_; }
  void attribute(const std::string& name, double value);
  void attribute(const std::string& name, std::int64_t value);
  void attribute(const std::string& name, std::uint64_t value);
  void attribute(const std::string& name, const std::string& value);
  void text(const std::string& name, const std::string& value, const std::string& longName);
  void texts(const std::string& name, const std::vector<std::string>& values, const std::string& longName);
  void integers(const std::string& name, const std::vector<std::int64_t>& values, const std::string& longName);
  /// Compressed if large. `units` is one word for all, or one an entry of the last dimension.
  void numbers(const std::string& name, const double* values, const Hdf5Shape& shape, const std::string& longName,
               const std::vector<std::string>& units);
  /// Makes a data set of this group a dimension scale.
  void makeScale(const std::string& name, const std::string& label);
  /// Attaches scales (absolute paths in the file) to the dimensions of a data set.
  void attachScales(const std::string& name, const std::vector<std::string>& scales);

 private:
  Hdf5Handle group_;
  std::string name_;
};

/// A group of an open file, for reading.
class Hdf5Reader {
 public:
  Hdf5Reader(hid_t parent, const std::string& name);

  hid_t id() const { return group_; }
  bool has(const std::string& name) const;
  bool hasAttribute(const std::string& name) const;
  double number(const std::string& attribute) const;
  std::int64_t integer(const std::string& attribute) const;
  std::uint64_t natural(const std::string& attribute) const;
  std::string text(const std::string& attribute) const;
  std::vector<std::string> attributeNames() const;
  std::string textData(const std::string& name) const;
  std::vector<std::string> texts(const std::string& name) const;
  std::vector<std::int64_t> integers(const std::string& name) const;
  /// Values in row-major order; `shape` is set.
  std::vector<double> numbers(const std::string& name, Hdf5Shape& shape) const;

 private:
  Hdf5Handle group_;
  std::string name_;
};

}  // namespace gamut
