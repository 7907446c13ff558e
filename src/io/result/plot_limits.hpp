#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "condyle/limit_band.hpp"
#include "io/result/plot_axes.hpp"

namespace condyle::io {

/// How far a healthy adult hip is said to turn in the motion of this name; empty where the source has no
/// value. American Academy of Orthopaedic Surgeons, "Joint Motion: Method of Measuring and Recording",
/// Chicago 1965: flexion 120, extension 30, abduction 45, adduction 30, internal and external rotation 45
/// degrees. Measured on the living, where soft tissue stops most motions before bone does: a bony limit past
/// the range is usual, one well short of it is not.
std::optional<Angle> normal_hip_range(std::string_view motion) noexcept;

/// The source as it is named on plots and in results.
inline constexpr std::string_view normal_hip_range_source =
    "AAOS, Joint Motion: Method of Measuring and Recording, 1965";

/// Which normal ranges stand behind the bars; of joints other than the hip none with a source are known here.
enum class NormalRanges { none, of_hip };

/// The limits of all motions as a horizontal bar chart, SVG text: how far each turns from its start in
/// degrees, with a mark for the reason and, behind the bar, the normal range where there is a source for it.
/// With bands, one per limit or none, a whisker from 5 to 95 % with a tick at the median.
std::string limits_plot(const PlotHeading& heading, std::span<const MotionLimit> limits,
                        std::span<const LimitBand> bands = {}, NormalRanges normal = NormalRanges::of_hip);

}  // namespace condyle::io
