#include "io/file/h5_image.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cassert>
#include <new>

#include "condyle/version.hpp"

namespace condyle::io {
namespace {

void require(bool done) {
  if (!done) throw std::bad_alloc();
}

/// HDF5 does not survive an allocation that fails: it frees twice and reads through null pointers. So the memory that it may need for
/// this many bytes of values is taken and given back before.
void require_memory(std::size_t values) {
  // Caches, the step by which the image grows, and heaps: where one cannot grow, each further one takes a megabyte at least.
  constexpr std::size_t beside = std::size_t{32} << 20;
  // The image may move as it grows, and a text has a length and a place beside it.
  const std::size_t bytes = beside + 3 * values;
  // By the system's own call: an allocator that checks itself would fill all of it.
  void* const block = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (block == MAP_FAILED) throw std::bad_alloc();
  ::munmap(block, bytes);
}

hid_t created_in_memory() {
  constexpr std::size_t step = 1 << 20;  // bytes: memory grows by so much
  const H5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  require(H5Pset_fapl_core(access.id(), step, false) >= 0);
  return H5Fcreate("in_memory.h5", H5F_ACC_TRUNC, H5P_DEFAULT,
                   access.id());  // in memory only: no such file is made
}

/// The time of writing would make two files of one answer differ.
void leave_out_times(const H5Handle& properties) {
  require(H5Pset_obj_track_times(properties.id(), false) >= 0);
}

void write_array(hid_t file, const std::string& path, hid_t stored, hid_t given, const H5Handle& space,
                 const void* values) {
  const H5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  leave_out_times(properties);
  const H5Handle set(
      H5Dcreate2(file, path.c_str(), stored, space.id(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
      H5Dclose);
  require(H5Dwrite(set.id(), given, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0);
}

/// UTF-8 texts of this length, which is above 0, or H5T_VARIABLE.
H5Handle text_type(std::size_t longest) {
  return {[&] {
            const hid_t type = H5Tcopy(H5T_C_S1);
            require(H5Tset_size(type, longest) >= 0);
            require(H5Tset_strpad(type, longest == H5T_VARIABLE ? H5T_STR_NULLTERM : H5T_STR_NULLPAD) >= 0);
            require(H5Tset_cset(type, H5T_CSET_UTF8) >= 0);
            return type;
          }(),
          H5Tclose};
}

}  // namespace

H5Silence::H5Silence() {
  // At the end of a program it would close what is left open, which is nothing on a disk, and crash where an allocation has failed.
  H5dont_atexit();
  require_memory(0);  // the first call makes what HDF5 has of its own
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

H5Silence::~H5Silence() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

H5Image::H5Image() : file_(created_in_memory(), H5Fclose) {
  // The first thing in the file: who may replace it looks near the beginning.
  attribute("/", "condyle_version", std::string(version));
}

void H5Image::group(const std::string& path) {
  require_memory(size_);
  const H5Handle properties(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  leave_out_times(properties);
  const H5Handle made(H5Gcreate2(file_.id(), path.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT),
                      H5Gclose);
}

void H5Image::numbers(const std::string& path, const std::vector<double>& values, std::size_t rows,
                      std::size_t columns) {
  assert(values.size() == rows * std::max<std::size_t>(columns, 1));
  size_ += sizeof(double) * values.size();
  require_memory(size_);
  const hsize_t lengths[2] = {rows, columns};
  const H5Handle space(H5Screate_simple(columns == 0 ? 1 : 2, lengths, nullptr), H5Sclose);
  write_array(file_.id(), path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, values.data());
}

void H5Image::texts(const std::string& path, std::span<const std::string> values) {
  std::vector<const char*> texts;
  for (const std::string& value : values) {
    texts.push_back(value.c_str());
    size_ += value.size() + 64;
  }
  require_memory(size_);
  const hsize_t length = values.size();
  const H5Handle space(H5Screate_simple(1, &length, nullptr), H5Sclose);
  const H5Handle type = text_type(H5T_VARIABLE);
  write_array(file_.id(), path, type.id(), type.id(), space, texts.data());
}

void H5Image::attribute(const std::string& path, const std::string& name, const std::string& text) {
  size_ += text.size();
  require_memory(size_);
  const H5Handle set(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT), H5Oclose);
  const H5Handle type = text_type(std::max<std::size_t>(text.size(), 1)),
                 space(H5Screate(H5S_SCALAR), H5Sclose);
  const H5Handle made(H5Acreate2(set.id(), name.c_str(), type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                      H5Aclose);
  require(H5Awrite(made.id(), type.id(), text.empty() ? "\0" : text.data()) >= 0);
}

std::string H5Image::bytes() const {
  require_memory(size_);
  require(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL) >= 0);
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
  require(size >= 0);
  std::string image(static_cast<std::size_t>(size), '\0');
  require(H5Fget_file_image(file_.id(), image.data(), image.size()) == size);
  return image;
}

}  // namespace condyle::io
