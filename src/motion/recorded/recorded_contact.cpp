#include "condyle/motion_contact.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>
#include <utility>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "core/per_thread.hpp"
#include "motion/recorded/rotation_contacts.hpp"
#include "motion/recorded/screw_contacts.hpp"

namespace condyle::motion {
namespace {

using motion::ContactPart;
using motion::ContactParts;
using motion::ScrewMotion;

/// Entries of R^T R - 1 up to this: what is farther from a rotation was not meant as one.
constexpr double rotation_tolerance = 1e-9;

bool is_rotation(const Eigen::Matrix3d& R) {
  const double off = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return off <= rotation_tolerance && R.determinant() > 0;  // false for what is not a number
}

void check_samples(std::span<const double> time_s, std::span<const Pose> X_FM,
                   const RecordedContactOptions& options) {
  const auto refuse = [](std::size_t sample, const char* what) {
    throw UsageError("recorded motion: sample " + std::to_string(sample) + ": " + what);
  };
  if (time_s.size() != X_FM.size())
    throw UsageError("recorded motion: " + std::to_string(time_s.size()) + " times and " +
                     std::to_string(X_FM.size()) + " poses");
  if (time_s.size() < 2) throw UsageError("recorded motion: needs two samples or more");
  if (!(options.resolution_s > 0) || !std::isfinite(options.resolution_s))
    throw UsageError("recorded motion: the resolution must be above 0 s");
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (!std::isfinite(time_s[i])) refuse(i, "its time is not finite");
    if (i > 0 && !(time_s[i] > time_s[i - 1])) refuse(i, "its time is not after the one before");
    if (!X_FM[i].translation().allFinite()) refuse(i, "its translation is not finite");
    if (!is_rotation(X_FM[i].linear())) refuse(i, "its rotation is none");
  }
}

/// Contact found between one sample and the next.
struct Segment {
  BetweenSamples searched = BetweenSamples::exact;
  Angle rotation = {};
  ContactParts contacts = {};
  std::size_t poses = 0;
};

/// The bodies, and what each thread keeps of them.
class SegmentSearch {
 public:
  explicit SegmentSearch(const contact::JointContact& bodies)
      : bodies_(bodies),
        reach_mm_(reach_of(bodies.mobile())),
        fixed_(bodies.fixed()),
        mobile_(bodies.mobile()),
        workers_([this] {
          return Worker{RotatingBody(fixed_), RotatingBody(mobile_)};
        }) {}

  ScrewMotion motion(const Pose& from, const Pose& to) const { return {from, to, reach_mm_}; }

  /// The resolution as a fraction of the segment.
  Segment search(const ScrewMotion& motion, double resolution) {
    Segment segment{BetweenSamples::exact, motion.rotation(), {}, 0};
    if (motion.is_still()) {
      if (bodies_.in_contact(motion.at(0))) segment.contacts = {{0, 1, ContactPart::Proven{0, 1}}};
    } else if (motion.holds_origin()) {
      Worker& worker = workers_.local();
      segment.contacts = motion::rotation_contacts(worker.fixed, worker.mobile, motion);
    } else {
      segment.searched = BetweenSamples::bounded;
      ScrewContacts found = motion::screw_contacts({bodies_, fixed_, mobile_}, motion, resolution);
      segment.contacts = std::move(found.contacts), segment.poses = found.poses;
    }
    return segment;
  }

 private:
  struct Worker {
    RotatingBody fixed, mobile;
  };

  const contact::JointContact& bodies_;
  double reach_mm_;
  FeatureTree fixed_, mobile_;
  core::PerThread<Worker> workers_;
};

/// A place in the recording.
struct Place {
  std::size_t sample;
  double fraction;  ///< of the segment to the next one
};

/// A contact over one segment or several, joined in order.
struct Run {
  Place entry, exit;
  struct Proven {
    Place first, last;
  };
  std::optional<Proven> proven;
  double undecided_s;
  std::optional<ContactWitness> at_entry, at_exit;

