#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "support/joint_text.hpp"
#include "support/test.hpp"

/// Joint files proposed for real hips in the frames and units that meshes come in, and for what is no hip.

namespace condyle::test {
namespace {

/// From the joint axes of the shared hips (X anterior, Y superior, Z right) to those of an image.
enum class Axes { joint, ras, lps };

TriMesh as_exported(const TriMesh& mesh, Axes axes, double scale) {
  return mapped(scaled_by(mesh, scale), [&](const Vec3& p) -> Vec3 {
    if (axes == Axes::joint) return p;
    return axes == Axes::ras ? Vec3(p.z(), p.x(), p.y()) : Vec3(-p.z(), -p.x(), p.y());
  });
}

std::string fitted_hip(std::string_view side) {
  return joint_text(
      {.side = side, .fixed = "mesh = \"bone.ply\"", .mobile = "mesh = \"thigh.ply\"", .centre = "\"fit\""});
}

struct Hip {
  const char* folder;
  const char* fixed;
  const char* mobile;
  Side side;
  friend void PrintTo(const Hip& hip, std::ostream* out) { *out << hip.folder; }
};
const Hip hips[] = {{"hip_vhf_right", "hip_bone.ply", "femur.ply", Side::right},
                    {"hip_libhip_m1_left", "coarse/hip_bone_2442.ply", "coarse/femur_1542.ply", Side::left}};

class ProposedHip : public testing::TestWithParam<Hip> {
 protected:
  void SetUp() override {
    FOUND_OR_SKIP(data, shared_data());
    fixed_ = read_ply(*data / GetParam().folder / GetParam().fixed);
    mobile_ = read_ply(*data / GetParam().folder / GetParam().mobile);
  }
  io::JointProposal proposed(Axes axes, double scale, std::optional<Side> side = {}) const {
    io::write_mesh(folder_ / "bone.ply", as_exported(fixed_, axes, scale));
    io::write_mesh(folder_ / "thigh.ply", as_exported(mobile_, axes, scale));
    return io::propose_joint({folder_ / "bone.ply", folder_ / "thigh.ply", folder_ / "joint.toml", side, {}});
  }
  io::LoadedJoint read(const std::string& toml) const {
    return io::read_joint(folder_.file("joint.toml", toml));
  }
  static std::vector<double> limits(const Joint& joint) {
    std::vector<double> out;
    for (const motion::MotionLimit& limit : motion::RangeOfMotion(joint).limits(motion::hip_motions()))
      out.push_back(limit.end.turned.degrees());
    return out;
  }

  TemporaryFolder folder_;
  TriMesh fixed_, mobile_;
};
INSTANTIATE_TEST_SUITE_P(SharedData, ProposedHip, testing::ValuesIn(hips),
                         [](const auto& hip) { return hip.param.folder; });

TEST_P(ProposedHip, HasTheLimitsOfAFileWrittenByHand) {
  io::write_mesh(folder_ / "bone.ply", fixed_);
  io::write_mesh(folder_ / "thigh.ply", mobile_);
  const auto by_hand = limits(read(fitted_hip(name_of(GetParam().side))).joint);
  for (const Axes axes : {Axes::joint, Axes::ras, Axes::lps}) {
    for (const double scale : {1.0, 0.001}) {
      if (axes == Axes::joint && scale != 1) continue;
      SCOPED_TRACE(testing::Message() << static_cast<int>(axes) << " " << scale);
      const io::JointProposal proposal = proposed(axes, scale);
      EXPECT_TRUE(proposal.to_fill_in.empty()) << proposal.to_fill_in.front();
      for (const char* minus_zero : {"-0,", "-0]", "-0.00,", "-0.00)", " -0 "})
        expect_silent(proposal.toml, minus_zero);
      const io::LoadedJoint loaded = read(proposal.toml);
      EXPECT_EQ(loaded.joint.side, GetParam().side);
      const auto found = limits(loaded.joint);
      for (std::size_t i = 0; i < found.size(); ++i)
        EXPECT_NEAR(found[i], by_hand[i], 0.1) << motion::hip_motions()[i].name;
    }
  }
}

/// Bones as finely meshed as they come, in the axes and the unit of an image.
TEST(ProposedFineHip, InMetresAndLpsHasTheLimitsOfAFileWrittenByHand) {
  FOUND_OR_SKIP(data, shared_data());
  const TemporaryFolder folder;
  const TriMesh fixed = read_ply(*data / "hip_libhip_m1_left/hip_bone.ply"),
                mobile = read_ply(*data / "hip_libhip_m1_left/femur.ply");
  const auto limits_of = [&](const std::string& toml) {
    const Joint joint = io::read_joint(folder.file("joint.toml", toml)).joint;
    EXPECT_EQ(joint.side, Side::left);
    return motion::RangeOfMotion(joint).limits(motion::hip_motions());
  };
  io::write_mesh(folder / "bone.ply", fixed);
  io::write_mesh(folder / "thigh.ply", mobile);
  const auto by_hand = limits_of(fitted_hip("left"));
  io::write_mesh(folder / "bone.ply", as_exported(fixed, Axes::lps, 0.001));
  io::write_mesh(folder / "thigh.ply", as_exported(mobile, Axes::lps, 0.001));
  const io::JointProposal proposal =
      io::propose_joint({folder / "bone.ply", folder / "thigh.ply", folder / "joint.toml", {}, {}});
  ASSERT_TRUE(proposal.to_fill_in.empty()) << proposal.to_fill_in.front();
  expect_says(proposal.toml, "units = \"m\"");
  expect_says(proposal.toml, "anterior = [0, -1, 0]");
  const auto found = limits_of(proposal.toml);
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i].end.turned.degrees(), by_hand[i].end.turned.degrees(), 0.1) << found[i].motion.name;
}

