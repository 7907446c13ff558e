// condyle-label-limits: how true limits of motion are that are computed from label maps.
//
// Meshes of hips are made into voxels, these into surfaces as `condyle init` makes them, and their limits are held against
// those of the meshes: what the grid costs, without the error of a segmentation.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/joint_checks.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/range_of_motion.hpp"
#include "io/file/whole_file.hpp"
#include "machine.hpp"
#include "mesh/subdivide.hpp"
#include "scenes.hpp"
#include "support/voxelised.hpp"
#include "table.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::Angle;
using condyle::Vec3;
using condyle::motion::LimitReason;

struct Options {
  std::string filter, json, csv;
  std::size_t samples = 200;
};

constexpr std::array<std::string_view, 3> hips = {"sample_3", "hip_vhf_right", "hip_libhip_m1_left"};

struct VoxelShape {
  std::string_view name;
  Vec3 spacing;       ///< mm: to the left, backwards, up; then turned
  Angle turned = {};  ///< about oblique_axis()
};

const std::array<VoxelShape, 5>& voxel_shapes() {
  static const std::array<VoxelShape, 5> shapes = {{
      {"0.5", Vec3::Constant(0.5)},
      {"1.0", Vec3::Constant(1)},
      {"1.5", Vec3::Constant(1.5)},
      {"0.7 x 0.7 x 2.0", Vec3(0.7, 0.7, 2)},
      {"1.0, turned by 20°", Vec3::Constant(1), Angle::degrees(20)},
  }};
  return shapes;
}

/// No axis of the image stays along one of the joint.
Vec3 oblique_axis() {
  return Vec3(1, 2, 3).normalized();
}

/// Where a voxel's centre lies beside the joint frame's origin, in voxels: no multiples of a half, which put centres onto
/// symmetry planes of the sample hip.
constexpr std::array<double, 3> first_offset = {0.13, 0.57, 0.91};
constexpr std::size_t offsets = 3;

/// Steps from voxel to voxel in the joint frame: LPS, as label maps from scanners mostly have it.
Eigen::Matrix3d steps_of(const VoxelShape& shape) {
  Eigen::Matrix3d axes;
  axes.col(0) = -Vec3::UnitZ();
  axes.col(1) = -Vec3::UnitX();
  axes.col(2) = Vec3::UnitY();
  return Eigen::AngleAxisd(shape.turned.radians(), oblique_axis()).toRotationMatrix() * axes *
         shape.spacing.asDiagonal();
}

condyle::VoxelGrid grid_of(const condyle::Joint& joint, const VoxelShape& shape, std::size_t offset) {
  const Eigen::Matrix3d steps = steps_of(shape);
  Vec3 shifted;
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = first_offset[a] + static_cast<double>(offset) / static_cast<double>(offsets);
    shifted[static_cast<Eigen::Index>(a)] = at - std::floor(at);
  }
  return condyle::test::grid_around(joint.fixed.mesh, joint.mobile.mesh, steps, steps * shifted);
}

/// One motion on the meshes and on the surfaces of their voxels. Its error is 0 if it reaches the end of its range on both.
struct Outcome {
  condyle::motion::MotionLimit mesh;
  condyle::motion::MotionLimit image;  ///< about the centre of the meshes' joint
  condyle::motion::MotionLimit own;    ///< about the centre fitted to the image's own head
  condyle::motion::LimitBand surface;  ///< of `image`, only the surface uncertain
  condyle::motion::LimitBand usual;    ///< of `own`, all sources, as `condyle rom --band` has it
  bool has_usual = false;              ///< it takes four times as long: only at the first offset

  bool ends_in_contact() const {
    return mesh.end.reason == LimitReason::contact || image.end.reason == LimitReason::contact;
  }
  /// One of the two reaches the end of the motion's range, where its error is then counted from: in truth it is larger.
  bool is_one_sided() const { return mesh.end.reason != image.end.reason; }
  double error(const condyle::motion::MotionLimit& limit) const {
    return (limit.end.turned - mesh.end.turned).degrees();
  }
};

struct Run {
  std::string hip, voxel;
  std::vector<Outcome> outcomes;
  double centre_off_mm = 0;  ///< of the image's own centre from the meshes'
  double triangles = 0, surface_s = 0, limits_s = 0;
};

