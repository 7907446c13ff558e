#include <fmt/format.h>
#include <fmt/ranges.h>

#include "condyle/io/mesh_file.hpp"
#include "condyle/io/model_file.hpp"
#include "condyle/io/provenance.hpp"
#include "io/motion/motion_text.hpp"
#include "support/test.hpp"

// Joint frames that are turned in their bodies: angles are named by the body's axes, X forwards, Y up and Z to the right.

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Matrix3d;

constexpr double pi = std::numbers::pi;

Matrix3d about(const Vec3& axis, double radians) {
  return Eigen::AngleAxisd(radians, axis.normalized()).toRotationMatrix();
}

/// Body-fixed X-Y-Z angles of a rotation, R = Rx Ry Rz.
std::string orientation_of(const Matrix3d& R) {
  const double y = std::asin(std::clamp(R(0, 2), -1.0, 1.0));
  if (std::abs(R(0, 2)) > 1 - 1e-12) return fmt::format("{:.17g} {:.17g} 0", std::atan2(R(2, 1), R(1, 1)), y);
  return fmt::format("{:.17g} {:.17g} {:.17g}", std::atan2(-R(1, 2), R(2, 2)), y,
                     std::atan2(-R(0, 1), R(0, 0)));
}

std::string numbers_of(const Vec3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

/// The 24 turns after which axes lie along axes.
std::vector<Matrix3d> quarter_turns() {
  std::vector<Matrix3d> turns;
  for (int x = 0; x < 6; ++x)
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      Matrix3d R = Matrix3d::Zero();
      R(x % 3, 0) = x < 3 ? 1 : -1;
      R(y % 3, 1) = y < 3 ? 1 : -1;
      R.col(2) = R.col(0).cross(R.col(1));
      turns.push_back(R);
    }
  return turns;
}

std::vector<Matrix3d> oblique_turns() {
  return {about({1, 2, 3}, 0.4), about({0, 1, 0}, 0.9), about({1, -1, 0.3}, 2), about({-3, 0.1, 1}, 3)};
}

/// A rotation or translation of a CustomJoint, its axis in the joint's frame.
struct Axis {
  std::string_view coordinate;
  Vec3 direction;
  double slope = 1, offset = 0;
};

/// A model of two bodies, the joint's frame turned by R_PF in the parent and the child alike, so that both are as they lie at 0.
struct TurnedModel {
  std::string type = "CustomJoint", name = "knee_r", parent = "femur_r", child = "tibia_r";
  std::vector<std::string> coordinates = {"q"};
  std::array<Axis, 6> axes = {Axis{"", Vec3::UnitX()}, {"", Vec3::UnitY()}, {"", Vec3::UnitZ()},
                              {"", Vec3::UnitX()},     {"", Vec3::UnitY()}, {"", Vec3::UnitZ()}};
  Matrix3d R_PF = Matrix3d::Identity();
  Matrix3d R_GP = Matrix3d::Identity();  ///< the parent in the ground

  std::string transform() const {
    constexpr const char* names[] = {"rotation1",    "rotation2",    "rotation3",
                                     "translation1", "translation2", "translation3"};
    std::string text = "<SpatialTransform>";
    for (std::size_t i = 0; i < 6; ++i)
      text += fmt::format(
          "<TransformAxis name=\"{}\"><coordinates>{}</coordinates><axis>{}</axis>{}</TransformAxis>",
          names[i], axes[i].coordinate, numbers_of(axes[i].direction),
          axes[i].coordinate.empty()
              ? "<Constant><value>0</value></Constant>"
              : fmt::format("<LinearFunction><coefficients>{} {}</coefficients></LinearFunction>",
                            axes[i].slope, axes[i].offset));
    return text + "</SpatialTransform>";
  }

  static std::string frame(std::string_view name, std::string_view body, std::string_view place,
                           const Matrix3d& R) {
    return fmt::format(
        "<PhysicalOffsetFrame "
        "name=\"{}\"><socket_parent>/bodyset/{}</socket_parent><translation>{}</translation>"
        "<orientation>{}</orientation></PhysicalOffsetFrame>",
        name, body, place, orientation_of(R));
  }

