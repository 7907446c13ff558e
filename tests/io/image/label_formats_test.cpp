#include "condyle/io/label_file.hpp"
#include "io/image/label_files.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

using Eigen::Affine3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using io::LabelFormat;
using io::LabelNoteCode;
using io::StatedAxes;
using test::LabelImage;
using test::TemporaryFolder;

Affine3d affine(const Matrix3d& axes, const Vector3d& origin) {
  Affine3d X = Affine3d::Identity();
  X.linear() = axes;
  X.translation() = origin;
  return X;
}

Matrix3d turned() {
  return (Eigen::AngleAxisd(0.35, Vector3d(1, -2, 0.5).normalized())).toRotationMatrix();
}

/// Every number one of a float, so that NIfTI-1 holds it.
Affine3d in_floats(const Affine3d& X) {
  Affine3d out = X;
  out.matrix() = X.matrix().cast<float>().cast<double>();
  return out;
}

struct Placement {
  const char* name;
  Affine3d X_WI;
  friend void PrintTo(const Placement& placement, std::ostream* out) { *out << placement.name; }
};

const Vector3d spacing(0.75, 0.8125, 2.5), origin(-120.5, 33.25, -800.125);

const std::vector<Placement>& placements() {
  static const std::vector<Placement> all = [] {
    Matrix3d shear = Matrix3d::Identity();
    shear(0, 2) = 0.4;
    shear(1, 2) = -0.2;
    const Matrix3d scale = spacing.asDiagonal();
    Matrix3d exchanged;
    exchanged << 0, 0, -1, 1, 0, 0, 0, -1, 0;
    return std::vector<Placement>{
        {"axis_aligned", affine(scale, origin)},
        {"exchanged_axes", affine(exchanged * scale, origin)},
        {"oblique", in_floats(affine(turned() * scale, origin))},
        {"sheared", in_floats(affine(turned() * shear * scale, origin))},
        {"mirrored", in_floats(affine(turned() * Vector3d(-1, 1, 1).asDiagonal() * scale, origin))}};
  }();
  return all;
}

void expect_same(const io::LabelMap& map, const LabelImage& image, double tolerance = 1e-9) {
  EXPECT_EQ(map.grid.size, image.size);
  EXPECT_LE((map.grid.X_WI.matrix() - image.X_WI.matrix()).cwiseAbs().maxCoeff(), tolerance)
      << map.grid.X_WI.matrix() << "\ninstead of\n"
      << image.X_WI.matrix();
  EXPECT_TRUE(std::is_sorted(map.labels.begin(), map.labels.end()));
  ASSERT_EQ(map.layers.size(), image.layers.size());
  for (std::size_t layer = 0; layer < map.layers.size(); ++layer) {
    std::vector<std::uint32_t> values;
    for (const auto index : map.layers[layer]) values.push_back(map.labels.at(index));
    EXPECT_EQ(values, image.layers[layer]) << "layer " << layer;
  }
}

/// A way to write an image into a folder, and the file that is then read.
struct Way {
  const char* name;
  std::function<std::filesystem::path(const LabelImage&, const TemporaryFolder&)> write;
  friend void PrintTo(const Way& way, std::ostream* out) { *out << way.name; }
};

Way one_file(const char* name, const char* file, std::function<std::string(const LabelImage&)> bytes) {
  return {name, [=](const LabelImage& image, const TemporaryFolder& folder) {
            return folder.file(file, bytes(image));
          }};
}

Way nifti_way(const char* name, const test::NiftiWriting& how) {
  return one_file(name, "bones.nii", [=](const auto& image) { return test::nifti(image, how); });
}

Way nrrd_way(const char* name, const test::NrrdWriting& how) {
  return one_file(name, "bones.nrrd", [=](const auto& image) { return test::nrrd(image, how); });
}

Way meta_way(const char* name, const test::MetaWriting& how) {
  return one_file(name, "bones.mha", [=](const auto& image) { return test::meta(image, how); });
}

Way nifti_pair(const char* name, const char* read, std::endian order, bool is_gzip = false) {
  return {name, [=](const LabelImage& image, const TemporaryFolder& folder) {
            const auto voxels = test::voxels_as(4, image.layers[0], order);
            folder.file("bones.hdr", test::nifti_header(image, {.order = order, .is_detached = true}));
            folder.file("bones.img", is_gzip ? test::gzipped(voxels) : voxels);
            return folder / read;
          }};
}

