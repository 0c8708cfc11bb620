// Reading: types and shapes are checked before anything is read, and nothing is believed that the file's size rules
// out.
#include <hdf5_hl.h>

#include <cstring>
#include <type_traits>

#include "studies/printable.hpp"
#include "studies/results/detail/hdf5.hpp"

namespace gamut {
namespace {

Hdf5Handle openGroup(hid_t parent, const std::string& name) {
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, name};
}

Hdf5Handle openData(hid_t group, const std::string& name) {
  return {H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, name};
}

Hdf5Handle openAttribute(hid_t group, const std::string& name) {
  return {H5Aopen(group, name.c_str(), H5P_DEFAULT), H5Aclose, name};
}

void checkClass(hid_t type, H5T_class_t expected, const std::string& name) {
  if (H5Tget_class(type) != expected) throw Hdf5Error(name);
}

void checkScalar(hid_t space, const std::string& name) {
  if (H5Sget_simple_extent_npoints(space) != 1) throw Hdf5Error(name);
}

/// What the file can hold of data at most: deflate packs 1032 bytes into one, and no better.
hsize_t largest(hid_t object, const std::string& name) {
  const Hdf5Handle file(H5Iget_file_id(object), H5Fclose, name);
  hsize_t size = 0;
  checkHdf5(H5Fget_filesize(file, &size), name);
  return 1100 * size;
}

Hdf5Shape shapeOf(hid_t data, std::size_t elementSize, const std::string& name) {
  const Hdf5Handle space(H5Dget_space(data), H5Sclose, name);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 8 || elementSize == 0) throw Hdf5Error(name);
  Hdf5Shape shape(static_cast<std::size_t>(rank));
  checkHdf5(H5Sget_simple_extent_dims(space, shape.data(), nullptr), name);
  hsize_t left = largest(data, name) / elementSize;
  for (const hsize_t extent : shape) {
    if (extent > left) throw Hdf5Error(name);
    if (extent > 0) left /= extent;
  }
  return shape;
}

/// The size of a text of fixed length.
std::size_t textSize(hid_t type, hid_t object, const std::string& name) {
  checkClass(type, H5T_STRING, name);
  const std::size_t size = H5Tget_size(type);
  if (H5Tis_variable_str(type) != 0 || size == 0 || size > largest(object, name)) throw Hdf5Error(name);
  return size;
}

/// Without the zero bytes that fill it up.
std::string trimmed(const char* begin, std::size_t size) {
  while (size > 0 && begin[size - 1] == '\0') --size;
  return {begin, size};
}

template <class T>
T readAttribute(hid_t group, const std::string& name, hid_t type, H5T_class_t expected) {
  const Hdf5Handle attribute = openAttribute(group, name);
  const Hdf5Handle found(H5Aget_type(attribute), H5Tclose, name);
  checkClass(found, expected, name);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, name);
  checkScalar(space, name);
  T value{};
  checkHdf5(H5Aread(attribute, type, &value), name);
  return value;
}

template <class T>
std::vector<T> readData(hid_t group, const std::string& name, hid_t type, H5T_class_t expected, Hdf5Shape& shape) {
  const Hdf5Handle data = openData(group, name);
  const Hdf5Handle found(H5Dget_type(data), H5Tclose, name);
  checkClass(found, expected, name);
  shape = shapeOf(data, sizeof(T), name);
  std::vector<T> values(countOf(shape));
  checkHdf5(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

std::string readTextAttribute(hid_t group, const std::string& name) {
  const Hdf5Handle attribute = openAttribute(group, name);
  const Hdf5Handle found(H5Aget_type(attribute), H5Tclose, name);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, name);
  checkScalar(space, name);
  std::string value(textSize(found, attribute, name), '\0');
  checkHdf5(H5Aread(attribute, found, value.data()), name);
  return trimmed(value.data(), value.size());
}

std::vector<std::string> readTexts(hid_t group, const std::string& name) {
  const Hdf5Handle data = openData(group, name);
  const Hdf5Handle found(H5Dget_type(data), H5Tclose, name);
  const std::size_t length = textSize(found, data, name);
  const hsize_t n = countOf(shapeOf(data, length, name));
  std::string table(n * length, '\0');
  checkHdf5(H5Dread(data, found, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.data()), name);
  std::vector<std::string> values;
  for (hsize_t i = 0; i < n; ++i) values.push_back(trimmed(table.data() + i * length, length));
  return values;
}

}  // namespace

void Hdf5Transcript::read(void* data, std::size_t size) {
  if (size > bytes_.size() - at_) throw Hdf5Error("the file");
  std::memcpy(data, bytes_.data() + at_, size);
  at_ += size;
}

template <class T>
void Hdf5Transcript::write(const T& value) {
  if constexpr (std::is_arithmetic_v<T>) {
    write(&value, sizeof value);
  } else {
    write(value.size());
    if constexpr (requires { value.front().size(); }) {
      for (const auto& part : value) write(part);
    } else {
      write(value.data(), value.size() * sizeof value[0]);
    }
  }
}

