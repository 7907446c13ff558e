#include "condyle/io/label_file.hpp"
#include "io/image/label_files.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using test::put;
using test::replaced;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Message of the reader's error; "accepted" if there is none.
std::string label_complaint(std::string_view bytes, io::LabelFormat format) {
  return test::complaint_of<FileError>([&] { io::read_labels(bytes, format, "bones"); });
}

std::string label_complaint(const std::filesystem::path& path) {
  return test::complaint_of<FileError>([&] { io::read_labels(path); });
}

test::LabelImage image() {
  Eigen::Affine3d X = Eigen::Affine3d::Identity();
  X.linear().diagonal() << 0.5, 0.75, 2;
  X.translation() << -20, 30, 400;
  return test::label_image(X);
}

template <class T>
std::string changed(std::string bytes, std::size_t at, T value) {
  put(bytes, at, value);
  return bytes;
}

std::vector<test::Refusal> damaged_nifti() {
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
      {"", "the file is empty"},
      {"\x5c", "the file ends within the header of 348 bytes"},
      {good.substr(0, 200), "the file ends within the header of 348 bytes"},
      {good_2.substr(0, 400), "the file ends within the header of 540 bytes"},
      {std::string(1000, 'x'), "sizeof_hdr: neither 348 nor 540: no NIfTI file"},
      {good.substr(0, 344) + std::string(4, '\0') + good.substr(348),
       "magic: neither 'n+1' nor 'ni1': no NIfTI-1 file (Analyze 7.5 is not read)"},
      {replaced(good_2, "n+2", "n+3"), "magic: neither 'n+2' nor 'ni2': no NIfTI-2 file"},
      {replaced(good, "n+1", "ni1"), "magic: the data lie in another file, '.img'"},
      {i16(40, 2), "dim[0]: 2 dimensions: only images of 3 are read"},
      {i16(40, 8), "dim[0]: 8 dimensions: only images of 3 are read"},
      {i16(40, -1), "dim[0]: -1 dimensions: only images of 3 are read"},
      {i16(44, 0), "dim: a size of 0"},
      {i16(44, -5), "dim: a size of -5"},
      {colossal, "dim: 32767 x 32767 x 1025 voxels are more than 2^40"},
      {changed(good_2, 24, std::numeric_limits<std::int64_t>::max()),
       "dim: 9223372036854775807 x 4 x 3 voxels are more than 2^40"},
      {promising, "data: the file is too short for the 1099444519936 bytes that the header promises"},
      {test::gzipped(promising),
       "data: the file is too short for the 1099444519936 bytes that the header promises"},
      {many, "dim[4]: 5 volumes: choose one of them"},
      {five, "dim[5]: a size of 2 is not read"},
      {changed(many, 48, std::int16_t{0}), "dim[4]: a size of 0"},
      {i16(70, 128), "datatype: 128 (colours) is not read"},
      {i16(70, 32), "datatype: 32 (complex numbers) is not read"},
      {i16(70, 3), "datatype: 3 (no type of NIfTI) is not read"},
      {i16(72, 8), "bitpix: 8 instead of the 16 of datatype 4"},
      {f32(108, 348), "vox_offset: 348 lies within the header of 352 bytes"},
      {f32(108, nan), "vox_offset: nan is no number of bytes"},
      {f32(108, -352), "vox_offset: -352 is no number of bytes"},
      {f32(108, 352.5), "vox_offset: 352.5 is no number of bytes"},
      {f32(108, 100000), "vox_offset: 100000 lies behind the end of the file"},
      {changed(good_2, 168, std::int64_t{-1}), "vox_offset: -1 is no number of bytes"},
      {good.substr(0, good.size() - 1),
       "data: the file is too short for the 120 bytes that the header promises"},
      {i16(254, 0),
       "qform_code, sform_code: both are 0: the file does not say how its axes lie in the body; "
       "state it"},
      {changed(good, 123, std::uint8_t{5}), "xyzt_units: 5 is no unit of length"},
      {f32(280, nan), "srow: places voxels at (nan, ..."},
      {f32(292, 2e30), "srow: places voxels at (..."},
      {f32(300, 0), "srow: voxels have an extent of 0 mm along axis 1"},
      {flat, "srow: the three axes lie in one plane"},
      {changed(by_qform, 256, std::numeric_limits<float>::quiet_NaN()),
       "quatern_b, quatern_c, quatern_d: not finite"},
      {changed(by_qform, 80, 0.0f), "pixdim[1]: 0 is no extent of a voxel"},
      {changed(by_qform, 84, -1.0f), "pixdim[2]: -1 is no extent of a voxel"},
      {changed(by_qform, 88, std::numeric_limits<float>::infinity()),
       "pixdim[3]: inf is no extent of a voxel"},
      {scaled,
       "voxel (1, 0, 0): value 0.292... is no whole number (slope 0.0038..., intercept 0): a map of "
       "probabilities is no label map"},
      {changed(scaled, 116, std::numeric_limits<float>::infinity()), "scl_inter: inf is not finite"},
      {changed(good, 352 + 2 * 21, std::int16_t{-1024}),
       "voxel (1, 0, 1): value -1024: labels are whole numbers from 0 to 4294967295"},
      {changed(test::nifti(image(), {.type = 1024}), 352, std::int64_t{1} << 32),
       "voxel (0, 0, 0): value 4294967296: labels are whole numbers from 0 to 4294967295"},
      {changed(test::nifti(image(), {.type = 64}), 352 + 8 * 59, 2.5),
       "voxel (4, 3, 2): value 2.5 is no whole number"},
      {changed(test::nifti(image(), {.type = 16}), 352, std::numeric_limits<float>::quiet_NaN()),
       "voxel (0, 0, 0): value nan is no whole number"},
      {changed(test::nifti(image(), {.type = 64}), 352, HUGE_VAL),
       "voxel (0, 0, 0): value inf is no whole number"},
      {gz.substr(0, gz.size() / 2), "the compressed data end too early, after ..."},
      {gz.substr(0, gz.size() - 4), "the compressed data end too early, after ..."},
      {changed(gz, gz.size() - 8, ~std::uint32_t{0}), "the compressed data are damaged after 472 bytes"},
      {test::gzipped(""), "the file ends within the header of 348 bytes"},
      {test::gzipped(good.substr(0, good.size() - 3)), "data: 117 bytes of the 120 that the header promises"},
      {extended(test::bytes_of(0, std::endian::little) + std::string(12, '\0')),
       "extension at byte 352: a size of 0"},
      {extended(test::bytes_of(4096, std::endian::little) + std::string(12, '\0')),
       "extension at byte 352: a size of 4096"},
      {named("<CaretExtension><Label Key=\"1\"><![CDATA[femur]]></Label>"),
       "CaretExtension: line 1: the file ends before '</CaretExtension>'"},
      {named("<CaretExtension><Label Key=\"1\"></CaretExtension></Label>"),
       "CaretExtension: line 1: '</CaretExtension>' closes what is not open"},
      {named("<CaretExtension><Label>femur</Label></CaretExtension>"),
       "CaretExtension: line 1: a Label without Key"},
      {named("<CaretExtension><Label Key=\"-1\">femur</Label></CaretExtension>"),
       "CaretExtension: line 1: Key '-1' is no label"},
      {named("<CaretExtension><Label Key=\"1\">a</Label>\n<Label Key=\"1\">b</Label></CaretExtension>"),
       "CaretExtension: line 2: Key 1 is given twice"},
      {named("<CaretExtension><Label Key=\"1\">a &bomb; b</Label></CaretExtension>"),
       "CaretExtension: line 1: '&bomb; b' is no entity"},
      {named("<CaretExtension><Label Key=\"1\"><![CDATA[femur</Label></CaretExtension>"),
       "CaretExtension: line 1: a CDATA section does not end"},
  };
}