Way nrrd_pair(const char* name, const test::NrrdWriting& how, const std::string& before) {
  return {name, [=](const LabelImage& image, const TemporaryFolder& folder) {
            folder.file(how.data_file, before + test::nrrd_data(image, how));
            return folder.file("bones.nhdr", test::nrrd_header(image, how));
          }};
}

Way meta_pair(const char* name, const test::MetaWriting& how, const std::string& before) {
  return {name, [=](const LabelImage& image, const TemporaryFolder& folder) {
            folder.file(how.data_file, before + test::meta_data(image, how));
            return folder.file("bones.mhd", test::meta_header(image, how));
          }};
}

constexpr auto big = std::endian::big;

const std::vector<Way>& ways() {
  static const std::vector<Way> all = {
      nifti_way("nifti_1", {}),
      nifti_way("nifti_1_big_endian", {.order = big}),
      nifti_way("nifti_2", {.version = 2}),
      nifti_way("nifti_2_big_endian", {.version = 2, .order = big, .type = 64}),
      nifti_way("nifti_u8", {.type = 2}),
      nifti_way("nifti_i8", {.type = 256}),
      nifti_way("nifti_u16", {.order = big, .type = 512}),
      nifti_way("nifti_i32", {.type = 8}),
      nifti_way("nifti_u32", {.order = big, .type = 768}),
      nifti_way("nifti_i64", {.type = 1024}),
      nifti_way("nifti_u64", {.order = big, .type = 1280}),
      nifti_way("nifti_f32", {.type = 16}),
      nifti_way("nifti_f64", {.type = 64}),
      nifti_way("nifti_extension",
                {.extensions = std::string("\1\0\0\0", 4) + test::nifti_extension(6, "a comment")}),
      one_file("nifti_gzip", "BONES.NII.GZ",
               [](const auto& image) { return test::gzipped(test::nifti(image)); }),
      one_file("nifti_gzip_in_three_members", "bones.nii.gz",
               [](const auto& image) {
                 const auto bytes = test::nifti(image);
                 return test::gzipped(bytes.substr(0, 100)) + test::gzipped(bytes.substr(100, 300)) +
                        test::gzipped(bytes.substr(400));
               }),
      one_file("nifti_scaled", "bones.nii",
               [](LabelImage image) {
                 const auto header = test::nifti_header(image, {.slope = 0.5, .intercept = -3});
                 for (auto& value : image.layers[0]) value = 2 * (value + 3);
                 return header + test::voxels_as(4, image.layers[0], std::endian::little);
               }),
      nifti_pair("nifti_pair", "bones.hdr", std::endian::little),
      nifti_pair("nifti_pair_big_endian", "bones.hdr", big),
      nifti_pair("nifti_pair_by_its_voxels", "bones.img", std::endian::little),
      nifti_pair("nifti_pair_gzip", "bones.hdr", std::endian::little, true),
      nrrd_way("nrrd_lps", {}),
      nrrd_way("nrrd_lps_short_name", {.space = "LPS"}),
      nrrd_way("nrrd_ras", {.space = "RAS"}),
      nrrd_way("nrrd_ras_long_name", {.space = "right-anterior-superior"}),
      nrrd_way("nrrd_las", {.space = "left-anterior-superior"}),
      nrrd_way("nrrd_gzip", {.is_gzip = true}),
      nrrd_way("nrrd_big_endian", {.order = big}),
      nrrd_way("nrrd_u8", {.type = 2}),
      nrrd_way("nrrd_i8", {.type = 256}),
      nrrd_way("nrrd_u64", {.type = 1280, .order = big, .is_gzip = true}),
      nrrd_way("nrrd_float", {.type = 16}),
      nrrd_way("nrrd_pairs",
               {.more_lines = "a key: with a colon:=value: and more\nspace units: \"mm\" \"mm\" \"mm\"\n"}),
      nrrd_pair("nrrd_detached", {.data_file = "bones.raw"}, ""),
      nrrd_pair("nrrd_detached_gzip", {.is_gzip = true, .data_file = "bones.raw.gz"}, ""),
      nrrd_pair("nrrd_line_and_byte_skip",
                {.more_lines = "line skip: 2\nbyte skip: 3\n", .data_file = "bones.raw"}, "one\ntwo\nxyz"),
      nrrd_pair("nrrd_bytes_from_the_end", {.more_lines = "byteskip: -1\n", .data_file = "bones.raw"},
                "whatever this is"),
      meta_way("metaimage", {}),
      meta_way("metaimage_big_endian", {.order = big}),
      meta_way("metaimage_compressed", {.is_compressed = true}),
      meta_way("metaimage_float_big_endian", {.type = 16, .order = big, .is_compressed = true}),
      meta_way("metaimage_aliases", {.order = big,
                                     .matrix_key = "Rotation",
                                     .offset_key = "Position",
                                     .order_key = "ElementByteOrderMSB"}),
      meta_way("metaimage_more_aliases", {.type = 2, .matrix_key = "Orientation", .offset_key = "Origin"}),
      meta_pair("metaimage_detached", {.data_file = "bones.raw"}, ""),
      meta_pair("metaimage_detached_compressed", {.is_compressed = true, .data_file = "bones.zraw"}, ""),
      meta_pair("metaimage_header_size", {.more_lines = "HeaderSize = 5\n", .data_file = "bones.raw"},
                "12345"),
      meta_pair("metaimage_bytes_from_the_end", {.more_lines = "HeaderSize = -1\n", .data_file = "bones.raw"},
                "whatever this is")};
  return all;
}

