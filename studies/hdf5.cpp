// The C interface's steps: spaces, types, properties, data sets, attributes. Texts are variable-length UTF-8.
#include "studies/detail/hdf5.hpp"

#include <hdf5_hl.h>

namespace gamut {
namespace {

void check(herr_t status, const std::string& what) {
  if (status < 0) throw Hdf5Error(what);
}

Hdf5Handle textType() {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  check(H5Tset_size(type, H5T_VARIABLE), "text type");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "text type");
  return type;
}

Hdf5Handle scalarSpace() { return {H5Screate(H5S_SCALAR), H5Sclose, "scalar space"}; }

Hdf5Handle simpleSpace(const Hdf5Shape& shape) {
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, "space"};
}

hsize_t count(const Hdf5Shape& shape) {
  hsize_t product = 1;
  for (const hsize_t extent : shape) product *= extent;
  return product;
}

std::vector<const char*> pointers(const std::vector<std::string>& values) {
  std::vector<const char*> result;
  for (const std::string& value : values) result.push_back(value.c_str());
  return result;
}

void writeAttribute(hid_t object, const std::string& name, hid_t type, hid_t space, const void* value) {
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, name);
  check(H5Awrite(attribute, type, value), name);
}

void writeTextAttribute(hid_t object, const std::string& name, const std::string& value) {
  const char* text = value.c_str();
  writeAttribute(object, name, textType(), scalarSpace(), static_cast<const void*>(&text));
}

void writeTextsAttribute(hid_t object, const std::string& name, const std::vector<std::string>& values) {
  const std::vector<const char*> texts = pointers(values);
  writeAttribute(object, name, textType(), simpleSpace({values.size()}), static_cast<const void*>(texts.data()));
}

Hdf5Handle createData(hid_t group, const std::string& name, hid_t type, hid_t space, hid_t properties) {
  return {H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose, name};
}

/// Shuffle and gzip in chunks of at most 64 Ki numbers, for what is worth it.
Hdf5Handle numberProperties(const Hdf5Shape& shape) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
  if (count(shape) < 512) return properties;
  Hdf5Shape chunk = shape;
  for (hsize_t& extent : chunk)
    while (count(chunk) > 65536 && extent > 1) extent = (extent + 1) / 2;
  check(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "chunks");
  check(H5Pset_shuffle(properties), "shuffle");
  check(H5Pset_deflate(properties, 6), "deflate");
  return properties;
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

void checkVariableText(hid_t type, const std::string& name) {
  checkClass(type, H5T_STRING, name);
  if (H5Tis_variable_str(type) <= 0) throw Hdf5Error(name);
}

void checkScalar(hid_t space, const std::string& name) {
  if (H5Sget_simple_extent_npoints(space) != 1) throw Hdf5Error(name);
}

Hdf5Shape shapeOf(hid_t data, const std::string& name) {
  const Hdf5Handle space(H5Dget_space(data), H5Sclose, name);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 8) throw Hdf5Error(name);
  Hdf5Shape shape(static_cast<std::size_t>(rank));
  check(H5Sget_simple_extent_dims(space, shape.data(), nullptr), name);
  // A damaged header may claim anything: nothing that we write is larger than this.
  hsize_t product = 1;
  for (const hsize_t extent : shape) {
    if (extent > (hsize_t{1} << 31) || (extent != 0 && product > (hsize_t{1} << 31) / extent)) throw Hdf5Error(name);
    product *= extent;
  }
  return shape;
}

template <class T>
T readAttribute(hid_t group, const std::string& name, hid_t type, H5T_class_t expected) {
  const Hdf5Handle attribute = openAttribute(group, name);
  const Hdf5Handle found(H5Aget_type(attribute), H5Tclose, name);
  checkClass(found, expected, name);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, name);
  checkScalar(space, name);
  T value{};
  check(H5Aread(attribute, type, &value), name);
  return value;
}

}  // namespace

Hdf5Handle::Hdf5Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
  if (id < 0) throw Hdf5Error(what);
}

Hdf5Handle::~Hdf5Handle() {
  if (id_ >= 0) close_(id_);
}

Hdf5Silence::Hdf5Silence() {
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Silence::~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }

// ---- Writing --------------------------------------------------------------------------------------------------------

Hdf5Writer::Hdf5Writer(hid_t file) : group_(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose, "/"), name_("/") {}

Hdf5Writer::Hdf5Writer(hid_t parent, const std::string& name)
    : group_(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name), name_(name) {}

void Hdf5Writer::attribute(const std::string& name, double value) {
  writeAttribute(group_, name, H5T_NATIVE_DOUBLE, scalarSpace(), &value);
}

void Hdf5Writer::attribute(const std::string& name, std::int64_t value) {
  writeAttribute(group_, name, H5T_NATIVE_INT64, scalarSpace(), &value);
}

void Hdf5Writer::attribute(const std::string& name, std::uint64_t value) {
  writeAttribute(group_, name, H5T_NATIVE_UINT64, scalarSpace(), &value);
}

void Hdf5Writer::attribute(const std::string& name, const std::string& value) {
  writeTextAttribute(group_, name, value);
}

void Hdf5Writer::text(const std::string& name, const std::string& value, const std::string& longName) {
  const Hdf5Handle type = textType();
  const Hdf5Handle data = createData(group_, name, type, scalarSpace(), H5P_DEFAULT);
  const char* pointer = value.c_str();
  check(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<const void*>(&pointer)), name);
  writeTextAttribute(data, "long_name", longName);
}

