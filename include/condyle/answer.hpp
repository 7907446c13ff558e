#pragma once

/// One function per question: a request in, an owning result out. The command, the Python module, studies, reports and the page
/// all ask here, so that they say the same bits, notes included. What a request leaves open is as the Case has it.
///
///     const Case hip{.joint = joint, .placement = placement};
///     const auto depth = answer_depth(joint, {.X_FM = X_FM});
///     const auto range = answer_range(hip, {.motions = hip.motions()});
///     const auto load  = answer_load(cartilages, {.X_FM = X_FM, .load = stance});
///     const auto gait  = answer_motion(bodies, &cartilages, {.X_FM = frames, .time_s = times});
///     const auto shape = answer_measures(hip);
///     const auto cup   = answer_implant(hip, {.hip = {.head_radius_mm = 18}});

// In reading order, not in the alphabet's.
// clang-format off
#include "condyle/answer/case.hpp"
#include "condyle/answer/depth.hpp"
#include "condyle/answer/load.hpp"
#include "condyle/answer/motion.hpp"
#include "condyle/answer/range.hpp"
#include "condyle/answer/measures.hpp"
#include "condyle/answer/resection.hpp"
#include "condyle/answer/implant.hpp"
#include "condyle/answer/sweep.hpp"