class LabelFormats : public testing::TestWithParam<std::tuple<Placement, Way>> {};

TEST_P(LabelFormats, GiveTheSameGridAndVoxels) {
  const auto& [placement, way] = GetParam();
  const TemporaryFolder folder;
  const auto image = test::label_image(placement.X_WI);
  const auto map = io::read_labels(way.write(image, folder));
  expect_same(map, image);
  EXPECT_TRUE(map.notes.empty()) << map.notes.front().text;
  EXPECT_TRUE(map.segments.empty());
}

INSTANTIATE_TEST_SUITE_P(EveryWay, LabelFormats,
                         testing::Combine(testing::ValuesIn(placements()), testing::ValuesIn(ways())),
                         [](const auto& both) {
                           return std::string(std::get<0>(both.param).name) + "_" +
                                  std::get<1>(both.param).name;
                         });

io::LabelMap read(const std::string& bytes, LabelFormat format, const io::LabelFileOptions& options = {}) {
  return io::read_labels(bytes, format, "bones", options);
}

bool has_note(const io::LabelMap& map, LabelNoteCode code) {
  return std::any_of(map.notes.begin(), map.notes.end(), [&](const auto& note) { return note.code == code; });
}

TEST(LabelLayers, LieInterleavedWhereTheListIsFirstAndElsewhereWhereItStands) {
  const auto image = test::label_image(placements()[3].X_WI, 3);
  for (const bool is_gzip : {false, true})
    for (std::size_t axis = 0; axis < 4; ++axis) {
      SCOPED_TRACE(axis);
      expect_same(read(test::nrrd(image, {.is_gzip = is_gzip, .layer_axis = axis}), LabelFormat::nrrd),
                  image);
    }
}

TEST(LabelLayers, StayApartOverManyBlocks) {
  LabelImage image{{70, 71, 72}, Affine3d::Identity(), {{}, {}}};
  std::mt19937 random(3);
  for (auto& layer : image.layers)
    for (int i = 0; i < 70 * 71 * 72; ++i) layer.push_back(static_cast<std::uint32_t>(random() % 7));
  for (const std::size_t axis : {0u, 2u, 3u})
    expect_same(read(test::nrrd(image, {.layer_axis = axis}), LabelFormat::nrrd), image);
}

TEST(NiftiAffine, ByQuaternionIsThatOfTheRows) {
  for (const int version : {1, 2})
    for (const auto& placement : placements()) {
      if (std::string(placement.name) == "sheared") continue;
      SCOPED_TRACE(placement.name);
      const bool is_mirrored = placement.X_WI.linear().determinant() < 0;
      const Matrix3d axes = (is_mirrored ? turned() * Vector3d(1, 1, -1).asDiagonal() : turned()) *
                            Matrix3d(spacing.asDiagonal());
      const auto image = test::label_image(affine(axes, origin));
      const auto map =
          read(test::nifti(image, {.version = version, .sform = false, .qform = true}), LabelFormat::nifti);
      // NIfTI-1 keeps floats: 2^-24 of the numbers at most, those of 800 mm.
      expect_same(map, image, version == 1 ? 800 * std::ldexp(1, -22) : 1e-9);
    }
}

