#include "condyle/io/joint_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "condyle/inspect.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/version.hpp"
#include "core/rounded.hpp"
#include "io/file/format_version.hpp"
#include "kinematics/hip_anatomy.hpp"
#include "kinematics/hip_axes.hpp"
#include "mesh/scale.hpp"

namespace condyle {
namespace {

double degrees(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

double degrees_forwards(double forwards, double outwards) {
  return std::atan2(forwards, outwards) * 180 / std::numbers::pi;
}

/// As TOML writes it, whatever it holds.
std::string toml_text(std::string_view text) {
  std::ostringstream out;
  out.exceptions(std::ios::badbit);  // no memory is an error, not half a text
  out << toml::value<std::string>(std::string(text));
  return out.str();
}

std::string numbers(const Vec3& v) {
  return fmt::format("[{:g}, {:g}, {:g}]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // no -0
}

/// Writes lines of a joint file: keys that were inferred, and the other keys as comments.
class Lines {
 public:
  void add(const std::string& line) { text_ += line + "\n"; }
  void key(std::string_view key, const std::string& value, const std::string& evidence) {
    add(fmt::format("{} = {}  # {}", key, value, evidence));
  }
  void missing(std::string_view key, std::string_view choices, const std::string& why) {
    add(fmt::format("# {} = {}  # to fill in: {}", key, choices, why));
    to_fill_in_.push_back(fmt::format("{}: {}", key, why));
  }

  void evidence(const std::string& line) {
    add("# " + line);
    evidence_.push_back(line);
  }

  JointProposal proposal() && { return {std::move(text_), std::move(to_fill_in_), std::move(evidence_)}; }

 private:
  std::string text_;
  std::vector<std::string> to_fill_in_, evidence_;
};

struct MeshInItsUnit {
  TriMesh mesh;
  LikelyUnit unit;
};

MeshInItsUnit load(const std::filesystem::path& path) {
  MeshInItsUnit loaded{read_mesh(path).mesh, {}};
  loaded.unit = likely_unit(loaded.mesh);
  return loaded;
}

void add_body(Lines& lines, std::string_view role, const std::filesystem::path& mesh,
              const std::filesystem::path& joint_file) {
  const auto folder = std::filesystem::absolute(joint_file).parent_path();
  const auto from_folder = std::filesystem::absolute(mesh).lexically_normal().lexically_proximate(folder);
  lines.add(fmt::format("\n[{}]", role));
  lines.add("name = " + toml_text(mesh.stem().string()));
  lines.add("mesh = " + toml_text(from_folder.generic_string()));
}

void add_side(Lines& lines, const std::optional<Side>& given, const kinematics::HipAxes& axes) {
  if (given)
    lines.key("side", toml_text(name_of(*given)), "given");
  else if (axes.agreeing.size() == 1)
    lines.key("side", toml_text(name_of(axes.agreeing[0].side)),
              "inferred from the bones, as the axes below");
  else
    lines.missing("side", "\"right\" or \"left\"",
                  axes.agreeing.empty() ? "no usual axes agree with the bones"
                                        : "more than one pair of axes and side agrees with the bones");
}

void add_axes(Lines& lines, const kinematics::HipAnatomy& hip, const kinematics::AgreeingAxes& inferred) {
  const auto& [axes, side] = inferred;
  const Vec3 lateral = inferred.lateral();
  lines.key("anterior", numbers(axes->anterior()),
            fmt::format("{}: of the axes in use the ones that agree", axes->name));
  lines.key("superior", numbers(axes->superior()),
            fmt::format("the femur hangs {:.0f} degrees from straight down, the hip bone lies {:.0f} degrees "
                        "from the way to the midline",
                        degrees(-hip.towards_femur.dot(axes->superior())),
                        degrees(-hip.towards_pelvis.dot(lateral))));
  if (hip.opening)
    lines.add(fmt::format(
        "# the socket opens {:.0f} degrees from straight to the side, {} forwards of it",
        degrees(hip.opening->dot(lateral)),
        core::rounded(degrees_forwards(hip.opening->dot(axes->anterior()), hip.opening->dot(lateral)), 0)));
}

}  // namespace

JointProposal propose_joint(const ProposalRequest& request) {
  MeshInItsUnit fixed = load(request.fixed), mobile = load(request.mobile);
  Lines lines;
  lines.add(fmt::format(
      "# Proposed by condyle init {} from the two meshes below. Each value has a comment with its evidence;",
      version));
  lines.add("# lines that begin with # and a key could not be inferred and are to be filled in.");
  lines.add(fmt::format("condyle = {}", io::format_version));
  lines.add("name = " + toml_text(request.mobile.stem().string() + " in " + request.fixed.stem().string()));

  const bool same_unit = mobile.unit.unit && fixed.unit.unit == mobile.unit.unit;
  const LengthUnit units = request.units.value_or(mobile.unit.unit.value_or(LengthUnit::millimetres));
  const std::string unit_text = units == LengthUnit::metres ? "\"m\"" : "\"mm\"";
  mesh::scale(fixed.mesh, mm_per(units));
  mesh::scale(mobile.mesh, mm_per(units));
  const auto hip = kinematics::hip_anatomy(fixed.mesh, mobile.mesh);
  if (hip) {
    lines.key("kind", "\"ball\"",
              fmt::format("inferred from a head of radius {:.2f} mm, {:.0f} % of a sphere{}",
                          hip->head.fit.sphere.radius, 100 * hip->head.coverage,
                          hip->socket ? fmt::format(", in a socket of radius {:.2f} mm",
                                                    hip->socket->fit.sphere.radius)
                                      : std::string(", without a spherical socket round it")));
  } else {
    lines.missing("kind", "\"ball\" or \"hinge\"", "no head was found on the mobile body near the fixed one");
  }

  const auto axes = hip ? kinematics::hip_axes(fixed.mesh, *hip, request.side)
                        : kinematics::HipAxes{{}, "no head was found to infer them from", {}};
  add_side(lines, request.side, axes);
  if (request.units)
    lines.key("units", unit_text, "given");
  else if (same_unit)
    lines.key("units", unit_text, "inferred from the size of the meshes: " + mobile.unit.reason);
  else
    lines.missing("units", "\"mm\" or \"m\"", "the sizes of the meshes do not speak for one unit");

  add_body(lines, "fixed", request.fixed, request.joint_file);
  add_body(lines, "mobile", request.mobile, request.joint_file);

  lines.add("\n[frame]");
  if (hip) {
    const Sphere& head = hip->head.fit.sphere;
    lines.key("centre", "\"fit\"",
              fmt::format("the head's centre, {} mm in the frame of the meshes, rms {:.2f} mm{}",
                          core::rounded(head.centre, 2), hip->head.fit.rms_residual,
                          hip->socket ? fmt::format("; the socket's is {:.2f} mm from it",
                                                    (hip->socket->fit.sphere.centre - head.centre).norm())
                                      : std::string()));
  } else {
    lines.missing("centre", "[x, y, z]", "nothing was fitted");
  }
  if (axes.agreeing.size() == 1) {
    add_axes(lines, *hip, axes.agreeing[0]);
  } else {
    lines.missing("anterior", "[x, y, z]", axes.why_none);
    lines.missing("superior", "[x, y, z]", "as anterior");
  }
  for (const std::string& line : axes.evidence) lines.evidence(line);
  return std::move(lines).proposal();
}

}  // namespace condyle
