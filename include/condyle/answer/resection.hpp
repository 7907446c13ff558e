#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/answer/case.hpp"
#include "condyle/answer/range.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/resection.hpp"

/// The bone that must go for motions to reach their targets.

namespace condyle {

/// Options of a request for a resection, with their defaults.
struct ResectionRequest {
  plan::ResectionOptions resection = {};
  /// Motions whose limits are given before and after; if empty, all that the case has.
  std::vector<motion::Motion> motions = {};
  /// Joints displaced within what is uncertain, by which the plan is made and judged; empty: by the joint as given only.
  std::optional<BandRequest> bands = BandRequest{};
  /// Share of them, above 0 and below 1, in which each target is to be reached: the margin is as much larger as that takes. Empty: the
  /// margin stays as it is.
  std::optional<double> confidence = 0.5;
  /// Points of each target's curve of degrees against removed volume; 0 for none.
  std::size_t curve_points = 10;
  /// Stopped once there is a cut for the joint as given, the answer is that cut, with a note that says what is left out.
  bool keep_if_stopped = false;
};

enum class ResectionNoteCode : std::uint8_t {
  nothing_to_do,   ///< The joint reaches all targets uncut.
  target_blocked,  ///< Kept bone stops a motion short of its target.
  band_not_reached,  ///< Not reached in the requested share of displaced joints, or in 80 %: kept bone ends the motion before.
  not_decided,  ///< A target is reached about the head's centre and not about the socket's, or the other way round.
  no_plan,  ///< About the other centre the motion goes less far after the cut than about this one before it.
  bearing_is_swept,  ///< The other bone sweeps over bearing surface, whose contact counts for nothing.
  neck_is_narrowed,  ///< More than 30 % of the neck's width goes.
  no_gain,           ///< A limit is unchanged.
  alpha_stays,  ///< The alpha angle is no smaller after a cut at the neck: what it is read from stands in no way.
  edge_changed,     ///< Triangles around the cut are larger or smaller than requested: EdgeReason.
  burr_meets_kept,  ///< The burr's ball would have to enter bone that stays.
  sliding_surfaces,  ///< The bodies slide on each other by nature, and no bearing surface is known: removed bone may belong to it.
  more_than_must,  ///< Much bone goes that no target needs: a depth, or counting whole triangles, cannot spare it.
  stopped,  ///< It was stopped: a cut for the joint as given, that no varied joint was asked about, or a plan without curves.
  finer_triangles,  ///< A limit grows by the smaller triangles around a cut alone: fewer of them lie partly in the bearing ball.
};

/// As in files: "nothing_to_do".
[[nodiscard]] std::string_view name_of(ResectionNoteCode code) noexcept;

struct ResectionNote {
  ResectionNoteCode code;
  std::string text;  ///< one sentence
};

/// Share of the neck's width that may go without a note.
inline constexpr double neck_width_share = 0.3;

struct ResectionAnswer {
  /// The cost of a target if it were the only one, at nearer angles.
  struct CurvePoint {
    std::size_t target;
    Angle reached;
    double volume_mm3, deepest_mm;
  };
  /// What a plan for a share of displaced joints costs.
  struct Alternative {
    double confidence, margin_mm, volume_mm3;
  };
  /// What a cut promises of a target.
  struct TargetPromise {
    /// A motion before and after a cut if the joint turned about its other centre.
    struct AboutOtherCentre {
      BodyRole of;  ///< the body whose sphere has that centre: the fixed one's is the socket
      Angle before, after;
      bool is_decided;  ///< the target is reached about both centres or about neither
    };
    std::optional<double> confidence_reached =
        {};  ///< share of the displaced joints in which this cut reaches it
    std::optional<motion::LimitBand> before = {}, after = {};
    /// If head and socket are known with their centres over centres_apart_mm apart.
    std::optional<AboutOtherCentre> other_centre = {};
    bool is_plan = true;    ///< false: about the other centre it ends before where it ends now
    std::string text = {};  ///< how far it goes, in how many joints, and about which centre: one line
  };

  plan::Resection resection;
  double margin_mm =
      0;  ///< as planned: larger than requested where a share of displaced joints is to reach the targets
  std::optional<double> confidence = {};       ///< as requested; empty where the margin was to stay
  std::size_t displaced = 0;                   ///< joints by which it is judged
  std::vector<TargetPromise> promises = {};    ///< one per target
  std::vector<Alternative> alternatives = {};  ///< the plan for the requested share, and the one for 80 %
  std::vector<motion::MotionLimit> before = {}, after = {};  ///< one per motion
  /// One per motion: what the cut adds, without what smaller triangles alone add; of a target what it adds in the requested share of displaced
  /// joints, or half.
  std::vector<Angle> gain = {};
  std::optional<measure::HipMeasures> shape_before = {}, shape_after = {};  ///< of a hip
  std::vector<motion::LimitBand> bands_before = {}, bands_after = {};       ///< one per motion if requested
  std::vector<CurvePoint> curve = {};                                       ///< by target, ascending
  std::vector<ResectionNote> notes = {};
  std::vector<RangeNote> limit_notes =
      {};  ///< what the limits after the cut must be read with, as those of answer_range()
  std::vector<std::string> caveats = {};  ///< what the plan leaves out, a sentence each
};

/// How far a motion shall go, by its name.
struct NamedReach {
  std::string motion;
  Angle reach;
  bool is_gain = false;  ///< as plan::ReachTarget::is_gain
};

/// Targets from "flexion=115 internal_rotation_at_90_flexion=+10", separated by blanks or commas: with a plus what the motion shall gain. Throws UsageError for other text.
[[nodiscard]] std::vector<NamedReach> parse_reach(std::string_view text);

/// Targets of these motions, each by its name as motion_named() finds it. Throws UsageError for an unknown name.
[[nodiscard]] std::vector<plan::ReachTarget> reach_targets(std::span<const motion::Motion> motions,
                                                           std::span<const NamedReach> named);
/// The targets in a text, as parse_reach() reads it.
[[nodiscard]] std::vector<plan::ReachTarget> reach_targets(std::span<const motion::Motion> motions,
                                                           std::string_view text);

/// The bone that must go, the limits and the shape before and after, and what each degree costs. Empty if it was stopped, but for
/// `keep_if_stopped`. Stages: "cuts", "joints of the band".
///
/// A motion that the cut gives nothing ends after it where it did before. Throws as resect(), measure_hip() and limit_bands() do, and
/// UsageError for a share outside its range. A second for each cut of a hip of 20,000 triangles: one, one for each point of a curve, and
/// about five to find the margin of a share of displaced joints.
[[nodiscard]] std::optional<ResectionAnswer> answer_resection(const Case& joint,
                                                              const ResectionRequest& request,
                                                              const Control& control);
[[nodiscard]] ResectionAnswer answer_resection(const Case& joint, const ResectionRequest& request);

}  // namespace condyle
