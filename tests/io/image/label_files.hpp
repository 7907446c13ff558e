#pragma once

#include <bit>
#include <cstring>

#include "support/test.hpp"

/// Label maps written in every way that the readers know, by code that shares nothing with them.

namespace condyle::test {

/// Labels and where they are: a world in LPS, mm.
struct LabelImage {
  std::array<std::int64_t, 3> size{};
  Eigen::Affine3d X_WI = Eigen::Affine3d::Identity();
  std::vector<std::vector<std::uint32_t>> layers;
};

/// Random labels among 0, 3, 75, 76 and 120, which every type holds.
LabelImage label_image(const Eigen::Affine3d& X_WI, std::size_t layers = 1);

/// Numbers as bytes of an order.
template <class T>
std::string bytes_of(T value, std::endian order) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return order == std::endian::native ? bytes : std::string(bytes.rbegin(), bytes.rend());
}

template <class T>
void put(std::string& bytes, std::size_t at, T value, std::endian order = std::endian::little) {
  bytes.replace(at, sizeof(T), bytes_of(value, order));
}

std::string gzipped(std::string_view bytes);
std::string as_zlib(std::string_view bytes);

/// One layer's values as numbers of a type of NIfTI: 2, 256, 4, 512, 8, 768, 1024, 1280, 16 or 64.
std::string voxels_as(int type, const std::vector<std::uint32_t>& values, std::endian order);

struct NiftiWriting {
  int version = 1;
  std::endian order = std::endian::little;
  int type = 4;
  bool sform = true, qform = false;
  bool is_detached = false;
  std::string extensions = {};  ///< from the four bytes behind the header on
  double slope = 0, intercept = 0;
  int units = 2;
  double unit_mm = 1;
};

/// Header and extensions of a NIfTI file; the voxels follow. The qform needs axes at right angles.
std::string nifti_header(const LabelImage& image, const NiftiWriting& how = {});
std::string nifti(const LabelImage& image, const NiftiWriting& how = {});
/// An extension of NIfTI: its bytes from esize on, padded.
std::string nifti_extension(int code, std::string text, std::endian order = std::endian::little);

struct NrrdWriting {
  std::string space = "left-posterior-superior";
  int type = 4;
  std::endian order = std::endian::little;
  bool is_gzip = false;
  std::string more_lines = {};
  std::string data_file = {};
  std::size_t layer_axis = 0;  ///< where the axis of layers stands, if there are several
};

/// The header with its empty line.
std::string nrrd_header(const LabelImage& image, const NrrdWriting& how = {});
/// The data in the order of the file's axes, compressed if asked.
std::string nrrd_data(const LabelImage& image, const NrrdWriting& how = {});
std::string nrrd(const LabelImage& image, const NrrdWriting& how = {});

struct MetaWriting {
  int type = 4;
  std::endian order = std::endian::little;
  bool is_compressed = false;
  std::string matrix_key = "TransformMatrix", offset_key = "Offset", order_key = "BinaryDataByteOrderMSB";
  std::string more_lines = {};
  std::string data_file = "LOCAL";
};

std::string meta_header(const LabelImage& image, const MetaWriting& how = {});
std::string meta_data(const LabelImage& image, const MetaWriting& how = {});
std::string meta(const LabelImage& image, const MetaWriting& how = {});

}  // namespace condyle::test
