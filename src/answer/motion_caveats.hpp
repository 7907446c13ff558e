#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "condyle/joint.hpp"
#include "condyle/range_of_motion.hpp"

/// Whether bone is what usually ends a motion. Written once, for every text, file, figure and page.

namespace condyle {

enum class MotionCaveatCode : std::uint8_t {
  bone_may_end,         ///< Bone met bone in normal hips in this motion.
  soft_tissue_ends,     ///< Soft tissue ended it.
  soft_tissue_close,    ///< Soft tissue ended it a few degrees before bone.
  capsule_restrains,    ///< The capsule's ligaments restrain it.
  labrum_not_modelled,  ///< A labrum ends it earlier, and no mesh is called one.
  end_unknown,          ///< No source is known here.
};

/// As in files: "soft_tissue_ends".
std::string_view name_of(MotionCaveatCode code) noexcept;

/// Caveat to read before a limit is compared with a living joint.
struct MotionCaveat {
  MotionCaveatCode code;
  std::string_view summary;  ///< of several motions: "soft tissue usually ends them before bone does"
  std::string_view text;     ///< one sentence
  std::string_view source;   ///< where it is from; empty for end_unknown
};

/// The caveats of a motion, by its name, angle and sense. Every motion of a hip has one at least, which says whether bone usually
/// ends it; for other joints no source is known here, and there are none.
///
///     flexion                            bone may end it         Turley et al. 2013
///     extension                          soft tissue ends it     Turley et al. 2013
///     abduction                          not known
///     adduction                          bone may end it         Turley et al. 2013, by one reading
///     internal_rotation, external_       the capsule restrains   van Arkel et al. 2015
///     abduction_at_90_flexion            bone may end it         Turley et al. 2013; Han et al. 2020
///     adduction_at_90_flexion            soft tissue ends it     Turley et al. 2013
///     internal_rotation_at_90_flexion    soft tissue ends it a few degrees earlier, Han et al. 2020; no labrum, PMC7754612
///     external_rotation_at_90_flexion    the capsule restrains   van Arkel et al. 2015
///     fadir                              bone may end it         Han et al. 2020; no labrum, PMC7754612
///     faber                              the capsule restrains   van Arkel et al. 2015
///
/// No labrum: not where a mesh is called one. The sources are of native hips: the motions of an implant have the caveat that no source is known.
std::vector<MotionCaveat> motion_caveats(const Joint& joint, const motion::Motion& motion);

}  // namespace condyle
