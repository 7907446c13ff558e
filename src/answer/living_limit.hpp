#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "condyle/answer/range.hpp"
#include "condyle/joint.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/range_of_motion.hpp"

/// What studies say of the living beside a limit of bone, of hips without an implant. The one table of it is in the source file.

namespace condyle {

/// How near soft tissue ended a motion to where bone would have, in the mean of cadaver hips: less than 5 degrees, 15, more.
enum class Closeness : std::uint8_t { close, moderate, weak };
inline constexpr Closeness all_closenesses[] = {Closeness::close, Closeness::moderate, Closeness::weak};
/// As in files: "close".
std::string_view name_of(Closeness closeness) noexcept;

/// How much earlier soft tissue ended the motion than bone, in hips of cadavers of adults.
struct SoftTissueGap {
  Closeness closeness;
  Angle mean, sd;
  int hips;
  std::string_view source;
};

/// How far other people's hips turn, soft tissue included: between means of groups or positions, or one mean: people spread wider. Never of this joint.
struct PeopleRange {
  Angle low, high;
  std::string_view who;
  std::optional<int> people;
  std::string_view source;
};

struct LivingLimit {
  std::optional<SoftTissueGap> gap;
  /// Where a living hip with this bone is expected to end: of the class close only, where impingement ends the motion, of adults and those whose
  /// age is not known, of bones that no plan has cut (people moved no farther after such cuts), and above 0. Its standard deviation is that of the gap and the band's, which are independent.
  std::optional<Angle> expected, expected_sd;
  std::optional<PeopleRange> people;
};

/// Empty if nothing is known of the motion, of implants and other joints, and if zero angles are not known to be neutral. `band` may be null.
std::optional<LivingLimit> living_limit(const Joint& joint, const motion::MotionLimit& limit,
                                        const motion::LimitBand* band);

/// The same of the i-th limit of an answer, with its band if it has any; no end is expected where a depth was allowed, as bone does not end the motion.
std::optional<LivingLimit> living_limit(const RangeAnswer& answer, std::size_t i);

/// What a table has of one motion: "some 129 (SD 5)" where an end is expected, else "groups' means 29–50", "mean 38", "clinical 30", or "-".
std::string text_of(const std::optional<LivingLimit>& living);

}  // namespace condyle