template <class T>
T Hdf5Transcript::read() {
  T value{};
  if constexpr (std::is_arithmetic_v<T>) {
    read(&value, sizeof value);
  } else {
    const auto size = read<std::size_t>();
    if (size > (bytes_.size() - at_)) throw Hdf5Error("the file");
    if constexpr (requires { value.front().size(); }) {
      for (std::size_t i = 0; i < size; ++i) value.push_back(read<typename T::value_type>());
    } else {
      if (size > (bytes_.size() - at_) / sizeof value[0]) throw Hdf5Error("the file");
      value.resize(size);
      read(value.data(), size * sizeof value[0]);
    }
  }
  return value;
}

template <class Answer>
Answer Hdf5Transcript::answer(const std::function<Answer()>& ask) {
  if (isTold_) {
    if (read<char>() != 0) return read<Answer>();
    throw Hdf5Error(read<std::string>());
  }
  try {
    Answer found = ask();
    write(char{1});
    write(found);
    return found;
  } catch (const Hdf5Error& error) {
    write(char{0});
    write(std::string(error.what()));
    throw;
  }
}

Hdf5Reader::Hdf5Reader(std::string_view image, Hdf5Transcript& transcript) : transcript_(&transcript) {
  // Neither copied nor freed; a file opened for reading is not written to.
  void* bytes = const_cast<char*>(image.data());
  const auto openImage = [&]() -> Hdf5Handle {
    return {H5LTopen_file_image(bytes, image.size(), H5LT_FILE_IMAGE_DONT_COPY | H5LT_FILE_IMAGE_DONT_RELEASE),
            H5Fclose, "the file"};
  };
  open([&] {
    file_.emplace(openImage());
    return openGroup(*file_, "/");
  });
}

Hdf5Reader::Hdf5Reader(Hdf5Transcript& transcript) : transcript_(&transcript) { open(nullptr); }

Hdf5Reader::Hdf5Reader(const Hdf5Reader& parent, const std::string& name) : transcript_(parent.transcript_) {
  open([&] { return openGroup(*parent.group_, name); });
}

void Hdf5Reader::open(const std::function<Hdf5Handle()>& open) {
  transcript_->answer<bool>([&] {
    group_.emplace(open());
    return true;
  });
}

bool Hdf5Reader::has(const std::string& name) const {
  return transcript_->answer<bool>([&] {
    const htri_t found = H5Lexists(*group_, name.c_str(), H5P_DEFAULT);
    if (found < 0) throw Hdf5Error(name);
    return found > 0;
  });
}

bool Hdf5Reader::hasAttribute(const std::string& name) const {
  return transcript_->answer<bool>([&] {
    const htri_t found = H5Aexists(*group_, name.c_str());
    if (found < 0) throw Hdf5Error(name);
    return found > 0;
  });
}

double Hdf5Reader::number(const std::string& attribute) const {
  return transcript_->answer<double>(
      [&] { return readAttribute<double>(*group_, attribute, H5T_NATIVE_DOUBLE, H5T_FLOAT); });
}

std::int64_t Hdf5Reader::integer(const std::string& attribute) const {
  return transcript_->answer<std::int64_t>(
      [&] { return readAttribute<std::int64_t>(*group_, attribute, H5T_NATIVE_INT64, H5T_INTEGER); });
}

std::uint64_t Hdf5Reader::natural(const std::string& attribute) const {
  return transcript_->answer<std::uint64_t>(
      [&] { return readAttribute<std::uint64_t>(*group_, attribute, H5T_NATIVE_UINT64, H5T_INTEGER); });
}

std::string Hdf5Reader::text(const std::string& name) const {
  return printable(transcript_->answer<std::string>([&] { return readTextAttribute(*group_, name); }));
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name) const {
  using Texts = std::vector<std::string>;
  Texts values = transcript_->answer<Texts>([&] { return readTexts(*group_, name); });
  for (std::string& value : values) value = printable(value);
  return values;
}

std::string Hdf5Reader::wholeText(const std::string& name) const {
  return transcript_->answer<std::string>([&] {
    const std::vector<std::string> values = readTexts(*group_, name);
    if (values.size() != 1) throw Hdf5Error(name);
    return values.front();
  });
}

/// A transcript may have come from a process that was out of its mind.
template <class T>
std::vector<T> Hdf5Reader::data(const std::string& name, hid_t type, H5T_class_t expected, Hdf5Shape& shape) const {
  std::vector<T> values =
      transcript_->answer<std::vector<T>>([&] { return readData<T>(*group_, name, type, expected, shape); });
  shape = transcript_->answer<Hdf5Shape>([&] { return shape; });
  if (countOf(shape) != values.size()) throw Hdf5Error(name);
  return values;
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& name, Hdf5Shape& shape) const {
  return data<std::int64_t>(name, H5T_NATIVE_INT64, H5T_INTEGER, shape);
}

std::vector<double> Hdf5Reader::numbers(const std::string& name, Hdf5Shape& shape) const {
  return data<double>(name, H5T_NATIVE_DOUBLE, H5T_FLOAT, shape);
}

}  // namespace gamut