void Hdf5Writer::texts(const std::string& name, const std::vector<std::string>& values, const std::string& longName) {
  const Hdf5Handle type = textType();
  const Hdf5Handle data = createData(group_, name, type, simpleSpace({values.size()}), H5P_DEFAULT);
  const std::vector<const char*> texts = pointers(values);
  check(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<const void*>(texts.data())), name);
  writeTextAttribute(data, "long_name", longName);
}

void Hdf5Writer::integers(const std::string& name, const std::vector<std::int64_t>& values,
                          const std::string& longName) {
  const Hdf5Handle data = createData(group_, name, H5T_NATIVE_INT64, simpleSpace({values.size()}), H5P_DEFAULT);
  check(H5Dwrite(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  writeTextAttribute(data, "long_name", longName);
}

void Hdf5Writer::numbers(const std::string& name, const double* values, const Hdf5Shape& shape,
                         const std::string& longName, const std::vector<std::string>& units) {
  const Hdf5Handle data = createData(group_, name, H5T_NATIVE_DOUBLE, simpleSpace(shape), numberProperties(shape));
  check(H5Dwrite(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  writeTextAttribute(data, "long_name", longName);
  if (units.size() == 1) {
    writeTextAttribute(data, "units", units.front());
  } else {
    writeTextsAttribute(data, "units", units);
  }
}

void Hdf5Writer::makeScale(const std::string& name, const std::string& label) {
  const Hdf5Handle data = openData(group_, name);
  check(H5DSset_scale(data, label.c_str()), name);
}

void Hdf5Writer::attachScales(const std::string& name, const std::vector<std::string>& scales) {
  const Hdf5Handle data = openData(group_, name);
  for (unsigned dimension = 0; dimension < scales.size(); ++dimension) {
    const Hdf5Handle scale = openData(group_, scales[dimension]);
    check(H5DSattach_scale(data, scale, dimension), name);
    const std::string label = scales[dimension].substr(scales[dimension].rfind('/') + 1);
    check(H5DSset_label(data, dimension, label.c_str()), name);
  }
}

// ---- Reading --------------------------------------------------------------------------------------------------------

Hdf5Reader::Hdf5Reader(hid_t parent, const std::string& name)
    : group_(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, name), name_(name) {}

bool Hdf5Reader::has(const std::string& name) const { return H5Lexists(group_, name.c_str(), H5P_DEFAULT) > 0; }

bool Hdf5Reader::hasAttribute(const std::string& name) const { return H5Aexists(group_, name.c_str()) > 0; }

double Hdf5Reader::number(const std::string& attribute) const {
  return readAttribute<double>(group_, attribute, H5T_NATIVE_DOUBLE, H5T_FLOAT);
}

std::int64_t Hdf5Reader::integer(const std::string& attribute) const {
  return readAttribute<std::int64_t>(group_, attribute, H5T_NATIVE_INT64, H5T_INTEGER);
}

std::uint64_t Hdf5Reader::natural(const std::string& attribute) const {
  return readAttribute<std::uint64_t>(group_, attribute, H5T_NATIVE_UINT64, H5T_INTEGER);
}

std::string Hdf5Reader::text(const std::string& name) const {
  const Hdf5Handle attribute = openAttribute(group_, name);
  const Hdf5Handle found(H5Aget_type(attribute), H5Tclose, name);
  checkVariableText(found, name);
  const Hdf5Handle space(H5Aget_space(attribute), H5Sclose, name);
  checkScalar(space, name);
  char* pointer = nullptr;
  check(H5Aread(attribute, textType(), static_cast<void*>(&pointer)), name);
  std::string value = pointer == nullptr ? "" : pointer;
  H5free_memory(pointer);
  return value;
}

std::vector<std::string> Hdf5Reader::attributeNames() const {
  std::vector<std::string> names;
  const auto visit = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  check(H5Aiterate2(group_, H5_INDEX_NAME, H5_ITER_INC, nullptr, visit, &names), name_);
  return names;
}

std::string Hdf5Reader::textData(const std::string& name) const {
  const std::vector<std::string> values = texts(name);
  if (values.size() != 1) throw Hdf5Error(name);
  return values.front();
}

std::vector<std::string> Hdf5Reader::texts(const std::string& name) const {
  const Hdf5Handle data = openData(group_, name);
  const Hdf5Handle found(H5Dget_type(data), H5Tclose, name);
  checkVariableText(found, name);
  std::vector<char*> texts(count(shapeOf(data, name)), nullptr);
  const Hdf5Handle type = textType();
  check(H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, static_cast<void*>(texts.data())), name);
  std::vector<std::string> values;
  for (char* text : texts) {
    values.emplace_back(text == nullptr ? "" : text);
    H5free_memory(text);
  }
  return values;
}

std::vector<std::int64_t> Hdf5Reader::integers(const std::string& name) const {
  const Hdf5Handle data = openData(group_, name);
  const Hdf5Handle found(H5Dget_type(data), H5Tclose, name);
  checkClass(found, H5T_INTEGER, name);
  std::vector<std::int64_t> values(count(shapeOf(data, name)));
  check(H5Dread(data, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

std::vector<double> Hdf5Reader::numbers(const std::string& name, Hdf5Shape& shape) const {
  const Hdf5Handle data = openData(group_, name);
  const Hdf5Handle found(H5Dget_type(data), H5Tclose, name);
  checkClass(found, H5T_FLOAT, name);
  shape = shapeOf(data, name);
  std::vector<double> values(count(shape));
  check(H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
  return values;
}

}  // namespace gamut
