#include "condyle/answer.hpp"
#include "condyle/inspect.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/resection.hpp"
#include "condyle/sample/hip.hpp"
#include "io/result/provenance_forms.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Parts of a body that planes cut from one of its meshes: `cut` of [[part]].

namespace condyle::cut_parts {
namespace {

std::string fragment_text(std::string_view planes, std::string_view more = "") {
  return "[[part]]\nname = \"fragment\"\nbody = \"fixed\"\ncut = [" + std::string(planes) + "]\n" +
         std::string(more) +
         "\n[[part.parameter]]\nname = \"frontal\"\nrange = [-40, 40]\n"
         "[[part.parameter]]\nname = \"lateral\"\nkind = \"translation\"\nalong = \"lateral\"\nrange = [-60, "
         "60]\n";
}

/// Above, behind and to the midline of the socket, and below it.
constexpr const char* around_socket =
    "{ point = [0, 46, 0], normal = [0, 0.96, -0.28] }, { point = [-44, 0, 0], normal = [-1, 0, 0] }, "
    "{ point = [0, 0, -44], normal = [0, 0, -1] }, { point = [0, -45, 0], normal = [0, -1, 0] }";

std::vector<motion::MotionLimit> limits_of(const io::LoadedJoint& joint) {
  return answer_range(joint, {.motions = motion::hip_motions()}).limits;
}

void expect_same(const std::vector<motion::MotionLimit>& limits,
                 const std::vector<motion::MotionLimit>& expected, double within_deg) {
  ASSERT_EQ(limits.size(), expected.size());
  for (std::size_t i = 0; i < limits.size(); ++i) {
    EXPECT_EQ(limits[i].end.reason, expected[i].end.reason) << limits[i].motion.name;
    EXPECT_EQ(limits[i].end.kind(), expected[i].end.kind()) << limits[i].motion.name;
    EXPECT_NEAR(limits[i].end.turned.degrees(), expected[i].end.turned.degrees(), within_deg)
        << limits[i].motion.name;
  }
}

void expect_sound_halves(const Joint& joint, const TriMesh& whole) {
  double volume = 0;
  ASSERT_TRUE(is_cut(joint.fixed));
  for (const BodyPart& part : joint.fixed.parts) {
    const MeshReport report = inspect(Mesh(mesh_of_part(joint.fixed, part.name)));
    EXPECT_TRUE(report.is_closed()) << part.name;
    EXPECT_EQ(report.self_crossings.count, 0u) << part.name;
    EXPECT_EQ(report.non_manifold_edges.count, 0u) << part.name;
    EXPECT_EQ(report.inverted_components.count, 0u) << part.name;
    EXPECT_EQ(report.unreferenced_vertices.count, 0u) << part.name;
    EXPECT_GT(part.cut_triangles, 0u);
    volume += *report.signed_volume;
  }
  // Points of the cuts are rounded: coordinates of less than 256 mm by 2^-46, on some square centimetres of outline.
  const MeshReport before = inspect(Mesh(whole));
  EXPECT_NEAR(volume, *before.signed_volume, before.area * 0x1p-46);
}

TriMesh turned(const TriMesh& mesh, double frontal_deg) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(frontal_deg * std::numbers::pi / 180, Vec3::UnitX()).toRotationMatrix();
  return test::mapped(mesh, [&](const Vec3& p) { return Vec3(R * p); });
}

class CutParts : public ::testing::Test {
 protected:
  void SetUp() override {
    static const sample::SampleHip hip = sample::sample_hip({}, sample::Scenario::two);
    hip_bone = hip.hip_bone, femur = hip.femur;
    io::write_mesh(folder / "hip_bone.ply", hip_bone);
    io::write_mesh(folder / "femur.ply", femur);
  }
  io::LoadedJoint read(const test::JointText& text, std::string_view name = "joint.toml") const {
    return io::read_joint(folder.file(name, test::joint_text(text)));
  }
  io::LoadedJoint read(std::string_view more, std::string_view fixed = plain,
                       std::string_view name = "joint.toml") const {
    const std::string named = "name = \"pelvis\"\n" + std::string(fixed);
    return read({.fixed = named, .mobile = femur_key, .more = more}, name);
  }
  std::string refusal(std::string_view more, std::string_view fixed = plain) const {
    return test::complaint_of([&] { read(more, fixed); });
  }

