// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_SIMD_CUBE_PROJECTION_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_SIMD_CUBE_PROJECTION_INL
#undef CONDYLE_SIMD_CUBE_PROJECTION_INL
#else
#define CONDYLE_SIMD_CUBE_PROJECTION_INL
#endif

#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::simd::HWY_NAMESPACE {

/// Which coordinate of each vector is along the axis of its face: x, else y, else z.
template <class FloatTag>
struct FaceAxis {
  hwy::HWY_NAMESPACE::Mask<FloatTag> is_x, is_y;
};

/// A vector's coordinates in the order of its face: along its axis, and along its columns and rows.
template <class FloatTag>
struct OnFaceAxes {
  hwy::HWY_NAMESPACE::Vec<FloatTag> depth, u, w;

  HWY_INLINE OnFaceAxes(const FaceAxis<FloatTag>& axis, hwy::HWY_NAMESPACE::Vec<FloatTag> x,
                        hwy::HWY_NAMESPACE::Vec<FloatTag> y, hwy::HWY_NAMESPACE::Vec<FloatTag> z) {
    namespace hn = hwy::HWY_NAMESPACE;
    depth = hn::IfThenElse(axis.is_x, x, hn::IfThenElse(axis.is_y, y, z));
    u = hn::IfThenElse(axis.is_x, y, hn::IfThenElse(axis.is_y, z, x));
    w = hn::IfThenElse(axis.is_x, z, hn::IfThenElse(axis.is_y, x, y));
  }
};

/// Where rays meet the cube: face 0 to 5 for +x +y +z -x -y -z, and u, w in [-1, 1] on it.
template <class FloatTag>
struct CubeProjection {
  hwy::HWY_NAMESPACE::Vec<hwy::HWY_NAMESPACE::RebindToSigned<FloatTag>> face;
  hwy::HWY_NAMESPACE::Vec<FloatTag> u, w;

  HWY_INLINE CubeProjection(FloatTag d, hwy::HWY_NAMESPACE::Vec<FloatTag> x,
                            hwy::HWY_NAMESPACE::Vec<FloatTag> y, hwy::HWY_NAMESPACE::Vec<FloatTag> z) {
    namespace hn = hwy::HWY_NAMESPACE;
    constexpr hn::RebindToSigned<FloatTag> di;
    const auto ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
    const auto is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
    const auto is_y = hn::AndNot(is_x, hn::Ge(ay, az));
    const OnFaceAxes<FloatTag> at({is_x, is_y}, x, y, z);
    const auto inverse = hn::Div(hn::Set(d, 1.0f), hn::Abs(at.depth));
    const auto axis =
        hn::IfThenElse(hn::RebindMask(di, is_x), hn::Zero(di),
                       hn::IfThenElse(hn::RebindMask(di, is_y), hn::Set(di, 1), hn::Set(di, 2)));
    const auto negative = hn::And(hn::ShiftRight<31>(hn::BitCast(di, at.depth)), hn::Set(di, 3));
    face = hn::Add(axis, negative);
    u = hn::Mul(at.u, inverse), w = hn::Mul(at.w, inverse);
  }
};

}  // namespace condyle::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
