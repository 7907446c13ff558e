#include "condyle/io/picture.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>

#include "condyle/answer.hpp"
#include "condyle/hip_measures.hpp"
#include "core/thread_limit.hpp"
#include "io/file/whole_file.hpp"
#include "io/picture/colour_scale.hpp"
#include "io/picture/depth_bands.hpp"
#include "io/picture/legend.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/subdivide.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

using io::Rgb;

/// So that in the middle of a face normals are the face's.
TriMesh fine_box(const Vec3& low, const Vec3& high) {
  TriMesh mesh = box(low, high);
  for (int level = 0; level < 4; ++level) mesh = mesh::subdivided(mesh);
  return mesh;
}

Joint joint_of(const TriMesh& fixed, const TriMesh& mobile, Side side = Side::right) {
  return {"boxes", JointKind::ball, side, {"fixed", fixed}, {"mobile", mobile}};
}

Rgb pixel(const io::Picture& picture, std::size_t column, std::size_t row) {
  Rgb colour;
  for (std::size_t k = 0; k < 3; ++k) colour[k] = picture.rgb[3 * (row * picture.width + column) + k];
  return colour;
}

/// Each channel within this many of 255.
void expect_colour(const Rgb& is, const Rgb& expected, double within, const std::string& what) {
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(is[k], expected[k], within) << what << ", channel " << k;
}

constexpr std::size_t side_px = 200;
constexpr double field_mm = 100;

/// 2 pixels a mm, the joint centre in the middle.
io::PictureOptions bare_square(std::string_view view, Side side = Side::right) {
  return {.view = io::view_named(view, side),
          .colour = io::PictureColour::none,
          .width = side_px,
          .height = side_px,
          .field_mm = field_mm,
          .is_annotated = false};
}

Rgb at_mm(const io::Picture& picture, double right, double up) {
  const double per_mm = side_px / field_mm;
  return pixel(picture, static_cast<std::size_t>(side_px / 2.0 + per_mm * right),
               static_cast<std::size_t>(side_px / 2.0 - per_mm * up));
}

struct ViewedFrom {
  const char* view;
  Side side;
  /// Where X, Y and Z point in the picture: right and up.
  std::array<double, 3> right, up;
};

class Views : public ::testing::TestWithParam<ViewedFrom> {};

TEST_P(Views, ShowBonesWhereTheyAre) {
  const auto& [view, side, right, up] = GetParam();
  const Vec3 of_fixed(30, 20, 10), of_mobile(-10, -30, -20), half(4, 4, 4);
  const Joint joint = joint_of(fine_box(of_fixed - half, of_fixed + half),
                               fine_box(of_mobile - half, of_mobile + half), side);
  const io::Picture picture = io::draw_joint(joint, {}, Pose::Identity(), bare_square(view, side));
  ASSERT_EQ(picture.rgb.size(), 3 * side_px * side_px);
  const auto place = [](const Vec3& p, const std::array<double, 3>& along) {
    return p.x() * along[0] + p.y() * along[1] + p.z() * along[2];
  };
  for (const double sign : {1.0, -1.0}) {
    const Rgb fixed = sign > 0 ? io::fixed_bone : io::white, mobile = sign > 0 ? io::mobile_bone : io::white;
    expect_colour(at_mm(picture, sign * place(of_fixed, right), sign * place(of_fixed, up)), fixed, 1,
                  "fixed");
    expect_colour(at_mm(picture, sign * place(of_mobile, right), sign * place(of_mobile, up)), mobile, 1,
                  "mobile");
  }
}

/// A picture of two meshes about the origin, 12 mm high, and its colour at a place.
struct TouchSeen {
  static constexpr double height_mm = 12;
  TouchAnswer answer;
  io::Picture picture;