TEST_P(ProposedHip, InCentimetresOrInchesNamesThatUnit) {
  const auto in_mm = limits(read(proposed(Axes::joint, 1).toml).joint);
  for (const auto& [word, mm] : {std::pair{"cm", 10.0}, std::pair{"in", 25.4}}) {
    const io::JointProposal proposal = proposed(Axes::joint, 1 / mm);
    expect_says(proposal.toml, std::string("units = \"") + word);
    const auto found = limits(read(proposal.toml).joint);
    // Vertices are floats, a tenth of a micrometre off; a micrometre moves no limit of these hips by a hundredth of a degree.
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], in_mm[i], 0.01) << word;
    expect_says(proposal.units_note, "--units mm, or --species of an animal");
  }
}

TEST_P(ProposedHip, OfAnimalsOfAnySizeIsInMillimetresWithDeviationsOfItsHead) {
  expect_says(proposed(Axes::joint, 0.02).to_fill_in.at(0), "--units mm, cm, in or m says which");
  const auto in_mm = limits(read(proposed(Axes::joint, 1).toml).joint);
  for (const double scale : {0.02, 0.125, 2.5}) {
    (void)proposed(Axes::joint, scale);
    const io::JointProposal proposal = io::propose_joint({.fixed = folder_ / "bone.ply",
                                                          .mobile = folder_ / "thigh.ply",
                                                          .joint_file = folder_ / "joint.toml",
                                                          .person = {.species = "cat"}});
    EXPECT_TRUE(proposal.to_fill_in.empty() && proposal.units_note.empty()) << proposal.toml;
    const io::LoadedJoint loaded = read(proposal.toml);
    EXPECT_EQ(loaded.joint.units, LengthUnit::millimetres);
    EXPECT_EQ(loaded.joint.person.species, "cat");
    for (const JointNote& note : check_joint(loaded.joint, loaded.report.placement))
      EXPECT_NE(note.code, JointNoteCode::unlikely_size) << note.text;
    // Three digits of 0.5 mm at a head of 24 mm.
    const double centre = by_head(0.5, loaded.report.placement.sphere->fit.sphere);
    EXPECT_NEAR(loaded.report.file.uncertainty.centre_mm, centre, 0.005 * centre);
    const auto found = limits(loaded.joint);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], in_mm[i], 0.01) << scale;
  }
}

