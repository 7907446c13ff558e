#include <fmt/format.h>

#include <cmath>

#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/repair.hpp"

namespace condyle {
namespace {

double scale_of(LengthUnit unit) noexcept {
  return unit == LengthUnit::metres ? 1000.0 : 1.0;
}

std::string_view name_of(LengthUnit unit) noexcept {
  return unit == LengthUnit::metres ? "metres" : "millimetres";
}

struct LoadedBody {
  TriMesh mesh;
  BodyReport report;
  LikelyUnit likely_unit;
};

LoadedBody load(const BodyEntry& entry) {
  MeshFile file = read_mesh(entry.mesh);
  LoadedBody body{std::move(file.mesh), {entry.mesh, 0, 0, file.welded_vertices, {}, {}}, {}};
  try {
    body.report.repairs = repair_mesh(body.mesh, entry.repairs);
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: {}", entry.mesh.string(), error.what()));
  }
  body.report.vertices = body.mesh.vertices.size();
  body.report.triangles = body.mesh.triangles.size();
  body.likely_unit = likely_unit(body.mesh);
  return body;
}

/// The unit is what the file says. Meshes that look otherwise are told of; two that contradict each other
/// cannot both be right and are refused.
void check_units(const JointFile& file, const LoadedBody& fixed, const LoadedBody& mobile,
                 JointReport& report) {
  const auto &f = fixed.likely_unit, &m = mobile.likely_unit;
  if (f.unit && m.unit && *f.unit != *m.unit)
    throw FileError(fmt::format("{}: units: {} looks like {} and {} like {}: give both in one unit",
                                file.path.string(), file.fixed.mesh.string(), name_of(*f.unit),
                                file.mobile.mesh.string(), name_of(*m.unit)));
  for (const LoadedBody* body : {&fixed, &mobile}) {
    const LikelyUnit& likely = body->likely_unit;
    if (likely.unit == file.units) continue;
    report.notes.push_back(fmt::format("{}: the file says {}, but {}", body->report.mesh.filename().string(),
                                       name_of(file.units), likely.reason));
  }
}

/// X * (scale p) in extended precision, rounded once per coordinate; untouched where nothing is to be done.
void place(const Pose& X, double scale, LoadedBody& body) {
  if (scale == 1 && X.matrix() == Pose::Identity().matrix()) return;
  Points& points = body.mesh.vertices;
  const auto& m = X.matrix();
  for (std::size_t v = 0; v < points.size(); ++v) {
    const long double x = scale * static_cast<long double>(points.x[v]);
    const long double y = scale * static_cast<long double>(points.y[v]);
    const long double z = scale * static_cast<long double>(points.z[v]);
    const auto row = [&](int i) {
      return static_cast<double>(m(i, 0) * x + m(i, 1) * y + m(i, 2) * z + m(i, 3));
    };
    const Vec3 placed(row(0), row(1), row(2));
    if (!placed.allFinite())
      throw FileError(
          fmt::format("{}: vertex {}: coordinates too large for millimetres", body.report.mesh.string(), v));
    points.set(v, placed);
  }
}

TriMesh in_millimetres(const LoadedBody& body, LengthUnit unit) {
  LoadedBody copy = body;
  place(Pose::Identity(), scale_of(unit), copy);
  return std::move(copy.mesh);
}

BoundingBox bounds_of(const TriMesh& mesh) {
  BoundingBox box{mesh.vertices[0], mesh.vertices[0]};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    box.low = box.low.cwiseMin(mesh.vertices[v]);
    box.high = box.high.cwiseMax(mesh.vertices[v]);
  }
  return box;
}

/// The axes about a centre, from directions or landmarks.
Pose frame_about(const Vec3& centre, const JointFile& file) {
  struct Frames {
    const Vec3& centre;
    Side side;
    Pose operator()(const FrameDirections& d) const {
      return frame_from_axes(centre, d.anterior, d.superior);
    }
    Pose operator()(const PelvisLandmarks& l) const { return frame_from_landmarks(centre, l); }
    Pose operator()(const AnteriorPelvicPlane& l) const { return frame_from_landmarks(centre, l); }
    Pose operator()(const FemurLandmarks& l) const { return frame_from_landmarks(centre, side, l); }
    Pose operator()(const TransepicondylarAxis& l) const { return frame_from_landmarks(side, l); }
  };
  try {
    return std::visit(Frames{centre, file.side}, file.frame.axes);
  } catch (const UsageError& error) {
    throw FileError(fmt::format("{}: frame: {}", file.path.string(), error.what()));
  }
}

/// Turns the frame by the smallest rotation that lays its Z axis along the fitted cylinder's, in the nearer
/// sense.
Pose turned_to_axis(const Pose& X_WF, const Vec3& fitted, JointReport& report) {
  constexpr double largest_turn_deg = 45;  // beyond it the fit is not of the joint that the axes describe
  const Vec3 z = X_WF.linear().col(2);
  const Vec3 axis = z.dot(fitted) < 0 ? Vec3(-fitted) : fitted;
  report.axis_turn = Angle::radians(std::atan2(z.cross(axis).norm(), z.dot(axis)));
  if (report.axis_turn.degrees() > largest_turn_deg)
    throw MeshError(
        fmt::format("{}: frame.centre: the fitted axis is {:.1f} degrees from right = anterior x superior; "
                    "more than {:g} is not taken for the same axis (limit the fit with fit_within)",
                    report.file.path.string(), report.axis_turn.degrees(), largest_turn_deg));
  Pose turned = X_WF;
  turned.linear() = Eigen::Quaterniond::FromTwoVectors(z, axis).toRotationMatrix() * X_WF.linear();
  return turned;
}

Pose fitted_frame(const CentreFit& fit, const LoadedBody& body, JointReport& report) {
  const JointFile& file = report.file;
  const TriMesh mesh = in_millimetres(body, file.units);
  try {
    if (file.kind == JointKind::ball) {
      SphereSearch search;
      search.part = fit.body == BodyRole::fixed ? SphericalPart::socket : SphericalPart::head;
      search.within = fit.within;
      report.head = find_sphere(mesh, search);
      return frame_about(report.head->fit.sphere.centre, file);
    }
    report.cylinder = find_cylinder(mesh, {.within = fit.within});
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("{}: frame.centre: {}: {}", file.path.string(),
                                body.report.mesh.filename().string(), error.what()));
  }
  const Cylinder& cylinder = report.cylinder->cylinder;
  return turned_to_axis(frame_about(cylinder.point, file), cylinder.direction, report);
}