std::vector<test::Refusal> damaged_nrrd() {
  const std::string good = test::nrrd(image());
  const std::string gz = test::nrrd(image(), {.is_gzip = true});
  const std::string layered = test::nrrd(test::label_image(image().X_WI, 3));
  const std::string directions = "(0.5,0,0) (0,0.75,0) (0,0,2)";
  const auto more = [&](const std::string& lines) { return test::nrrd(image(), {.more_lines = lines}); };
  return {
      {"", "the file is empty"},
      {"PNG\n\n", "does not begin with 'NRRD000': no NRRD file"},
      {replaced(good, "NRRD0004", "NRRD0009"), "'NRRD0009': versions 1 to 5 of NRRD are read"},
      {replaced(good, "NRRD0004", "NRRD00.01"), "'NRRD00.01': versions 1 to 5 of NRRD are read"},
      {"NRRD0004\n\n", "dimension: is missing"},
      {more("spacing: 1 2 3\n"), "line 12: 'spacing: 1 2 3' is no field of NRRD"},
      {more("\x1b[31m\n"), "line 12: '?[31m' is no field of NRRD"},
      {more("type: short\n"), "line 12: the field 'type' is given twice"},
      {more("a:=1\na:=2\n"), "line 13: the key 'a' is given twice"},
      {replaced(good, "dimension: 3", "dimension: 2"),
       "dimension: 2: 3, and 4 with an axis of layers, are read"},
      {replaced(good, "dimension: 3", "dimension: 16"),
       "dimension: 16: 3, and 4 with an axis of layers, are read"},
      {replaced(good, "dimension: 3", "dimension: three"), "dimension: 'three' is no whole number"},
      {replaced(good, "sizes: 5 4 3\n", ""), "sizes: is missing"},
      {replaced(good, "sizes: 5 4 3", "sizes: 5 4"), "sizes: has 2 values instead of 3"},
      {replaced(good, "sizes: 5 4 3", "sizes: 5 0 3"), "sizes: a size of 0"},
      {replaced(good, "sizes: 5 4 3", "sizes: 5 4 -3"), "sizes: a size of -3"},
      {replaced(good, "sizes: 5 4 3", "sizes: 5 4 x"), "sizes: 'x' is no whole number"},
      {replaced(good, "sizes: 5 4 3", "sizes: 5 4 18446744073709551619"),
       "sizes: '18446744073709551619' is no whole number"},
      {replaced(good, "sizes: 5 4 3", "sizes: 4294967296 4294967296 2"),
       "sizes: 4294967296 x 4294967296 x 2 voxels are more than 2^40"},
      {replaced(good, "sizes: 5 4 3", "sizes: 8192 8192 8192"),
       "data: the file is too short for the 1099511627776 bytes that the header promises"},
      {replaced(gz, "sizes: 5 4 3", "sizes: 8192 8192 8192"),
       "data: the file is too short for the 1099511627776 bytes that the header promises"},
      {replaced(layered, "sizes: 3 5 4 3", "sizes: 0 5 4 3"), "sizes: 0 layers: 1 to 1024 are read"},
      {replaced(layered, "sizes: 3 5 4 3", "sizes: 5000 5 4 3"), "sizes: 5000 layers: 1 to 1024 are read"},
      {replaced(good, "type: short\n", ""), "type: is missing"},
      {replaced(good, "type: short", "type: block"), "type: 'block' is not read"},
      {replaced(good, "encoding: raw\n", ""), "encoding: is missing"},
      {replaced(good, "encoding: raw", "encoding: ascii"),
       "encoding: 'ascii' is not read: 'raw' and 'gzip' are"},
      {replaced(good, "encoding: raw", "encoding: bz2"), "encoding: 'bz2' is not read: 'raw' and 'gzip' are"},
      {replaced(good, "endian: little\n", ""), "endian: is missing"},
      {replaced(good, "endian: little", "endian: middle"), "endian: 'middle' is neither 'little' nor 'big'"},
      {replaced(good, "left-posterior-superior", "left-posterior-inferior"),
       "space: 'left-posterior-inferior' is not read"},
      {replaced(good, "left-posterior-superior", "LPST"), "space: 'lpst' is not read"},
      {replaced(good, "space: left-posterior-superior\n", ""),
       "space: missing or no named one: the file does not say how its axes lie in the body; state it"},
      {replaced(good, "left-posterior-superior", "3D-right-handed"),
       "space: missing or no named one: the file does not say how its axes lie in the body; state it"},
      {replaced(good, "space directions: " + directions, "spacings: 1 1 1"),
       "space directions: missing or no named one: the file does not say how its axes lie in the "
       "body; "
       "state it"},
      {replaced(good, "space directions: " + directions + "\n", ""), "spacings: is missing"},
      {more("space units: \"mm\" \"mm\" \"cm\"\n"), "space units: are not three times the same unit"},
      {more("space units: \"s\" \"s\" \"s\"\n"), "space units: '\"s\"' is no unit of length that is read"},
      {replaced(good, directions, "(0.5,0,0) (0,0.75,0)"), "space directions: '' is no vector"},
      {replaced(good, directions, directions + " (1,0,0)"), "space directions: are more than the 3 axes"},
      {replaced(good, directions, "none (0,0.75,0) (0,0,2)"),
       "space directions: name 2 axes of space instead of 3"},
      {replaced(layered, "none " + directions, directions + " (1,1,1)"),
       "space directions: name 4 axes of space instead of 3"},
      {replaced(good, directions, "(0.5,0) (0,0.75) (0,0)"),
       "space directions: a vector has another number of components than 3"},
      {replaced(good, directions, "(0.5,0,0,0) (0,0.75,0,0) (0,0,2,0)"),
       "space directions: a vector has another number of components than 3"},
      {replaced(good, directions, "(0.5,0,0 (0,0.75,0 (0,0,2"),
       "space directions: '(0.5,0,0 (0,0.75,0 (0,0,2' is no vector"},
      {replaced(good, directions, "(0.5,0,x) (0,0.75,0) (0,0,2)"), "space directions: 'x' is no number"},
      {replaced(good, directions, "(nan,0,0) (0,0.75,0) (0,0,2)"),
       "space directions: places voxels at (nan, ..."},
      {replaced(good, directions, "(0.5,0,0) (0,0.75,0) (1,1,0)"),
       "space directions: the three axes lie in one plane"},
      {replaced(good, directions, "(0.5,0,0) (0,0.75,0) (0,0,0)"),
       "space directions: voxels have an extent of 0 mm along axis 2"},
      {replaced(good, "space origin: (-20,30,400)", "space origin: -20 30 400"),
       "space origin: '-20 30 400' is no vector"},
      {replaced(good, "space origin: (-20,30,400)", "space origin: none"),
       "space origin: is no single vector"},
      {replaced(good, "space origin: (-20,30,400)", "space origin: (inf,30,400)"),
       "space directions: places voxels at (inf, 30, 400) mm, which is not finite or beyond 1e30"},
      {replaced(good, "kinds: domain domain domain", "kinds: domain"), "kinds: are 1 instead of 3"},
      {replaced(layered, "kinds: list", "kinds: RGB-color"),
       "kinds: 'rgb-color' is no axis of layers: 'list' and 'vector' are"},
      {more("line skip: 1000\n"), "line skip: the file of the data has fewer lines"},
      {more("line skip: -1\n"), "line skip: -1 is no number of lines"},
      {more("byte skip: 100000\n"), "byte skip: the data have fewer than 100000 bytes"},
      {more("byte skip: -2\n"), "byte skip: -2 is no number of bytes"},
      {test::nrrd(image(), {.is_gzip = true, .more_lines = "byte skip: -1\n"}),
       "byte skip: -1 is for raw data only"},
      {more("data file: x.raw\n"), "data file: the data lie in another file, 'x.raw'"},
      {more("data file: LIST\na.raw\nb.raw\n"), "data file: LIST: data in several files are not read"},
      {more("data file: a%03d.raw 1 3 1\n"),
       "data file: 'a%03d.raw 1 3 1': data in several files are not read"},
      {more("Segment0_LabelValue:=1\nSegment0_Layer:=1\n"), "Segment0_Layer: layer 1 of an image with 1"},
      {more("Segment0_LabelValue:=-1\n"), "'Segment0_LabelValue': '-1' is no whole number"},
      {good.substr(0, good.size() - 1),
       "data: the file is too short for the 120 bytes that the header promises"},
      {gz.substr(0, gz.size() - 30) + std::string(30, 'x'), "the compressed data ..."},
  };
}