  TouchSeen(const TriMesh& fixed, const TriMesh& mobile, const io::ViewDirection& view)
      : answer(answer_touch(fixed, mobile, {})) {
    io::PictureOptions options = bare_square("anterior");
    options.view = view, options.field_mm = height_mm;
    picture = io::draw_touch(fixed, mobile, answer, options);
  }
  Rgb at(double right, double up) const {
    const double per_mm = side_px / height_mm;
    return pixel(picture, static_cast<std::size_t>(side_px / 2.0 + per_mm * right),
                 static_cast<std::size_t>(side_px / 2.0 - per_mm * up));
  }
};

constexpr Rgb meeting_red = {213, 94, 0}, way_blue = {0, 114, 178};
/// Red that shines through the mobile body by 45 parts of 100.
constexpr Rgb dimmed_red = {0.45 * 213 + 0.55 * io::mobile_bone[0], 0.45 * 94 + 0.55 * io::mobile_bone[1],
                            0.55 * io::mobile_bone[2]};

TEST(TouchPicture, ShowsTheTrianglesThatMeetAndTheDeepestPlace) {
  // A box sunk into the top of another one, from above: both triangles of that face meet it, and none of its own top.
  const TouchSeen seen(box({-10, -10, -10}, {10, 10, 10}), fine_box({-3, -2, 8.75}, {3, 4, 14}),
                       {Vec3::UnitZ(), Vec3::UnitY()});
  ASSERT_TRUE(seen.answer.deepest);
  const Vec3 place = seen.answer.deepest->place;
  expect_colour(seen.at(-5, -5), meeting_red, 1, "of the fixed body");
  expect_colour(seen.at(place.x() > 0 ? -2 : 2, 3), dimmed_red, 1, "behind the mobile body");
  expect_colour(seen.at(place.x(), place.y()), way_blue, 1, "deepest place");
}

TEST(TouchPicture, ShowsTheNearestPoints) {
  const TouchSeen seen(fine_box({-10, -10, -20}, {10, 10, -4}), box({-3, -2, 4}, {3, 4, 10}),
                       {Vec3::UnitY(), Vec3::UnitZ()});
  ASSERT_TRUE(seen.answer.nearest);
  expect_colour(seen.at(-seen.answer.nearest->on_fixed.x(), 0), way_blue, 1, "between");
  expect_colour(seen.at(5, -5.8), io::fixed_bone, 1, "nothing meets");
  expect_colour(seen.at(5, 0), io::white, 1, "nothing");
  // The mobile body's way out is upwards, seen from beside it and a little from above.
  const io::ViewDirection view = io::view_of_touch(seen.answer);
  EXPECT_NEAR(view.up.z(), 1 / std::hypot(1, 0.6), 1e-15);
  EXPECT_NEAR(view.towards_viewer.z(), 0.6 / std::hypot(1, 0.6), 1e-15);
  EXPECT_NEAR(view.up.dot(view.towards_viewer), 0, 1e-15);
}

constexpr std::array<double, 3> x = {1, 0, 0}, minus_x = {-1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 1},
                                minus_z = {0, 0, -1};
INSTANTIATE_TEST_SUITE_P(
    Picture, Views,
    ::testing::Values(ViewedFrom{"anterior", Side::right, minus_z, y},
                      ViewedFrom{"posterior", Side::right, z, y}, ViewedFrom{"right", Side::right, x, y},
                      ViewedFrom{"left", Side::right, minus_x, y}, ViewedFrom{"superior", Side::right, z, x},
                      ViewedFrom{"inferior", Side::right, minus_z, x},
                      ViewedFrom{"lateral", Side::right, x, y}, ViewedFrom{"medial", Side::right, minus_x, y},
                      ViewedFrom{"lateral", Side::left, minus_x, y}, ViewedFrom{"medial", Side::left, x, y}));

