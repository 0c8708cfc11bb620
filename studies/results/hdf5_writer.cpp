// Writing: the C interface's steps from spaces, types and properties to data sets and attributes.
#include <hdf5_hl.h>

#include <algorithm>

#include "studies/results/detail/hdf5.hpp"

namespace gamut {
namespace {

/// Data up to this size (bytes) lie in their header, of which the library allows 64 KiB.
constexpr hsize_t compactSize = 4096;
/// Of a text that cannot be cut into chunks.
constexpr hsize_t compactTextSize = 60000;
constexpr hsize_t chunkSize = hsize_t{1} << 19;

/// UTF-8, filled up with zero bytes.
Hdf5Handle textType(std::size_t size) {
  Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "text type");
  checkHdf5(H5Tset_size(type, std::max<std::size_t>(size, 1)), "text type");
  checkHdf5(H5Tset_cset(type, H5T_CSET_UTF8), "text type");
  checkHdf5(H5Tset_strpad(type, H5T_STR_NULLPAD), "text type");
  return type;
}

Hdf5Handle space(const Hdf5Shape& shape, const std::string& name) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, name};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose, name};
}

void writeAttribute(hid_t object, const std::string& name, hid_t type, const void* value) {
  const Hdf5Handle attribute(H5Acreate2(object, name.c_str(), type, space({}, name), H5P_DEFAULT, H5P_DEFAULT),
                             H5Aclose, name);
  checkHdf5(H5Awrite(attribute, type, value), name);
}

void writeTextAttribute(hid_t object, const std::string& name, const std::string& value) {
  writeAttribute(object, name, textType(value.size()), value.c_str());
}

/// Small data sets lie in their header; larger ones in chunks with a checksum each, shuffled and compressed unless they
/// are noise.
Hdf5Handle layout(const Hdf5Shape& shape, std::size_t elementSize, bool isNoise) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
  const hsize_t size = countOf(shape) * elementSize;
  if (size <= (shape.empty() ? compactTextSize : compactSize)) {
    checkHdf5(H5Pset_layout(properties, H5D_COMPACT), "layout");
    return properties;
  }
  if (shape.empty()) return properties;
  Hdf5Shape chunk = shape;
  for (hsize_t& extent : chunk)
    while (countOf(chunk) * elementSize > chunkSize && extent > 1) extent = (extent + 1) / 2;
  checkHdf5(H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()), "chunks");
  if (!isNoise) {
    checkHdf5(H5Pset_shuffle(properties), "shuffle");
    checkHdf5(H5Pset_deflate(properties, 6), "deflate");
  }
  checkHdf5(H5Pset_fletcher32(properties), "checksum");
  return properties;
}

}  // namespace

Hdf5Writer::Hdf5Writer(hid_t file) : group_(H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose, "/") {}

Hdf5Writer::Hdf5Writer(hid_t parent, const std::string& name)
    : group_(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose, name) {}

void Hdf5Writer::attribute(const std::string& name, double value) {
  writeAttribute(group_, name, H5T_NATIVE_DOUBLE, &value);
}

void Hdf5Writer::attribute(const std::string& name, std::int64_t value) {
  writeAttribute(group_, name, H5T_NATIVE_INT64, &value);
}

void Hdf5Writer::attribute(const std::string& name, std::uint64_t value) {
  writeAttribute(group_, name, H5T_NATIVE_UINT64, &value);
}

void Hdf5Writer::attribute(const std::string& name, const std::string& value) {
  writeTextAttribute(group_, name, value);
}

void Hdf5Writer::data(const std::string& name, hid_t type, const Hdf5Shape& shape, const void* values,
                      const std::string& longName, bool isNoise) {
  const Hdf5Handle data(H5Dcreate2(group_, name.c_str(), type, space(shape, name), H5P_DEFAULT,
                                   layout(shape, H5Tget_size(type), isNoise), H5P_DEFAULT),
                        H5Dclose, name);
  checkHdf5(H5Dwrite(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), name);
  writeTextAttribute(data, "long_name", longName);
  // netCDF's word for how texts are to be read.
  if (H5Tget_class(type) == H5T_STRING) writeTextAttribute(data, "_Encoding", "utf-8");
}

void Hdf5Writer::text(const std::string& name, const std::string& value, const std::string& longName) {
  data(name, textType(value.size()), {}, value.c_str(), longName);
}

void Hdf5Writer::texts(const std::string& name, const std::vector<std::string>& values, const std::string& longName) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string table(values.size() * length, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) values[i].copy(table.data() + i * length, length);
  data(name, textType(length), {values.size()}, table.data(), longName);
}

void Hdf5Writer::integers(const std::string& name, const std::vector<std::int64_t>& values,
                          const std::string& longName) {
  data(name, H5T_NATIVE_INT64, {values.size()}, values.data(), longName);
}

void Hdf5Writer::numbers(const std::string& name, const double* values, const Hdf5Shape& shape,
                         const std::string& longName, const std::string& units, bool isNoise) {
  data(name, H5T_NATIVE_DOUBLE, shape, values, longName, isNoise);
  if (units.empty()) return;
  const Hdf5Handle data(H5Dopen2(group_, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  writeTextAttribute(data, "units", units);
}

void Hdf5Writer::makeScale(const std::string& name, const std::string& label) {
  const Hdf5Handle data(H5Dopen2(group_, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  checkHdf5(H5DSset_scale(data, label.c_str()), name);
}

void Hdf5Writer::attachScales(const std::string& name, const std::vector<std::string>& scales) {
  const Hdf5Handle data(H5Dopen2(group_, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  for (unsigned dimension = 0; dimension < scales.size(); ++dimension) {
    const Hdf5Handle scale(H5Dopen2(group_, scales[dimension].c_str(), H5P_DEFAULT), H5Dclose, name);
    checkHdf5(H5DSattach_scale(data, scale, dimension), name);
    const std::string label = scales[dimension].substr(scales[dimension].rfind('/') + 1);
    checkHdf5(H5DSset_label(data, dimension, label.c_str()), name);
  }
}

}  // namespace gamut