/// Bones that a shape model gives apart, or into each other; in centimetres, so that the pose's unit counts.
TEST_P(ProposedHip, OfBonesApartIsSeatedIfThatIsAsked) {
  const auto seated = [&](const TriMesh& mobile, const TriMesh& fixed) {
    io::write_mesh(folder_ / "bone.ply", scaled_by(fixed, 0.1));
    io::write_mesh(folder_ / "thigh.ply", scaled_by(mobile, 0.1));
    return io::propose_joint({.fixed = folder_ / "bone.ply",
                              .mobile = folder_ / "thigh.ply",
                              .joint_file = folder_ / "joint.toml",
                              .side = GetParam().side,
                              .units = LengthUnit::centimetres,
                              .seat = true});
  };
  const auto centres_apart = [](const Joint& joint) {
    return (find_sphere(joint.fixed.mesh, {.part = SphericalPart::socket, .within = Sphere{Vec3::Zero(), 60}})
                .fit.sphere.centre -
            find_sphere(joint.mobile.mesh).fit.sphere.centre)
        .norm();
  };
  const Vec3 directions[] = {{1, 0, 0}, {-0.6, 0.8, 0}, {0, -1, 0}, {0, 0.6, -0.8}};
  std::vector<double> first;
  for (const double mm : {1, 8, 15, 30})
    for (const Vec3& direction : directions) {
      const Vec3 by = mm * direction;
      const TriMesh pulled = mapped(mobile_, [&](const Vec3& p) -> Vec3 { return p + by; });
      const io::LoadedJoint loaded = read(seated(pulled, fixed_).toml);
      EXPECT_LT(centres_apart(loaded.joint), 0.3) << by.transpose();
      expect_says(loaded.joint.planned, "thigh seated, moved by ");
      // Wherever it was: the same joint.
      std::vector<double> found = limits(loaded.joint);
      if (first.empty()) first = found;
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], first[i], 0.02);
    }
  const auto refusal = [&](const TriMesh& mobile, const TriMesh& fixed) {
    try {
      (void)seated(mobile, fixed);
    } catch (const MeshError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  expect_says(refusal(scaled_by(mobile_, 1.3), fixed_), "they do not fit, so nothing is seated");
  expect_says(refusal(scaled_by(mobile_, 0.6), fixed_), "they do not fit, so nothing is seated");
  expect_says(refusal(mapped(mobile_, [](const Vec3& p) -> Vec3 { return p + Vec3(0, 0, 300); }), fixed_),
              "no socket near the head was found to seat");
  expect_says(refusal(box(Vec3(-20, -20, -20), Vec3(20, 20, 20)), fixed_), "no head was found to seat");
}

TEST_P(ProposedHip, OfTwoUnitsScalesOneBody) {
  io::write_mesh(folder_ / "bone.ply", fixed_);
  io::write_mesh(folder_ / "thigh.ply", as_exported(mobile_, Axes::joint, 0.1));
  const io::JointProposal proposal =
      io::propose_joint({folder_ / "bone.ply", folder_ / "thigh.ply", folder_ / "joint.toml", {}, {}});
  expect_says(proposal.toml, "scale = [10, 10, 10]");
  const auto found = limits(read(proposal.toml).joint),
             in_mm = limits(read(proposed(Axes::joint, 1).toml).joint);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], in_mm[i], 0.01);
}

TEST_P(ProposedHip, OfTheWrongSideIsNotGuessed) {
  const Side wrong = GetParam().side == Side::right ? Side::left : Side::right;
  const io::JointProposal proposal = proposed(Axes::ras, 1, wrong);
  ASSERT_EQ(proposal.to_fill_in.size(), 2u);
  expect_begins(proposal.to_fill_in[0], "anterior: the bones agree with none");
  EXPECT_THROW(read(proposal.toml), FileError) << "not to be read before it is filled in";
}

TEST_P(ProposedHip, OfExchangedBodiesHasNoHead) {
  io::write_mesh(folder_ / "bone.ply", fixed_);
  io::write_mesh(folder_ / "thigh.ply", mobile_);
  const io::JointProposal proposal =
      io::propose_joint({folder_ / "thigh.ply", folder_ / "bone.ply", folder_ / "joint.toml", {}, {}});
  EXPECT_FALSE(proposal.to_fill_in.empty());
}

TEST(ProposedJoint, OfTwoBoxesIsToBeFilledIn) {
  const TemporaryFolder folder;
  io::write_mesh(folder / "a \"quoted\".ply", box({-20, -20, -20}, {20, 20, 20}));
  io::write_mesh(folder / "b.ply", box({30, -20, -20}, {300, 20, 20}));
  const io::JointProposal proposal = io::propose_joint(
      {folder / "a \"quoted\".ply", folder / "b.ply", folder / "sub" / "joint.toml", {}, LengthUnit::metres});
  std::vector<std::string> keys;
  for (const std::string& line : proposal.to_fill_in) keys.push_back(line.substr(0, line.find(':')));
  EXPECT_EQ(keys, (std::vector<std::string>{"kind", "side", "centre", "anterior", "superior"}));
  std::string filled = proposal.toml + "anterior = [1, 0, 0]\nsuperior = [0, 1, 0]\ncentre = [0, 0, 0]\n";
  filled = "kind = \"ball\"\nside = \"right\"\n" + filled;
  std::filesystem::create_directory(folder / "sub");
  std::ofstream(folder / "sub" / "joint.toml") << filled;
  EXPECT_TRUE(std::filesystem::equivalent(
      io::read_joint_file(folder / "sub" / "joint.toml").fixed.meshes[0].mesh, folder / "a \"quoted\".ply"))
      << filled;
  expect_says(proposal.toml, "units = \"m\"  # given");
  EXPECT_THROW(io::propose_joint({folder / "none.ply", folder / "b.ply", folder / "j.toml", {}, {}}),
               FileError);
}

}  // namespace
}  // namespace condyle::test
