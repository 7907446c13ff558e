#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "condyle/error.hpp"
#include "condyle/io/label_file.hpp"
#include "io/image/label_files.hpp"

namespace condyle {
namespace {

using test::put;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Message of the reader's error; "read" if there is none.
std::string label_complaint(std::string_view bytes, io::LabelFormat format) {
  try {
    io::read_labels(bytes, format, "bones");
  } catch (const FileError& error) {
    return error.what();
  }
  return "read";
}

std::string label_complaint(const std::filesystem::path& path) {
  try {
    io::read_labels(path);
  } catch (const FileError& error) {
    return error.what();
  }
  return "read";
}

std::string with_text(std::string text, std::string_view old_part, std::string_view new_part) {
  const auto at = text.find(old_part);
  EXPECT_NE(at, std::string::npos) << old_part;
  return at == std::string::npos ? text : text.replace(at, old_part.size(), new_part);
}

test::LabelImage image() {
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  X.linear().diagonal() << 0.5, 0.75, 2;
  X.translation() << -20, 30, 400;
  return test::label_image(X);
}

/// A damaged file, and what the message must be; "..." at its end stands for any rest.
struct Damage {
  std::string name, bytes, message;
};

template <class T>
std::string changed(std::string bytes, std::size_t at, T value) {
  put(bytes, at, value);
  return bytes;
}

std::vector<Damage> damaged_nifti() {
  const std::string good = test::nifti(image());
  const std::string by_qform = test::nifti(image(), {.sform = false, .qform = true});
  const std::string good_2 = test::nifti(image(), {.version = 2});
  const std::string gz = test::gzipped(good);
  const auto i16 = [&](std::size_t at, int value) {
    return changed(good, at, static_cast<std::int16_t>(value));
  };
  const auto f32 = [&](std::size_t at, double value) { return changed(good, at, static_cast<float>(value)); };
  const auto extended = [&](const std::string& extensions) {
    return test::nifti(image(), {.extensions = std::string("\1\0\0\0", 4) + extensions});
  };
  const auto named = [&](const std::string& xml) { return extended(test::nifti_extension(0, xml)); };
  std::string many = i16(40, 4);
  put<std::int16_t>(many, 48, 5);
  std::string five = i16(40, 5);
  put<std::int16_t>(five, 50, 2);
  std::string colossal = i16(42, 32767);
  put<std::int16_t>(colossal, 44, 32767);
  put<std::int16_t>(colossal, 46, 1025);
  std::string promising = i16(42, 32767);
  put<std::int16_t>(promising, 44, 32767);
  put<std::int16_t>(promising, 46, 512);
  std::string flat = good;
  for (const std::size_t at : {280, 296, 312}) flat.replace(at + 4, 4, flat.substr(at, 4));
  std::string scaled = f32(112, 0.0039);
  return {
      {"empty", "", "bones: the file is empty"},
      {"one_byte", "\x5c", "bones: the file ends within the header of 348 bytes"},
      {"half_a_header", good.substr(0, 200), "bones: the file ends within the header of 348 bytes"},
      {"half_a_header_2", good_2.substr(0, 400), "bones: the file ends within the header of 540 bytes"},
      {"other_bytes", std::string(1000, 'x'), "bones: sizeof_hdr: neither 348 nor 540: no NIfTI file"},
      {"analyze", good.substr(0, 344) + std::string(4, '\0') + good.substr(348),
       "bones: magic: neither 'n+1' nor 'ni1': no NIfTI-1 file (Analyze 7.5 is not read)"},
      {"magic_2", with_text(good_2, "n+2", "n+3"), "bones: magic: neither 'n+2' nor 'ni2': no NIfTI-2 file"},
      {"detached", with_text(good, "n+1", "ni1"), "bones: magic: the data lie in another file, '.img'"},
      {"two_dimensions", i16(40, 2), "bones: dim[0]: 2 dimensions: only images of 3 are read"},
      {"eight_dimensions", i16(40, 8), "bones: dim[0]: 8 dimensions: only images of 3 are read"},
      {"negative_dimensions", i16(40, -1), "bones: dim[0]: -1 dimensions: only images of 3 are read"},
      {"size_0", i16(44, 0), "bones: dim: a size of 0"},
      {"size_negative", i16(44, -5), "bones: dim: a size of -5"},
      {"too_many_voxels", colossal, "bones: dim: 32767 x 32767 x 1025 voxels are more than 2^40"},
      {"too_many_voxels_2", changed(good_2, 24, std::numeric_limits<std::int64_t>::max()),
       "bones: dim: 9223372036854775807 x 4 x 3 voxels are more than 2^40"},
      {"promises_too_much", promising,
       "bones: data: the file is too short for the 1099444519936 bytes that the header promises"},
      {"promises_too_much_compressed", test::gzipped(promising),
       "bones: data: the file is too short for the 1099444519936 bytes that the header promises"},
      {"several_volumes", many, "bones: dim[4]: 5 volumes: choose one of them"},
      {"five_dimensions", five, "bones: dim[5]: a size of 2 is not read"},
      {"no_volume", changed(many, 48, std::int16_t{0}), "bones: dim[4]: a size of 0"},
      {"colours", i16(70, 128), "bones: datatype: 128 (colours) is not read"},
      {"complex", i16(70, 32), "bones: datatype: 32 (complex numbers) is not read"},
      {"no_type", i16(70, 3), "bones: datatype: 3 (no type of NIfTI) is not read"},
      {"bits", i16(72, 8), "bones: bitpix: 8 instead of the 16 of datatype 4"},
      {"offset_in_header", f32(108, 348), "bones: vox_offset: 348 lies within the header of 352 bytes"},
      {"offset_nan", f32(108, nan), "bones: vox_offset: nan is no number of bytes"},
      {"offset_negative", f32(108, -352), "bones: vox_offset: -352 is no number of bytes"},
      {"offset_half", f32(108, 352.5), "bones: vox_offset: 352.5 is no number of bytes"},
      {"offset_behind", f32(108, 100000), "bones: vox_offset: 100000 lies behind the end of the file"},
      {"offset_negative_2", changed(good_2, 168, std::int64_t{-1}),
       "bones: vox_offset: -1 is no number of bytes"},
      {"cut", good.substr(0, good.size() - 1),
       "bones: data: the file is too short for the 120 bytes that the header promises"},
      {"no_orientation", i16(254, 0),
       "bones: qform_code, sform_code: both are 0: the file does not say how its axes lie in the body; "
       "state it"},
      {"units", changed(good, 123, std::uint8_t{5}), "bones: xyzt_units: 5 is no unit of length"},
      {"srow_nan", f32(280, nan), "bones: srow: places voxels at (nan, ..."},
      {"srow_far", f32(292, 2e30), "bones: srow: places voxels at (..."},
      {"srow_zero", f32(300, 0), "bones: srow: voxels have an extent of 0 mm along axis 1"},
      {"srow_flat", flat, "bones: srow: the three axes lie in one plane"},
      {"quaternion_nan", changed(by_qform, 256, std::numeric_limits<float>::quiet_NaN()),
       "bones: quatern_b, quatern_c, quatern_d: not finite"},
      {"pixdim_zero", changed(by_qform, 80, 0.0f), "bones: pixdim[1]: 0 is no extent of a voxel"},
      {"pixdim_negative", changed(by_qform, 84, -1.0f), "bones: pixdim[2]: -1 is no extent of a voxel"},
      {"pixdim_infinite", changed(by_qform, 88, std::numeric_limits<float>::infinity()),
       "bones: pixdim[3]: inf is no extent of a voxel"},
      {"slope", scaled,
       "bones: voxel (1, 0, 0): value 0.292... is no whole number (slope 0.0038..., intercept 0): a map of "
       "probabilities is no label map"},
      {"intercept", changed(scaled, 116, std::numeric_limits<float>::infinity()),
       "bones: scl_inter: inf is not finite"},
      {"negative_value", changed(good, 352 + 2 * 21, std::int16_t{-1024}),
       "bones: voxel (1, 0, 1): value -1024: labels are whole numbers from 0 to 4294967295"},
      {"large_value", changed(test::nifti(image(), {.type = 1024}), 352, std::int64_t{1} << 32),
       "bones: voxel (0, 0, 0): value 4294967296: labels are whole numbers from 0 to 4294967295"},
      {"half_value", changed(test::nifti(image(), {.type = 64}), 352 + 8 * 59, 2.5),
       "bones: voxel (4, 3, 2): value 2.5 is no whole number"},
      {"nan_value", changed(test::nifti(image(), {.type = 16}), 352, std::numeric_limits<float>::quiet_NaN()),
       "bones: voxel (0, 0, 0): value nan is no whole number"},
      {"infinite_value", changed(test::nifti(image(), {.type = 64}), 352, HUGE_VAL),
       "bones: voxel (0, 0, 0): value inf is no whole number"},
      {"gzip_cut", gz.substr(0, gz.size() / 2), "bones: the compressed data end too early, after ..."},
      {"gzip_without_checksum", gz.substr(0, gz.size() - 4),
       "bones: the compressed data end too early, after ..."},
      {"gzip_wrong_checksum", changed(gz, gz.size() - 8, ~std::uint32_t{0}),
       "bones: the compressed data are damaged after 472 bytes"},
      {"gzip_of_nothing", test::gzipped(""), "bones: the file ends within the header of 348 bytes"},
      {"gzip_with_fewer_voxels", test::gzipped(good.substr(0, good.size() - 3)),
       "bones: data: 117 bytes of the 120 that the header promises"},
      {"extension_size_0", extended(test::bytes_of(0, std::endian::little) + std::string(12, '\0')),
       "bones: extension at byte 352: a size of 0"},
      {"extension_behind_voxels", extended(test::bytes_of(4096, std::endian::little) + std::string(12, '\0')),
       "bones: extension at byte 352: a size of 4096"},
      {"names_not_closed", named("<CaretExtension><Label Key=\"1\"><![CDATA[femur]]></Label>"),
       "bones: CaretExtension: line 1: the file ends before '</CaretExtension>'"},
      {"names_crossed", named("<CaretExtension><Label Key=\"1\"></CaretExtension></Label>"),
       "bones: CaretExtension: line 1: '</CaretExtension>' closes what is not open"},
      {"names_without_key", named("<CaretExtension><Label>femur</Label></CaretExtension>"),
       "bones: CaretExtension: line 1: a Label without Key"},
      {"names_negative_key", named("<CaretExtension><Label Key=\"-1\">femur</Label></CaretExtension>"),
       "bones: CaretExtension: line 1: Key '-1' is no label"},
      {"names_twice",
       named("<CaretExtension><Label Key=\"1\">a</Label>\n<Label Key=\"1\">b</Label></CaretExtension>"),
       "bones: CaretExtension: line 2: Key 1 is given twice"},
      {"names_entity", named("<CaretExtension><Label Key=\"1\">a &bomb; b</Label></CaretExtension>"),
       "bones: CaretExtension: line 1: '&bomb; b' is no entity"},
      {"names_open_cdata", named("<CaretExtension><Label Key=\"1\"><![CDATA[femur</Label></CaretExtension>"),
       "bones: CaretExtension: line 1: a CDATA section does not end"},
  };
}

std::vector<Damage> damaged_nrrd() {
  const std::string good = test::nrrd(image());
  const std::string gz = test::nrrd(image(), {.is_gzip = true});
  const std::string layered = test::nrrd(test::label_image(image().X_WI, 3));
  const std::string directions = "(0.5,0,0) (0,0.75,0) (0,0,2)";
  const auto more = [&](const std::string& lines) { return test::nrrd(image(), {.more_lines = lines}); };
  return {
      {"empty", "", "bones: the file is empty"},
      {"other_bytes", "PNG\n\n", "bones: does not begin with 'NRRD000': no NRRD file"},
      {"version", with_text(good, "NRRD0004", "NRRD0009"),
       "bones: 'NRRD0009': versions 1 to 5 of NRRD are read"},
      {"old_version", with_text(good, "NRRD0004", "NRRD00.01"),
       "bones: 'NRRD00.01': versions 1 to 5 of NRRD are read"},
      {"only_magic", "NRRD0004\n\n", "bones: dimension: is missing"},
      {"unknown_field", more("spacing: 1 2 3\n"), "bones: line 12: 'spacing: 1 2 3' is no field of NRRD"},
      {"control_characters", more("\x1b[31m\n"), "bones: line 12: '?[31m' is no field of NRRD"},
      {"field_twice", more("type: short\n"), "bones: line 12: the field 'type' is given twice"},
      {"key_twice", more("a:=1\na:=2\n"), "bones: line 13: the key 'a' is given twice"},
      {"dimension_2", with_text(good, "dimension: 3", "dimension: 2"),
       "bones: dimension: 2: 3, and 4 with an axis of layers, are read"},
      {"dimension_16", with_text(good, "dimension: 3", "dimension: 16"),
       "bones: dimension: 16: 3, and 4 with an axis of layers, are read"},
      {"dimension_text", with_text(good, "dimension: 3", "dimension: three"),
       "bones: dimension: 'three' is no whole number"},
      {"sizes_missing", with_text(good, "sizes: 5 4 3\n", ""), "bones: sizes: is missing"},
      {"sizes_two", with_text(good, "sizes: 5 4 3", "sizes: 5 4"), "bones: sizes: has 2 values instead of 3"},
      {"sizes_zero", with_text(good, "sizes: 5 4 3", "sizes: 5 0 3"), "bones: sizes: a size of 0"},
      {"sizes_negative", with_text(good, "sizes: 5 4 3", "sizes: 5 4 -3"), "bones: sizes: a size of -3"},
      {"sizes_text", with_text(good, "sizes: 5 4 3", "sizes: 5 4 x"), "bones: sizes: 'x' is no whole number"},
      {"sizes_beyond_64_bits", with_text(good, "sizes: 5 4 3", "sizes: 5 4 18446744073709551619"),
       "bones: sizes: '18446744073709551619' is no whole number"},
      {"sizes_colossal", with_text(good, "sizes: 5 4 3", "sizes: 4294967296 4294967296 2"),
       "bones: sizes: 4294967296 x 4294967296 x 2 voxels are more than 2^40"},
      {"promises_too_much", with_text(good, "sizes: 5 4 3", "sizes: 8192 8192 8192"),
       "bones: data: the file is too short for the 1099511627776 bytes that the header promises"},
      {"promises_too_much_compressed", with_text(gz, "sizes: 5 4 3", "sizes: 8192 8192 8192"),
       "bones: data: the file is too short for the 1099511627776 bytes that the header promises"},
      {"layers_none", with_text(layered, "sizes: 3 5 4 3", "sizes: 0 5 4 3"),
       "bones: sizes: 0 layers: 1 to 1024 are read"},
      {"layers_many", with_text(layered, "sizes: 3 5 4 3", "sizes: 5000 5 4 3"),
       "bones: sizes: 5000 layers: 1 to 1024 are read"},
      {"type_missing", with_text(good, "type: short\n", ""), "bones: type: is missing"},
      {"type_block", with_text(good, "type: short", "type: block"), "bones: type: 'block' is not read"},
      {"encoding_missing", with_text(good, "encoding: raw\n", ""), "bones: encoding: is missing"},
      {"encoding_ascii", with_text(good, "encoding: raw", "encoding: ascii"),
       "bones: encoding: 'ascii' is not read: 'raw' and 'gzip' are"},
      {"encoding_bzip2", with_text(good, "encoding: raw", "encoding: bz2"),
       "bones: encoding: 'bz2' is not read: 'raw' and 'gzip' are"},
      {"endian_missing", with_text(good, "endian: little\n", ""), "bones: endian: is missing"},
      {"endian_middle", with_text(good, "endian: little", "endian: middle"),
       "bones: endian: 'middle' is neither 'little' nor 'big'"},
      {"space_unknown", with_text(good, "left-posterior-superior", "left-posterior-inferior"),
       "bones: space: 'left-posterior-inferior' is not read"},
      {"space_in_time", with_text(good, "left-posterior-superior", "LPST"),
       "bones: space: 'lpst' is not read"},
      {"space_missing", with_text(good, "space: left-posterior-superior\n", ""),
       "bones: space: missing or no named one: the file does not say how its axes lie in the body; state it"},
      {"space_only_handed", with_text(good, "left-posterior-superior", "3D-right-handed"),
       "bones: space: missing or no named one: the file does not say how its axes lie in the body; state it"},
      {"only_spacings", with_text(good, "space directions: " + directions, "spacings: 1 1 1"),
       "bones: space directions: missing or no named one: the file does not say how its axes lie in the "
       "body; "
       "state it"},
      {"no_axes", with_text(good, "space directions: " + directions + "\n", ""),
       "bones: spacings: is missing"},
      {"space_units", more("space units: \"mm\" \"mm\" \"cm\"\n"),
       "bones: space units: are not three times the same unit"},
      {"space_units_unknown", more("space units: \"s\" \"s\" \"s\"\n"),
       "bones: space units: '\"s\"' is no unit of length that is read"},
      {"directions_two", with_text(good, directions, "(0.5,0,0) (0,0.75,0)"),
       "bones: space directions: '' is no vector"},
      {"directions_four", with_text(good, directions, directions + " (1,0,0)"),
       "bones: space directions: are more than the 3 axes"},
      {"directions_with_none", with_text(good, directions, "none (0,0.75,0) (0,0,2)"),
       "bones: space directions: name 2 axes of space instead of 3"},
      {"directions_without_none", with_text(layered, "none " + directions, directions + " (1,1,1)"),
       "bones: space directions: name 4 axes of space instead of 3"},
      {"directions_of_two", with_text(good, directions, "(0.5,0) (0,0.75) (0,0)"),
       "bones: space directions: a vector has another number of components than 3"},
      {"directions_of_four", with_text(good, directions, "(0.5,0,0,0) (0,0.75,0,0) (0,0,2,0)"),
       "bones: space directions: a vector has another number of components than 3"},
      {"directions_open", with_text(good, directions, "(0.5,0,0 (0,0.75,0 (0,0,2"),
       "bones: space directions: '(0.5,0,0 (0,0.75,0 (0,0,2' is no vector"},
      {"directions_text", with_text(good, directions, "(0.5,0,x) (0,0.75,0) (0,0,2)"),
       "bones: space directions: 'x' is no number"},
      {"directions_nan", with_text(good, directions, "(nan,0,0) (0,0.75,0) (0,0,2)"),
       "bones: space directions: places voxels at (nan, ..."},
      {"directions_flat", with_text(good, directions, "(0.5,0,0) (0,0.75,0) (1,1,0)"),
       "bones: space directions: the three axes lie in one plane"},
      {"directions_zero", with_text(good, directions, "(0.5,0,0) (0,0.75,0) (0,0,0)"),
       "bones: space directions: voxels have an extent of 0 mm along axis 2"},
      {"origin_text", with_text(good, "space origin: (-20,30,400)", "space origin: -20 30 400"),
       "bones: space origin: '-20 30 400' is no vector"},
      {"origin_none", with_text(good, "space origin: (-20,30,400)", "space origin: none"),
       "bones: space origin: is no single vector"},
      {"origin_infinite", with_text(good, "space origin: (-20,30,400)", "space origin: (inf,30,400)"),
       "bones: space directions: places voxels at (inf, 30, 400) mm, which is not finite or beyond 1e30"},
      {"kinds_too_few", with_text(good, "kinds: domain domain domain", "kinds: domain"),
       "bones: kinds: are 1 instead of 3"},
      {"kinds_colours", with_text(layered, "kinds: list", "kinds: RGB-color"),
       "bones: kinds: 'rgb-color' is no axis of layers: 'list' and 'vector' are"},
      {"line_skip", more("line skip: 1000\n"), "bones: line skip: the file of the data has fewer lines"},
      {"line_skip_negative", more("line skip: -1\n"), "bones: line skip: -1 is no number of lines"},
      {"byte_skip", more("byte skip: 100000\n"), "bones: byte skip: the data have fewer than 100000 bytes"},
      {"byte_skip_negative", more("byte skip: -2\n"), "bones: byte skip: -2 is no number of bytes"},
      {"byte_skip_compressed", test::nrrd(image(), {.is_gzip = true, .more_lines = "byte skip: -1\n"}),
       "bones: byte skip: -1 is for raw data only"},
      {"data_file", more("data file: x.raw\n"), "bones: data file: the data lie in another file, 'x.raw'"},
      {"data_files_listed", more("data file: LIST\na.raw\nb.raw\n"),
       "bones: data file: LIST: data in several files are not read"},
      {"data_files_numbered", more("data file: a%03d.raw 1 3 1\n"),
       "bones: data file: 'a%03d.raw 1 3 1': data in several files are not read"},
      {"segment_layer", more("Segment0_LabelValue:=1\nSegment0_Layer:=1\n"),
       "bones: Segment0_Layer: layer 1 of an image with 1"},
      {"segment_label", more("Segment0_LabelValue:=-1\n"),
       "bones: 'Segment0_LabelValue': '-1' is no whole number"},
      {"cut", good.substr(0, good.size() - 1),
       "bones: data: the file is too short for the 120 bytes that the header promises"},
      {"gzip_damaged", gz.substr(0, gz.size() - 30) + std::string(30, 'x'), "bones: the compressed data ..."},
  };
}

std::vector<Damage> damaged_metaimage() {
  const std::string good = test::meta(image());
  const std::string compressed = test::meta(image(), {.is_compressed = true});
  const auto more = [&](const std::string& lines) { return test::meta(image(), {.more_lines = lines}); };
  const std::string matrix = "TransformMatrix = 1 0 0 0 1 0 0 0 1";
  return {
      {"empty", "", "bones: the file is empty"},
      {"other_bytes", "hello", "bones: line 1: 'hello' is no 'key = value'"},
      {"no_data_file", with_text(good, "ElementDataFile = LOCAL\n", ""), "bones: line 13: ..."},
      {"ends_in_header", good.substr(0, good.find("CompressedData")), "bones: ElementDataFile: is missing"},
      {"key_twice", more("NDims = 3\n"), "bones: line 12: the key 'NDims' is given twice"},
      {"alias_too", more("Origin = 0 0 0\n"), "bones: Origin: Offset says the same already"},
      {"object_type", with_text(good, "= Image", "= Tube"), "bones: ObjectType: 'Tube' is no Image"},
      {"dimensions_missing", with_text(good, "NDims = 3\n", ""), "bones: NDims: is missing"},
      {"dimensions_2", with_text(good, "NDims = 3", "NDims = 2"),
       "bones: NDims: 2 dimensions: only images of 3 are read"},
      {"text_data", with_text(good, "BinaryData = True", "BinaryData = False"),
       "bones: BinaryData: voxels written as text are not read"},
      {"neither_true_nor_false", with_text(good, "BinaryData = True", "BinaryData = Yes"),
       "bones: BinaryData: 'Yes' is neither True nor False"},
      {"channels", more("ElementNumberOfChannels = 3\n"),
       "bones: ElementNumberOfChannels: several values in a voxel are not read"},
      {"slope", more("ElementToIntensityFunctionSlope = 0.5\n"),
       "bones: ElementToIntensityFunctionSlope: a slope other than 1 is not read"},
      {"sizes_missing", with_text(good, "DimSize = 5 4 3\n", ""), "bones: DimSize: is missing"},
      {"sizes_four", with_text(good, "DimSize = 5 4 3", "DimSize = 5 4 3 1"),
       "bones: DimSize: has 4 values instead of 3"},
      {"sizes_zero", with_text(good, "DimSize = 5 4 3", "DimSize = 0 4 3"), "bones: DimSize: a size of 0"},
      {"sizes_half", with_text(good, "DimSize = 5 4 3", "DimSize = 5 4.5 3"),
       "bones: DimSize: '4.5' is no whole number"},
      {"promises_too_much", with_text(compressed, "DimSize = 5 4 3", "DimSize = 8192 8192 8192"),
       "bones: data: the file is too short for the 1099511627776 bytes that the header promises"},
      {"type_missing", with_text(good, "ElementType = MET_SHORT\n", ""), "bones: ElementType: is missing"},
      {"type_array", with_text(good, "MET_SHORT", "MET_SHORT_ARRAY"),
       "bones: ElementType: 'MET_SHORT_ARRAY' is not read"},
      {"type_long", with_text(good, "MET_SHORT", "MET_LONG"),
       "bones: ElementType: MET_LONG has 4 bytes in some programs and 8 in others: is not read"},
      {"spacing_missing", with_text(good, "ElementSpacing = 0.5 0.75 2\n", ""),
       "bones: ElementSpacing: is missing"},
      {"spacing_zero", with_text(good, "ElementSpacing = 0.5 0.75 2", "ElementSpacing = 0.5 0 2"),
       "bones: TransformMatrix: voxels have an extent of 0 mm along axis 1"},
      {"matrix_of_eight", with_text(good, matrix, "TransformMatrix = 1 0 0 0 1 0 0 0"),
       "bones: TransformMatrix: has 8 values instead of 9"},
      {"matrix_text", with_text(good, matrix, "TransformMatrix = 1 0 0 0 1 0 0 0 one"),
       "bones: TransformMatrix: 'one' is no number"},
      {"matrix_flat", with_text(good, matrix, "TransformMatrix = 1 0 0 0 1 0 1 1 0"),
       "bones: TransformMatrix: the three axes lie in one plane"},
      {"matrix_infinite", with_text(good, matrix, "TransformMatrix = inf 0 0 0 1 0 0 0 1"),
       "bones: TransformMatrix: places voxels at (..."},
      {"units", more("DistanceUnits = inch\n"),
       "bones: DistanceUnits: 'inch' is no unit of length that is read"},
      {"header_size", more("HeaderSize = 100000\n"),
       "bones: HeaderSize: the file holds fewer than 100000 bytes"},
      {"header_size_negative", more("HeaderSize = -2\n"), "bones: HeaderSize: -2 is no number of bytes"},
      {"header_size_compressed",
       test::meta(image(), {.is_compressed = true, .more_lines = "HeaderSize = -1\n"}),
       "bones: HeaderSize: -1 is for data without compression"},
      {"compressed_size",
       test::meta(image(), {.is_compressed = true, .more_lines = "CompressedDataSize = 100000\n"}),
       "bones: CompressedDataSize: the file holds fewer than 100000 bytes of data"},
      {"data_file", with_text(good, "LOCAL", "x.raw"),
       "bones: ElementDataFile: the data lie in another file, 'x.raw'"},
      {"data_files_listed", with_text(good, "LOCAL", "LIST"),
       "bones: ElementDataFile: 'LIST': data in several files are not read"},
      {"data_files_numbered", with_text(good, "LOCAL", "a%03d.raw 1 3 1"),
       "bones: ElementDataFile: 'a%03d.raw 1 3 1': data in several files are not read"},
      {"cut", good.substr(0, good.size() - 1),
       "bones: data: the file is too short for the 120 bytes that the header promises"},
      {"not_compressed", with_text(good, "CompressedData = False", "CompressedData = True"),
       "bones: the compressed data ..."},
      {"compressed_cut", compressed.substr(0, compressed.size() - 3),
       "bones: the compressed data end too early, after ..."},
  };
}

/// Parts of the expected text between "..." must follow each other in the message, the first at its start.
bool is_like(std::string_view message, std::string_view expected) {
  const bool is_whole = expected.find("...") == std::string_view::npos;
  if (is_whole) return message == expected;
  for (bool is_first = true; !expected.empty(); is_first = false) {
    const auto end = expected.find("...");
    const auto part = expected.substr(0, end);
    const auto at = message.find(part);
    if (at == std::string_view::npos || (is_first && at != 0)) return false;
    message.remove_prefix(at + part.size());
    expected = end == std::string_view::npos ? "" : expected.substr(end + 3);
  }
  return true;
}

void expect_one_line_for_each(const std::vector<Damage>& damages, io::LabelFormat format) {
  for (const auto& damage : damages) {
    const auto message = label_complaint(damage.bytes, format);
    EXPECT_TRUE(is_like(message, damage.message))
        << damage.name << ": " << message << "\ninstead of " << damage.message;
    EXPECT_TRUE(message.starts_with("bones: ")) << damage.name << ": " << message;
    EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }))
        << damage.name << ": " << message;
  }
}

