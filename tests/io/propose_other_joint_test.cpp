#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/drawn_bones.hpp"
#include "support/test.hpp"

/// Joint files proposed for knees, ankles, elbows and shoulders: real and drawn ones, in the frames and units meshes come in.

namespace condyle::test {
namespace {

/// Largest errors of an axis and a place that are inferred.
constexpr double most_deg = 3, most_mm = 2;

class ProposedOther : public testing::Test {
 protected:
  io::JointProposal proposed(const TriMesh& fixed, const TriMesh& mobile, Anatomy anatomy,
                             std::optional<Side> side = {}) const {
    io::write_mesh(folder_ / "fixed.ply", fixed);
    io::write_mesh(folder_ / "mobile.ply", mobile);
    return io::propose_joint({.fixed = folder_ / "fixed.ply",
                              .mobile = folder_ / "mobile.ply",
                              .joint_file = folder_ / "joint.toml",
                              .side = side,
                              .anatomy = anatomy});
  }
  io::LoadedJoint read(const std::string& toml) const {
    return io::read_joint(folder_.file("joint.toml", toml));
  }
  static std::vector<std::string> keys_to_fill_in(const io::JointProposal& proposal) {
    std::vector<std::string> keys;
    for (const std::string& line : proposal.to_fill_in) keys.push_back(line.substr(0, line.find(':')));
    return keys;
  }
  /// The line of the file that proposes one of several values, with the first of them taken.
  static std::string filled(std::string toml, const std::string& key) {
    const auto at = toml.find("# " + key + " = ");
    EXPECT_NE(at, std::string::npos) << toml;
    toml.erase(at, 2);
    const auto other = toml.find(" or ", at);
    toml.replace(other, toml.find("  #", at) - other, "");
    return toml;
  }
  using Keys = std::vector<std::string>;

