#include "condyle/io/label_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/joint_checks.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/sample/hip.hpp"
#include "support/test.hpp"
#include "support/voxelised.hpp"

/// Label maps as people have them, of the sample hip and two real ones, degraded by a seeded draw: right within 5 degrees, refused, or with a note of
/// the joint. CONDYLE_LONG_TESTS=1 draws sixty of each kind, else two.

namespace condyle {
namespace {

struct Hip {
  std::string name;
  TriMesh hip_bone, femur;  ///< in LPS about the head's centre
  Side side;
  double head_mm;
  std::vector<double> limits = {};
};

std::vector<double> limits_of(const Joint& joint) {
  std::vector<double> all;
  for (const motion::MotionLimit& limit : motion::RangeOfMotion(joint).limits(motion::hip_motions()))
    all.push_back(limit.end.turned.degrees());
  return all;
}

PlacedJoint placed(Side side, Body fixed, Body mobile) {
  JointDescription description;
  description.side = side;
  description.frame.axes = lps_axes;
  description.frame.centre = CentreFit{};
  return make_joint(description, std::move(fixed), std::move(mobile));
}

TriMesh in_lps(TriMesh mesh) {
  return test::mapped(mesh, [](const Vec3& p) { return Vec3(-p.z(), -p.x(), p.y()); });
}

const std::vector<Hip>& hips() {
  static const std::vector<Hip> all = [] {
    const sample::SampleHip made = sample::sample_hip({}, sample::Scenario::two);
    std::vector<Hip> found{{"sample", in_lps(made.hip_bone), in_lps(made.femur), Side::right, 24}};
    if (const auto data = test::shared_data())
      for (const auto& [name, side, head] : {std::tuple{"hip_vhf_right", Side::right, 23.9},
                                             std::tuple{"hip_libhip_m1_left", Side::left, 26.2}})
        found.push_back({name, in_lps(test::read_ply(*data / name / "hip_bone.ply")),
                         in_lps(test::read_ply(*data / name / "femur.ply")), side, head});
    for (Hip& hip : found)
      hip.limits =
          limits_of(placed(hip.side, {"hip bone", Mesh(hip.hip_bone)}, {"femur", Mesh(hip.femur)}).joint);
    return found;
  }();
  return all;
}

class Draw {
 public:
  explicit Draw(int seed) : bits_(static_cast<unsigned>(seed)) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0;
  }