  static constexpr const char *plain = "mesh = \"hip_bone.ply\"",
                              *femur_key = "name = \"femur\"\nmesh = \"femur.ply\"";

  const test::TemporaryFolder folder;
  TriMesh hip_bone, femur;
};

TEST_F(CutParts, AreClosedAndTogetherTheBone) {
  const io::LoadedJoint joint = read(fragment_text(around_socket));
  ASSERT_EQ(joint.joint.fixed.parts.size(), 2u);
  EXPECT_EQ(joint.joint.fixed.parts[0].name, "pelvis");
  EXPECT_EQ(joint.joint.fixed.parts[1].name, "fragment");
  expect_sound_halves(joint.joint, hip_bone);
  const auto& lines = joint.report.processing;
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.rfind("fragment: cut from pelvis by 4 planes: ", 0) == 0;
  }));
  // A mesh that is named in a list keeps its name.
  const io::LoadedJoint named = read(fragment_text(around_socket, "meshes = [\"hip bone\"]"),
                                     "meshes = [{ name = \"hip bone\", mesh = \"hip_bone.ply\" }]");
  EXPECT_EQ(named.joint.fixed.parts[0].name, "hip bone");
  EXPECT_EQ(named.joint.fixed.mesh.arrays(), joint.joint.fixed.mesh.arrays());
}

TEST_F(CutParts, AsGivenHaveTheLimitsOfTheWholeBone) {
  const io::LoadedJoint cut = read(fragment_text(around_socket)), whole = read("");
  expect_same(limits_of(cut), limits_of(whole), 1e-9);
  const auto a = answer_measures(cut).measures, b = answer_measures(whole).measures;
  EXPECT_NEAR(*a.acetabulum.centre_edge_lateral.value, *b.acetabulum.centre_edge_lateral.value, 1e-9);
  EXPECT_NEAR(*a.acetabulum.inclination.value, *b.acetabulum.inclination.value, 1e-9);
  EXPECT_NEAR(*a.both.ischiofemoral.value, *b.both.ischiofemoral.value, 1e-9);
  EXPECT_NEAR(*a.both.joint_space_least.value, *b.both.joint_space_least.value, 1e-9);
  EXPECT_TRUE(a.left_out.empty());
  const auto codes_of = [](const io::LoadedJoint& loaded) {
    std::vector<std::string> codes;
    for (const RangeNote& note : answer_range(loaded, {.motions = motion::hip_motions()}).notes)
      codes.push_back(note.text);
    return codes;
  };
  EXPECT_EQ(codes_of(cut), codes_of(whole));
}

TEST_F(CutParts, TurnedHaveTheLimitsOfMeshesTurnedByHand) {
  const io::LoadedJoint cut = read(fragment_text(around_socket));
  const ParameterValue ten{"fragment.frontal", 10};
  const io::LoadedJoint there = with_parameters(cut, {&ten, 1});
  io::write_mesh(folder / "rest.ply", mesh_of_part(cut.joint.fixed, "pelvis"));
  io::write_mesh(folder / "turned.ply", turned(mesh_of_part(cut.joint.fixed, "fragment"), 10));
  const io::LoadedJoint by_hand =
      read("",
           "meshes = [{ name = \"rest\", mesh = \"rest.ply\" }, { name = \"fragment\", "
           "mesh = \"turned.ply\" }]",
           "by_hand.toml");
  expect_same(limits_of(there), limits_of(by_hand), 1e-6);
  EXPECT_NE(limits_of(there)[0].end.turned.degrees(), limits_of(cut)[0].end.turned.degrees());
  // The angle of a socket about the head's centre grows by the turn; the centre is fitted.
  const auto lateral = [](const io::LoadedJoint& of) {
    return *answer_measures(of).measures.acetabulum.centre_edge_lateral.value;
  };
  constexpr double off_centre_deg = 2 * 2e-7 / 20 * 180 / std::numbers::pi;
  EXPECT_NEAR(lateral(there), lateral(cut) + 10, off_centre_deg);
}