TEST(NiftiAffine, AHalfTurnHasNoRealPart) {
  for (const Vector3d& axis :
       {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(0.6, 0, 0.8)}) {
    const Matrix3d half = Eigen::AngleAxisd(M_PI, axis).toRotationMatrix();
    // In RAS, as the quaternion is; the image is in LPS.
    const Matrix3d axes = Vector3d(-1, -1, 1).asDiagonal() * half * spacing.asDiagonal();
    const auto image = test::label_image(affine(axes, origin));
    expect_same(read(test::nifti(image, {.version = 2, .sform = false, .qform = true}), LabelFormat::nifti),
                image);
    // In floats, (0.6, 0, 0.8) is longer than 1: the square of the real part would be negative.
    expect_same(read(test::nifti(image, {.sform = false, .qform = true}), LabelFormat::nifti), image,
                800 * std::ldexp(1, -22));
  }
}

TEST(NiftiAffine, TheFirstPixdimIsPlusForZero) {
  const auto image = test::label_image(affine(turned() * Matrix3d(spacing.asDiagonal()), origin));
  auto bytes = test::nifti(image, {.version = 2, .sform = false, .qform = true});
  ASSERT_EQ(bytes.substr(104, 8), test::bytes_of(1.0, std::endian::little));
  test::put(bytes, 104, 0.0);
  expect_same(read(bytes, LabelFormat::nifti), image);
}

TEST(NiftiAffine, TwoThatDifferAreNotedAndTheUserChooses) {
  const auto image = test::label_image(placements()[0].X_WI);
  auto bytes = test::nifti(image, {.version = 2, .qform = true});
  EXPECT_FALSE(has_note(read(bytes, LabelFormat::nifti), LabelNoteCode::two_affines));

  // The offset along x: just below and just above a tenth of a voxel.
  const auto x = -origin.x();
  test::put(bytes, 376, x + 0.099 * spacing.x());
  EXPECT_FALSE(has_note(read(bytes, LabelFormat::nifti), LabelNoteCode::two_affines));
  test::put(bytes, 376, x + 0.101 * spacing.x());
  const auto by_sform = read(bytes, LabelFormat::nifti);
  EXPECT_TRUE(has_note(by_sform, LabelNoteCode::two_affines));
  expect_same(by_sform, image);

  const auto by_qform = read(bytes, LabelFormat::nifti, {.affine = io::AffineChoice::qform});
  EXPECT_TRUE(has_note(by_qform, LabelNoteCode::two_affines));
  EXPECT_NEAR(by_qform.grid.X_WI.translation().x(), origin.x() - 0.101 * spacing.x(), 1e-12);
}

TEST(NiftiAffine, ThatDoesNotCountMayBeBroken) {
  const auto image = test::label_image(placements()[0].X_WI);
  for (const std::size_t at : {std::size_t{112}, std::size_t{352}, std::size_t{376}}) {  // pixdim[1], b, x
    auto bytes = test::nifti(image, {.version = 2, .qform = true});
    test::put(bytes, at, std::nan(""));
    const auto map = read(bytes, LabelFormat::nifti);
    expect_same(map, image);
    EXPECT_TRUE(has_note(map, LabelNoteCode::two_affines));
  }
}

