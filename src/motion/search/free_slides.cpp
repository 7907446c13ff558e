#include "motion/search/free_slides.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "condyle/first_contact.hpp"
#include "contact/body_pair.hpp"
#include "core/coordinate_range.hpp"
#include "core/ordered_sums.hpp"
#include "motion/search/start_contact.hpp"

namespace condyle::motion {
namespace {

Pose slid(Pose X, const Vec3& by) {
  X.translation() += by;
  return X;
}

/// What placing both bodies in one frame and then in another may part them by.
double rounding_of_frames(const contact::BodyPair& bodies, const Pose& X_FM) {
  double size = X_FM.translation().cwiseAbs().maxCoeff();
  for (const mesh::TriangleTree* tree : {&bodies.fixed_tree(), &bodies.mobile_tree()})
    for (int k = 0; k < 3; ++k)
      size += std::abs(double(tree->nodes()[0].centre[k])) + tree->nodes()[0].half[k];
  return 1e-14 * size;
}

/// Of a free interval; `at` ends the contact beside it.
SlideEnd slide_end(const TranslationEnd& at, const Vec3& along, const Pose& X_FM) {
  if (at.fixed_triangle == no_index) return {at.at_mm};
  const Pose X = slid(X_FM, along * at.at_mm);
  return {at.at_mm, std::abs(at.sure_mm - at.at_mm),
          ContactWitness{{FeatureKind::face, at.fixed_triangle},
                         {FeatureKind::face, at.mobile_triangle},
                         at.point,
                         posed(inverted(X), at.point)}};
}

/// Ends by size: nothing ends the line's.
constexpr double no_end = std::numeric_limits<double>::infinity();
double low_of(const SlideEnd& end) noexcept {
  return end.at_mm.value_or(-no_end);
}
double high_of(const SlideEnd& end) noexcept {
  return end.at_mm.value_or(no_end);
}

}  // namespace

FreeSlides free_slides(const Mesh& fixed, const Mesh& mobile, const Vec3& direction_F, const Pose& X_FM) {
  const AxisFrame frame(Vec3::Zero(), direction_F);
  return free_slides(fixed, SlidingBody(fixed, frame), mobile, frame, X_FM, {});
}

FreeSlides free_slides(const Mesh& fixed, const SlidingBody& placed_fixed, const Mesh& mobile,
                       const AxisFrame& frame, const Pose& X_FM, const SlideRange& range) {
  core::require_rotation(X_FM);
  const Vec3 along = frame.direction();
  const SlidingBody placed_mobile(mobile.moved_to(posed(X_FM, mobile.vertices())), frame);
  const std::vector<TranslationContact> contacts =
      translation_contacts(placed_fixed, placed_mobile, frame, range);
  const contact::BodyPair bodies(fixed, mobile);
  FreeSlides slides{.free_at_start = false, .negative = {0.0}, .positive = {0.0}, .intervals = {}};
  for (std::size_t i = 0; i <= contacts.size(); ++i) {
    FreeSlide gap;
    if (i > 0) gap.low = slide_end(contacts[i - 1].high, along, X_FM);
    if (i < contacts.size()) gap.high = slide_end(contacts[i].low, along, X_FM);
    if (low_of(gap.low) == no_end || high_of(gap.high) == -no_end) continue;  // beyond the range
    // One body inside the other is in contact all the way between two contacts of their surfaces.
    if (gap.low.at_mm && gap.high.at_mm &&
        bodies.touch(slid(X_FM, along * (*gap.low.at_mm + (*gap.high.at_mm - *gap.low.at_mm) / 2))))
      continue;
    if (!(gap.low.at_mm && *gap.low.at_mm >= 0) && !(gap.high.at_mm && *gap.high.at_mm <= 0)) {
      if (const auto touching = faces_touching(bodies, fixed, mobile, X_FM)) {
        const SlideEnd start{0.0, 0, touching};
        const double narrowest = rounding_of_frames(bodies, X_FM);
        for (const FreeSlide& part : {FreeSlide{gap.low, start}, FreeSlide{start, gap.high}})
          if (!part.low.at_mm || !part.high.at_mm || *part.high.at_mm - *part.low.at_mm > narrowest)
            slides.intervals.push_back(part);
        continue;
      }
      slides.free_at_start = true;
      slides.negative = gap.low, slides.positive = gap.high;
    }
    slides.intervals.push_back(std::move(gap));
  }
  return slides;
}

FreeSlides free_in_both(const FreeSlides& a, const FreeSlides& b) {
  const auto later = [](const SlideEnd& p, const SlideEnd& q) { return low_of(p) < low_of(q) ? q : p; };
  const auto sooner = [](const SlideEnd& p, const SlideEnd& q) { return high_of(q) < high_of(p) ? q : p; };
  FreeSlides both{a.free_at_start && b.free_at_start, {0.0}, {0.0}, {}};
  if (both.free_at_start)
    both.negative = later(a.negative, b.negative), both.positive = sooner(a.positive, b.positive);
  for (const FreeSlide& p : a.intervals)
    for (const FreeSlide& q : b.intervals) {
      FreeSlide shared{later(p.low, q.low), sooner(p.high, q.high)};
      if (low_of(shared.low) < high_of(shared.high)) both.intervals.push_back(std::move(shared));
    }
  return both;
}

}  // namespace condyle::motion
