#include "kinematics/hip_axes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/formatted.hpp"
#include "core/trigonometry.hpp"

namespace condyle::kinematics {
namespace {

using core::formatted;

const std::array known_axes{KnownAxes{"RAS (x right, y anterior, z superior)", ras_axes},
                            KnownAxes{"LPS (x left, y posterior, z superior)", lps_axes},
                            KnownAxes{"joint axes (x anterior, y superior, z right)", {}}};

/// Up and outwards are inferred if the votes have this mean, none of them is below the least (70 degrees off), and no
/// other axes in use come near. Of 18,000 scans of 3 real and 44 sample hips, whole or cut, with bones turned by up to 20
/// degrees against each other and by up to 30 against their axes, half are inferred and none is wrong; with a lead of 0.15
/// three are.
constexpr double least_mean = 0.75, least_vote = 0.35, least_lead = 0.25;
/// A smaller lead does if both bones are long and their ends vote so many margins: legs that lie turned or flexed take the lead from what their ends
/// show all the same.
constexpr double lead_of_long_bones = 0.1, votes_of_long_bones = 3;
constexpr std::size_t fewest_directions = 3;
/// Axes that are not in use may get this much more, as they do by bones that are cut; axes that are a quarter of a turn
/// from those in use get more than that.
constexpr double most_in_other_axes = 0.1;

/// Neck and socket lie on the diagonal between down and outwards, so that axes in which the two are exchanged get like
/// votes. The end of a bone decides: that of a femur that reaches beyond the trochanters, of a hip bone with its wing; in
/// head radii. In the same scans both are 5 to 60 degrees nearer to the vertical.
constexpr double long_femur = 3.3, long_hip_bone = 5.5, end_margin_deg = 10;

/// Votes for a side: the socket opens in front of the neck by 30 to 50 degrees, less in a femur that is turned
/// inwards; the hip bone's lower part runs forwards to the pubis, deeper in front than behind. In the same scans the
/// wrong side gets 26 degrees at most, and a correlation of 0.47 (if a cut took the pubis away).
constexpr double neck_margin_deg = 30, hip_bone_margin = 0.5;
/// A reading that one piece of evidence contradicts by half its margin is not taken.
constexpr double contradiction = -0.5;

/// From the head's centre to the pubis, in head radii: a hip bone that does not come so near the midline is cut.
constexpr double pubis_reach = 3;
/// Least horizontal part of a neck whose direction seen from above means something.
constexpr double least_horizontal = 0.3;

/// With known axes: the mean cosine of the directions to the side, and the largest to the other one. Whole hips have 0.5 and more; the
/// wrong side has as much the other way.
constexpr double least_outwards = 0.25, most_inwards = 0.2;

/// A direction that the bones show, and where it points in every hip.
struct Direction {
  const char* name;
  Vec3 seen;
  double up, outwards;