  TemporaryFolder folder_;
};

/// The rotation from the axes of the shared knee to those of an image, and its unit.
struct Export {
  const char* name;
  Pose X;
  double scale;
  bool is_left;
};

Pose axes_of(const Vec3& x, const Vec3& y, const Vec3& z) {
  Pose X = Pose::Identity();
  X.linear() << x, y, z;
  return X;
}

/// The shared knee's model turns about Z through the origin with Y along the femur.
TEST_F(ProposedOther, KneeOfRealBonesHasTheFrameOfItsModelInAllAxesUnitsAndMirrored) {
  FOUND_OR_SKIP(data, shared_data());
  const TriMesh femur = read_ply(*data / "knee_lenhart2015_right/femur_bone.ply"),
                tibia = read_ply(*data / "knee_lenhart2015_right/tibia_bone.ply");
  const Pose lps = axes_of(-Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitX());
  const Export exports[] = {{"as it is", Pose::Identity(), 1, false},
                            {"LPS, m", lps, 0.001, false},
                            {"LPS, mirrored", lps, 1, true}};
  for (const auto& [name, X, scale, is_left] : exports) {
    SCOPED_TRACE(testing::Message() << name);
    const auto exported = [&, pose = X, factor = scale, mirror = is_left](const TriMesh& mesh) {
      return scaled_by(posed(pose, mirror ? mirrored(mesh) : mesh), factor);
    };
    const io::JointProposal proposal = proposed(exported(femur), exported(tibia), Anatomy::knee);
    ASSERT_EQ(keys_to_fill_in(proposal), Keys{}) << proposal.toml;
    EXPECT_EQ(proposal.side, is_left ? Side::left : Side::right);
    for (const char* minus_zero : {"-0,", "-0]"}) expect_silent(proposal.toml, minus_zero);
    const io::LoadedJoint loaded = read(proposal.toml);
    EXPECT_EQ(loaded.joint.kind, JointKind::free);
    EXPECT_EQ(loaded.joint.anatomy, Anatomy::knee);
    EXPECT_EQ(loaded.joint.side, is_left ? Side::left : Side::right);
    const Pose& X_WF = loaded.report.placement.X_WF;
    EXPECT_LT(degrees_between(X_WF.linear().col(2), X.linear().col(2)), most_deg);
    EXPECT_LT(degrees_between(X_WF.linear().col(1), X.linear().col(1)), most_deg);
    EXPECT_LT((X_WF.translation() - X * Vec3(-2, 0, 0)).norm(), most_mm)
        << "the cylinder lies 2 mm behind the model's axis";
  }
}

TEST_F(ProposedOther, KneeOfExchangedBonesSaysSo) {
  const io::JointProposal proposal = proposed(tibia_of_knee(), femur_of({}), Anatomy::knee);
  EXPECT_EQ(keys_to_fill_in(proposal), (Keys{"side", "centre", "anterior", "superior"}));
  expect_says(proposal.toml, "fixed and mobile look exchanged");
}

TEST_F(ProposedOther, OthersOfExchangedBonesSaySo) {
  struct Exchanged {
    Anatomy anatomy;
    TriMesh fixed, mobile;
  };
  for (const auto& [anatomy, fixed, mobile] :
       {Exchanged{Anatomy::ankle, talus(), tibia_of_ankle()},
        Exchanged{Anatomy::elbow, ulna(), humerus_at_elbow()},
        Exchanged{Anatomy::shoulder, humerus_at_shoulder(), scapula()}}) {
    const io::JointProposal proposal = proposed(fixed, mobile, anatomy);
    EXPECT_EQ(keys_to_fill_in(proposal), (Keys{"side", "centre", "anterior", "superior"}));
    expect_says(proposal.toml, "fixed and mobile look exchanged");
  }
}

TEST_F(ProposedOther, KneeOfAGivenSideThatItsBonesContradictHasNone) {
  const TriMesh femur = femur_of({}), tibia = tibia_of_knee();
  EXPECT_EQ(keys_to_fill_in(proposed(femur, tibia, Anatomy::knee, Side::left)), Keys{"side"});
  const io::JointProposal agreed = proposed(femur, tibia, Anatomy::knee, Side::right);
  EXPECT_EQ(agreed.side, Side::right);
  expect_says(agreed.toml, "side = \"right\"  # given");
}

TEST_F(ProposedOther, KneeOfACutFemurHasACentreOnly) {
  const io::JointProposal proposal =
      proposed(femur_of({.length = 60}), tibia_of_knee(), Anatomy::knee, Side::right);
  EXPECT_EQ(keys_to_fill_in(proposal), (Keys{"anterior", "superior"}));
}

TEST_F(ProposedOther, AnkleAndElbowAreHingesAboutTheirCylinders) {
  struct Hinge {
    Anatomy anatomy;
    TriMesh fixed, mobile;
    Keys missing;
  };
  for (const auto& [anatomy, fixed, mobile, missing] :
       {Hinge{Anatomy::ankle, tibia_of_ankle(), talus(), {"side"}},
        Hinge{Anatomy::elbow, humerus_at_elbow(), ulna(), {"side", "anterior"}}}) {
    const Pose X = any_pose(2);
    const io::JointProposal proposal = proposed(posed(X, fixed), posed(X, mobile), anatomy);
    ASSERT_EQ(keys_to_fill_in(proposal), missing) << proposal.toml;
    std::string toml = proposal.toml;
    for (const std::string& key : missing) toml = filled(std::move(toml), key);
    const io::LoadedJoint loaded = read(toml);
    EXPECT_EQ(loaded.joint.kind, JointKind::hinge);
    EXPECT_EQ(loaded.joint.anatomy, anatomy);
    const Pose& X_WF = loaded.report.placement.X_WF;
    EXPECT_LT(degrees_between(X_WF.linear().col(2), X.linear().col(2)), most_deg) << toml;
    EXPECT_LT(degrees_between(X_WF.linear().col(1), X.linear().col(1)), most_deg);
    EXPECT_LT((X_WF.translation() - X.translation()).norm(), most_mm);
  }
}

TEST_F(ProposedOther, ShoulderHasTheCentreOfItsHead) {
  const Pose X = any_pose(1);
  const io::JointProposal proposal =
      proposed(posed(X, scapula()), posed(X, humerus_at_shoulder()), Anatomy::shoulder, Side::right);
  EXPECT_EQ(keys_to_fill_in(proposal), (Keys{"anterior", "superior"}));
  EXPECT_EQ(proposal.evidence.size(), 2u) << proposal.toml;
  const io::LoadedJoint loaded = read(proposal.toml + "axes = \"RAS\"\n");
  EXPECT_EQ(loaded.joint.kind, JointKind::ball);
  EXPECT_LT((loaded.report.placement.X_WF.translation() - X.translation()).norm(), most_mm);
}

TEST_F(ProposedOther, OfTwoBoxesIsToBeFilledIn) {
  for (const Anatomy anatomy : {Anatomy::knee, Anatomy::ankle, Anatomy::elbow, Anatomy::shoulder}) {
    const io::JointProposal proposal =
        proposed(box({-20, -20, -20}, {20, 20, 20}), box({30, -20, -20}, {300, 20, 20}), anatomy);
    const Keys keys = keys_to_fill_in(proposal);
    EXPECT_EQ(Keys(keys.end() - 4, keys.end()), (Keys{"side", "centre", "anterior", "superior"}))
        << proposal.toml;
  }
}

TEST_F(ProposedOther, OfAMeshInsideOutSaysSo) {
  const std::string toml = proposed(flipped(femur_of({})), tibia_of_knee(), Anatomy::knee).toml;
  expect_says(toml, "the mesh of fixed is inside out: condyle inspect --repair flip_inverted");
  const std::string open = proposed(box({-20, -20, -20}, {20, 20, 20}), tibia_of_knee(), Anatomy::knee).toml;
  expect_silent(open, "inside out");
}

TEST_F(ProposedOther, HipIsProposedAsWithoutAnAnatomy) {
  const TriMesh fixed = box({-20, -20, -20}, {20, 20, 20}), mobile = sphere({30, 0, 0}, 25, 4);
  const std::string named = proposed(fixed, mobile, Anatomy::hip).toml;
  EXPECT_EQ(named,
            io::propose_joint({folder_ / "fixed.ply", folder_ / "mobile.ply", folder_ / "joint.toml", {}, {}})
                .toml);
}

}  // namespace
}  // namespace condyle::test