TEST(BadNiftiFile, EndsInOneLine) {
  expect_one_line_for_each(damaged_nifti(), io::LabelFormat::nifti);
}

TEST(BadNrrdFile, EndsInOneLine) {
  expect_one_line_for_each(damaged_nrrd(), io::LabelFormat::nrrd);
}

TEST(BadMetaImageFile, EndsInOneLine) {
  expect_one_line_for_each(damaged_metaimage(), io::LabelFormat::metaimage);
}

TEST(BadLabelFile, WithANumberThatIsNotFiniteAnywhereInItsAffineIsRefused) {
  constexpr float not_finite[] = {std::numeric_limits<float>::quiet_NaN(),
                                  std::numeric_limits<float>::infinity()};
  for (const float value : not_finite)
    for (std::size_t at = 280; at < 328; at += 4) {
      const auto message = label_complaint(changed(test::nifti(image()), at, value), io::LabelFormat::nifti);
      EXPECT_TRUE(message.starts_with("bones: srow: places voxels at (")) << at << ": " << message;
    }
}

TEST(BadLabelFile, CutAnywhereEndsInOneLine) {
  const std::vector<std::pair<std::string, io::LabelFormat>> files = {
      {test::nifti(image()), io::LabelFormat::nifti},
      {test::gzipped(test::nifti(image(), {.version = 2})), io::LabelFormat::nifti},
      {test::nrrd(image(), {.is_gzip = true}), io::LabelFormat::nrrd},
      {test::meta(image(), {.is_compressed = true}), io::LabelFormat::metaimage}};
  for (const auto& [bytes, format] : files) {
    EXPECT_EQ(label_complaint(bytes, format), "read");
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      const auto message = label_complaint(bytes.substr(0, size), format);
      EXPECT_TRUE(message.starts_with("bones: ")) << size << " of " << bytes.size() << ": " << message;
    }
  }
}