  double vote(const Vec3& superior, const Vec3& lateral) const {
    return up * seen.dot(superior) + outwards * seen.dot(lateral);
  }
};

/// Expected directions lie between those of whole bones and of bones cut near the joint; unit.
std::vector<Direction> directions_of(const HipAnatomy& hip) {
  std::vector<Direction> found{
      {"femur's mass, down and outwards of the head", hip.towards_femur, -0.76, 0.65},
      {"hip bone's mass, up and to the midline", hip.towards_pelvis, 0.7, -0.71}};
  if (hip.towards_neck) found.push_back({"femur's neck, outwards and down", *hip.towards_neck, -0.65, 0.76});
  if (hip.opening) found.push_back({"socket's opening, outwards and down", *hip.opening, -0.65, 0.76});
  return found;
}

struct Votes {
  double mean = 0, least = 1;
};

Votes votes_for(const Vec3& superior, const Vec3& lateral, const std::vector<Direction>& directions) {
  Votes votes;
  for (const Direction& direction : directions) {
    const double vote = direction.vote(superior, lateral);
    votes.mean += vote / static_cast<double>(directions.size());
    votes.least = std::min(votes.least, vote);
  }
  return votes;
}

struct Reading {
  AgreeingAxes axes;
  Votes votes;
};

/// Every reading of the axes in use, the most voted for first.
std::vector<Reading> ranked(const std::vector<Direction>& directions) {
  std::vector<Reading> all;
  for (const KnownAxes& known : known_axes)
    for (const Side side : {Side::right, Side::left}) {
      const AgreeingAxes axes{&known, side};
      all.push_back({axes, votes_for(axes.superior(), axes.lateral(), directions)});
    }
  std::stable_sort(all.begin(), all.end(),
                   [](const Reading& a, const Reading& b) { return a.votes.mean > b.votes.mean; });
  return all;
}

/// The best mean that any two axes of the meshes get as up and outwards, in use or not, and the two.
struct BestOfAll {
  double mean = -1;
  Vec3 up = Vec3::Zero(), outwards = Vec3::Zero();
};
BestOfAll best_of_all(const std::vector<Direction>& directions) {
  std::vector<Vec3> axes;
  for (int i = 0; i < 3; ++i)
    for (const double sense : {1.0, -1.0}) axes.push_back(sense * Vec3::Unit(i));
  BestOfAll best;
  for (const Vec3& up : axes)
    for (const Vec3& outwards : axes)
      if (up.dot(outwards) == 0)
        if (const double mean = votes_for(up, outwards, directions).mean; mean > best.mean)
          best = {mean, up, outwards};
  return best;
}

/// Evidence for or against a reading, in its margins.
struct Evidence {
  double vote;
  std::string line;
};

/// "+y"
std::string signed_axis(const Vec3& axis) {
  Eigen::Index i = 0;
  axis.cwiseAbs().maxCoeff(&i);
  return {axis[i] < 0 ? '-' : '+', "xyz"[i]};
}

bool contradicted(const std::vector<Evidence>& all) {
  return std::any_of(all.begin(), all.end(), [](const Evidence& one) { return one.vote <= contradiction; });
}

bool supported(const std::vector<Evidence>& all) {
  return !contradicted(all) &&
         std::any_of(all.begin(), all.end(), [](const Evidence& one) { return one.vote >= 1; });
}

/// Seen along the reading's anterior axis: by how much a long bone's end is nearer to up or down than the line of neck and
/// socket is.
Evidence end_vote(const char* bone, const AgreeingAxes& reading, const Vec3& line, const Vec3& end) {
  const auto seen = [&](const Vec3& v) {
    return Vec3(v.dot(reading.lateral()), v.dot(reading.superior()), 0);
  };
  const Vec3 from = seen(line), to = seen(end);
  const double deg = -core::arctangent(from.cross(to).z(), from.dot(to)) * 180 / std::numbers::pi;
  return {
      deg / end_margin_deg,
      formatted(
          "the far end of the %s is %.0f degrees nearer to the vertical than neck and socket (needs %.0f)",
          bone, deg, end_margin_deg)};
}

std::vector<Evidence> end_votes(const HipAnatomy& hip, const AgreeingAxes& reading) {
  const Vec3 line = hip.towards_neck.value_or(Vec3::Zero()) + hip.opening.value_or(Vec3::Zero());
  const double radius = hip.head.fit.sphere.radius;
  std::vector<Evidence> votes;
  if (hip.femur_end.norm() >= long_femur * radius)
    votes.push_back(end_vote("femur", reading, line, hip.femur_end));
  if (hip.hip_bone_end.norm() >= long_hip_bone * radius)
    votes.push_back(end_vote("hip bone", reading, -line, hip.hip_bone_end));
  return votes;
}

/// Readings that differ in front and back only.
bool same_front(const AgreeingAxes& a, const AgreeingAxes& b) {
  return a.superior() == b.superior() && a.lateral() == b.lateral();
}

std::vector<AgreeingAxes> sharing_front(const std::vector<Reading>& readings, const AgreeingAxes& best,
                                        const std::optional<Side>& given) {
  std::vector<AgreeingAxes> shared;
  for (const Reading& reading : readings)
    if (same_front(reading.axes, best) && (!given || reading.axes.side == *given))
      shared.push_back(reading.axes);
  return shared;
}

/// Seen from above: `out` is where the socket opens, `front` is in front of it in a right hip.
struct Horizon {
  Vec3 up, out, front;
};

Horizon horizon_of(const Vec3& up, const Vec3& opening) {
  const Vec3 front = up.cross(opening).normalized();
  return {up, front.cross(up), front};
}

std::string vote_text(double vote) {
  return std::abs(vote) < 1 ? "no vote" : vote > 0 ? "votes right" : "votes left";
}

/// Votes for a right hip: > 0.
std::optional<Evidence> neck_vote(const Vec3& neck, const Horizon& seen) {
  const double front = neck.dot(seen.front), out = neck.dot(seen.out);
  if (core::hypotenuse(front, out) < least_horizontal) return std::nullopt;
  const double deg = -core::arctangent(front, out) * 180 / std::numbers::pi, vote = deg / neck_margin_deg;
  return Evidence{
      vote,
      formatted("the socket opens %.0f degrees in front of the neck, read as a right hip: %s (needs %.0f)",
                deg, vote_text(vote).c_str(), neck_margin_deg)};
}

/// Sums by area over the hip bone below the head's centre, of how far in front and how deep (against the opening) it is.
struct LowerHipBone {
  double area = 0, front = 0, depth = 0, front_front = 0, front_depth = 0, depth_depth = 0;
  double to_midline = 0;