  std::string text() const {
    std::string list;
    for (const std::string& each : coordinates) list += fmt::format("<Coordinate name=\"{}\"/>", each);
    return fmt::format(
        R"(<OpenSimDocument Version="40000"><Model name="turned"><BodySet><objects>
<Body name="{0}"><attached_geometry><Mesh name="m"><mesh_file>a.ply</mesh_file></Mesh></attached_geometry></Body>
<Body name="{1}"><attached_geometry><Mesh name="m"><mesh_file>b.ply</mesh_file></Mesh></attached_geometry></Body></objects></BodySet>
<JointSet><objects><WeldJoint name="root"><socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>in_ground</socket_child_frame><frames>{2}</frames></WeldJoint>
<{3} name="{4}"><socket_parent_frame>p</socket_parent_frame><socket_child_frame>c</socket_child_frame>
<coordinates>{5}</coordinates><frames>{6}{7}</frames>{8}</{3}></objects></JointSet></Model></OpenSimDocument>)",
        parent, child, frame("in_ground", parent, "0 0 0", R_GP.transpose()), type, name, list,
        frame("p", parent, "0.01 -0.4 0.02", R_PF), frame("c", child, "0.003 0.02 0", R_PF),
        type == "CustomJoint" ? transform() : "");
  }
};

class TurnedFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* mesh : {"a.ply", "b.ply"})
      io::write_mesh(folder_.path() / mesh, test::box({-0.02, -0.03, -0.02}, {0.03, 0.02, 0.01}));
  }

  io::Model read(const TurnedModel& model) const {
    return io::read_model(folder_.file("model.osim", model.text()));
  }

  struct Answer {
    io::LoadedJoint loaded;
    std::array<double, 3> angles = {};  ///< flexion, adduction, internal rotation, radians
    bool by_columns = false;
    Matrix3d R_PA = Matrix3d::Identity();  ///< the joint frame in the parent's body
  };
  /// What a motion of these coordinates, radians and metres, is called.
  Answer answer(const TurnedModel& of, const std::vector<double>& q, std::optional<Anatomy> anatomy = {},
                std::optional<Side> side = {}) const {
    const io::Model model = read(of);
    Answer out{.loaded = io::read_joint(
                   model, {.joint = of.name, .joint_file = {}, .anatomy = anatomy, .side = side})};
    std::vector<std::vector<double>> values;
    for (const double value : q) values.push_back({value});
    const std::vector<std::string> columns(of.coordinates.begin(),
                                           of.coordinates.begin() + static_cast<std::ptrdiff_t>(q.size()));
    const Pose X_FM = *io::motion_of(out.loaded, test::motion_table(columns, values)).X_FM[0];
    const JointAngles angles = angles_at(out.loaded.joint.coordinates(), X_FM);
    out.angles = {angles.flexion.radians(), angles.adduction.radians(), angles.internal_rotation.radians()};
    out.by_columns =
        std::holds_alternative<std::vector<io::ColumnOfCoordinate>>(*out.loaded.report.file.recorded_motion);
    const io::Provenance from = io::provenance_of(out.loaded, {});
    out.R_PA = from.fixed.source_from_joint.linear() / 0.001;
    // Whatever its angles are called, the child lies where the model has it.
    const Eigen::Affine3d X =
        from.fixed.source_from_joint * Eigen::Affine3d(X_FM) * from.mobile.joint_from_source;
    EXPECT_LE((X.matrix() - io::pose_of(io::joint_named(model, of.name), q).matrix()).cwiseAbs().maxCoeff(),
              1e-12);
    return out;
  }

  std::vector<std::string> notes(const TurnedModel& of, std::optional<Anatomy> anatomy = {}) const {
    std::vector<std::string> lines;
    for (const io::ModelNote& note :
         io::propose_joint(read(of), {.joint = of.name, .joint_file = {}, .anatomy = anatomy}).notes)
      if (note.code == io::ModelNoteCode::turned_frame || note.code == io::ModelNoteCode::oblique_axis)
        lines.push_back(io::to_text(note));
    return lines;
  }

  std::string proposal(const TurnedModel& of) const {
    return io::propose_joint(read(of), {.joint = of.name, .joint_file = {}}).proposal.toml;
  }

  const test::TemporaryFolder folder_;
};

void expect_angles(const std::array<double, 3>& angles, const std::array<double, 3>& wanted) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(angles[i], wanted[i], 1e-12) << "angle " << i;
}

/// The angle that grows about an axis of the body, +-X, +-Y or +-Z, and its sense: docs/joint-frame.md, "Signs".
std::array<double, 3> turn_about(const Vec3& axis, double angle, Anatomy anatomy, Side side) {
  const double sideways = side == Side::right ? 1 : -1, flexion = anatomy == Anatomy::knee ? -1 : 1;
  return {flexion * axis.z() * angle, sideways * axis.x() * angle, sideways * axis.y() * angle};
}