TEST(PictureView, IsBetweenSeveralDirections) {
  const io::ViewDirection view = io::view_named("anterior-superior", Side::right);
  EXPECT_NEAR((view.towards_viewer - Vec3(1, 1, 0).normalized()).norm(), 0, 1e-15);
  EXPECT_NEAR((view.up - Vec3(-1, 1, 0).normalized()).norm(), 0, 1e-15);
  for (const char* bad :
       {"", "up", "anterior-", "-anterior", "anterior-posterior", "Anterior", "medial-right-lateral-left"})
    EXPECT_THROW(io::view_named(bad, Side::right), UsageError) << bad;
}

/// A plate 5 mm in front of another one, far from the joint centre so that rays to neighbouring vertices are
/// parallel to 0.005 mm; and one 3 mm within a block: their distances in closed form.
Joint plate_before_plate() {
  return joint_of(fine_box({101, -40, -40}, {102, 40, 40}), fine_box({106, -20, -20}, {107, 20, 20}));
}
Joint plate_in_block() {
  return joint_of(fine_box({-50, -50, -50}, {50, 50, 50}), fine_box({46, -10, -10}, {47, 10, 10}));
}

enum class Hidden { none, fixed, mobile };

io::Picture coloured(const Joint& joint, io::PictureColour colour,
                     std::optional<double> range_mm = std::nullopt, Hidden hidden = Hidden::none) {
  io::PictureOptions options = bare_square("anterior");
  options.colour = colour, options.range_mm = range_mm;
  if (hidden == Hidden::fixed) options.fixed = io::BodyStyle::hidden;
  if (hidden == Hidden::mobile) options.mobile = io::BodyStyle::hidden;
  return io::draw_joint(joint, {}, Pose::Identity(), options);
}

/// In the middle of what is above the legend.
Rgb middle_of(const io::Picture& picture) {
  return pixel(picture, picture.width / 2,
               (picture.height - io::legend_height({.height = picture.height})) / 2);
}

TEST(PictureColours, AreThoseOfTheScale) {
  const auto expect = [](const io::Picture& picture, io::PictureColour colour, double range_mm, double mm) {
    expect_colour(middle_of(picture), *io::ColourScale{colour, range_mm}.at(mm), 1, std::to_string(mm));
  };
  // The front of the plate at x = 107 is 5 mm from the other's front at x = 102.
  expect(coloured(plate_before_plate(), io::PictureColour::nearest), io::PictureColour::nearest, 8, 5);
  expect(coloured(plate_before_plate(), io::PictureColour::nearest, 20), io::PictureColour::nearest, 20, 5);
  // For the plate behind, seen without the other, the ray along X goes on from x = 102 to the other one's back at x =
  // 106.
  expect(coloured(plate_before_plate(), io::PictureColour::gap, std::nullopt, Hidden::mobile),
         io::PictureColour::gap, 8, 4);
  for (const io::PictureColour colour : {io::PictureColour::nearest, io::PictureColour::gap})
    expect(coloured(plate_in_block(), colour, std::nullopt, Hidden::fixed), colour, 8, -3);
  // Depths have the first of 1, 2, 5, 10 ... as their end that holds them: 3 mm along rays at the middle, 4 at
  // the back of the plate, more at its corners, where rays are oblique.
  expect(coloured(plate_in_block(), io::PictureColour::depth, std::nullopt, Hidden::fixed),
         io::PictureColour::depth, 5, 3);
  expect(coloured(plate_in_block(), io::PictureColour::depth, 40, Hidden::fixed), io::PictureColour::depth,
         40, 3);
}

TEST(PictureColours, LeaveBoneWhereThereIsNothingToSay) {
  expect_colour(middle_of(coloured(plate_before_plate(), io::PictureColour::depth)), io::mobile_bone, 1,
                "not inside");
  expect_colour(middle_of(coloured(plate_before_plate(), io::PictureColour::gap)), io::mobile_bone, 1,
                "no ray meets it");
  expect_colour(middle_of(coloured(plate_before_plate(), io::PictureColour::gap, 3, Hidden::mobile)),
                io::fixed_bone, 1, "above the range");
  expect_colour(middle_of(coloured(plate_before_plate(), io::PictureColour::none)), io::mobile_bone, 1,
                "none asked");
}

