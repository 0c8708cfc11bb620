// A few hands on HDF5's C interface: handles that close themselves, files in memory, and reading and writing of the
// kinds of data that results are made of. Failures throw Hdf5Error with the object's name.
//
// Everything is written so that damage shows: headers in the library's format 1.10, which have checksums; small data
// inside their headers, larger ones in chunks with a checksum each; texts of fixed length, never by reference.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gamut {

class Hdf5Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Hdf5Error naming `what` where a call of the library failed.
void checkHdf5(herr_t status, const std::string& what);

/// Owns an HDF5 identifier of any kind.
class Hdf5Handle {
 public:
  /// Throws Hdf5Error naming `what` if the identifier is invalid.
  Hdf5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what);
  ~Hdf5Handle();
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT(google-explicit-*): implicit, handles are passed to C functions

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

/// The bytes of a file that `fill` writes, with `userBlock` bytes (a power of two, at least 512) in front, all zero,
/// that are not HDF5's. No disk is touched.
std::string hdf5InMemory(hsize_t userBlock, const std::function<void(hid_t)>& fill);

using Hdf5Shape = std::vector<hsize_t>;

/// How many elements data of this shape have.
hsize_t countOf(const Hdf5Shape& shape);

/// A group of an open file, for writing.
class Hdf5Writer {
 public:
  /// The root group of a file.
  explicit Hdf5Writer(hid_t file);
  /// A new group.
  Hdf5Writer(hid_t parent, const std::string& name);

  void attribute(const std::string& name, double value);
  void attribute(const std::string& name, std::int64_t value);
  void attribute(const std::string& name, std::uint64_t value);
  void attribute(const std::string& name, const std::string& value);
  void text(const std::string& name, const std::string& value, const std::string& longName);
  void texts(const std::string& name, const std::vector<std::string>& values, const std::string& longName);
  void integers(const std::string& name, const std::vector<std::int64_t>& values, const std::string& longName);
  /// `units` may be empty: then there is no such attribute. Noise is not compressed.
  void numbers(const std::string& name, const double* values, const Hdf5Shape& shape, const std::string& longName,
               const std::string& units, bool isNoise = false);
  /// Makes a data set of this group a dimension scale.
  void makeScale(const std::string& name, const std::string& label);
  /// Attaches scales (absolute paths in the file) to the dimensions of a data set.
  void attachScales(const std::string& name, const std::vector<std::string>& scales);

 private:
  void data(const std::string& name, hid_t type, const Hdf5Shape& shape, const void* values,
            const std::string& longName, bool isNoise = false);

  Hdf5Handle group_;
};

/// What an Hdf5Reader was told by the library, to be told again where the library must not run.
class Hdf5Transcript {
 public:
  /// To be written.
  Hdf5Transcript() = default;
  /// To be told again.
  explicit Hdf5Transcript(std::string bytes) : bytes_(std::move(bytes)), isTold_(true) {}

  const std::string& bytes() const { return bytes_; }

  /// The answer of `ask`, written down; or the next one that was. Throws Hdf5Error as `ask` does, and where nothing
  /// that could be an answer is written.
  template <class Answer>
  Answer answer(const std::function<Answer()>& ask);

 private:
  void write(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  void read(void* data, std::size_t size);
  template <class T>
  void write(const T& value);
  template <class T>
  T read();

  std::string bytes_;
  std::size_t at_ = 0;
  bool isTold_ = false;
};

/// A group of an open file, or of the transcript of one, for reading.
class Hdf5Reader {
 public:
  /// The root group of `image`, a file's bytes, which must outlive this.
  Hdf5Reader(std::string_view image, Hdf5Transcript& transcript);
  /// The root group as it was read.
  explicit Hdf5Reader(Hdf5Transcript& transcript);
  Hdf5Reader(const Hdf5Reader& parent, const std::string& name);

  bool has(const std::string& name) const;
  bool hasAttribute(const std::string& name) const;
  double number(const std::string& attribute) const;
  std::int64_t integer(const std::string& attribute) const;
  std::uint64_t natural(const std::string& attribute) const;
  // Words, with escapes for control characters.
  std::string text(const std::string& attribute) const;
  std::vector<std::string> texts(const std::string& name) const;
  /// A text as it is.
  std::string wholeText(const std::string& name) const;
  // Values in row-major order; `shape` is set.
  std::vector<std::int64_t> integers(const std::string& name, Hdf5Shape& shape) const;
  std::vector<double> numbers(const std::string& name, Hdf5Shape& shape) const;

 private:
  void open(const std::function<Hdf5Handle()>& open);
  template <class T>
  std::vector<T> data(const std::string& name, hid_t type, H5T_class_t expected, Hdf5Shape& shape) const;

  std::optional<Hdf5Handle> file_, group_;  ///< none where a transcript is told again
  Hdf5Transcript* transcript_;
};

}  // namespace gamut
