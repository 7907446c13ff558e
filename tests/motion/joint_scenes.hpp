#pragma once

#include "condyle/joint.hpp"

/// Joints whose limits are known, and irregular ones that end most motions by contact.

namespace condyle::test {

/// The post's edge that the arm meets, in the plane across the axis, and half of the arm's width.
inline constexpr double post_x = 40, post_y = -80, arm_half_width = 1;

/// Where the arm's front, one half width before its middle, meets the post's edge at distance rho:
///
///        C
///        |.                 rho sin(alpha - limit) = half width,   tan alpha = post_x / -post_y
///        | .
///        |  .  post
///        |   +---+
///       arm  |   |
double post_limit();

/// An arm hanging from the centre and a post in front of it, laid out in the plane across the axis of one
/// angle, so that adding to that angle turns the arm towards the post.
struct PostJoint {
  Joint joint;
  double limit;            ///< rad
  double limit_other_way;  ///< rad: over the top, down to the post's other side
};
PostJoint post_joint(JointAngle vary, Side side);

/// A bumpy ball with an arm in a bumpy half shell: free at zero angles, stopped in most directions.
Joint bumpy_joint(Side side);

/// The same joint on the other side of the body.
Joint mirrored(const Joint& joint);

/// The arm reaches 1 mm into the post in the reference pose.
Joint overlapping_joint();

/// post_joint() for flexion with a ball on the arm's end that overlaps another ball of the fixed body, all
/// inside a ball about the centre.
Joint ball_and_post_joint();

/// post_joint() for flexion whose arm hangs from a head of head_radius in a half shell about the centre, which is open
/// below. The head's centre is off by `offset`.
Joint head_and_post_joint(const Vec3& offset);
inline constexpr double head_radius = 20, socket_radius = 23;

}  // namespace condyle::test