TEST(PictureColours, HatchDepthsThatAreOnlyBounds) {
  // 3 mm under the top of a wide block, 150 mm from the centre: the ray leaves at atan(150 / 47) = 73 degrees.
  Joint joint =
      joint_of(fine_box({-200, -50, -200}, {200, 50, 200}), fine_box({140, 46, -10}, {160, 47, 10}));
  joint.kind = JointKind::free;
  Pose X_FM(Eigen::Translation3d(1e-9, 0, 0));  // so that no arcs are asked for
  const io::PictureOptions options{.view = io::view_named("superior", Side::right),
                                   .fixed = io::BodyStyle::hidden,
                                   .width = 400,
                                   .height = 400,
                                   .field_mm = 400};
  const io::Picture picture = io::draw_joint(joint, {}, X_FM, options);
  // From above anterior is up: one pixel a mm, roughly, and the plate 150 mm above the middle.
  const std::size_t rows = 400 - io::legend_height(options);
  const auto row =
      static_cast<std::size_t>(static_cast<double>(rows) / 2 - 150 * static_cast<double>(rows) / 400);
  std::size_t dark = 0, light = 0;
  for (std::size_t column = 193; column < 207; ++column) {
    const Rgb colour = pixel(picture, column, row);
    EXPECT_EQ(colour[0], colour[1]);
    EXPECT_EQ(colour[1], colour[2]);
    dark += colour == io::hatch_dark, light += colour == io::hatch_light;
  }
  EXPECT_GT(dark, 0u);
  EXPECT_GT(light, 0u);
}

std::size_t pixels_like(const io::Picture& picture, const Rgb& colour) {
  std::size_t count = 0;
  for (std::size_t row = 0; row < picture.height; ++row)
    for (std::size_t column = 0; column < picture.width; ++column)
      count += pixel(picture, column, row) == colour;
  return count;
}

TEST(Picture, LeavesOutWhatIsHiddenAndShowsThroughGlass) {
  const Joint joint = plate_before_plate();
  io::PictureOptions options = bare_square("anterior");
  const auto count = [&](const Rgb& bone) {
    return pixels_like(io::draw_joint(joint, {}, Pose::Identity(), options), bone);
  };
  EXPECT_GT(count(io::fixed_bone), 1000u);
  EXPECT_GT(count(io::mobile_bone), 1000u);
  options.mobile = io::BodyStyle::hidden;
  EXPECT_EQ(count(io::mobile_bone), 0u);
  EXPECT_GT(count(io::fixed_bone), 1000u);
  options.mobile = io::BodyStyle::transparent;
  const Rgb middle = middle_of(io::draw_joint(joint, {}, Pose::Identity(), options));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(std::min(io::fixed_bone[k], io::mobile_bone[k]), middle[k]);
    EXPECT_GT(std::max(io::fixed_bone[k], io::mobile_bone[k]), middle[k]);
  }
}

TEST(PictureMarks, CoverBonesBehindThemAndShineThroughThoseBeforeThem) {
  const Joint joint = joint_of(fine_box({-5, -40, -40}, {5, 40, 40}), fine_box({-60, -1, -1}, {-58, 1, 1}));
  io::PictureOptions options = bare_square("anterior");
  const Rgb blue = {0, 114, 178};
  options.marks = {{box({20, -10, -30}, {21, 10, -20}), {0, 114, 178}},
                   {box({-30, -10, 20}, {-29, 10, 30}), {0, 114, 178}},
                   {box({-30, 42, -5}, {-29, 48, 5}), {0, 114, 178}}};
  const io::Picture picture = io::draw_joint(joint, {}, Pose::Identity(), options);
  expect_colour(at_mm(picture, 25, 0), blue, 1, "before the bone");
  Rgb through;
  for (std::size_t k = 0; k < 3; ++k) through[k] = 0.45 * blue[k] + 0.55 * io::fixed_bone[k];
  expect_colour(at_mm(picture, -25, 0), through, 1.5, "behind it");
  expect_colour(at_mm(picture, 0, 45), blue, 1, "behind nothing");
  expect_colour(at_mm(picture, 0, 0), io::fixed_bone, 1, "beside them");
}

