#pragma once

#include <memory>

#include "condyle/condyle.h"
#include "condyle/mesh.hpp"
#include "support/test.hpp"

/// Objects of the C interface that destroy themselves, and C++'s arguments as it takes them.

#define ASSERT_OK(call) ASSERT_EQ(call, CONDYLE_OK) << condyle_last_error()
#define EXPECT_OK(call) EXPECT_EQ(call, CONDYLE_OK) << condyle_last_error()

namespace condyle::test {

template <auto destroy>
struct Destroyed {
  void operator()(auto* object) const noexcept { destroy(object); }
};
template <class T, auto destroy>
using Held = std::unique_ptr<T, Destroyed<destroy>>;

using HeldMesh = Held<condyle_mesh, condyle_mesh_destroy>;
using HeldContact = Held<condyle_joint_contact, condyle_joint_contact_destroy>;
using HeldResults = Held<condyle_contact_results, condyle_contact_results_destroy>;
using HeldDepth = Held<condyle_normal_depth, condyle_normal_depth_destroy>;
using HeldNormalResults = Held<condyle_normal_results, condyle_normal_results_destroy>;
using HeldOptions = Held<condyle_elastic_options, condyle_elastic_options_destroy>;
using HeldElastic = Held<condyle_elastic_contact, condyle_elastic_contact_destroy>;
using HeldElasticResults = Held<condyle_elastic_results, condyle_elastic_results_destroy>;
using HeldForceOptions = Held<condyle_force_options, condyle_force_options_destroy>;
using HeldForces = Held<condyle_force_results, condyle_force_results_destroy>;
using HeldRamp = Held<condyle_ramp, condyle_ramp_destroy>;
using HeldRotation = Held<condyle_first_contact, condyle_first_contact_destroy>;
using HeldFree = Held<condyle_free_results, condyle_free_results_destroy>;

inline constexpr int all_parts =
    CONDYLE_STIFFNESS | CONDYLE_VERTEX_FORCES | CONDYLE_VERTEX_STIFFNESS | CONDYLE_PATCHES;

/// What a _create function makes; null where it fails.
template <class Object, class... Arguments>
Object made(condyle_status (*create)(Arguments...), auto... arguments) {
  typename Object::pointer object = nullptr;
  create(arguments..., &object);
  return Object(object);
}

inline void expect_refused(condyle_status status, const std::string& line,
                           condyle_status expected = CONDYLE_BAD_ARGUMENT) {
  EXPECT_EQ(status, expected);
  EXPECT_NE(line, "");
  EXPECT_EQ(condyle_last_error(), line);
}

inline std::vector<double> c_points(const Points& points) {
  std::vector<double> xyz;
  for (std::size_t v = 0; v < points.size(); ++v)
    for (int k = 0; k < 3; ++k) xyz.push_back(points[v][k]);
  return xyz;
}

inline HeldMesh c_mesh(const TriMesh& mesh) {
  const std::vector<double> xyz = c_points(mesh.vertices);
  return made<HeldMesh>(condyle_mesh_create, xyz.data(), mesh.vertices.size(),
                        mesh.triangles.empty() ? nullptr : mesh.triangles.front().data(),
                        mesh.triangles.size());
}

inline HeldContact c_contact(const TriMesh& fixed, const TriMesh& mobile) {
  return made<HeldContact>(condyle_joint_contact_create, c_mesh(fixed).get(), c_mesh(mobile).get());
}

/// Options with a layer of one thickness on the fixed body.
inline HeldOptions c_layer(double E_mpa, double nu, double thickness_mm,
                           condyle_casting casting = CONDYLE_CAST_BOTH) {
  HeldOptions options = made<HeldOptions>(condyle_elastic_options_create);
  EXPECT_OK(condyle_elastic_options_set_layer(options.get(), CONDYLE_FIXED, E_mpa, nu, &thickness_mm, 1));
  EXPECT_OK(condyle_elastic_options_set_casting(options.get(), casting));
  return options;
}

inline constexpr condyle_pose c_identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};

inline condyle_pose c_pose(const Pose& X) {
  condyle_pose out;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) out.rotation[3 * i + k] = X.matrix()(i, k);
    out.translation_mm[i] = X.matrix()(i, 3);
  }
  return out;
}

}  // namespace condyle::test
