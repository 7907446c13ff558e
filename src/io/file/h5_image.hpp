#pragma once

#include <hdf5.h>

#include <cstddef>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <vector>

namespace condyle::io {

/// HDF5 prints its errors unless this suppresses them.
class H5Silence {
 public:
  H5Silence();
  ~H5Silence();
  H5Silence(const H5Silence&) = delete;
  H5Silence& operator=(const H5Silence&) = delete;

 private:
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Something of HDF5's that has to be closed, unless a call of HDF5's has failed: it then frees twice what it closes. In memory nothing
/// fails but for want of it.
class H5Handle {
 public:
  H5Handle(hid_t id, herr_t (*close)(hid_t))
      : id_(id), close_(close), exceptions_(std::uncaught_exceptions()) {
    if (id < 0) throw std::bad_alloc();
  }
  ~H5Handle() {
    if (std::uncaught_exceptions() == exceptions_) close_(id_);
  }
  H5Handle(const H5Handle&) = delete;
  H5Handle& operator=(const H5Handle&) = delete;
  hid_t id() const noexcept { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
  int exceptions_;
};

/// An HDF5 file in memory, since one that fills the disk halfway must not keep the name. Without times of writing: two files
/// of one answer are the same bytes. HDF5's library takes one thread at a time. Raises std::bad_alloc, where it can before HDF5 is asked
/// for more than there is memory for.
class H5Image {
 public:
  H5Image();

  void group(const std::string& path);

  /// Doubles, in an array of one length (`columns` 0) or of rows and columns, row by row.
  void numbers(const std::string& path, const std::vector<double>& values, std::size_t rows,
               std::size_t columns);

  /// Texts in UTF-8 of variable length, without a character 0: a long one takes its own room only.
  void texts(const std::string& path, std::span<const std::string> values);

  /// A text that a data set, or a group, has beside its values.
  void attribute(const std::string& path, const std::string& name, const std::string& text);

  std::string bytes() const;

 private:
  H5Silence silence_;
  H5Handle file_;
  std::size_t size_ = 0;  ///< bytes of values so far, about
};

}  // namespace condyle::io
