#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/angle.hpp"
#include "condyle/contact.hpp"
#include "condyle/mesh.hpp"
#include "condyle/pose.hpp"

/// One way of finding collisions: Condyle's, a library's, or a published one in plain code of our own.

namespace bench {

/// The measured scene: the fixed mesh in F, the mobile one in M, the joint centre at both origins. Both closed.
struct Bodies {
  const condyle::TriMesh& fixed;
  const condyle::TriMesh& mobile;
};

/// A mobile vertex in the fixed solid.
struct InsideVertex {
  condyle::Index vertex = condyle::no_index;
  condyle::Index triangle = condyle::no_index;  ///< Where it leaves the solid; no_index if not reported.
  double depth_mm =
      std::numeric_limits<double>::quiet_NaN();  ///< The method's kind of depth; NaN if not reported.
};

/// Whether two bodies meet, and how deep they are in each other at their deepest place.
struct BodyDepth {
  bool in_contact = false;
  double depth_mm = 0;  ///< 0 without contact.
};

/// Which way a method measures how deep a vertex is: along the ray through the joint centre, along the circle
/// about the flexion axis, or to the nearest point of the surface. Each is held against its own true value.
enum class DepthKind { none, along_ray, along_arc, nearest_surface };

/// The axis of `along_arc`: that of flexion, through the joint centre.
condyle::AxisFrame arc_axis();

/// Work of a method, counted since it was made; names are the method's own.
using Work = std::vector<std::pair<std::string, std::int64_t>>;

/// A method made ready for two bodies. Called from one thread.
///
/// X_FM is the pose of the mobile body in the fixed one's frame. Answers go to vectors that are reused, so
/// that no allocation is timed: each starts by clearing it. What a method cannot answer it need not override:
/// its kind says so, and it is never asked.
class Method {
 public:
  virtual ~Method() = default;

  /// Whether the two surfaces share a point (one body wholly inside the other is not asked).
  virtual bool touch(const condyle::Pose& X_FM);

  /// Triangles of both bodies that share a point, in any order.
  virtual void find_pairs(const condyle::Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out);

  /// Every mobile vertex that is in the fixed solid, in any order.
  virtual void find_inside(const condyle::Pose& X_FM, std::vector<InsideVertex>& out);

  /// Whether the bodies meet, and how deep.
  virtual BodyDepth find_depth(const condyle::Pose& X_FM);

  /// How far the mobile body turns from where both frames coincide, about an axis through the joint centre, until the
  /// bodies meet; empty if they do not within the range.
  virtual std::optional<condyle::Angle> find_first_contact(const condyle::Vec3& axis_F, condyle::Angle range);

  /// The fixed mesh's vertices have moved here, its triangles are the same: answers from now on are for them.
  /// The points live as long as the method is asked.
  virtual void deform(condyle::PointsView fixed_vertices);

  /// The same method for another thread, sharing what was built; null where the method has no such thing.
  virtual std::unique_ptr<Method> for_another_thread();

  /// Memory of what was built, without the two meshes it was built from, as far as it can be known; else 0.
  virtual std::size_t bytes() const { return 0; }

  virtual Work work() const { return {}; }
};

/// Questions to a method.
struct Answers {
  bool touch = false, pairs = false, inside = false;
  bool deforms = false;  ///< Follows a deforming fixed body otherwise than by being made anew.
  bool depth = false, first_contact = false;  ///< Only `beside_others` asks for these.
};

struct MethodKind {
  std::string name;    ///< For --filter and files: "embree_8_robust".
  std::string family;  ///< "bounding volume hierarchies"
  std::string title;   ///< For people: "Embree, 8 rays at a time, robust"
  Answers answers;
  DepthKind depth = DepthKind::none;
  /// Whether its answers must be the exact ones; a disagreement then fails the run. For others it is
  /// reported.
  bool is_exact = false;
  std::function<std::unique_ptr<Method>(const Bodies&)> make;
  bool is_slow_to_make = false;  ///< Seconds even for the smallest scene.
  /// Triangles of both bodies together above which being made ready takes minutes.
  std::size_t most_triangles = std::numeric_limits<std::size_t>::max();
};

/// A group of methods that one Debian package stands behind, or none.
struct MethodGroup {
  std::string package;  ///< Empty for our own.
  bool is_built;        ///< Whether the package was there when this program was built.
  std::vector<MethodKind> kinds;
};

/// All of them, those of absent packages without kinds.
std::vector<MethodGroup> method_groups();

/// The one of this name; empty where its package was absent, or there is none.
std::optional<MethodKind> method_named(std::string_view name);

}  // namespace bench