/// The head of a femur that is cut keeps what a fit found, by other numbers.
TEST_F(CutParts, OfAFemurLeaveItsHeadAndLimitsAsTheyAre) {
  const auto fitted = [&](std::string_view more, std::string_view name) {
    return read({.fixed = plain, .mobile = femur_key, .centre = "\"fit\"", .more = more}, name);
  };
  const io::LoadedJoint whole = fitted("", "whole.toml"),
                        cut = fitted(
                            "[[part]]\nname = \"shaft\"\nbody = \"mobile\"\ncentre = [0, -40, 38]\n"
                            "cut = [{ point = [0, -40, 0], normal = [0, 1, 0] }]\n"
                            "[[part.parameter]]\nname = \"version\"\nrange = [-40, 40]\n",
                            "cut.toml");
  ASSERT_TRUE(is_cut(cut.joint.mobile));
  expect_same(limits_of(cut), limits_of(whole), 1e-9);
  const auto a = answer_measures(cut).measures, b = answer_measures(whole).measures;
  EXPECT_NEAR(*a.femur.head_radius.value, *b.femur.head_radius.value, 1e-12);
  EXPECT_NEAR(*a.femur.neck_shaft.value, *b.femur.neck_shaft.value, 1e-9);
  EXPECT_NEAR(*a.femur.alpha_1_30.value, *b.femur.alpha_1_30.value, 1e-9);
  EXPECT_NEAR(*a.femur.trochanter_height.value, *b.femur.trochanter_height.value, 1e-9);
  EXPECT_TRUE(a.left_out.empty());
  // The shaft turns about its own point, the head stays.
  const ParameterValue fifteen{"shaft.version", 15};
  const io::LoadedJoint turned = with_parameters(cut, {&fifteen, 1});
  EXPECT_EQ(mesh_of_part(turned.joint.mobile, "femur").arrays(),
            mesh_of_part(cut.joint.mobile, "femur").arrays());
}

TEST_F(CutParts, AreCutWhereTheFileSaysInItsFrameAndUnits) {
  const io::LoadedJoint joint = read(fragment_text(around_socket));
  // Turned by a quarter about Z and shifted, which costs no bits but those of the shift.
  const auto elsewhere = [](const Vec3& p) { return Vec3(Vec3(-p.y() + 512, p.x(), p.z()) / 1000); };
  io::write_mesh(folder / "hip_bone_m.ply", test::mapped(hip_bone, elsewhere));
  io::write_mesh(folder / "femur_m.ply", test::mapped(femur, elsewhere));
  const std::string planes =
      "{ point = [0.466, 0, 0], normal = [-0.96, 0, -0.28] }, { point = [0.512, -0.044, 0], normal = [0, -1, "
      "0] }, { point = [0.512, 0, -0.044], normal = [0, 0, -1] }, { point = [0.557, 0, 0], normal = [1, 0, "
      "0] }";
  const io::LoadedJoint other = read({.units = "m",
                                      .fixed = "name = \"pelvis\"\nmesh = \"hip_bone_m.ply\"",
                                      .mobile = "mesh = \"femur_m.ply\"",
                                      .centre = "[0.512, 0, 0]",
                                      .axes = "anterior = [0, 1, 0]\nsuperior = [-1, 0, 0]\n",
                                      .more = fragment_text(planes)});
  for (const char* name : {"pelvis", "fragment"}) {
    const MeshReport a = inspect(Mesh(mesh_of_part(joint.joint.fixed, name))),
                     b = inspect(Mesh(mesh_of_part(other.joint.fixed, name)));
    EXPECT_NEAR(*a.signed_volume, *b.signed_volume, 1e-6);
    EXPECT_NEAR(a.area, b.area, 1e-6);
  }
}

TEST_F(CutParts, TakeOtherMeshesAlong) {
  const TriMesh ball = test::sphere({0, 30, 5}, 3, 2);
  io::write_mesh(folder / "cartilage.ply", ball);
  const std::string both =
      "meshes = [{ name = \"bone\", mesh = \"hip_bone.ply\" }, { name = \"cartilage\", mesh = "
      "\"cartilage.ply\", "
      "contact = \"soft\" }]";
  const io::LoadedJoint joint =
      read(fragment_text(around_socket, "meshes = [\"bone\", \"cartilage\"]"), both);
  ASSERT_EQ(joint.joint.fixed.parts.size(), 3u);
  EXPECT_EQ(joint.joint.fixed.parts[1].name, "fragment");
  EXPECT_EQ(joint.joint.fixed.parts[2].contact, PartContact::soft);
  EXPECT_EQ(mesh_of_part(joint.joint.fixed, "cartilage").arrays(), ball);
  const ParameterValue ten{"fragment.frontal", 10};
  const io::LoadedJoint there = with_parameters(joint, {&ten, 1});
  EXPECT_LT(
      test::farthest(mesh_of_part(there.joint.fixed, "cartilage").vertices(), turned(ball, 10).vertices),
      1e-12);
  EXPECT_EQ(mesh_of_part(there.joint.fixed, "bone").arrays(),
            mesh_of_part(joint.joint.fixed, "bone").arrays());
  test::expect_says(refusal(fragment_text("{ point = [0, 29, 0], normal = [0, 1, 0] }",
                                          "meshes = [\"bone\", \"cartilage\"]"),
                            both),
                    "part fragment: cut: cartilage reaches beyond plane 1");
  test::expect_says(refusal(fragment_text(around_socket), both),
                    "the first must name the mesh that it is cut from; there are bone, cartilage");
}