TEST(NiftiAffine, NotesVoxelsThatPixdimHasInAnotherSize) {
  const auto image = test::label_image(placements()[2].X_WI);
  const auto with_size = [&](double factor, io::AffineChoice affine = io::AffineChoice::sform_first) {
    auto bytes = test::nifti(image, {.version = 2, .qform = affine == io::AffineChoice::qform});
    for (int axis = 0; axis < 3; ++axis)
      test::put(bytes, 112 + 8 * static_cast<std::size_t>(axis),
                factor * image.X_WI.linear().col(axis).norm());
    return read(bytes, LabelFormat::nifti, {.affine = affine});
  };
  const auto noted = with_size(0.5);
  EXPECT_TRUE(has_note(noted, LabelNoteCode::two_voxel_sizes));
  expect_same(noted, image);
  EXPECT_FALSE(has_note(with_size(1), LabelNoteCode::two_voxel_sizes));
  EXPECT_FALSE(has_note(with_size(1.0009), LabelNoteCode::two_voxel_sizes)) << "three digits";
  EXPECT_TRUE(has_note(with_size(1.0011), LabelNoteCode::two_voxel_sizes));
  EXPECT_FALSE(has_note(with_size(0), LabelNoteCode::two_voxel_sizes)) << "no size at all";
  EXPECT_FALSE(has_note(with_size(0.5, io::AffineChoice::qform), LabelNoteCode::two_voxel_sizes))
      << "the qform takes pixdim";
}

TEST(NiftiAffine, WithoutOrientationNeedsStatedAxes) {
  const auto image = test::label_image(Affine3d(Eigen::Scaling(spacing)));
  const auto bytes = test::nifti(image, {.sform = false});
  EXPECT_THROW(read(bytes, LabelFormat::nifti), FileError);
  expect_same(read(bytes, LabelFormat::nifti, {.axes = StatedAxes::lps}), image);
  const auto ras = read(bytes, LabelFormat::nifti, {.axes = StatedAxes::ras});
  EXPECT_EQ(ras.grid.X_WI.linear(), Matrix3d(Vector3d(-0.75, -0.8125, 2.5).asDiagonal()));
}

TEST(StatedAxes, AreNotedWhereTheFileHasItsOwn) {
  const auto image = test::label_image(placements()[3].X_WI);
  const std::pair<LabelFormat, std::string> files[] = {{LabelFormat::nifti, test::nifti(image)},
                                                       {LabelFormat::nrrd, test::nrrd(image, {})}};
  for (const auto& [format, bytes] : files) {
    EXPECT_FALSE(has_note(read(bytes, format), LabelNoteCode::axes_not_used));
    const auto map = read(bytes, format, {.axes = StatedAxes::las});
    expect_same(map, image);
    EXPECT_TRUE(has_note(map, LabelNoteCode::axes_not_used));
  }
  const auto upright = test::label_image(Affine3d(Eigen::Scaling(spacing)));
  EXPECT_FALSE(
      has_note(read(test::nifti(upright, {.sform = false}), LabelFormat::nifti, {.axes = StatedAxes::lps}),
               LabelNoteCode::axes_not_used));
  EXPECT_FALSE(has_note(read(test::nrrd(image, {.space = ""}), LabelFormat::nrrd, {.axes = StatedAxes::lps}),
                        LabelNoteCode::axes_not_used));
}

TEST(NiftiUnits, AreConverted) {
  const auto image = test::label_image(placements()[2].X_WI);
  for (const auto& [code, mm] : {std::pair{1, 1000.0}, {2, 1.0}, {3, 1e-3}})
    expect_same(read(test::nifti(image, {.version = 2, .units = code, .unit_mm = mm}), LabelFormat::nifti),
                image);
  const auto unknown = read(test::nifti(image, {.units = 0}), LabelFormat::nifti);
  EXPECT_TRUE(has_note(unknown, LabelNoteCode::unknown_units));
  expect_same(unknown, image);
}

TEST(NiftiVolumes, AreChosenByNumber) {
  const auto image = test::label_image(placements()[1].X_WI, 3);
  for (const bool is_gzip : {false, true}) {
    const auto bytes = is_gzip ? test::gzipped(test::nifti(image)) : test::nifti(image);
    EXPECT_THROW(read(bytes, LabelFormat::nifti), FileError);
    EXPECT_THROW(read(bytes, LabelFormat::nifti, {.volume = 3}), FileError);
    EXPECT_THROW(read(bytes, LabelFormat::nifti, {.volume = -1}), FileError);
    if (!is_gzip) {
      EXPECT_THROW(read(bytes.substr(0, bytes.size() - 1), LabelFormat::nifti, {.volume = 0}), FileError);
    }
    for (std::size_t volume = 0; volume < 3; ++volume) {
      const auto map = read(bytes, LabelFormat::nifti, {.volume = static_cast<std::int64_t>(volume)});
      expect_same(map, {image.size, image.X_WI, {image.layers[volume]}});
      EXPECT_TRUE(map.notes.empty());
    }
  }
}