TEST(PictureMarks, OfMeasuresLieWhereTheyWereMeasured) {
  measure::HipMeasures measures;
  EXPECT_TRUE(io::measure_marks(measures, Pose::Identity()).empty());
  const Vec3 head(1, 2, 3), down = -Vec3::UnitY();
  measures.femur.neck = measure::NeckGeometry{
      {head, 24}, down, {}, {Vec3::UnitX(), Vec3::UnitZ()}, measure::ClockSource::frame};
  measures.acetabulum.plane =
      measure::RimGeometry{Vec3(0, 0, 10), Vec3::UnitZ(), 30, {Vec3::UnitY(), Vec3::UnitX()}};
  measures.acetabulum.rim = {
      {0, Vec3(0, 30, 10), 0, 0, true}, {1, Vec3(5, -20, 12), 0, 0, false}, {2, {}, 0, 0, false}};
  Pose X_FM(Eigen::Translation3d(100, 0, 0));
  const std::vector<io::PictureMark> marks = io::measure_marks(measures, X_FM);
  ASSERT_EQ(marks.size(), 5u);
  const auto expect_bounds = [](const TriMesh& mesh, const Vec3& low, const Vec3& high, const char* what) {
    const BoundingBox box = mesh::bounds_of_surface(mesh);
    EXPECT_LT((box.low - low).cwiseAbs().maxCoeff(), 0.02) << what << ": " << box.low.transpose();
    EXPECT_LT((box.high - high).cwiseAbs().maxCoeff(), 0.02) << what << ": " << box.high.transpose();
  };
  const double line = 0.5, dot = 0.9;
  expect_bounds(marks[0].mesh, Vec3(-30 - line, -30 - line, 10 - line), Vec3(30 + line, 30 + line, 35),
                "plane");
  expect_bounds(marks[1].mesh, Vec3(-dot, 30 - dot, 10 - dot), Vec3(dot, 30 + dot, 10 + dot), "in the plane");
  expect_bounds(marks[2].mesh, Vec3(5 - dot, -20 - dot, 12 - dot), Vec3(5 + dot, -20 + dot, 12 + dot),
                "off it");
  expect_bounds(marks[3].mesh, Vec3(101 - line, 2 - 48, 3 - line), Vec3(101 + line, 2 + 1.3 * 24, 3 + line),
                "the neck's axis, with the femur");
  expect_bounds(marks[4].mesh, Vec3(101, 2 - line, 3 - line), Vec3(101 + 1.3 * 24, 2 + line, 3 + line),
                "12 o'clock, with the femur");
}

TEST(Picture, FitsBothBodiesWhateverIsHidden) {
  Joint joint = joint_of(fine_box({-5, 300, -5}, {5, 310, 5}), fine_box({-5, -80, -5}, {5, -70, 5}));
  io::PictureOptions options = bare_square("anterior");
  options.field_mm = HUGE_VAL;
  const io::Picture both = io::draw_joint(joint, {}, Pose::Identity(), options);
  // 390 mm within 92 % of 200 pixels: the boxes are 4.7 pixels high, at either end of the picture's middle column.
  expect_colour(pixel(both, 100, 10), io::fixed_bone, 1, "fixed");
  expect_colour(pixel(both, 100, 189), io::mobile_bone, 1, "mobile");
  options.fixed = io::BodyStyle::hidden;
  const io::Picture one = io::draw_joint(joint, {}, Pose::Identity(), options);
  expect_colour(pixel(one, 100, 10), io::white, 0, "fixed");
  expect_colour(pixel(one, 100, 189), io::mobile_bone, 1, "mobile");
}

