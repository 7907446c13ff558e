#pragma once

#include <cstddef>
#include <vector>

#include "condyle/radial.hpp"

/// Points and poses that penetrations are asked for, and what they are held against.

namespace condyle::test {

Pose pose_of(double angle, const Vec3& axis, const Vec3& translation);

/// The identity, rotations about the centre, and rotations with ever larger translations.
std::vector<Pose> some_poses(std::size_t count, double largest_translation, unsigned seed);

Points random_points(std::size_t count, double reach, unsigned seed);

/// Points of the mesh's surface, moved along their rays by the given factor.
Points points_near_surface(const TriMesh& mesh, std::size_t count, double factor, unsigned seed);

struct Compared {
  std::size_t found = 0;
  radial::PenetrationWork work;
};

/// That at every pose the table says of the points what the plain query of the same surface says.
Compared expect_plain_answers(const radial::RadialTable& table, const Points& points,
                              const std::vector<Pose>& poses, const Vec3& centre = Vec3::Zero());

}  // namespace condyle::test