  void add(double size, double f, double d) {
    area += size, front += size * f, depth += size * d;
    front_front += size * f * f, front_depth += size * f * d, depth_depth += size * d * d;
  }
  double correlation() const {
    const double f = front / area, d = depth / area;
    return (front_depth / area - f * d) /
           std::sqrt((front_front / area - f * f) * (depth_depth / area - d * d));
  }
};

LowerHipBone lower_hip_bone(const TriMesh& hip_bone, const Vec3& centre, const Vec3& opening,
                            const Horizon& seen) {
  LowerHipBone sums;
  for (std::size_t t = 0; t < hip_bone.triangles.size(); ++t) {
    const Vec3 a = hip_bone.corner(t, 0), b = hip_bone.corner(t, 1), c = hip_bone.corner(t, 2);
    const Vec3 p = (a + b + c) / 3 - centre;
    if (p.dot(seen.up) > 0) continue;
    sums.add((b - a).cross(c - a).norm(), p.dot(seen.front), -p.dot(opening));
    sums.to_midline = std::max(sums.to_midline, -p.dot(seen.out));
  }
  return sums;
}

std::optional<Evidence> hip_bone_vote(const TriMesh& hip_bone, const HipAnatomy& hip, const Horizon& seen) {
  const Sphere& head = hip.head.fit.sphere;
  const LowerHipBone lower = lower_hip_bone(hip_bone, head.centre, *hip.opening, seen);
  if (!(lower.to_midline >= pubis_reach * head.radius)) return std::nullopt;
  const double correlation = lower.correlation(), vote = correlation / hip_bone_margin;
  if (!std::isfinite(vote)) return std::nullopt;
  return Evidence{vote, formatted("the hip bone below the head is deeper in front, read as a right hip, by a "
                                  "correlation of %.2f: %s (needs %.1f)",
                                  correlation, vote_text(vote).c_str(), hip_bone_margin)};
}

std::vector<Evidence> side_votes(const TriMesh& hip_bone, const HipAnatomy& hip, const Vec3& up) {
  std::vector<Evidence> votes;
  if (!hip.opening) return votes;
  const Horizon seen = horizon_of(up, *hip.opening);
  if (hip.towards_neck)
    if (auto vote = neck_vote(*hip.towards_neck, seen)) votes.push_back(std::move(*vote));
  if (auto vote = hip_bone_vote(hip_bone, hip, seen)) votes.push_back(std::move(*vote));
  return votes;
}

/// The votes for a right hip as votes for this side.
std::vector<Evidence> as_for(Side side, std::vector<Evidence> votes) {
  if (side == Side::left)
    for (Evidence& one : votes) one.vote = -one.vote;
  return votes;
}

std::string text_of(const AgreeingAxes& reading) {
  return formatted("%s of a %s hip", std::string(reading.axes->name).c_str(),
                   reading.side == Side::right ? "right" : "left");
}

std::vector<std::string> votes_text(const std::vector<Direction>& directions, const Reading& best,
                                    const Reading& next, double of_all) {
  std::vector<std::string> lines{"votes for " + text_of(best.axes) + "; for the next, " + text_of(next.axes)};
  const auto vote = [](const Direction& direction, const Reading& reading) {
    return direction.vote(reading.axes.superior(), reading.axes.lateral());
  };
  for (const Direction& direction : directions)
    lines.push_back(
        formatted("%s: %.2f; %.2f", direction.name, vote(direction, best), vote(direction, next)));
  lines.push_back(formatted(
      "mean: %.2f; %.2f; at best in any axes %.2f (needs %.2f, %.2f more than the next, no vote below %.2f)",
      best.votes.mean, next.votes.mean, of_all, least_mean, least_lead, least_vote));
  return lines;
}

std::string why_several(const std::vector<AgreeingAxes>& agreeing) {
  std::string why = "the bones agree with more than one of the axes in use";
  for (const AgreeingAxes& reading : agreeing) why += "; " + text_of(reading);
  return why;
}

/// The one that the sides' votes choose among readings that differ in front and back only; all if they choose none.
std::vector<AgreeingAxes> chosen(std::vector<AgreeingAxes> readings, const std::vector<Evidence>& votes) {
  if (readings.size() == 1) {
    if (contradicted(as_for(readings[0].side, votes))) readings.clear();
    return readings;
  }
  for (const AgreeingAxes& reading : readings)
    if (supported(as_for(reading.side, votes))) return {reading};
  return readings;
}

}  // namespace

HipAxes hip_axes(const TriMesh& hip_bone, const HipAnatomy& hip, const std::optional<Side>& given) {
  const auto directions = directions_of(hip);
  const auto readings = ranked(directions);
  const Reading& best = readings.front();
  const Reading& next = *std::find_if(readings.begin(), readings.end(), [&](const Reading& reading) {
    return !same_front(reading.axes, best.axes);
  });
  const auto [of_all, up, outwards] = best_of_all(directions);
  const auto ends = end_votes(hip, best.axes);
  const auto sides = side_votes(hip_bone, hip, best.axes.superior());

  const bool are_long = ends.size() > 1 && std::all_of(ends.begin(), ends.end(), [](const Evidence& end) {
                          return end.vote >= votes_of_long_bones;
                        });
  const double lead = best.votes.mean - next.votes.mean;
  HipAxes answer;
  answer.evidence = votes_text(directions, best, next, of_all);
  for (const auto* votes : {&ends, &sides})
    for (const Evidence& vote : *votes) answer.evidence.push_back(vote.line);
  const std::string likeliest = "the bones lie most nearly as in " + text_of(best.axes);
  if (directions.size() < fewest_directions)
    answer.why_none = "neck and socket of the bones were not found";
  else if (best.votes.mean < std::max(least_mean, of_all - most_in_other_axes))
    answer.why_none = formatted(
        "the bones agree with none of the axes in use: up is most nearly %s of the meshes, outwards %s",
        signed_axis(up).c_str(), signed_axis(outwards).c_str());
  else if (best.votes.least < least_vote)
    answer.why_none = likeliest + ", and one direction of theirs contradicts it";
  else if (!supported(ends))
    answer.why_none = likeliest + ", but no far end of theirs shows up apart from outwards";
  else if (lead < (are_long ? lead_of_long_bones : least_lead))
    answer.why_none = likeliest + ", and nearly as much as in " + text_of(next.axes);
  if (!answer.why_none.empty()) return answer;
  answer.agreeing = chosen(sharing_front(readings, best.axes, given), sides);
  if (answer.agreeing.empty())
    answer.why_none =
        formatted("the bones agree with none of the axes in use as a %s hip: their shape is the other side's",
                  given.value_or(best.axes.side) == Side::right ? "right" : "left");
  else if (answer.agreeing.size() > 1)
    answer.why_none = why_several(answer.agreeing);
  return answer;
}

double shape_vote(Side side, const TriMesh& hip_bone, const HipAnatomy& hip, const Vec3& up) {
  double sum = 0;
  for (const Evidence& vote : as_for(side, side_votes(hip_bone, hip, up))) sum += vote.vote;
  return sum;
}

SideInAxes side_in(const FrameDirections& axes, const HipAnatomy& hip) {
  const Vec3 right = axes.anterior.cross(axes.superior);
  const auto directions = directions_of(hip);
  SideInAxes answer;
  double mean = 0, least = 1, largest = -1;
  for (const Direction& direction : directions) {
    const double to_right = std::copysign(1.0, direction.outwards) * direction.seen.dot(right);
    mean += to_right / static_cast<double>(directions.size());
    least = std::min(least, to_right), largest = std::max(largest, to_right);
    answer.evidence.push_back(formatted("%s: to the right by %.2f", direction.name, to_right));
  }
  answer.evidence.push_back(formatted("mean: %.2f (needs %.2f either way, none that contradicts by %.2f)",
                                      mean, least_outwards, most_inwards));
  if (directions.size() < fewest_directions) return answer;
  if (mean >= least_outwards && least >= -most_inwards) answer.side = Side::right;
  if (mean <= -least_outwards && largest <= most_inwards) answer.side = Side::left;
  return answer;
}

}  // namespace condyle::kinematics