TEST(LabelValues, WithinAThousandthOfAWholeNumberCountAsIt) {
  LabelImage image{{3, 1, 1}, Affine3d::Identity(), {{1, 2, 300000}}};
  auto bytes = test::nifti(image, {.type = 64});
  test::put(bytes, 352, 1.0009);
  test::put(bytes, 360, 1.9991);
  expect_same(read(bytes, LabelFormat::nifti), image);
  test::put(bytes, 352, 1.0011);
  EXPECT_THROW(read(bytes, LabelFormat::nifti), FileError);
}

TEST(LabelValues, ReachTheLargestNumberOf32Bits) {
  const LabelImage image{{3, 1, 1}, Affine3d::Identity(), {{0, 4294967295u, 65536}}};
  for (const int type : {768, 1024, 1280, 64})
    expect_same(read(test::nifti(image, {.type = type}), LabelFormat::nifti), image);
}

TEST(LabelValues, AreAtMost65535Different) {
  LabelImage image{{65536, 1, 1}, Affine3d::Identity(), {{}}};
  for (std::uint32_t i = 0; i < 65536; ++i) image.layers[0].push_back(std::min(i, 65534u));
  expect_same(read(test::nrrd(image, {.type = 512}), LabelFormat::nrrd), image);
  image.layers[0].back() = 65535;
  EXPECT_THROW(read(test::nrrd(image, {.type = 512}), LabelFormat::nrrd), FileError);
  EXPECT_THROW(read(test::nrrd(image, {.type = 768}), LabelFormat::nrrd), FileError);
}

TEST(LabelGrid, HasNoNegativeZeros) {
  const auto map = read(test::nifti(test::label_image(placements()[0].X_WI)), LabelFormat::nifti);
  for (const double number : map.grid.X_WI.matrix().reshaped())
    EXPECT_FALSE(number == 0 && std::signbit(number));
}

TEST(NrrdSpace, WithoutAKnownWorldNeedsAStatedOne) {
  const auto image = test::label_image(placements()[3].X_WI);
  for (const char* space : {"", "3D-right-handed"}) {
    const auto bytes = test::nrrd(image, {.space = space});
    EXPECT_THROW(read(bytes, LabelFormat::nrrd), FileError);
    expect_same(read(bytes, LabelFormat::nrrd, {.axes = StatedAxes::lps}), image);
  }
}

TEST(NrrdSpace, UnitsAreConverted) {
  auto image = test::label_image(placements()[3].X_WI);
  const auto bytes = test::nrrd(image, {.more_lines = "space units: \"um\" \"um\" \"um\"\n"});
  image.X_WI.matrix().topRows<3>() *= 1e-3;
  expect_same(read(bytes, LabelFormat::nrrd), image);
}

TEST(MetaImageMatrix, HasTheAxesInItsRows) {
  // Turned by the angle whose cosine is 0.8 about z: i runs along (0.8, 0.6, 0).
  const std::string header =
      "NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\nElementSpacing = 10 10 10\nOffset = 1 2 3\n"
      "TransformMatrix = 0.8 0.6 0 -0.6 0.8 0 0 0 1\nElementDataFile = LOCAL\n";
  const auto map = read(header + std::string("\1\2", 2), LabelFormat::metaimage);
  EXPECT_LE((map.grid.X_WI * Vector3d(1, 0, 0) - Vector3d(9, 8, 3)).norm(), 1e-12);
  EXPECT_LE((map.grid.X_WI * Vector3d(0, 1, 0) - Vector3d(-5, 10, 3)).norm(), 1e-12);
}

TEST(MetaImageMatrix, ThatIsMissingNeedsStatedAxes) {
  const std::string bytes = std::string(
      "NDims = 3\nDimSize = 2 1 1\nElementType = MET_UCHAR\nElementSpacing = 10 20 30\nOffset = 1 2 3\n"
      "ElementDataFile = LOCAL\n\1\2");
  test::expect_says(test::complaint_of<FileError>([&] { read(bytes, LabelFormat::metaimage); }),
                    "TransformMatrix: is missing");
  const auto lps = read(bytes, LabelFormat::metaimage, {.axes = StatedAxes::lps});
  EXPECT_EQ(lps.grid.X_WI * Vector3d(1, 1, 1), Vector3d(11, 22, 33));
  const auto ras = read(bytes, LabelFormat::metaimage, {.axes = StatedAxes::ras});
  EXPECT_EQ(ras.grid.X_WI * Vector3d(1, 1, 1), Vector3d(-11, -22, 33));
}