constexpr std::array unit_axes = {0, 1, 2};

TEST_F(TurnedFrames, OfAMovingKneeKeepTheNamesOfAngles) {
  std::vector<Matrix3d> turns = quarter_turns();
  for (const Matrix3d& R : oblique_turns()) turns.push_back(R);
  for (const Matrix3d& R : turns)
    for (const int axis : unit_axes)
      for (const double sense : {1.0, -1.0}) {
        const Vec3 in_body = sense * Vec3::Unit(axis);
        // The same motion of the bones in every frame: a turn about the body's axis, and a slide along its X.
        TurnedModel model{.R_PF = R};
        model.axes[0] = {"q", R.transpose() * in_body};
        model.axes[1].direction = R.transpose() * Vec3::Unit((axis + 1) % 3);
        model.axes[2].direction = R.transpose() * Vec3::Unit((axis + 2) % 3);
        model.axes[3] = {"q", R.transpose() * Vec3::UnitX(), 0.002, 0};
        model.axes[4].direction = R.transpose() * Vec3::UnitY();
        model.axes[5].direction = R.transpose() * Vec3::UnitZ();
        for (const bool is_left : {false, true}) {
          if (is_left) model.name = "knee_l", model.parent = "femur_l", model.child = "tibia_l";
          for (const Anatomy anatomy : {Anatomy::knee, Anatomy::ankle}) {
            const Answer made = answer(model, {0.5}, anatomy);
            EXPECT_EQ(made.loaded.joint.kind, JointKind::free);
            EXPECT_LE((made.R_PA - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12) << R;
            expect_angles(made.angles, turn_about(in_body, 0.5, anatomy, is_left ? Side::left : Side::right));
          }
        }
      }
}

TEST_F(TurnedFrames, OfHipsKeepTheirColumns) {
  for (const Matrix3d& R : quarter_turns())
    for (const bool is_left : {false, true})
      for (const double sense : {1.0, -1.0}) {
        TurnedModel model{.name = "hip_r",
                          .parent = "pelvis_r",
                          .child = "femur_r",
                          .coordinates = {"f", "a", "r"},
                          .R_PF = R};
        if (is_left) model.name = "hip_l", model.parent = "pelvis", model.child = "femur_l";
        constexpr std::array names = {"f", "a", "r"};
        const Vec3 turning[] = {Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
        for (std::size_t i = 0; i < 3; ++i) model.axes[i] = {names[i], sense * R.transpose() * turning[i]};
        const Answer made = answer(model, {0.6, 0.2, -0.3});
        EXPECT_EQ(made.loaded.joint.kind, JointKind::ball);
        EXPECT_TRUE(made.by_columns) << R;
        const double sideways = is_left ? -1 : 1;
        expect_angles(made.angles, {sense * 0.6, sense * sideways * 0.2, -sense * sideways * 0.3});
      }
}

TEST_F(TurnedFrames, OfPinsTurnTowardsTheBodysRight) {
  for (const double sense : {1.0, -1.0})
    for (const double about_z : {0.0, 1.0, 3.0}) {
      // F's Z to the right or to the left, its X anywhere across it.
      TurnedModel model{.type = "PinJoint",
                        .R_PF = (sense > 0 ? Matrix3d::Identity().eval() : about(Vec3::UnitY(), pi)) *
                                about(Vec3::UnitZ(), about_z)};
      for (const Anatomy anatomy : {Anatomy::knee, Anatomy::elbow}) {
        const Answer made = answer(model, {0.7}, anatomy);
        EXPECT_EQ(made.loaded.joint.kind, JointKind::hinge);
        EXPECT_LE((made.R_PA.col(2) - Vec3::UnitZ()).norm(), 1e-12);
        expect_angles(made.angles, {(anatomy == Anatomy::knee ? -sense : sense) * 0.7, 0, 0});
        EXPECT_EQ(notes(model, anatomy), std::vector<std::string>{});
      }
      test::expect_says(proposal(model), sense > 0 ? "# q grows with extension" : "# q grows with flexion");
    }
}

TEST_F(TurnedFrames, OfObliqueHingesTurnAboutTheAxisItself) {
  // F lies along the axis, as a Pin needs it.
  const auto hinge_about = [](const Vec3& axis, const char* name, const char* parent, const char* child) {
    const Vec3 z = axis.normalized(), x = z.cross(Vec3(0.3, -0.5, 0.8)).normalized();
    Matrix3d R;
    R << x, z.cross(x), z;
    return TurnedModel{.type = "PinJoint", .name = name, .parent = parent, .child = child, .R_PF = R};
  };
  const Vec3 ankle(-0.105, -0.174, 0.979);
  for (const double sense : {1.0, -1.0}) {
    const TurnedModel model = hinge_about(sense * ankle, "ankle_r", "tibia_r", "talus_r");
    const Answer made = answer(model, {0.3});
    expect_angles(made.angles, {sense * 0.3, 0, 0});
    EXPECT_LE((made.R_PA.col(2) - ankle.normalized()).norm(), 1e-12);
    EXPECT_GT(made.R_PA(0, 0), 0.9) << "X stays forwards";
    EXPECT_EQ(notes(model), std::vector<std::string>{});
  }
  // A left joint that is the mirror image has the same angle.
  const Vec3 subtalar(0.787, 0.605, -0.121);
  const Answer right = answer(hinge_about(subtalar, "s_r", "talus_r", "calcn_r"), {0.3}, Anatomy::ankle),
               left = answer(hinge_about({-0.787, -0.605, -0.121}, "s_l", "talus_l", "calcn_l"), {0.3},
                             Anatomy::ankle);
  expect_angles(right.angles, {-0.3, 0, 0});
  expect_angles(left.angles, right.angles);
}

TEST_F(TurnedFrames, OfHingesAcrossTheDirectionToTheRightAreNoted) {
  const auto with = [](const Vec3& axis, bool is_left) {
    const Vec3 x = axis.cross(Vec3(0.3, -0.5, 0.8)).normalized();
    Matrix3d R;
    R << x, axis.cross(x), axis;
    TurnedModel model{.type = "PinJoint", .R_PF = R};
    if (is_left) model.name = "knee_l", model.parent = "femur_l", model.child = "tibia_l";
    return model;
  };
  // Positive is adduction, about +X on the right and -X on the left, or internal rotation.
  EXPECT_EQ(
      notes(with(Vec3::UnitX(), false)),
      std::vector<std::string>{
          "oblique_axis: the axis is 90 degrees from the direction to the right, nearest to X, forwards: the "
          "angle is called flexion nevertheless, positive about (1.000, 0.000, 0.000) of body 'femur_r'"});
  EXPECT_EQ(notes(with(-Vec3::UnitX(), true)).front().find("nearest to -X, backwards") == std::string::npos,
            false);
  for (const Vec3& axis : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY())})
    for (const double sense : {1.0, -1.0})
      for (const bool is_left : {false, true})
        expect_angles(answer(with(sense * axis, is_left), {0.4}).angles,
                      {(is_left ? -sense : sense) * 0.4, 0, 0});
  test::expect_says(notes(with(Vec3::UnitY(), false)).front(), "nearest to Y, up");
  // Just beside the bound of 45 degrees.
  EXPECT_EQ(notes(with({std::sin(0.785), 0, std::cos(0.785)}, false)), std::vector<std::string>{});
  EXPECT_EQ(notes(with({std::sin(0.786), 0, std::cos(0.786)}, false)).size(), 1u);
  // Superior still points up.
  EXPECT_LE((answer(with(Vec3::UnitX(), false), {0.4}).R_PA.col(1) - Vec3::UnitY()).norm(), 1e-12);
}