  void continue_with(Run next) {
    exit = next.exit;
    undecided_s += next.undecided_s;
    if (!next.proven) return;
    if (!proven) proven = next.proven, at_entry = std::move(next.at_entry);
    proven->last = next.proven->last, at_exit = std::move(next.at_exit);
  }
};

std::vector<Run> runs_of(std::span<const double> time_s, std::span<const Segment> segments) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    for (const ContactPart& s : segments[i].contacts) {
      Run run{{i, s.entry}, {i, s.exit}, {}, s.undecided * (time_s[i + 1] - time_s[i]),
              s.at_entry,   s.at_exit};
      if (s.proven) run.proven = Run::Proven{{i, s.proven->first}, {i, s.proven->last}};
      const bool continues =
          !runs.empty() && s.entry == 0 && runs.back().exit.sample + 1 == i && runs.back().exit.fraction == 1;
      if (continues) {
        runs.back().continue_with(std::move(run));
      } else {
        runs.push_back(std::move(run));
      }
    }
  }
  return runs;
}

RecordedContact put_together(std::span<const double> time_s, std::span<const Segment> segments) {
  RecordedContact out;
  for (const Segment& segment : segments)
    out.searched.push_back(segment.searched), out.poses += segment.poses;
  const auto time = [&](const Place& p) {
    const double from = time_s[p.sample], to = time_s[p.sample + 1];
    return p.fraction == 1 ? to : from + p.fraction * (to - from);
  };
  const auto end_at = [&](const Place& place, bool of_recording, std::optional<ContactWitness> contact) {
    const Segment& segment = segments[place.sample];
    const ContactEndKind kind = of_recording                                  ? ContactEndKind::recording
                                : segment.searched == BetweenSamples::bounded ? ContactEndKind::bounded
                                                                              : ContactEndKind::exact;
    return ContactEnd{
        kind, time(place), 0, place.sample, segment.rotation * place.fraction, std::move(contact)};
  };
  for (Run& run : runs_of(time_s, segments)) {
    const bool from_begin = run.entry.sample == 0 && run.entry.fraction == 0;
    const bool to_end = run.exit.sample + 1 == segments.size() && run.exit.fraction == 1;
    ContactInterval contact{end_at(run.entry, from_begin, std::move(run.at_entry)),
                            end_at(run.exit, to_end, std::move(run.at_exit)), run.proven.has_value(),
                            run.undecided_s};
    contact.entry.uncertainty_s = time(run.proven ? run.proven->first : run.exit) - contact.entry.time_s;
    contact.exit.uncertainty_s = contact.exit.time_s - time(run.proven ? run.proven->last : run.entry);
    out.contacts.push_back(std::move(contact));
  }
  return out;
}

}  // namespace

RecordedContact contact_between(const contact::JointContact& bodies, std::span<const double> time_s,
                                std::span<const Pose> X_FM, const RecordedContactOptions& options) {
  return *contact_between(bodies, time_s, X_FM, options, {});
}

std::optional<RecordedContact> contact_between(const contact::JointContact& bodies,
                                               std::span<const double> time_s, std::span<const Pose> X_FM,
                                               const RecordedContactOptions& options,
                                               const Control& control) {
  check_samples(time_s, X_FM, options);
  SegmentSearch search(bodies);
  std::vector<ScrewMotion> motions;
  for (std::size_t i = 0; i + 1 < X_FM.size(); ++i) {
    motions.push_back(search.motion(X_FM[i], X_FM[i + 1]));
    if (motions.back().rotation() > most_rotation)
      throw UsageError("recorded motion: samples " + std::to_string(i) + " and " + std::to_string(i + 1) +
                       " are more than 179 degrees apart: which way round is not known");
  }

  std::vector<Segment> segments(motions.size());
  std::size_t done = 0;
  std::mutex reporting;
  core::parallel_chunks(segments.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && !control.stop.stop_requested(); ++i) {
      segments[i] = search.search(motions[i], options.resolution_s / (time_s[i + 1] - time_s[i]));
      const std::scoped_lock lock(reporting);
      ++done;
      if (control.progress) control.progress("segments between samples", done, segments.size());
    }
  });
  if (done < segments.size()) return std::nullopt;
  return put_together(time_s, segments);
}

}  // namespace condyle::motion
