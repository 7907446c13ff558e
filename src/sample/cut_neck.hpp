#pragma once

#include "condyle/mesh.hpp"

namespace condyle::sample {

/// A closed mesh without its head: what hangs together on the side of the plane normal . p < offset, with the vertex that lies deepest there, is
/// cut off, and the cut closed by a flat face. Other places of the bone beyond the plane, as a trochanter that stands higher than the cut,
/// stay. Throws UsageError if the plane does not cut the bone in one ring that its middle sees all of.
TriMesh cut_neck(const TriMesh& bone, const Vec3& normal, double offset_mm);

}  // namespace condyle::sample