TEST_F(TurnedFrames, OfEveryTypeOfJointHaveTheBodysAxes) {
  const std::pair<const char*, std::vector<std::string>> types[] = {
      {"UniversalJoint", {"a", "b"}},
      {"BallJoint", {"a", "b", "c"}},
      {"GimbalJoint", {"a", "b", "c"}},
      {"PlanarJoint", {"a", "x", "y"}},
      {"FreeJoint", {"a", "b", "c", "x", "y", "z"}},
      {"SliderJoint", {"x"}}};
  const std::vector<double> values = {0.3, -0.2, 0.25, 0.01, -0.02, 0.03};
  for (const Matrix3d& R : quarter_turns())
    for (const auto& [type, coordinates] : types) {
      SCOPED_TRACE(type);
      const TurnedModel model{.type = type, .coordinates = coordinates, .R_PF = R};
      const std::vector<double> q(values.begin(),
                                  values.begin() + static_cast<std::ptrdiff_t>(coordinates.size()));
      const Answer made = answer(model, q);
      EXPECT_LE((made.R_PA - Matrix3d::Identity()).cwiseAbs().maxCoeff(), 1e-12);
      // Parent and child are turned alike: the child's rotation in the parent is that of the joint.
      const Pose X_FM = [&] {
        Pose turned = Pose::Identity();
        turned.linear() = io::pose_of(io::joint_named(read(model), model.name), q).linear();
        return turned;
      }();
      const JointAngles wanted = angles_at(made.loaded.joint.coordinates(), X_FM);
      expect_angles(made.angles, {wanted.flexion.radians(), wanted.adduction.radians(),
                                  wanted.internal_rotation.radians()});
    }
}