TEST(BadLabelFile, MissingAFolderUnknownOrWithoutItsDataIsNamed) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "inside.nii");
  const auto missing = folder / "bones.nii", inside = folder / "inside.nii";
  EXPECT_EQ(label_complaint(missing), missing.string() + ": no such file");
  EXPECT_EQ(label_complaint(inside), inside.string() + ": is a folder, not a file");
  const auto unknown = folder.file("bones.tif", "x");
  EXPECT_EQ(label_complaint(unknown),
            unknown.string() +
                ": unknown extension '.tif': label maps in .nii, .nii.gz, .hdr, .nrrd, .nhdr, .mha and .mhd "
                "are read");
  const auto header = folder.file("bones.hdr", test::nifti_header(image(), {.is_detached = true}));
  EXPECT_EQ(label_complaint(header),
            header.string() + ": magic: 'bones.img' cannot be opened or is no regular file");
  const auto nhdr = folder.file("bones.nhdr", test::nrrd_header(image(), {.data_file = "/etc/passwd"}));
  EXPECT_EQ(label_complaint(nhdr),
            nhdr.string() + ": data file: '/etc/passwd' lies outside the folder of the header");
  const auto mhd = folder.file("bones.mhd", test::meta_header(image(), {.data_file = "../../x.raw"}));
  EXPECT_EQ(label_complaint(mhd),
            mhd.string() + ": ElementDataFile: '../../x.raw' lies outside the folder of the header");
}

TEST(BadLabelFile, ThatInflatesToMoreThanItPromisesIsReadNoFurther) {
  const auto bomb = test::nifti(image()) + std::string(std::size_t{1} << 26, '\0');
  const auto map = io::read_labels(test::gzipped(bomb), io::LabelFormat::nifti, "bones");
  ASSERT_EQ(map.notes.size(), 1u);
  EXPECT_EQ(map.notes[0].code, io::LabelNoteCode::more_bytes);
}

TEST(BadLabelFile, WithAnEndlessHeaderIsRefused) {
  EXPECT_EQ(label_complaint("NRRD0004\n# " + std::string(std::size_t{20} << 20, 'x'), io::LabelFormat::nrrd),
            "bones: the header is longer than 16 MB");
  EXPECT_EQ(label_complaint(std::string(std::size_t{20} << 20, 'x'), io::LabelFormat::metaimage),
            "bones: the header is longer than 16 MB");
}

}  // namespace
}  // namespace condyle