/// How many mm high the scene of a picture is that shows a box of 10 mm, and where the box's middle is, in pixels from the scene's.
struct Shown {
  double height_mm, to_right, upwards;
};

/// The mobile body is hidden.
Shown box_shown(const Joint& joint, io::PictureColour colour, std::optional<double> height_mm) {
  io::PictureOptions options = bare_square("anterior");
  options.colour = colour, options.field_mm = height_mm, options.mobile = io::BodyStyle::hidden;
  const io::Picture picture = io::draw_joint(joint, {}, Pose::Identity(), options);
  const std::size_t rows = side_px - io::legend_height(options);
  std::size_t left = side_px, right = 0, top = rows, bottom = 0;
  // The mark of zero reaches a pixel beyond a legend as low as this one.
  for (std::size_t row = 0; row + 1 < rows; ++row)
    for (std::size_t column = 0; column < side_px; ++column)
      if (pixel(picture, column, row) != io::white) {
        left = std::min(left, column), right = std::max(right, column + 1);
        top = std::min(top, row), bottom = std::max(bottom, row + 1);
      }
  const auto half = [](std::size_t twice) { return static_cast<double>(twice) / 2; };
  return {5 * static_cast<double>(rows) / half(bottom - top), half(left + right) - half(side_px),
          half(rows) - half(top + bottom)};
}

TEST(PictureField, IsTwoAndAHalfRadiiOfTheHeadAboutTheCentreOrAllOfBothBodies) {
  // A head of 20 mm: 100 mm high, 2 pixels a mm. A speck inside the head changes nothing.
  const TriMesh mobile = joined(sphere({0, 0, 0}, 20, 4), fine_box({-5, -300, -5}, {5, -21, 5}));
  const Joint ball = joint_of(fine_box({-5, 10, -5}, {5, 20, 5}), mobile);
  for (const Joint& joint :
       {ball, joint_of(ball.fixed.mesh.arrays(), joined(mobile, box({-1, -1, -1}, {1, 1, 1})))}) {
    const Shown shown = box_shown(joint, io::PictureColour::none, std::nullopt);
    EXPECT_NEAR(shown.height_mm, 100, 5);
    EXPECT_NEAR(shown.to_right, 0, 1);
    EXPECT_NEAR(shown.upwards, 30, 1);
  }
  // 320 mm within 92 % of the picture, so 1.74 to a pixel: of the box's 5.75 pixels 5 to 7 are seen.
  const Joint hinge{"boxes", JointKind::hinge, Side::right, ball.fixed, ball.mobile};
  for (const Shown& all : {box_shown(hinge, io::PictureColour::none, std::nullopt),
                           box_shown(ball, io::PictureColour::none, HUGE_VAL)}) {
    EXPECT_GE(all.height_mm, 10 * side_px / 7.);
    EXPECT_LE(all.height_mm, 10 * side_px / 5.);
  }
}

TEST(PictureField, IsThreeTimesTheContactOrHalfTheJointAboutItsMiddle) {
  // A box of 10 mm within the mobile body, beside a head about the centre.
  const auto shown = [](double radius) {
    return box_shown(
        joint_of(fine_box({-5, -85, 20}, {5, -75, 30}),
                 joined(sphere({0, 0, 0}, radius, 4), fine_box({-40, -300, -40}, {40, -40, 40}))),
        io::PictureColour::nearest, std::nullopt);
  };
  for (const auto& [radius, height] : {std::pair{8.0, 30.0}, std::pair{32.0, 80.0}}) {
    EXPECT_NEAR(shown(radius).height_mm, height, 0.05 * height);
    EXPECT_NEAR(shown(radius).to_right, 0, 1);
    EXPECT_NEAR(shown(radius).upwards, 0, 1);
  }
}