TEST_F(CutParts, AreRefusedInOneLine) {
  const auto refused = [&](std::string_view more, std::string_view saying) {
    const std::string line = refusal(more);
    test::expect_says(line, saying);
    test::expect_says(line, "joint.toml: ");
    test::expect_silent(line, "\n");
  };
  refused(fragment_text(""), "cut: needs one plane or more");
  refused(fragment_text("{ point = [0, 0, 0], normal = [0, 2, 0] }"), "normal: must be a unit vector");
  refused(fragment_text("{ point = [0, 0, 0] }"), "normal");
  refused(fragment_text("{ point = [0, 0, 0], normal = [0, 1, 0], offset = 3 }"), "offset");
  refused(fragment_text("{ point = [0, 0, nan], normal = [0, 1, 0] }"), "finite");
  refused(fragment_text("{ point = [0, 400, 0], normal = [0, 1, 0] }"),
          "part fragment: cut: plane 1 misses pelvis, which lies wholly on its inner side");
  refused(fragment_text("{ point = [0, -400, 0], normal = [0, 1, 0] }"), "wholly on its outer side");
  refused(
      fragment_text("{ point = [0, 0, 0], normal = [0, 1, 0] }, { point = [0, 1, 0], normal = [0, -1, 0] }"),
      "nothing of pelvis lies on the inner side of planes 1 to 2");
  refused(fragment_text(around_socket, "meshes = [\"ilium\"]"),
          "part fragment: the body has no mesh \"ilium\"; there are pelvis");
  refused(
      fragment_text(around_socket) +
          "[[part]]\nname = \"other\"\nbody = \"fixed\"\nmeshes = [\"pelvis\"]\ncut = [{ point = [0, 90, 0], "
          "normal = [0, -1, 0] }]\n[[part.parameter]]\nname = \"tilt\"\nrange = [-9, 9]\n",
      "part other: cut: pelvis is cut already");
  refused(fragment_text(around_socket) + "[contact]\ncasting = \"mobile\"\n",
          "contact.fixed_part: part fragment is cut from that mesh: name one that is not cut");
  TriMesh open = hip_bone;
  open.triangles.pop_back();
  io::write_mesh(folder / "hip_bone.ply", open);
  refused(fragment_text(around_socket), "part fragment: cut: pelvis: an open boundary");
}

TEST_F(CutParts, SayWhichMotionsEndOnTheirFaces) {
  // The planes cut the front of the rim off: shifted to the side it leaves its face open to the neck.
  const io::LoadedJoint joint = read(fragment_text("{ point = [12, 0, 0], normal = [-1, 0, 0] }"));
  const ParameterValue away{"fragment.lateral", -60};
  const io::LoadedJoint there = with_parameters(joint, {&away, 1});
  const auto answer = answer_range(there, {.motions = motion::hip_motions()});
  // Both faces stay in the plane; nothing else that the femur meets lies in it.
  std::string in_plane;
  for (const motion::MotionLimit& limit : answer.limits)
    if (limit.end.contact && std::abs(limit.end.contact->fixed_point.x() - 12) < 1e-9)
      in_plane += (in_plane.empty() ? "" : ", ") + limit.motion.name;
  ASSERT_NE(in_plane, "") << "the neck meets the face";
  const auto note = std::find_if(answer.notes.begin(), answer.notes.end(), [](const RangeNote& each) {
    return each.code == RangeNoteCode::limit_on_part_cut;
  });
  ASSERT_NE(note, answer.notes.end());
  EXPECT_EQ(name_of(note->code), "limit_on_part_cut");
  EXPECT_EQ(note->text,
            in_plane +
                " end on a face or an edge in which a part of pelvis is cut: where the planes lie "
                "decides these limits");
}

