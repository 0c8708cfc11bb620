// Handles and files in memory.
#include "studies/results/detail/hdf5.hpp"

#include <cstdlib>
#include <cstring>

namespace gamut {
namespace {

/// Takes a file in memory over when HDF5 closes it. (What H5Fget_file_image gives of an open one has a wrong checksum
/// in its superblock, in 1.10.8 at least.)
struct Taker {
  std::string bytes;  ///< as long as the file

  static herr_t release(void* memory, H5FD_file_image_op_t operation, void* taker) {
    auto* self = static_cast<Taker*>(taker);
    if (operation == H5FD_FILE_IMAGE_OP_FILE_CLOSE)
      self->bytes.replace(0, self->bytes.size(), static_cast<const char*>(memory), self->bytes.size());
    std::free(memory);
    return 0;
  }

  H5FD_file_image_callbacks_t callbacks() {
    return {[](std::size_t size, H5FD_file_image_op_t, void*) { return std::malloc(size); },
            [](void* to, const void* from, std::size_t size, H5FD_file_image_op_t, void*) {
              return std::memcpy(to, from, size);
            },
            [](void* memory, std::size_t size, H5FD_file_image_op_t, void*) { return std::realloc(memory, size); },
            release,
            [](void* taker) { return taker; },
            [](void*) -> herr_t { return 0; },
            this};
  }
};

}  // namespace

void checkHdf5(herr_t status, const std::string& what) {
  if (status < 0) throw Hdf5Error(what);
}

hsize_t countOf(const Hdf5Shape& shape) {
  hsize_t product = 1;
  for (const hsize_t extent : shape) product *= extent;
  return product;
}

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

std::string hdf5InMemory(hsize_t userBlock, const std::function<void(hid_t)>& fill) {
  constexpr std::size_t increment = 4096;  // of which the file is a multiple
  Taker taker;
  H5FD_file_image_callbacks_t callbacks = taker.callbacks();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "the file"),
      creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "the file");
  if (H5Pset_fapl_core(access, increment, false) < 0 || H5Pset_file_image_callbacks(access, &callbacks) < 0 ||
      H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110) < 0 || H5Pset_userblock(creation, userBlock) < 0)
    throw Hdf5Error("the file");
  {
    const Hdf5Handle file(H5Fcreate("results", H5F_ACC_TRUNC, creation, access), H5Fclose, "the file");
    fill(file);
    hsize_t size = 0;
    if (H5Fflush(file, H5F_SCOPE_GLOBAL) < 0 || H5Fget_filesize(file, &size) < 0) throw Hdf5Error("the file");
    taker.bytes.resize(size);
  }
  return std::move(taker.bytes);
}

}  // namespace gamut