TEST(PictureKey, HasASwatchOfEachMeaningUnderThePicture) {
  const Rgb blue = {0, 114, 178}, red = {200, 0, 0};
  io::PictureOptions options = bare_square("anterior");
  options.marks = {{box({20, -10, -30}, {21, 10, -20}), {0, 114, 178}, "a plane"},
                   {box({20, -10, 20}, {21, 10, 30}), {0, 114, 178}, "a plane"},
                   {box({20, 20, -5}, {21, 30, 5}), {200, 0, 0}}};
  EXPECT_EQ(io::legend_height(options), 0u) << "plain pictures have none";
  options.is_annotated = true;
  const std::size_t key = io::legend_height(options);
  ASSERT_EQ(key, 16u);
  const io::Picture picture = io::draw_joint(plate_before_plate(), {}, Pose::Identity(), options);
  std::size_t swatches = 0, reds = 0;
  for (std::size_t column = 1; column < side_px; ++column) {
    const std::size_t row = side_px - key / 2 - 1;
    swatches += pixel(picture, column, row) == blue && pixel(picture, column - 1, row) == io::black;
    reds += pixel(picture, column, row) == red;
  }
  EXPECT_EQ(swatches, 1u);
  EXPECT_EQ(reds, 0u) << "without a meaning";
}

/// A bone of which a millimetre goes at one vertex.
plan::CutBone cut_at(const Vec3& place) {
  const TriMesh surface = box(place, place + Vec3(10, 10, 10));
  plan::CutBone cut{{"bone", surface}, surface, {}, {}, {}, 0, 0, 0, 0, 0, 0, Vec3::Zero()};
  cut.depth_mm.assign(surface.vertices.size(), 0);
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    if (surface.vertices[v] == place) cut.depth_mm[v] = 1;
  return cut;
}

TEST(PictureKey, OfACutHasItsDepthsInMillimetres) {
  plan::CutBone cut = cut_at({20, -40, 60});
  cut.deepest_mm = 1;
  const std::vector<io::PictureMark> bands = io::depth_bands(cut);
  ASSERT_EQ(bands.size(), 4u);
  EXPECT_EQ(bands[0].meaning, "0-0.25");
  EXPECT_EQ(bands[1].meaning, "0.25-0.5");
  EXPECT_EQ(bands[3].meaning, "0.75-1 mm deep");
  cut.deepest_mm = 20;
  std::replace(cut.depth_mm.begin(), cut.depth_mm.end(), 1.0, 20.0);
  EXPECT_EQ(io::depth_bands(cut).back().meaning, "over 12 mm deep");
}

TEST(Picture, SmoothsEdges) {
  // An edge through the middle of pixels: 2 pixels a mm, from z = -10.25 to 10.25.
  const Joint joint =
      joint_of(fine_box({0, -10, -10.25}, {5, 10, 10.25}), fine_box({-60, -1, -1}, {-58, 1, 1}));
  const io::Picture picture = io::draw_joint(joint, {}, Pose::Identity(), bare_square("anterior"));
  const double shade = at_mm(picture, 10.1, 0.3)[2], inside = at_mm(picture, 9.6, 0.3)[2];
  EXPECT_NEAR(shade, (inside + 255) / 2, 8);
}

TEST(PictureLegend, IsTheScaleWithItsZero) {
  io::PictureOptions options{.colour = io::PictureColour::gap, .width = 400, .height = 300, .range_mm = 4};
  const io::Picture picture = io::draw_joint(plate_before_plate(), {}, Pose::Identity(), options);
  const std::size_t legend = io::legend_height(options), row = 300 - legend + legend / 4;
  // The bar reaches from 32 to 68 % of the width.
  const io::ColourScale scale{io::PictureColour::gap, 4};
  for (const std::size_t column : {130u, 160u, 190u, 210u, 240u, 270u})
    expect_colour(pixel(picture, column, row),
                  *scale.at(-4 + 8 * (static_cast<double>(column) + 0.5 - 128) / 144), 1,
                  std::to_string(column));
  expect_colour(pixel(picture, 200, row + legend / 4), io::black, 0, "the mark of zero");
  EXPECT_GT(pixels_like(picture, io::black), 200u);
  EXPECT_EQ(io::legend_height({.colour = io::PictureColour::none}), 0u);
}