 private:
  std::mt19937 bits_;
};

constexpr std::uint16_t femur_label = 1, hip_label = 2;  // positions among 0, 76, 78

/// `label_at(label, p)`: the label that a point of a bone has.
template <class LabelAt>
io::LabelMap map_of(const Hip& hip, const Eigen::Matrix3d& steps, const LabelAt& label_at) {
  io::LabelMap map{
      test::grid_around(hip.hip_bone, hip.femur, steps, Vec3(0.1, 0.3, 0.6)), {0, 76, 78}, {}, {}, {}};
  const auto& size = map.grid.size;
  map.layers.emplace_back(static_cast<std::size_t>(size[0] * size[1] * size[2]));
  for (const std::uint16_t label : {femur_label, hip_label}) {
    const VoxelMask mask = test::voxelised(label == femur_label ? hip.femur : hip.hip_bone, map.grid);
    auto inside = mask.inside.begin();
    for (std::int64_t k = mask.first[2]; k < mask.first[2] + mask.size[2]; ++k)
      for (std::int64_t j = mask.first[1]; j < mask.first[1] + mask.size[1]; ++j)
        for (std::int64_t i = mask.first[0]; i < mask.first[0] + mask.size[0]; ++i)
          if (*inside++)
            map.layers[0][static_cast<std::size_t>(i + size[0] * (j + size[1] * k))] =
                label_at(label, map.grid.X_WI * Vec3(double(i), double(j), double(k)));
  }
  return map;
}

/// As where labels are interpolated half a step along each axis, and rounded.
void interpolate(io::LabelMap& map) {
  const auto [ni, nj, nk] = map.grid.size;
  const std::vector<std::uint16_t> before = map.layers[0];
  const std::vector<std::uint32_t> of = map.labels;
  map.labels.resize(100);
  for (std::uint32_t v = 0; v < 100; ++v) map.labels[v] = v;
  for (std::int64_t v = 0; v < ni * nj * (nk - 1) - ni - 1; ++v) {
    double sum = 0;
    for (const std::int64_t step : {0L, 1L, ni, ni + 1, ni * nj, ni * nj + 1, ni * nj + ni, ni * nj + ni + 1})
      sum += of[before[static_cast<std::size_t>(v + step)]] / 8.0;
    map.layers[0][static_cast<std::size_t>(v)] = static_cast<std::uint16_t>(std::lround(sum));
  }
}

/// As where slices are resampled to so many of the same: voxels are as thin as others are.
void repeat_slices(io::LabelMap& map, std::int64_t times) {
  std::vector<std::uint16_t> all;
  const std::int64_t slice = map.grid.size[0] * map.grid.size[1];
  for (auto at = map.layers[0].begin(); at != map.layers[0].end(); at += slice)
    for (std::int64_t n = 0; n < times; ++n) all.insert(all.end(), at, at + slice);
  map.layers[0] = std::move(all);
  map.grid.size[2] *= times;
  map.grid.X_WI.linear().col(2) /= static_cast<double>(times);
}

enum class Kind { good, plate, triradiate, no_head, interpolated, slices, repeated, stretched, tilted };

io::LabelMap drawn(Kind kind, const Hip& hip, Draw draw) {
  const bool is_thick = kind == Kind::slices || kind == Kind::repeated;
  const double edge = is_thick ? 0.8 : draw.between(1, 1.6);
  const Vec3 edges(edge, edge, is_thick ? draw.between(3, 5) : std::min(2.0, edge * draw.between(1, 1.6)));
  const Vec3 axis(draw.between(-1, 1), draw.between(-1, 1), draw.between(0.1, 1));
  const double turn = draw.between(0, is_thick ? 5 : 40) * std::numbers::pi / 180;
  Eigen::Matrix3d steps = Eigen::AngleAxisd(turn, axis.normalized()).toRotationMatrix() * edges.asDiagonal();
  if (draw.between(0, 1) < 0.5) steps.col(0) *= -1;
  // From the head's centre along the neck: outwards, down and a little backwards.
  const Vec3 neck = Vec3(hip.side == Side::right ? -0.7 : 0.7, 0.15, -0.7).normalized();
  const double width = draw.between(2, 4.5), off = draw.between(4, 20),
               cut = draw.between(0.1, 0.9) * hip.head_mm;
  const std::uint16_t head_is = draw.between(0, 1) < 0.5 ? hip_label : std::uint16_t{0};
  io::LabelMap map = map_of(hip, steps, [&](std::uint16_t label, const Vec3& p) {
    if (label == femur_label && kind == Kind::plate && std::abs(neck.dot(p) - off) < width / 2)
      return std::uint16_t{0};
    if (label == femur_label && kind == Kind::no_head && p.norm() < 2 * hip.head_mm && neck.dot(p) < cut)
      return head_is;
    // Three half planes that meet in the line through the head's centre inwards.
    if (label == hip_label && kind == Kind::triradiate)
      for (const double plane : {0.0, 2.1, -2.1}) {
        const double along = p.z() * std::cos(plane) + p.y() * std::sin(plane);
        const double across = p.y() * std::cos(plane) - p.z() * std::sin(plane);
        if (along > -width && std::abs(across) < width / 2) return std::uint16_t{0};
      }
    return label;
  });
  if (kind == Kind::interpolated) interpolate(map);
  if (kind == Kind::repeated) repeat_slices(map, 4);
  // What the header says of the slices is wrong: their distance, or where each of them begins.
  const double by = draw.between(0.1, 0.3), axis_of_tilt = draw.between(0, 1);
  if (kind == Kind::stretched) map.grid.X_WI.linear().col(2) *= axis_of_tilt < 0.5 ? 1 + by : 1 / (1 + by);
  if (kind == Kind::tilted) {
    const Vec3 along = map.grid.X_WI.linear().col(axis_of_tilt < 0.5 ? 0 : 1).normalized();
    map.grid.X_WI.linear().col(2) += (by + 0.08) * map.grid.X_WI.linear().col(2).norm() * along;
  }
  return map;
}

std::optional<io::LabelJoint> joint_of(const io::LabelMap& map, Side side,
                                       const std::filesystem::path& file) {
  io::LabelJointRequest request{.labels = "ct.nii", .fixed = {"78"}, .mobile = {"76"}, .joint_file = file};
  request.side = side;
  return io::propose_joint(map, nullptr, request, {});
}

/// Empty if the hip is right, refused or noted; else what it says. A good one is right and has no note.
std::string fault_of(Kind kind, const Hip& hip, const io::LabelMap& map) {
  std::string text;
  try {
    const io::LabelJoint found = *joint_of(map, hip.side, "hip.toml");
    if (!found.proposal.to_fill_in.empty()) throw MeshError(found.proposal.to_fill_in.front());
    const auto body = [](const io::LabelBone& of) {
      return Body{of.name, Mesh(of.surface.mesh), {}, of.image};
    };
    const PlacedJoint joint = placed(hip.side, body(found.fixed), body(found.mobile));
    // The pieces together are the bone: notes of a gap, in which a motion may go on, allow twice as much and no more.
    double allowed_deg = 5;
    for (const JointNote& note : check_joint(joint.joint, joint.placement))
      if (note.code == JointNoteCode::gap_in_bone || note.code == JointNoteCode::separate_pieces)
        allowed_deg = 10;
      else
        text += std::string(name_of(note.code)) + ": " + note.text + "; ";
    if (kind != Kind::good && !text.empty()) return "";
    const std::vector<double> limits = limits_of(joint.joint);
    for (std::size_t m = 0; m < limits.size(); ++m)
      if (std::abs(limits[m] - hip.limits[m]) > allowed_deg)
        text += motion::hip_motions()[m].name + " " + std::to_string(limits[m]) + " for " +
                std::to_string(hip.limits[m]) + "; ";
  } catch (const std::exception& error) {
    if (kind == Kind::good) text = error.what();
  }
  return text;
}

class DegradedHip : public testing::TestWithParam<std::pair<const char*, Kind>> {};

TEST_P(DegradedHip, IsRightRefusedOrNoted) {
  const int draws = std::getenv("CONDYLE_LONG_TESTS") ? 60 : 2;
  const Kind kind = GetParam().second;
  for (int n = 0; n < draws; ++n) {
    const Hip& hip = hips()[static_cast<std::size_t>(n) % hips().size()];
    EXPECT_EQ(fault_of(kind, hip, drawn(kind, hip, Draw(n))), "") << "draw " << n << " of " << hip.name;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, DegradedHip,
    testing::Values(std::pair{"good", Kind::good}, std::pair{"plate", Kind::plate},
                    std::pair{"triradiate", Kind::triradiate}, std::pair{"no_head", Kind::no_head},
                    std::pair{"interpolated", Kind::interpolated}, std::pair{"slices", Kind::slices},
                    std::pair{"repeated", Kind::repeated}, std::pair{"stretched", Kind::stretched},
                    std::pair{"tilted", Kind::tilted}),
    [](const auto& kind) { return std::string(kind.param.first); });

/// What a map leaves out is a note of the joint that is read from the proposal.
TEST(DegradedHips, KeepTheirNotesInTheJointFile) {
  const Hip& hip = hips()[0];
  const io::LabelMap map =
      map_of(hip, 2 * Eigen::Matrix3d::Identity(), [](std::uint16_t label, const Vec3& p) {
        return label == femur_label && p.z() < -40 && p.z() > -60 ? std::uint16_t{0} : label;
      });
  const test::TemporaryFolder folder;
  const io::LabelJoint found = *joint_of(map, hip.side, folder.path() / "hip.toml");
  ASSERT_EQ(found.mobile.image.notes.size(), 1u);
  const JointNote& note = found.mobile.image.notes[0];
  EXPECT_EQ(note.code, JointNoteCode::pieces_left_out);
  io::write_mesh(found.fixed_mesh, found.fixed.surface.mesh);
  io::write_mesh(found.mobile_mesh, found.mobile.surface.mesh);
  std::string toml = found.proposal.toml;
  const io::LoadedJoint read = io::read_joint(folder.file("hip.toml", toml));
  const auto notes = check_joint(read.joint, read.report.placement);
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(),
                          [&](const JointNote& each) { return each.text == note.text; }),
            1)
      << note.text;
  toml.replace(toml.find("pieces_left_out"), 15, "wrong_side");
  EXPECT_THROW(io::read_joint(folder.file("hip.toml", toml)), FileError);
}

}  // namespace
}  // namespace condyle
