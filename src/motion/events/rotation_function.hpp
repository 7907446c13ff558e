#pragma once

namespace condyle::motion {

/// Three coordinates of any number type: the formulas of contact under rotation are written once and used
/// with doubles (fast, bounded) and with integers (exact).
template <class Number>
struct Triple {
  Number x, y, z;

  friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
};

template <class Number>
Triple<Number> cross(const Triple<Number>& a, const Triple<Number>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class Number>
Number dot(const Triple<Number>& a, const Triple<Number>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

/// T(t) = A cos t + B sin t + C: any quantity linear in the coordinates of a rotating point. Its roots are
///
///     t = atan2(B, A) +- atan2(S, -C),     S = sqrt(r^2 - C^2) = |T'|,     r = hypot(A, B)
///
/// none where |C| > r, one (grazing) where |C| = r; r = C = 0 is zero throughout and counts as no root.
template <class Number>
struct RotationFunction {
  Number A, B, C;
};

/// The same quantity when the rotation goes the other way: T(-t).
template <class Number>
RotationFunction<Number> reversed(const RotationFunction<Number>& T) {
  return {T.A, -T.B, T.C};
}

/// Height of the rotating point p over the plane through a with normal n, times |n|:
///
///            x(t)
///         . - o ~ ~ ~ ~ ~   plane  n . (x - a) = 0
///       .    /    .
///      .    / t    .        x(t) = R(t) p,  R(t) the rotation about z by t
///      .   +---p---.
///
///     T(t) = n . (R(t) p - a)
///
/// With R p = (p_x cos t - p_y sin t, p_x sin t + p_y cos t, p_z) the coefficients read off. C is formed from
/// p_z - a_z, so that a long way along the axis costs no digits. For a rotating plane and a stationary point take
/// `reversed`.
template <class Number>
RotationFunction<Number> height_over_plane(const Triple<Number>& n, const Triple<Number>& a,
                                           const Triple<Number>& p) {
  return {n.x * p.x + n.y * p.y, n.y * p.x - n.x * p.y, n.z * (p.z - a.z) - (n.x * a.x + n.y * a.y)};
}

/// Six times the volume spanned by the rotating edge from a along u and the stationary edge from c along w; zero
/// where their lines meet or are parallel:
///
///     T(t) = R m . w + R u . m',      m = a x u,  m' = c x w      (docs/mathematics/05-contact-under-rotation.md)
///
/// Both moments are taken about the axis point at a's height: rotating about z commutes with shifting along z,
/// and the coefficients then carry no product with the distance along the axis.
template <class Number>
RotationFunction<Number> volume_of_edges(const Triple<Number>& a, const Triple<Number>& u,
                                         const Triple<Number>& c, const Triple<Number>& w) {
  const Number h = c.z - a.z;
  const Number m_x = a.y * u.z, m_y = -(a.x * u.z), m_z = a.x * u.y - a.y * u.x;
  const Number n_x = c.y * w.z - h * w.y, n_y = h * w.x - c.x * w.z, n_z = c.x * w.y - c.y * w.x;
  return {(m_x * w.x + m_y * w.y) + (u.x * n_x + u.y * n_y),
          (m_x * w.y - m_y * w.x) + (u.x * n_y - u.y * n_x), m_z * w.z + u.z * n_z};
}

}  // namespace condyle::motion