std::vector<test::Refusal> damaged_metaimage() {
  const std::string good = test::meta(image());
  const std::string compressed = test::meta(image(), {.is_compressed = true});
  const auto more = [&](const std::string& lines) { return test::meta(image(), {.more_lines = lines}); };
  const std::string matrix = "TransformMatrix = 1 0 0 0 1 0 0 0 1";
  return {
      {"", "the file is empty"},
      {"hello", "line 1: 'hello' is no 'key = value'"},
      {replaced(good, "ElementDataFile = LOCAL\n", ""), "line 13: ..."},
      {good.substr(0, good.find("CompressedData")), "ElementDataFile: is missing"},
      {more("NDims = 3\n"), "line 12: the key 'NDims' is given twice"},
      {more("Origin = 0 0 0\n"), "Origin: Offset says the same already"},
      {replaced(good, "= Image", "= Tube"), "ObjectType: 'Tube' is no Image"},
      {replaced(good, "NDims = 3\n", ""), "NDims: is missing"},
      {replaced(good, "NDims = 3", "NDims = 2"), "NDims: 2 dimensions: only images of 3 are read"},
      {replaced(good, "BinaryData = True", "BinaryData = False"),
       "BinaryData: voxels written as text are not read"},
      {replaced(good, "BinaryData = True", "BinaryData = Yes"),
       "BinaryData: 'Yes' is neither True nor False"},
      {more("ElementNumberOfChannels = 3\n"),
       "ElementNumberOfChannels: several values in a voxel are not read"},
      {more("ElementToIntensityFunctionSlope = 0.5\n"),
       "ElementToIntensityFunctionSlope: a slope other than 1 is not read"},
      {replaced(good, "DimSize = 5 4 3\n", ""), "DimSize: is missing"},
      {replaced(good, "DimSize = 5 4 3", "DimSize = 5 4 3 1"), "DimSize: has 4 values instead of 3"},
      {replaced(good, "DimSize = 5 4 3", "DimSize = 0 4 3"), "DimSize: a size of 0"},
      {replaced(good, "DimSize = 5 4 3", "DimSize = 5 4.5 3"), "DimSize: '4.5' is no whole number"},
      {replaced(compressed, "DimSize = 5 4 3", "DimSize = 8192 8192 8192"),
       "data: the file is too short for the 1099511627776 bytes that the header promises"},
      {replaced(good, "ElementType = MET_SHORT\n", ""), "ElementType: is missing"},
      {replaced(good, "MET_SHORT", "MET_SHORT_ARRAY"), "ElementType: 'MET_SHORT_ARRAY' is not read"},
      {replaced(good, "MET_SHORT", "MET_LONG"),
       "ElementType: MET_LONG has 4 bytes in some programs and 8 in others: is not read"},
      {replaced(good, "ElementSpacing = 0.5 0.75 2\n", ""), "ElementSpacing: is missing"},
      {replaced(good, "ElementSpacing = 0.5 0.75 2", "ElementSpacing = 0.5 0 2"),
       "TransformMatrix: voxels have an extent of 0 mm along axis 1"},
      {replaced(good, matrix, "TransformMatrix = 1 0 0 0 1 0 0 0"),
       "TransformMatrix: has 8 values instead of 9"},
      {replaced(good, matrix, "TransformMatrix = 1 0 0 0 1 0 0 0 one"),
       "TransformMatrix: 'one' is no number"},
      {replaced(good, matrix, "TransformMatrix = 1 0 0 0 1 0 1 1 0"),
       "TransformMatrix: the three axes lie in one plane"},
      {replaced(good, matrix, "TransformMatrix = inf 0 0 0 1 0 0 0 1"),
       "TransformMatrix: places voxels at (..."},
      {more("DistanceUnits = inch\n"), "DistanceUnits: 'inch' is no unit of length that is read"},
      {more("HeaderSize = 100000\n"), "HeaderSize: the file holds fewer than 100000 bytes"},
      {more("HeaderSize = -2\n"), "HeaderSize: -2 is no number of bytes"},
      {test::meta(image(), {.is_compressed = true, .more_lines = "HeaderSize = -1\n"}),
       "HeaderSize: -1 is for data without compression"},
      {test::meta(image(), {.is_compressed = true, .more_lines = "CompressedDataSize = 100000\n"}),
       "CompressedDataSize: the file holds fewer than 100000 bytes of data"},
      {replaced(good, "LOCAL", "x.raw"), "ElementDataFile: the data lie in another file, 'x.raw'"},
      {replaced(good, "LOCAL", "LIST"), "ElementDataFile: 'LIST': data in several files are not read"},
      {replaced(good, "LOCAL", "a%03d.raw 1 3 1"),
       "ElementDataFile: 'a%03d.raw 1 3 1': data in several files are not read"},
      {good.substr(0, good.size() - 1),
       "data: the file is too short for the 120 bytes that the header promises"},
      {replaced(good, "CompressedData = False", "CompressedData = True"), "the compressed data ..."},
      {compressed.substr(0, compressed.size() - 3), "the compressed data end too early, after ..."},
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

/// Damaged files, and what the message must be behind "bones: ".
void expect_one_line_for_each(const std::vector<test::Refusal>& damages, io::LabelFormat format) {
  for (const auto& [bytes, says] : damages) {
    const auto message = label_complaint(bytes, format);
    EXPECT_TRUE(is_like(message, "bones: " + says)) << message << "\ninstead of " << says;
    EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }))
        << message;
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
    EXPECT_EQ(label_complaint(bytes, format), "accepted");
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
