#include "method.hpp"

#include <stdexcept>

#include "condyle/joint_coordinates.hpp"
#include "methods/kinds.hpp"

namespace bench {

condyle::AxisFrame arc_axis() {
  return {{0, 0, 0}, axis_of(condyle::JointAngle::flexion, {.side = condyle::Side::right}, {})};
}

bool Method::touch(const condyle::Pose&) {
  throw std::logic_error("this method does not answer whether the bodies touch");
}

void Method::find_pairs(const condyle::Pose&, std::vector<condyle::contact::TrianglePair>&) {
  throw std::logic_error("this method does not find pairs");
}

void Method::find_inside(const condyle::Pose&, std::vector<InsideVertex>&) {
  throw std::logic_error("this method does not find vertices inside");
}

BodyDepth Method::find_depth(const condyle::Pose&) {
  throw std::logic_error("this method does not find how deep bodies are in each other");
}

std::optional<condyle::Angle> Method::find_first_contact(const condyle::Vec3&, condyle::Angle) {
  throw std::logic_error("this method does not find first contact");
}

void Method::deform(condyle::PointsView) {
  throw std::logic_error("this method does not follow a deforming body");
}

std::unique_ptr<Method> Method::for_another_thread() {
  return nullptr;
}

// Methods that CMake did not find are not compiled, and are listed as skipped.
std::vector<MethodGroup> method_groups() {
  return {
      {"", true, condyle_kinds()},
      {"", true, sphere_tree_kinds()},
      {"", true, hybrid_tree_kinds()},
      {"", true, spherical_shell_kinds()},
      {"", true, spherical_sampling_kinds()},
      {"", true, layered_depth_kinds()},
      {"", true, dense_distance_kinds()},
#ifdef CONDYLE_BENCH_FCL
      {"libfcl-dev", true, fcl_kinds()},
#else
      {"libfcl-dev", false, {}},
#endif
#ifdef CONDYLE_BENCH_CGAL
      {"libcgal-dev", true, cgal_kinds()},
      {"libcgal-dev", true, spatial_hashing_kinds()},
#else
      {"libcgal-dev", false, {}},
#endif
#ifdef CONDYLE_BENCH_VTK
      {"libvtk9-dev", true, vtk_kinds()},
#else
      {"libvtk9-dev", false, {}},
#endif
#ifdef CONDYLE_BENCH_BULLET
      {"libbullet-dev", true, bullet_kinds()},
#else
      {"libbullet-dev", false, {}},
#endif
#ifdef CONDYLE_BENCH_ODE
      {"libode-dev", true, ode_kinds()},
#else
      {"libode-dev", false, {}},
#endif
#ifdef CONDYLE_BENCH_SIMBODY
      {"libsimbody-dev", true, simbody_kinds()},
#else
      {"libsimbody-dev", false, {}},
#endif
#ifdef CONDYLE_BENCH_EMBREE
      {"libembree-dev", true, embree_kinds()},
#else
      {"libembree-dev", false, {}},
#endif
#ifdef CONDYLE_BENCH_OPENVDB
      {"libopenvdb-dev", true, openvdb_kinds()},
#else
      {"libopenvdb-dev", false, {}},
#endif
  };
}

std::optional<MethodKind> method_named(std::string_view name) {
  for (MethodGroup& group : method_groups()) {
    for (MethodKind& kind : group.kinds) {
      if (kind.name == name) return std::move(kind);
    }
  }
  return std::nullopt;
}

}  // namespace bench