TEST_F(TurnedFrames, LaidAlongABonesFunctionKeepTheirOwnAxes) {
  // The knee of Rajagopal et al. (2016): X to the left, some degrees off.
  const Matrix3d R =
      about(Vec3::UnitX(), -1.64157) * about(Vec3::UnitY(), 1.44618) * about(Vec3::UnitZ(), 1.5708);
  TurnedModel model{.R_PF = R};
  model.axes[0] = {"q", Vec3::UnitX()};
  model.axes[3] = {"q", Vec3::UnitX(), 0.002, 0};
  const Answer made = answer(model, {1.2});
  expect_angles(made.angles, {1.2, 0, 0});
  EXPECT_LE((made.R_PA.col(2) + R.col(0)).norm(), 1e-12) << "Z is -X of the frame";
  EXPECT_EQ(notes(model),
            std::vector<std::string>{
                "turned_frame: the joint's frame is turned in body 'femur_r', its X along -Z, to the left, "
                "its Y along Y, "
                "up and its Z along X, forwards: angles are named by the body's axes; q grows with flexion"});
  test::expect_says(proposal(model), "# q grows with flexion\nmodel = ");
}

TEST_F(TurnedFrames, FarFromEveryAxisGiveWayToTheBodys) {
  for (const double off : {29.9, 30.1}) {
    const Matrix3d R = about(Vec3::UnitY(), off * pi / 180);
    TurnedModel model{
        .name = "hip_r", .parent = "pelvis", .child = "femur_r", .coordinates = {"f", "a", "r"}, .R_PF = R};
    model.axes[0] = {"f", Vec3::UnitZ()};
    model.axes[1] = {"a", Vec3::UnitX()};
    model.axes[2] = {"r", Vec3::UnitY()};
    const Answer made = answer(model, {0.6, 0, 0});
    const bool is_far = off > 30;
    EXPECT_EQ(made.by_columns, !is_far);
    EXPECT_LE((made.R_PA - (is_far ? Matrix3d::Identity().eval() : R)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(notes(model).size(), is_far ? 1u : 0u);
  }
}

TEST_F(TurnedFrames, InABodyThatLiesTurnedItselfStandUpright) {
  // Bodies in the axes of a scanner, as some programs make models from images: X to the left, Y backwards, Z up.
  Matrix3d R_GP;
  R_GP << 0, -1, 0, 0, 0, 1, -1, 0, 0;
  TurnedModel model{.R_PF = R_GP.transpose(), .R_GP = R_GP};
  model.axes[0] = {"", Vec3::UnitX()};
  model.axes[2] = {"q", Vec3::UnitZ()};
  const Answer hinge = answer(model, {0.4});
  expect_angles(hinge.angles, {-0.4, 0, 0});
  EXPECT_LE((hinge.R_PA - R_GP.transpose()).cwiseAbs().maxCoeff(), 1e-12);
  // An axis 40 degrees from the ground's, as an ankle's: still of the ground, and not of the body.
  TurnedModel ankle = model;
  ankle.R_PF = R_GP.transpose() * about(Vec3::UnitY(), 40 * pi / 180);
  expect_angles(answer(ankle, {0.4}).angles, {-0.4, 0, 0});
  ASSERT_EQ(notes(model).size(), 1u);
  test::expect_says(notes(model)[0], "body 'femur_r' is 90 degrees from the ground's in the standing model");
  model.axes[3] = {"q", Vec3::UnitX(), 0.002, 0};
  expect_angles(answer(model, {0.4}).angles, {-0.4, 0, 0});
}

}  // namespace
}  // namespace condyle