TEST_F(CutParts, StandInTheProvenance) {
  const io::LoadedJoint joint = read(fragment_text(around_socket));
  const io::Provenance from = io::provenance_of(joint, {});
  const auto json = io::provenance_json(&from);
  ASSERT_EQ(json["cuts"].size(), 1u);
  EXPECT_EQ(json["cuts"][0]["part"], "fragment");
  EXPECT_EQ(json["cuts"][0]["body"], "fixed");
  EXPECT_EQ(json["cuts"][0]["mesh"], "pelvis");
  ASSERT_EQ(json["cuts"][0]["planes"].size(), 4u);
  EXPECT_EQ(json["cuts"][0]["planes"][1]["point_mm"], (std::vector<double>{-44, 0, 0}));
  EXPECT_EQ(json["cuts"][0]["planes"][1]["normal"], (std::vector<double>{-1, 0, 0}));
  const io::Provenance without = io::provenance_of(read(""), {});
  EXPECT_FALSE(io::provenance_json(&without).contains("cuts"));
}

TEST_F(CutParts, LeaveResectionTheOtherBone) {
  const io::LoadedJoint joint = read(fragment_text(around_socket));
  const motion::Motion motion =
      motion::motion_named(motion::hip_motions(), "internal_rotation_at_90_flexion");
  const double limit = motion::RangeOfMotion(joint.joint).limit(motion).end.turned.degrees();
  plan::ResectionOptions request;
  request.targets = {{motion, Angle::degrees(limit + 2)}};
  EXPECT_GE(
      motion::RangeOfMotion(plan::resect(joint.joint, request).joint).limit(motion).end.turned.degrees(),
      limit + 2);
  request.fixed_share = 0.5;
  EXPECT_THROW(plan::check_resection(joint.joint, request), UsageError);
}

TEST_F(CutParts, HaveTheBandsOfTheWholeBone) {
  const io::LoadedJoint cut = read(fragment_text(around_socket)), whole = read("");
  const std::vector<motion::Motion> motions = {
      motion::motion_named(motion::hip_motions(), "internal_rotation_at_90_flexion"),
      motion::motion_named(motion::hip_motions(), "abduction")};
  const motion::BandOptions few{.samples = 40};
  const auto a = motion::limit_bands(cut.joint, motions, {}, few),
             b = motion::limit_bands(whole.joint, motions, {}, few);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    EXPECT_NEAR(a[i].p5.degrees(), b[i].p5.degrees(), 1e-9);
    EXPECT_NEAR(a[i].p95.degrees(), b[i].p95.degrees(), 1e-9);
  }
}

/// A real hip bone, cut 10 to 25 mm around its socket.
TEST(CutRealParts, HaveTheLimitsOfTheWholeBoneAndOfMeshesTurnedByHand) {
  FOUND_OR_SKIP(data, test::shared_data());
  const test::TemporaryFolder folder;
  const auto path = *data / "hip_vhf_right/hip_bone.ply";
  const std::string fixed = test::mesh_key(path), mobile = test::mesh_key(*data / "hip_vhf_right/femur.ply");
  const auto read = [&](std::string_view name, std::string_view body, std::string_view more) {
    const std::string named = "name = \"pelvis\"\n" + std::string(body);
    return io::read_joint(
        folder.file(name, test::joint_text({.fixed = named, .mobile = mobile, .more = more})));
  };
  const io::LoadedJoint cut = read("cut.toml", fixed, fragment_text(around_socket)),
                        whole = read("whole.toml", fixed, "");
  expect_sound_halves(cut.joint, whole.joint.fixed.mesh);
  expect_same(limits_of(cut), limits_of(whole), 1e-9);
  const ParameterValue ten{"fragment.frontal", 10};
  const io::LoadedJoint there = with_parameters(cut, {&ten, 1});
  io::write_mesh(folder / "rest.ply", mesh_of_part(cut.joint.fixed, "pelvis"));
  io::write_mesh(folder / "turned.ply", turned(mesh_of_part(cut.joint.fixed, "fragment"), 10));
  const io::LoadedJoint by_hand =
      read("by_hand.toml",
           "meshes = [{ name = \"rest\", mesh = \"rest.ply\" }, { name = \"fragment\", "
           "mesh = \"turned.ply\" }]",
           "");
  expect_same(limits_of(there), limits_of(by_hand), 1e-6);
}

}  // namespace
}  // namespace condyle::cut_parts