/// Codes of the notes on joints, and how many joints have each.
using Codes = std::map<std::string, std::size_t>;

void count_notes(const condyle::PlacedJoint& placed, Codes& codes) {
  for (const condyle::JointNote& note : check_joint(placed.joint, placed.placement))
    ++codes[std::string(name_of(note.code))];
}

const TableHead triangles_head{"label_triangles",
                               "Limits of the meshes with smaller triangles of the femur on the same "
                               "surface: the largest change, in degrees",
                               {{"hip", "hip"},
                                {"four_deg", "each triangle in 4", 2},
                                {"sixteen_deg", "in 16", 2},
                                {"sixty_four_deg", "in 64", 2},
                                {"motion", "of"}}};

/// A hip and what the comparison needs of its meshes.
class Hip {
 public:
  explicit Hip(const condyle::Joint& joint) : joint_(joint) {
    description_.name = joint.name;
    description_.side = joint.side;
    description_.frame.centre = condyle::CentreFit{};
    placed_ = make_joint(description_, joint.fixed, joint.mobile);
    limits_ = condyle::motion::RangeOfMotion(placed_->joint).limits(motions_);
  }

  const condyle::PlacedJoint& placed() const { return *placed_; }

  /// The bearing surface is made of whole triangles: where it ends depends on their size, and surfaces of voxels have small ones.
  void add_triangles(Report& report) const {
    std::vector<Cell> row = {joint_.name};
    condyle::Body mobile = joint_.mobile;
    std::string worst;
    for (int times = 1; times <= 3; ++times) {
      mobile.mesh = condyle::mesh::subdivided(mobile.mesh);
      condyle::JointDescription description = description_;
      description.frame.centre = Vec3(placed_->placement.X_WF.translation());
      const condyle::PlacedJoint divided = make_joint(description, joint_.fixed, mobile);
      const auto limits = condyle::motion::RangeOfMotion(divided.joint).limits(motions_);
      double largest = 0;
      for (std::size_t m = 0; m < limits.size(); ++m) {
        const double change = (limits[m].end.turned - limits_[m].end.turned).degrees();
        if (std::abs(change) > std::abs(largest)) largest = change, worst = limits[m].motion.name;
      }
      // Below a thousandth it is rounding.
      row.emplace_back(std::abs(largest) < 1e-3 ? 0 : largest);
    }
    row.emplace_back(worst);
    report.table(triangles_head).add(std::move(row));
  }

  Run run(const VoxelShape& shape, std::size_t offset, const Options& options, Codes& codes) const {
    const condyle::VoxelGrid grid = grid_of(joint_, shape, offset);
    const auto fixed_mask = condyle::test::voxelised(joint_.fixed.mesh, grid),
               mobile_mask = condyle::test::voxelised(joint_.mobile.mesh, grid);
    Run run;
    run.hip = joint_.name, run.voxel = shape.name;
    const Stopwatch making;
    const condyle::Body fixed = condyle::test::body_of("hip bone", fixed_mask),
                        mobile = condyle::test::body_of("femur", mobile_mask);
    run.surface_s = making.wall_seconds();
    run.triangles = static_cast<double>(fixed.mesh.triangles().size() + mobile.mesh.triangles().size());

    condyle::JointDescription description = description_;
    const condyle::PlacedJoint own = make_joint(description, fixed, mobile);
    const Vec3 centre = placed_->placement.X_WF.translation();
    run.centre_off_mm = (own.placement.X_WF.translation() - centre).norm();
    description.frame.centre = centre;
    const condyle::PlacedJoint image = make_joint(description, fixed, mobile);
    count_notes(own, codes);

    std::vector<condyle::motion::MotionLimit> limits;
    run.limits_s =
        wall_seconds_of([&] { limits = condyle::motion::RangeOfMotion(image.joint).limits(motions_); });
    const auto own_limits = condyle::motion::RangeOfMotion(own.joint).limits(motions_);
    condyle::motion::Uncertainty only_surface;
    only_surface.centre_mm = 0, only_surface.axes = Angle();
    const auto surface =
        limit_bands(image.joint, motions_, {}, {.sigma = only_surface, .samples = options.samples});
    std::vector<condyle::motion::LimitBand> usual;
    if (offset == 0) usual = limit_bands(own.joint, motions_, {}, {.samples = options.samples});
    for (std::size_t m = 0; m < motions_.size(); ++m) {
      run.outcomes.push_back({limits_[m], limits[m], own_limits[m], surface[m], {}, offset == 0});
      if (offset == 0) run.outcomes.back().usual = usual[m];
    }
    return run;
  }