TEST(LabelHeaders, OfAnyLineEndsAndWithAMarkOfUtf8AreRead) {
  const auto image = test::label_image(placements()[0].X_WI);
  const auto with_ends = [](const std::string& header, std::string_view end) {
    std::string out;
    for (const char c : header) out += c == '\n' ? std::string(end) : std::string(1, c);
    return out;
  };
  for (const std::string_view mark : {"", "\xEF\xBB\xBF"})
    for (const std::string_view end : {"\n", "\r", "\r\n"}) {
      const std::string start(mark);
      expect_same(
          read(start + with_ends(test::nrrd_header(image), end) + test::nrrd_data(image), LabelFormat::nrrd),
          image);
      expect_same(read(start + with_ends(test::meta_header(image), end) + test::meta_data(image),
                       LabelFormat::metaimage),
                  image);
    }
}

TEST(LabelBytes, AreNotedBeyondThoseThatTheHeaderPromises) {
  const auto image = test::label_image(placements()[0].X_WI);
  for (const auto& [bytes, format] : {std::pair{test::nifti(image), LabelFormat::nifti},
                                      {test::nrrd(image), LabelFormat::nrrd},
                                      {test::meta(image), LabelFormat::metaimage}}) {
    EXPECT_FALSE(has_note(read(bytes, format), LabelNoteCode::more_bytes));
    const auto map = read(bytes + "x", format);
    EXPECT_TRUE(has_note(map, LabelNoteCode::more_bytes));
    expect_same(map, image);
  }
}

TEST(EmptySegmentation, IsNotedForASingleVoxel) {
  const LabelImage image{{1, 1, 1}, Affine3d::Identity(), {{0}}};
  EXPECT_TRUE(has_note(read(test::nrrd(image), LabelFormat::nrrd), LabelNoteCode::empty_segmentation));
}

TEST(DetachedData, LieBelowTheFolderOfTheHeaderUnlessTheUserAllows) {
  const auto image = test::label_image(placements()[0].X_WI);
  const TemporaryFolder folder;
  const auto inner = folder / "inner";
  std::filesystem::create_directories(inner / "deeper");
  const test::NrrdWriting how{.data_file = "../bones.raw"};
  folder.file("bones.raw", test::nrrd_data(image, how));
  folder.file("inner/deeper/bones.raw", test::nrrd_data(image, how));
  std::filesystem::create_symlink(folder / "bones.raw", inner / "link.raw");

  const auto read_as = [&](const std::string& data_file, const io::LabelFileOptions& options) {
    folder.file("inner/a.mhd", test::meta_header(image, {.data_file = data_file}));
    expect_same(io::read_labels(inner / "a.mhd", options), image);
    return io::read_labels(folder.file("inner/a.nhdr", test::nrrd_header(image, {.data_file = data_file})),
                           options);
  };
  for (const std::string& outside :
       {std::string("../bones.raw"), std::string("link.raw"), std::string("deeper/../../bones.raw"),
        (folder / "bones.raw").string()}) {
    SCOPED_TRACE(outside);
    EXPECT_THROW(read_as(outside, {}), FileError);
    expect_same(read_as(outside, {.outside_folder = true}), image);
  }
  for (const std::string& below : {std::string("deeper/bones.raw"), std::string("./deeper/bones.raw"),
                                   (inner / "deeper/bones.raw").string()})
    expect_same(read_as(below, {}), image);
}

TEST(LabelFormatOf, IsWhatTheNameEndsIn) {
  EXPECT_EQ(io::label_format_of("a/b.nii.gz"), LabelFormat::nifti);
  EXPECT_EQ(io::label_format_of("B.SEG.NRRD"), LabelFormat::nrrd);
  EXPECT_EQ(io::label_format_of("b.mhd"), LabelFormat::metaimage);
  EXPECT_EQ(io::label_format_of("b.stl"), std::nullopt);
  EXPECT_EQ(io::label_format_of("b.gz"), std::nullopt);
}

}  // namespace
}  // namespace condyle