Pose frame_of(const LoadedBody& fixed, const LoadedBody& mobile, JointReport& report) {
  const FrameEntry& frame = report.file.frame;
  if (const auto* directions = std::get_if<FrameDirections>(&frame.axes))
    report.axis_errors = axis_errors(directions->anterior, directions->superior);
  if (const auto* fit = std::get_if<CentreFit>(&frame.centre))
    return fitted_frame(*fit, fit->body == BodyRole::fixed ? fixed : mobile, report);
  const auto* centre = std::get_if<Vec3>(&frame.centre);
  return frame_about(centre ? *centre : Vec3(Vec3::Zero()), report.file);
}

void note_what_was_done(JointReport& report) {
  auto& notes = report.notes;
  if (report.file.units == LengthUnit::metres)
    notes.push_back("meshes and lengths converted from metres to mm");
  for (const BodyReport* body : {&report.fixed, &report.mobile}) {
    const std::string name = body->mesh.filename().string();
    if (body->welded_vertices > 0)
      notes.push_back(
          fmt::format("{}: {} equal corners read as one vertex each", name, body->welded_vertices));
    for (const RepairDone& done : body->repairs) notes.push_back(fmt::format("{}: {}", name, describe(done)));
  }
  if (!report.axis_errors.none())
    notes.push_back(
        fmt::format("axes made orthonormal: lengths were off by {:.1e} and {:.1e}, the right angle by {:.1e}",
                    report.axis_errors.anterior_length, report.axis_errors.superior_length,
                    report.axis_errors.right_angle));
  if (report.head) {
    const SphereFit& fit = report.head->fit;
    notes.push_back(
        fmt::format("centre fitted: sphere of radius {:.3f} mm over {} vertices, {:.0f} % of the sphere, rms "
                    "residual {:.3f} mm, largest {:.3f} mm",
                    fit.sphere.radius, fit.vertices.size(), 100 * report.head->coverage, fit.rms_residual,
                    fit.largest_residual));
  }
  if (report.cylinder) {
    const CylinderFit& fit = *report.cylinder;
    notes.push_back(
        fmt::format("axis fitted: cylinder of radius {:.3f} mm over {} vertices, rms residual {:.3f} mm, "
                    "largest {:.3f} mm; axes turned by {:.2f} degrees to it",
                    fit.cylinder.radius, fit.vertices.size(), fit.rms_residual, fit.largest_residual,
                    report.axis_turn.degrees()));
  }
}

}  // namespace

std::vector<RepairDone> repair_mesh(TriMesh& mesh, const std::vector<Repair>& repairs) {
  std::vector<RepairDone> done;
  for (const Repair repair : repairs) {
    const auto count = [&] {
      switch (repair) {
        case Repair::weld:
          return weld_exactly(mesh);
        case Repair::drop_unreferenced:
          return drop_unreferenced_vertices(mesh);
        case Repair::flip_inverted:
          break;
      }
      return flip_inverted(mesh);
    }();
    done.push_back({repair, count});
  }
  return done;
}

std::string describe(const RepairDone& done) {
  switch (done.repair) {
    case Repair::weld:
      return fmt::format("weld: {} vertices merged with an equal one", done.count);
    case Repair::drop_unreferenced:
      return fmt::format("drop_unreferenced: {} vertices dropped", done.count);
    case Repair::flip_inverted:
      break;
  }
  return fmt::format("flip_inverted: {} triangles turned", done.count);
}

LoadedJoint read_joint(const std::filesystem::path& path) {
  JointReport report{.file = read_joint_file(path),
                     .fixed = {},
                     .mobile = {},
                     .X_WF = Pose::Identity(),
                     .head = {},
                     .cylinder = {},
                     .axis_turn = {},
                     .notes = {}};
  const JointFile& file = report.file;
  LoadedBody fixed = load(file.fixed), mobile = load(file.mobile);
  check_units(file, fixed, mobile, report);
  report.X_WF = frame_of(fixed, mobile, report);

  // The mobile mesh is given in the reference pose: p_F = X_FM(ref) p_M, and so p_M = X_FM(ref)^-1 X_WF^-1
  // p_W.
  const Pose X_FW = report.X_WF.inverse(), X_MF = pose_at(file.side, file.reference_pose).inverse();
  place(X_FW, scale_of(file.units), fixed);
  place(X_MF * X_FW, scale_of(file.units), mobile);
  for (LoadedBody* body : {&fixed, &mobile}) body->report.bounds = bounds_of(body->mesh);

  report.fixed = std::move(fixed.report);
  report.mobile = std::move(mobile.report);
  note_what_was_done(report);
  Joint joint{file.name,
              file.kind,
              file.side,
              {file.fixed.name, std::move(fixed.mesh)},
              {file.mobile.name, std::move(mobile.mesh)}};
  return {std::move(joint), std::move(report)};
}

}  // namespace condyle