 private:
  condyle::Joint joint_;
  condyle::JointDescription description_;
  std::vector<condyle::motion::Motion> motions_ = condyle::motion::hip_motions();
  std::optional<condyle::PlacedJoint> placed_;
  std::vector<condyle::motion::MotionLimit> limits_;
};

// Summary of several runs for the tables.

struct Errors {
  std::vector<double> values;  ///< degrees
  std::string worst;           ///< the motion of the largest

  void add(double error, const std::string& motion) {
    if (values.empty() || std::abs(error) > largest()) worst = motion;
    values.push_back(error);
  }
  std::vector<double> sizes() const {
    std::vector<double> out;
    for (const double e : values) out.push_back(std::abs(e));
    std::sort(out.begin(), out.end());
    return out;
  }
  double largest() const { return sizes().back(); }
  /// That of 95 of 100.
  double most() const {
    const std::vector<double> sorted = sizes();
    return sorted[static_cast<std::size_t>(0.95 * static_cast<double>(sorted.size() - 1))];
  }
  double mean() const { return mean_of(values); }
  double mean_size() const { return mean_of(sizes()); }

  static double mean_of(const std::vector<double>& all) {
    double sum = 0;
    for (const double e : all) sum += e;
    return all.empty() ? 0 : sum / static_cast<double>(all.size());
  }
};

/// Bands and whether they hold the meshes' limits.
struct Bands {
  std::vector<double> widths;
  std::size_t holding = 0;
  double farthest_outside = 0;  ///< degrees

  void add(const condyle::motion::LimitBand& band, Angle truth) {
    widths.push_back((band.p95 - band.p5).degrees());
    const double outside = std::max((band.p5 - truth).degrees(), (truth - band.p95).degrees());
    // Limits of one place computed twice differ by rounding.
    constexpr double rounding_deg = 1e-6;
    holding += outside <= rounding_deg;
    farthest_outside = std::max(farthest_outside, outside);
  }
  double share() const {
    return widths.empty() ? 0 : 100 * static_cast<double>(holding) / static_cast<double>(widths.size());
  }
  double widest() const { return widths.empty() ? 0 : *std::max_element(widths.begin(), widths.end()); }
};

const TableHead limits_head{"label_limits",
                            "Errors: limits of surfaces from label maps less those of the meshes, in degrees",
                            {{"hip", "hip"},
                             {"voxel_mm", "voxel, mm"},
                             {"limits", "limits"},
                             {"largest_deg", "largest error"},
                             {"worst_motion", "of"},
                             {"most_deg", "95 % below"},
                             {"mean_size_deg", "mean size"},
                             {"mean_deg", "bias", 2},
                             {"own_largest_deg", "own centre: largest error"},
                             {"own_mean_size_deg", "mean size"},
                             {"own_mean_deg", "bias", 2},
                             {"one_sided", "one-sided"},
                             {"centre_off_mm", "own centre off by at most, mm", 2},
                             {"triangles", "triangles, thousands"},
                             {"surface_s", "surfaces, s", 2},
                             {"limits_s", "12 limits, s", 2}}};

const TableHead bands_head{"label_bands",
                           "Bands from 5 to 95 %, in degrees, and the share that holds the meshes' limits",
                           {{"hip", "hip"},
                            {"voxel_mm", "voxel, mm"},
                            {"limits", "limits in contact"},
                            {"share", "surface only: holds, %"},
                            {"mean_width_deg", "mean width"},
                            {"widest_deg", "widest"},
                            {"farthest_outside_deg", "truth outside by at most", 2},
                            {"usual_limits", "limits in contact, first offset"},
                            {"usual_share", "all sources: holds, %"},
                            {"usual_mean_width_deg", "mean width"},
                            {"usual_widest_deg", "widest"}}};

