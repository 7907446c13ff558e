#include "io/picture/annotations.hpp"

#include "condyle/joint_coordinates.hpp"
#include "io/picture/colour_scale.hpp"
#include "support/test.hpp"

namespace condyle::test {
namespace {

bool is_black(const io::Picture& picture, std::size_t column, std::size_t row) {
  const std::uint8_t* rgb = &picture.rgb[3 * (row * picture.width + column)];
  return rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0;
}

Joint two_boxes(JointKind kind) {
  return {"boxes",
          kind,
          Side::right,
          {"fixed", box({0, 0, 0}, {1, 1, 1})},
          {"mobile", box({5, 0, 0}, {6, 1, 1})}};
}

JointAngles angles(double flexion, double adduction, double internal_rotation) {
  return {Angle::degrees(flexion), Angle::degrees(adduction), Angle::degrees(internal_rotation)};
}

}  // namespace

TEST(PictureAnnotations, NameTheNearestSideFirst) {
  EXPECT_EQ(io::orientation_letters({1, 0, 0}), "A");
  EXPECT_EQ(io::orientation_letters({0, -1, 0}), "I");
  EXPECT_EQ(io::orientation_letters({0, 0, -1}), "L");
  EXPECT_EQ(io::orientation_letters(Vec3(-0.5, 0, 0.8).normalized()), "RP");
  EXPECT_EQ(io::orientation_letters(Vec3(0.1, 1, 0.1).normalized()), "S")
      << "what is nearly along an edge is of that side";
}

TEST(PictureAnnotations, TakeOneTwoOrFiveForTheScale) {
  for (const auto& [longest, bar] :
       {std::pair{0.3, 0.2}, {1., 1.}, {1.99, 1.}, {4.9, 2.}, {5., 5.}, {99., 50.}, {100., 100.}})
    EXPECT_DOUBLE_EQ(io::scale_bar_mm(longest), bar) << longest;
}

TEST(PictureAnnotations, SayTheCoordinatesThatTheJointHas) {
  const Pose here = Pose::Identity();
  EXPECT_EQ(io::pose_line(two_boxes(JointKind::ball), angles(90, -0.04, 12.34), here),
            "flexion 90, adduction 0, internal rotation 12.3 deg");
  EXPECT_EQ(io::pose_line(two_boxes(JointKind::hinge), angles(30, 0, 0), here), "flexion 30 deg");
  Pose moved = here;
  moved.translation() = Vec3(1.5, 0, -2);
  EXPECT_EQ(io::pose_line(two_boxes(JointKind::free), angles(0, 0, 0), moved),
            "flexion 0, adduction 0, internal rotation 0 deg, x 1.5, y 0, z -2 mm");
}

TEST(PictureAnnotations, SayWhatThePoseIsToTheLimits) {
  const Joint joint{"boxes",
                    JointKind::hinge,
                    Side::right,
                    {"fixed", box({0, 0, 0}, {1, 1, 1})},
                    {"mobile", box({1.2, 0, 0}, {2, 1, 1})}};
  const auto caption = [&](const JointAngles& at) {
    return io::caption_of(joint, at, pose_at(joint.coordinates(), at));
  };
  EXPECT_EQ(caption({}), "flexion 0 deg, free");
  // An edge at (1.2, 0) turns to (0.85, 0.85).
  EXPECT_EQ(caption(angles(45, 0, 0)), "flexion 45 deg, in contact, and any contact ends a motion");
}

TEST(PictureAnnotations, DrawABarOfTheLengthItSays) {
  const Joint joint = two_boxes(JointKind::ball);
  const io::PictureOptions options{.view = io::view_named("anterior", Side::right),
                                   .colour = io::PictureColour::none,
                                   .width = 200,
                                   .height = 200,
                                   .field_mm = 100};
  // Two pixels a mm: a fifth of the width is 20 mm, so 40 pixels, 5 from the left and from below.
  const io::Picture picture = io::draw_joint(joint, {}, Pose::Identity(), options);
  std::size_t first = 200, last = 0;
  for (std::size_t column = 0; column < 100; ++column)
    if (is_black(picture, column, 194)) {
      first = std::min(first, column);
      last = column;
    }
  EXPECT_EQ(first, 5u);
  EXPECT_EQ(last + 1 - first, 40u);
  io::PictureOptions plain = options;
  plain.is_annotated = false;
  const io::Picture bare = io::draw_joint(joint, {}, Pose::Identity(), plain);
  for (std::size_t column = 0; column < 100; ++column) EXPECT_FALSE(is_black(bare, column, 194));
}

}  // namespace condyle::test
