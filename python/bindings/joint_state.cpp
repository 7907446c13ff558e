#include "joint_state.hpp"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/version.hpp"

namespace condyle::python {
namespace {

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

template <class T, template <class...> class Of>
constexpr bool is_a = false;
template <template <class...> class Of, class... Parts>
constexpr bool is_a<Of<Parts...>, Of> = true;

template <class T>
constexpr bool is_array = false;
template <class T, std::size_t N>
constexpr bool is_array<std::array<T, N>> = true;

/// Calls back with all members of a struct. One that gets a member more no longer compiles here.
template <class T, class Each>
void members(T& value, const Each& each) {
  using Struct = std::remove_const_t<T>;
  if constexpr (std::is_same_v<Struct, Points>) {
    auto& [x, y, z] = value;
    each(x, y, z);
  } else if constexpr (std::is_same_v<Struct, TriMesh>) {
    auto& [vertices, triangles] = value;
    each(vertices, triangles);
  } else if constexpr (std::is_same_v<Struct, BodyPart>) {
    auto& [name, first_vertex, vertices, first_triangle, triangles, contact, cut_triangles] = value;
    each(name, first_vertex, vertices, first_triangle, triangles, contact, cut_triangles);
  } else if constexpr (std::is_same_v<Struct, Body>) {
    auto& [name, mesh, parts, image, head, bearing_margin_mm] = value;
    each(name, mesh, parts, image, head, bearing_margin_mm);
  } else if constexpr (std::is_same_v<Struct, BodyImage>) {
    auto& [voxel, cuts] = value;
    each(voxel, cuts);
  } else if constexpr (std::is_same_v<Struct, ImageCut>) {
    auto& [normal, offset] = value;
    each(normal, offset);
  } else if constexpr (std::is_same_v<Struct, Joint>) {
    auto& [name, kind, side, fixed, mobile, anatomy, frame, posed, implant, zero_from] = value;
    each(name, kind, side, fixed, mobile, anatomy, frame, posed, implant, zero_from);
  } else if constexpr (std::is_same_v<Struct, JointImplant>) {
    auto& [fixed_mesh, mobile_mesh, cup_axis, pair, why_no_pair] = value;
    each(fixed_mesh, mobile_mesh, cup_axis, pair, why_no_pair);
  } else if constexpr (std::is_same_v<Struct, RevolvedPair>) {
    auto& [fixed_axis, mobile_axis, half_angle, of_facets_low, of_facets_high] = value;
    each(fixed_axis, mobile_axis, half_angle, of_facets_low, of_facets_high);
  } else if constexpr (std::is_same_v<Struct, PosedParts>) {
    auto& [parts, fixed, mobile] = value;
    each(parts, fixed, mobile);
  } else if constexpr (std::is_same_v<Struct, UnposedBody>) {
    auto& [mesh, image, head] = value;
    each(mesh, image, head);
  } else if constexpr (std::is_same_v<Struct, PosedPart>) {
    auto& [name, body, meshes, centre, definition, parameters, cut, cut_from] = value;
    each(name, body, meshes, centre, definition, parameters, cut, cut_from);
  } else if constexpr (std::is_same_v<Struct, CutPlane>) {
    auto& [point, normal] = value;
    each(point, normal);
  } else if constexpr (std::is_same_v<Struct, DescribedPart>) {
    auto& [part, centre_in_W] = value;
    each(part, centre_in_W);
  } else if constexpr (std::is_same_v<Struct, PartParameter>) {
    auto& [name, kind, low, high, now, described, as_given, sigma, direction] = value;
    each(name, kind, low, high, now, described, as_given, sigma, direction);
  } else if constexpr (std::is_same_v<Struct, Sphere>) {
    auto& [centre, radius] = value;
    each(centre, radius);
  } else if constexpr (std::is_same_v<Struct, SphereFit>) {
    auto& [sphere, rms, largest, vertices] = value;
    each(sphere, rms, largest, vertices);
  } else if constexpr (std::is_same_v<Struct, SphericalPatch>) {
    auto& [fit, coverage, bound] = value;
    each(fit, coverage, bound);
  } else if constexpr (std::is_same_v<Struct, Cylinder>) {
    auto& [point, direction, radius] = value;
    each(point, direction, radius);
  } else if constexpr (std::is_same_v<Struct, CylinderFit>) {
    auto& [cylinder, rms, largest, vertices, coverage, direction_bound, axis_bound] = value;
    each(cylinder, rms, largest, vertices, coverage, direction_bound, axis_bound);
  } else if constexpr (std::is_same_v<Struct, AxisErrors>) {
    auto& [anterior, superior, right_angle] = value;
    each(anterior, superior, right_angle);
  } else if constexpr (std::is_same_v<Struct, FrameDirections>) {
    auto& [anterior, superior] = value;
    each(anterior, superior);
  } else if constexpr (std::is_same_v<Struct, PelvisLandmarks>) {
    auto& [a, b, c, d] = value;
    each(a, b, c, d);
  } else if constexpr (std::is_same_v<Struct, AnteriorPelvicPlane> ||
                       std::is_same_v<Struct, TransepicondylarAxis>) {
    auto& [a, b, c] = value;
    each(a, b, c);
  } else if constexpr (std::is_same_v<Struct, FemurLandmarks>) {
    auto& [medial, lateral] = value;
    each(medial, lateral);
  } else if constexpr (std::is_same_v<Struct, CentreFit>) {
    auto& [body, within] = value;
    each(body, within);
  } else if constexpr (std::is_same_v<Struct, FrameDescription>) {
    auto& [centre, axes, mobile_axes] = value;
    each(centre, axes, mobile_axes);
  } else if constexpr (std::is_same_v<Struct, JointAngles>) {
    auto& [flexion, adduction, internal_rotation] = value;
    each(flexion, adduction, internal_rotation);
  } else if constexpr (std::is_same_v<Struct, JointCoordinates>) {
    auto& [angles, translation] = value;
    each(angles, translation);
  } else if constexpr (std::is_same_v<Struct, io::PoseDegrees>) {
    auto& [flexion, adduction, internal_rotation, translation] = value;
    each(flexion, adduction, internal_rotation, translation);
  } else if constexpr (std::is_same_v<Struct, JointDescription>) {
    auto& [name, kind, side, units, frame, pose, zero_from, anatomy, translation_frame, fixed_in_W,
           mobile_in_W, parts] = value;
    each(name, kind, side, units, frame, pose, zero_from, anatomy, translation_frame, fixed_in_W, mobile_in_W,
         parts);
  } else if constexpr (std::is_same_v<Struct, LikelyUnit>) {
    auto& [unit, reason] = value;
    each(unit, reason);
  } else if constexpr (std::is_same_v<Struct, BoundingBox>) {
    auto& [low, high] = value;
    each(low, high);
  } else if constexpr (std::is_same_v<Struct, BodyPlacement>) {
    auto& [unit, bounds] = value;
    each(unit, bounds);
  } else if constexpr (std::is_same_v<Struct, JointPlacement>) {
    auto& [X_WF, sphere, cylinder, body, rotation, errors, pose, zero_from, fixed, mobile, notes] = value;
    each(X_WF, sphere, cylinder, body, rotation, errors, pose, zero_from, fixed, mobile, notes);
  } else if constexpr (std::is_same_v<Struct, io::MeshEntry>) {
    auto& [part, mesh, repairs, contact, polygons, pieces, scale, X_BG] = value;
    each(part, mesh, repairs, contact, polygons, pieces, scale, X_BG);
  } else if constexpr (std::is_same_v<Struct, io::BodyEntry>) {
    auto& [name, meshes, image, head, bearing_margin_mm] = value;
    each(name, meshes, image, head, bearing_margin_mm);
  } else if constexpr (std::is_same_v<Struct, motion::Motion>) {
    auto& [name, vary, sense, start, range] = value;
    each(name, vary, sense, start, range);
  } else if constexpr (std::is_same_v<Struct, motion::Uncertainty>) {
    auto& [centre, axes, surface, surface_voxels] = value;
    each(centre, axes, surface, surface_voxels);
  } else if constexpr (std::is_same_v<Struct, contact::NormalDepthOptions>) {
    auto& [rule, reach] = value;
    each(rule, reach);
  } else if constexpr (std::is_same_v<Struct, io::LayerEntry>) {
    auto& [modulus, ratio, thickness, behind, file, unit, bounds] = value;
    each(modulus, ratio, thickness, behind, file, unit, bounds);
  } else if constexpr (std::is_same_v<Struct, contact::HalfSpace>) {
    auto& [normal, offset] = value;
    each(normal, offset);
  } else if constexpr (std::is_same_v<Struct, io::RegionEntry>) {
    auto& [name, half_spaces] = value;
    each(name, half_spaces);
  } else if constexpr (std::is_same_v<Struct, io::ContactEntry>) {
    auto& [fixed_part, mobile_part, casting, rays, law, fixed, mobile, moment_on, regions] = value;
    each(fixed_part, mobile_part, casting, rays, law, fixed, mobile, moment_on, regions);
  } else if constexpr (std::is_same_v<Struct, io::ColumnOfCoordinate>) {
    auto& [coordinate, kind, column, unit, sign, offset, otherwise, range, is_locked] = value;
    each(coordinate, kind, column, unit, sign, offset, otherwise, range, is_locked);
  } else if constexpr (std::is_same_v<Struct, io::ColumnsOfPoses>) {
    auto& [fixed_body, mobile_body, unit] = value;
    each(fixed_body, mobile_body, unit);
  } else if constexpr (std::is_same_v<Struct, io::PosesOfModel>) {
    auto& [model, joint, in_degrees] = value;
    each(model, joint, in_degrees);
  } else if constexpr (std::is_same_v<Struct, io::FileDigest>) {
    auto& [bytes, sha256] = value;
    each(bytes, sha256);
  } else if constexpr (std::is_same_v<Struct, io::JointFile>) {
    auto& [path, joint, fixed, mobile, motions, uncertainty, seed, pose, contact, recorded, implant, digest,
           notes] = value;
    each(path, joint, fixed, mobile, motions, uncertainty, seed, pose, contact, recorded, implant, digest,
         notes);
  } else if constexpr (std::is_same_v<Struct, plan::CupAngles>) {
    auto& [inclination, anteversion, definition] = value;
    each(inclination, anteversion, definition);
  } else if constexpr (std::is_same_v<Struct, plan::TotalHip>) {
    auto& [cup, neck_shaft, version, head, clearance, neck, taper, upper, lower, half_angle, chamfer, lip,
           towards, width, cup_radius, offset, stem, length, leg, facets] = value;
    each(cup, neck_shaft, version, head, clearance, neck, taper, upper, lower, half_angle, chamfer, lip,
         towards, width, cup_radius, offset, stem, length, leg, facets);
  } else if constexpr (std::is_same_v<Struct, plan::ReverseShoulder>) {
    auto& [inclination, version, neck_shaft, retroversion, head, clearance, neck, taper, half_angle, chamfer,
           cup_radius, pillar, stem, length, facets] = value;
    each(inclination, version, neck_shaft, retroversion, head, clearance, neck, taper, half_angle, chamfer,
         cup_radius, pillar, stem, length, facets);
  } else if constexpr (std::is_same_v<Struct, RepairDone>) {
    auto& [repair, count] = value;
    each(repair, count);
  } else if constexpr (std::is_same_v<Struct, io::BodyMeshReport>) {
    auto& [part, mesh, vertices, triangles, welded, repairs, digest, body_from_file, left_out, split, guessed,
           guessed_within] = value;
    each(part, mesh, vertices, triangles, welded, repairs, digest, body_from_file, left_out, split, guessed,
         guessed_within);
  } else if constexpr (std::is_same_v<Struct, io::JointReport>) {
    auto& [file, fixed, mobile, placement, notes] = value;
    each(file, fixed, mobile, placement, notes);
  } else {
    static_assert(std::is_same_v<Struct, io::LoadedJoint>);
    auto& [joint, report] = value;
    each(joint, report);
  }
}

class Writer {
 public:
  template <class T>
  void put(const T& value) {
    if constexpr (Plain<T>) {
      put_bytes(&value, sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      put(value.size());
      put_bytes(value.data(), value.size());
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
      put(value.native());
    } else if constexpr (std::is_same_v<T, Angle>) {
      put(value.radians());
    } else if constexpr (std::is_same_v<T, Vec3>) {
      put_bytes(value.data(), 3 * sizeof(double));
    } else if constexpr (std::is_same_v<T, Eigen::Matrix3d>) {
      put_bytes(value.data(), 9 * sizeof(double));
    } else if constexpr (std::is_same_v<T, Pose> || std::is_same_v<T, Eigen::Affine3d>) {
      put_bytes(value.matrix().data(), 16 * sizeof(double));
    } else if constexpr (std::is_same_v<T, Mesh>) {
      put(value.arrays());
    } else if constexpr (is_a<T, std::optional>) {
      put(value.has_value());
      if (value) put(*value);
    } else if constexpr (is_a<T, std::vector>) {
      put(value.size());
      for (const auto& each : value) put(each);
    } else if constexpr (is_array<T>) {
      for (const auto& each : value) put(each);
    } else if constexpr (is_a<T, std::variant>) {
      put(value.index());
      std::visit([&](const auto& held) { put(held); }, value);
    } else if constexpr (!std::is_same_v<T, std::monostate>) {
      members(value, [&](const auto&... each) { (put(each), ...); });
    }
  }
  std::string take() { return std::move(bytes_); }

 private:
  void put_bytes(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  void get(T& value) {
    if constexpr (Plain<T>) {
      get_bytes(&value, sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      value.resize(count());
      get_bytes(value.data(), value.size());
    } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
      value = made<std::string>();
    } else if constexpr (std::is_same_v<T, Angle>) {
      value = Angle::radians(made<double>());
    } else if constexpr (std::is_same_v<T, Vec3>) {
      get_bytes(value.data(), 3 * sizeof(double));
    } else if constexpr (std::is_same_v<T, Eigen::Matrix3d>) {
      get_bytes(value.data(), 9 * sizeof(double));
    } else if constexpr (std::is_same_v<T, Pose> || std::is_same_v<T, Eigen::Affine3d>) {
      get_bytes(value.matrix().data(), 16 * sizeof(double));
    } else if constexpr (std::is_same_v<T, Mesh>) {
      value = Mesh(made<TriMesh>());
    } else if constexpr (is_a<T, std::optional>) {
      if (made<bool>()) get(value.emplace());
    } else if constexpr (is_a<T, std::vector>) {
      value.resize(count());
      for (auto& each : value) get(each);
    } else if constexpr (is_array<T>) {
      for (auto& each : value) get(each);
    } else if constexpr (is_a<T, std::variant>) {
      get_held(value, made<std::size_t>(), std::make_index_sequence<std::variant_size_v<T>>());
    } else if constexpr (!std::is_same_v<T, std::monostate>) {
      members(value, [&](auto&... each) { (get(each), ...); });
    }
  }

 private:
  template <class T>
  T made() {
    T value{};
    get(value);
    return value;
  }
  template <class T, std::size_t... I>
  void get_held(T& value, std::size_t index, std::index_sequence<I...>) {
    ((I == index ? get(value.template emplace<I>()) : void()), ...);
  }
  /// How many follow, each of a byte at least.
  std::size_t count() {
    const auto number = made<std::size_t>();
    if (number > left_.size()) fail();
    return number;
  }
  void get_bytes(void* data, std::size_t size) {
    if (size > left_.size()) fail();
    std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }
  [[noreturn]] static void fail() { throw UsageError("joint: what was pickled is cut off"); }

  std::string_view left_;
};

Body no_body() {
  return {"", Mesh(TriMesh{}), {}};
}

}  // namespace

std::string state_of(const io::LoadedJoint& joint) {
  Writer writer;
  writer.put(std::string(version));
  writer.put(joint);
  return writer.take();
}

io::LoadedJoint joint_of_state(std::string_view state) {
  Reader reader(state);
  std::string written_by;
  reader.get(written_by);
  if (written_by != version)
    throw UsageError(
        fmt::format("joint: was pickled by condyle {:.40}, and this is {}: make it anew from its files",
                    written_by, version));
  io::LoadedJoint joint{Joint{"", JointKind::ball, Side::right, no_body(), no_body()}, {}};
  reader.get(joint);
  return joint;
}

}  // namespace condyle::python