const TableHead notes_head{"label_notes",
                           "Notes of condyle check on these joints",
                           {{"hip", "hip"}, {"of", "of"}, {"joints", "joints"}, {"notes", "notes"}}};

const TableHead every_head{"label_limits_all",
                           "Every limit",
                           {{"hip", "hip"},
                            {"voxel_mm", "voxel"},
                            {"run", "run"},
                            {"motion", "motion"},
                            {"mesh_deg", "mesh"},
                            {"image_deg", "image"},
                            {"own_deg", "own centre"},
                            {"mesh_in_contact", "mesh in contact"},
                            {"image_in_contact", "image in contact"},
                            {"p5_deg", "5 %"},
                            {"p95_deg", "95 %"},
                            {"usual_p5_deg", "5 %, all sources"},
                            {"usual_p95_deg", "95 %, all sources"}},
                           true};

void add_rows(const std::string& hip, const std::string& voxel, const std::vector<const Run*>& runs,
              Report& report) {
  if (runs.empty()) return;
  Errors image, own;
  Bands surface, usual;
  std::int64_t one_sided = 0;
  double centre_off = 0;
  std::vector<double> triangles, surface_s, limits_s;
  for (const Run* run : runs) {
    centre_off = std::max(centre_off, run->centre_off_mm);
    triangles.push_back(run->triangles / 1000);
    surface_s.push_back(run->surface_s), limits_s.push_back(run->limits_s);
    for (const Outcome& outcome : run->outcomes) {
      image.add(outcome.error(outcome.image), outcome.mesh.motion.name);
      own.add(outcome.error(outcome.own), outcome.mesh.motion.name);
      one_sided += outcome.is_one_sided();
      if (!outcome.ends_in_contact()) continue;
      surface.add(outcome.surface, outcome.mesh.end.turned);
      if (outcome.has_usual) usual.add(outcome.usual, outcome.mesh.end.turned);
    }
  }
  report.table(limits_head)
      .add({hip, voxel, static_cast<std::int64_t>(image.values.size()), image.largest(), image.worst,
            image.most(), image.mean_size(), image.mean(), own.largest(), own.mean_size(), own.mean(),
            one_sided, centre_off, Errors::mean_of(triangles), Errors::mean_of(surface_s),
            Errors::mean_of(limits_s)});
  report.table(bands_head)
      .add({hip, voxel, static_cast<std::int64_t>(surface.widths.size()), surface.share(),
            Errors::mean_of(surface.widths), surface.widest(), surface.farthest_outside,
            static_cast<std::int64_t>(usual.widths.size()), usual.share(), Errors::mean_of(usual.widths),
            usual.widest()});
}

/// Runs of this hip and these voxels; of all where a name is empty.
std::vector<const Run*> chosen(const std::vector<Run>& runs, std::string_view hip, std::string_view voxel) {
  std::vector<const Run*> out;
  for (const Run& run : runs)
    if ((hip.empty() || run.hip == hip) && (voxel.empty() || run.voxel == voxel)) out.push_back(&run);
  return out;
}

void add_tables(const std::vector<Run>& runs, Report& report) {
  for (const std::string_view hip : hips)
    for (const VoxelShape& shape : voxel_shapes())
      add_rows(std::string(hip), std::string(shape.name), chosen(runs, hip, shape.name), report);
  for (const std::string_view hip : hips) add_rows(std::string(hip), "all", chosen(runs, hip, ""), report);
  for (const VoxelShape& shape : voxel_shapes())
    add_rows("all", std::string(shape.name), chosen(runs, "", shape.name), report);
  add_rows("all", "all", chosen(runs, "", ""), report);
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const Outcome& o : runs[r].outcomes)
      report.table(every_head)
          .add({runs[r].hip, runs[r].voxel, static_cast<std::int64_t>(r), o.mesh.motion.name,
                o.mesh.end.turned.degrees(), o.image.end.turned.degrees(), o.own.end.turned.degrees(),
                std::int64_t{o.mesh.end.reason == LimitReason::contact},
                std::int64_t{o.image.end.reason == LimitReason::contact}, o.surface.p5.degrees(),
                o.surface.p95.degrees(), o.has_usual ? Cell(o.usual.p5.degrees()) : Cell("-"),
                o.has_usual ? Cell(o.usual.p95.degrees()) : Cell("-")});
}

