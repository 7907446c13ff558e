#include "joint.hpp"

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

template <class T, class... Of>
constexpr bool is_one_of = (std::is_same_v<T, Of> || ...);

/// Calls back with all members of a struct, which stands with those of as many. One that gets a member more no longer compiles here.
template <class T, class Each>
void members(T& value, const Each& each) {
  using Struct = std::remove_const_t<T>;
  if constexpr (is_one_of<Struct, TriMesh, CoordinateSystem, JointNote, ImageCut, CutPlane, DescribedPart,
                          Sphere, FrameDirections, FemurLandmarks, CentreFit, JointCoordinates, LikelyUnit,
                          BoundingBox, BodyPlacement, contact::NormalDepthOptions, contact::HalfSpace,
                          io::RegionEntry, io::FileDigest, RepairDone, io::LoadedJoint>) {
    auto& [a, b] = value;
    each(a, b);
  } else if constexpr (is_one_of<Struct, Points, BodyImage, PosedParts, UnposedBody, SphericalPatch, Cylinder,
                                 AxisErrors, AnteriorPelvicPlane, TransepicondylarAxis, FrameDescription,
                                 JointAngles, io::ColumnsOfPoses, io::PosesOfModel, plan::CupAngles,
                                 Person>) {
    auto& [a, b, c] = value;
    each(a, b, c);
  } else if constexpr (is_one_of<Struct, SphereFit, PelvisLandmarks, io::PoseDegrees, DescribedLigament>) {
    auto& [a, b, c, d] = value;
    each(a, b, c, d);
  } else if constexpr (is_one_of<Struct, JointImplant, RevolvedPair, io::BodyEntry, motion::Motion,
                                 motion::Uncertainty, io::JointReport>) {
    auto& [a, b, c, d, e] = value;
    each(a, b, c, d, e);
  } else if constexpr (is_one_of<Struct, Body>) {
    auto& [a, b, c, d, e, f] = value;
    each(a, b, c, d, e, f);
  } else if constexpr (is_one_of<Struct, BodyPart, CylinderFit, io::LayerEntry, LigamentWrap>) {
    auto& [a, b, c, d, e, f, g] = value;
    each(a, b, c, d, e, f, g);
  } else if constexpr (is_one_of<Struct, PosedPart, io::MeshEntry, io::ZeroOfColumns>) {
    auto& [a, b, c, d, e, f, g, h] = value;
    each(a, b, c, d, e, f, g, h);
  } else if constexpr (is_one_of<Struct, PartParameter, io::ContactEntry, io::ColumnOfCoordinate>) {
    auto& [a, b, c, d, e, f, g, h, i] = value;
    each(a, b, c, d, e, f, g, h, i);
  } else if constexpr (is_one_of<Struct, Ligament, JointPlacement>) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = value;
    each(a, b, c, d, e, f, g, h, i, j, k);
  } else if constexpr (is_one_of<Struct, io::BodyMeshReport>) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = value;
    each(a, b, c, d, e, f, g, h, i, j, k, l);
  } else if constexpr (is_one_of<Struct, Joint, io::JointFile>) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = value;
    each(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
  } else if constexpr (is_one_of<Struct, JointDescription, plan::ReverseShoulder>) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = value;
    each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
  } else {
    static_assert(is_one_of<Struct, plan::TotalHip>);
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = value;
    each(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t);
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