TEST(Picture, IsTheSameBytesOnOneThreadAndOnTwo) {
  const Joint joint = joint_of(sphere({0, 0, 0}, 30, 4), sphere({10, 20, -5}, 15, 4));
  const auto draw = [&](std::size_t threads) {
    const core::ThreadLimit limit(threads);
    return io::draw_joint(joint, {}, Pose::Identity(),
                          {.fixed = io::BodyStyle::transparent, .width = 300, .height = 200})
        .rgb;
  };
  EXPECT_EQ(draw(1), draw(2));
}

TEST(Picture, RefusesWhatItCannotDraw) {
  const Joint joint = plate_before_plate();
  const auto draw = [&](const io::PictureOptions& options) {
    return io::draw_joint(joint, {}, Pose::Identity(), options);
  };
  EXPECT_THROW(draw({.width = 63}), UsageError);
  EXPECT_THROW(draw({.height = 8193}), UsageError);
  for (const double bad : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW(draw({.range_mm = bad}), UsageError);
    EXPECT_THROW(draw({.field_mm = bad}), UsageError);
  }
  EXPECT_THROW(draw({.range_mm = HUGE_VAL}), UsageError);
  EXPECT_THROW(draw({.field_mm = 2e5}), UsageError);
  TriMesh open = joint.fixed.mesh.arrays();
  open.triangles.pop_back();
  const Joint with_open = joint_of(open, joint.mobile.mesh);
  for (const io::PictureColour colour : {io::PictureColour::depth, io::PictureColour::gap})
    EXPECT_THROW(io::draw_joint(with_open, {}, Pose::Identity(), {.colour = colour}), MeshError);
  expect_colour(middle_of(coloured(with_open, io::PictureColour::nearest)),
                *io::ColourScale{io::PictureColour::nearest, 8}.at(5), 1, "nearest");
}

TEST(PicturePng, ReadsBackWithItsProvenance) {
  const TemporaryFolder folder;
  const io::Picture picture =
      io::draw_joint(plate_before_plate(), {}, Pose::Identity(), {.width = 80, .height = 64});
  io::Provenance from{};
  from.command = {"picture", "joint.toml"};
  io::write_png(folder / "new/p.png", picture, &from);
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName((folder / "new/p.png").c_str());
  reader->Update();
  vtkImageData& image = *reader->GetOutput();
  ASSERT_EQ(image.GetDimensions()[0], 80);
  ASSERT_EQ(image.GetDimensions()[1], 64);
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 80; ++column)
      for (int k = 0; k < 3; ++k)
        ASSERT_EQ(image.GetScalarComponentAsDouble(column, 63 - row, 0, k),
                  picture.rgb[static_cast<std::size_t>(3 * (row * 80 + column) + k)]);
  expect_says(io::read_whole_file(folder / "new/p.png"), "picture joint.toml");
  folder.file("file", "in the way");
  EXPECT_THROW(io::write_png(folder / "file/p.png", picture), FileError);
}

// Seen from in front, superior up: pictures are four wide and three high, about the joint centre.
TEST(Picture, ACutIsInItsPictureHoweverFarFromTheJointCentre) {
  const io::ViewDirection from_in_front;
  EXPECT_EQ(io::field_of(cut_at({20, -40, 60}), from_in_front), 110);
  EXPECT_NEAR(io::field_of(cut_at({20, -80, 60}), from_in_front), 2.2 * 80, 1e-9);
  EXPECT_NEAR(io::field_of(cut_at({20, -40, -100}), from_in_front), 2.2 * 75, 1e-9);
}

}  // namespace
}  // namespace condyle::test
