// Included once for every instruction set, by sources that are compiled so.
#if defined(CONDYLE_RADIAL_DOUBLE_VECTORS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef CONDYLE_RADIAL_DOUBLE_VECTORS_INL
#undef CONDYLE_RADIAL_DOUBLE_VECTORS_INL
#else
#define CONDYLE_RADIAL_DOUBLE_VECTORS_INL
#endif

#include "simd/prelude-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace condyle::radial::HWY_NAMESPACE {

/// As many vectors in space as there are lanes.
using DD = hwy::HWY_NAMESPACE::CappedTag<double, 8>;
using Doubles = hwy::HWY_NAMESPACE::Vec<DD>;

struct Vectors {
  Doubles x, y, z;
};

/// The sum in the order of triangle_plane::dot(), for the same bits.
HWY_INLINE Doubles dot(const Vectors& a, const Vectors& b) {
  namespace hn = hwy::HWY_NAMESPACE;
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

}  // namespace condyle::radial::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
