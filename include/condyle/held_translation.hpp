#pragma once

#include "condyle/joint.hpp"

namespace condyle {

/// A joint whose mobile body keeps this translation, of the fixed body's axes in mm: the same joint seen from where the
/// mobile body's origin is. With R_FM p_M + t = p_F and t held, p_F - t = R_FM p_M is a rotation about the origin, and all that
/// turns a ball about its centre turns this joint exactly. Vertices of the fixed body are moved by -t, rounded once; points
/// of answers in its frame are t short of those of the joint given.
///
/// Linear in the fixed mesh; with t = 0 the joint as it is.
Joint held_at(const Joint& joint, const Vec3& translation_mm);

}  // namespace condyle