void add_notes(std::string_view hip, const std::string& of, std::size_t joints, const Codes& codes,
               Report& report) {
  std::string words;
  for (const auto& [code, count] : codes)
    words += fmt::format("{}{} on {}", words.empty() ? "" : ", ", code, count);
  report.table(notes_head)
      .add({std::string(hip), of, static_cast<std::int64_t>(joints), words.empty() ? "none" : words});
}

std::vector<Run> run_all(const Options& options, Report& report) {
  std::vector<Run> runs;
  for (const std::string_view name : hips) {
    const auto asked = [&](const VoxelShape& shape) {
      return fmt::format("{}/{}", name, shape.name).find(options.filter) != std::string::npos;
    };
    if (std::none_of(voxel_shapes().begin(), voxel_shapes().end(), asked)) continue;
    const auto scene = make_scene(name);
    if (!scene) {
      report.skipped.push_back(fmt::format("{}: its meshes are not there", name));
      continue;
    }
    const Hip hip(scene->joint);
    Codes of_mesh, of_images;
    count_notes(hip.placed(), of_mesh);
    hip.add_triangles(report);
    std::size_t joints = 0;
    for (const VoxelShape& shape : voxel_shapes()) {
      if (!asked(shape)) continue;
      for (std::size_t offset = 0; offset < offsets; ++offset, ++joints) {
        const Stopwatch watch;
        runs.push_back(hip.run(shape, offset, options, of_images));
        fmt::print(stderr, "{}/{}/{}: {:.1f} s\n", name, shape.name, offset, watch.wall_seconds());
      }
    }
    add_notes(name, "meshes", 1, of_mesh, report);
    add_notes(name, "label maps", joints, of_images, report);
    // Both would be false here: the heads and sockets are those of the meshes.
    for (const char* code : {"head_socket_apart", "socket_smaller_than_head"})
      if (of_images.count(code) > of_mesh.count(code))
        report.disagreements.push_back(fmt::format("{}: {} on surfaces from label maps only", name, code));
  }
  return runs;
}

int run(const Options& options) {
  Report report;
  report.machine = describe_machine();
  report.machine.emplace_back("run", options.filter.empty() ? "full" : "of " + options.filter);
  report.machine.emplace_back("samples of a band", fmt::format("{}", options.samples));
  const double load_before = load_average();
  add_tables(run_all(options, report), report);
  report.machine.emplace_back("load", fmt::format("{:.1f} before, {:.1f} after (this program included)",
                                                  load_before, load_average()));
  if (!options.json.empty()) condyle::io::write_whole_file(options.json, to_json(report).dump(1) + "\n");
  for (const Table& table : report.tables) {
    if (!table.head.is_long) fmt::print("\n{}", terminal_text(table));
    if (table.head.is_long && !options.csv.empty())
      condyle::io::write_whole_file(options.csv, csv_text(table));
  }
  for (const std::string& what : report.skipped) fmt::print("\nskipped: {}\n", what);
  for (const std::string& what : report.disagreements) fmt::print("\nDISAGREES: {}\n", what);
  return report.disagreements.empty() ? 0 : 1;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  CLI::App app(
      "How true limits from label maps are: hips made into voxels, and limits of the surfaces of these held "
      "against those of the meshes");
  bench::Options options;
  app.add_option("--filter", options.filter, "Only runs with these words in hip/voxel");
  app.add_option("--samples", options.samples, "Samples of a band")->capture_default_str();
  app.add_option("--json", options.json, "Write all tables to this file too");
  app.add_option("--csv", options.csv, "Write every limit to this file, a line each");
  app.footer("Example:\n  condyle-label-limits --filter sample_3/1.0 --samples 20");
  CLI11_PARSE(app, argc, argv);
  try {
    return bench::run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "condyle-label-limits: {}\n", error.what());
    return 2;
  }
}
