#include <algorithm>
#include <string>
#include <vector>

#include "condyle/answer.hpp"
#include "condyle/error.hpp"
#include "core/formatted.hpp"

namespace condyle {
namespace {

/// Elements of a rotation that its angles give again differ by no more, whatever the angles are rounded by.
constexpr double same_rotation = 1e-9;

bool translates(const DepthRequest& request) {
  return request.X_FM.translation() != Vec3::Zero();
}

/// A line has a direction; an angle's axis goes through the joint centre, where the mobile body has to be.
void check_arcs(const contact::ArcsAbout& about, const Pose& X_FM) {
  if (const auto* line = std::get_if<contact::AxisLine>(&about))
    static_cast<void>(AxisFrame(line->point, line->direction));
  else if (X_FM.translation() != Vec3::Zero())
    throw UsageError(core::formatted(
        "arcs about an angle's axis turn about the joint centre, and the pose is translated from it "
        "by %.3f mm; arcs about a line answer there, or depths along rays",
        X_FM.translation().norm()));
}

/// As all depths along rays and arcs need them.
void add_measures(DepthAnswer& answer, const contact::JointContact& bodies,
                  const contact::MeasuredContact& contact) {
  const DepthRequest& request = answer.request;
  if (request.measures == MeasuresOf::distances_only)
    answer.measures.distances = contact::nearest_distances(bodies, request.X_FM, contact, request.distances);
  else
    answer.measures = contact::measure_contact(bodies, request.X_FM, contact, request.distances);
}

void add_ray_depths(DepthAnswer& answer, const contact::JointContact& bodies, const Joint& joint) {
  const DepthRequest& request = answer.request;
  RayDepths depths{bodies.radial(request.X_FM), {}};
  add_measures(answer, bodies, contact::MeasuredContact(depths.contact));
  // About which axis a body that is translated would turn depends on how it got there.
  depths.reliable = request.method == DepthMethod::reliable && !translates(request)
                        ? contact::reliable_depths(bodies, joint.kind, joint.coordinates(), *request.pose,
                                                   depths.contact, answer.measures.distances)
                        : contact::reliable_radial_depths(depths.contact, answer.measures.distances);
  answer.depths = std::move(depths);
}

void add_arc_depths(DepthAnswer& answer, const contact::JointContact& bodies, const Joint& joint) {
  const DepthRequest& request = answer.request;
  ArcDepths depths = arc_depths(bodies, request.about.value_or(JointAngle::flexion), joint.coordinates(),
                                request.X_FM, *request.pose);
  add_measures(answer, bodies, contact::MeasuredContact(depths.contact));
  answer.depths = std::move(depths);
}

void add_normal_depths(DepthAnswer& answer, const contact::JointContact& bodies) {
  const DepthRequest& request = answer.request;
  answer.depths =
      contact::normal_contact(bodies, request.X_FM, request.casting.value_or(contact::Casting::both),
                              request.rays.value_or(contact::NormalDepthOptions{}));
  add_measures(answer, bodies, contact::MeasuredContact());
}

std::vector<std::string> caveats_of(const DepthRequest& request) {
  if (request.method == DepthMethod::normal)
    return {
        "depths along normals compare with those of the same casting surface and rule only, not with radial "
        "or tangential ones"};
  if (!translates(request)) return {};
  return {
      core::formatted("the mobile body's centre is %.3f mm from the fixed body's: rays of mobile vertices "
                      "start at the fixed body's, those of fixed vertices at the mobile body's%s",
                      request.X_FM.translation().norm(),
                      request.method == DepthMethod::reliable ? "; no depths along arcs are computed" : "")};
}

const std::vector<contact::TrianglePair>& pairs_of(const DepthAnswer& answer) {
  struct {
    const std::vector<contact::TrianglePair>& operator()(const RayDepths& of) const {
      return of.contact.pairs;
    }
    const std::vector<contact::TrianglePair>& operator()(const ArcDepths& of) const {
      return of.contact.pairs;
    }
    const std::vector<contact::TrianglePair>& operator()(const contact::NormalContact& of) const {
      return of.pairs;
    }
  } read;
  return std::visit(read, answer.depths);
}

/// Where a body meets a face in which a part of the other was cut.
void add_cut_caveats(DepthAnswer& answer, const Joint& joint) {
  const auto add = [&](const Body& cut, const Body& other, Index contact::TrianglePair::*triangle) {
    if (!is_cut(cut)) return;
    const auto& pairs = pairs_of(answer);
    if (std::any_of(pairs.begin(), pairs.end(),
                    [&](const contact::TrianglePair& pair) { return is_cut_face(cut, pair.*triangle); }))
      answer.caveats.push_back(other.name + " meets a face in which a part of " + cut.name +
                               " is cut: depths end there, and contact areas count it");
  };
  add(joint.fixed, joint.mobile, &contact::TrianglePair::fixed);
  add(joint.mobile, joint.fixed, &contact::TrianglePair::mobile);
}

}  // namespace

bool DepthAnswer::in_contact() const noexcept {
  struct {
    bool operator()(const RayDepths& of) const noexcept { return of.contact.in_contact; }
    bool operator()(const ArcDepths& of) const noexcept { return of.contact.in_contact; }
    bool operator()(const contact::NormalContact& of) const noexcept { return of.in_contact; }
  } read;
  return std::visit(read, depths);
}

contact::AxisLine line_of(const contact::ArcsAbout& about, const CoordinateSystem& system,
                          const JointAngles& at) {
  if (const auto* line = std::get_if<contact::AxisLine>(&about)) return *line;
  return {axis_of(std::get<JointAngle>(about), system, at)};
}

ArcDepths arc_depths(const contact::JointContact& bodies, const contact::ArcsAbout& about,
                     const CoordinateSystem& system, const Pose& X_FM, const JointAngles& at) {
  check_arcs(about, X_FM);
  const contact::AxisLine line = line_of(about, system, at);
  ArcDepths depths{{{}, line.direction, line.point}, bodies.tangential(X_FM, line)};
  if (const auto* angle = std::get_if<JointAngle>(&about))
    depths.axis.about = *angle;
  else
    depths.axis.direction_F = AxisFrame(line.point, line.direction).direction();
  return depths;
}

void check_depth_request(const Joint& joint, const DepthRequest& request) {
  if (request.about && request.method != DepthMethod::tangential)
    throw UsageError("about: is for method tangential");
  if ((request.casting || request.rays) && request.method != DepthMethod::normal)
    throw UsageError("casting, rule, reach: are for method normal");
  if (request.method == DepthMethod::tangential)
    check_arcs(request.about.value_or(JointAngle::flexion), request.X_FM);
  if (!request.pose) return;
  const Eigen::Matrix3d difference =
      pose_at(joint.coordinates(), *request.pose).linear() - request.X_FM.linear();
  if (!(difference.cwiseAbs().maxCoeff() <= same_rotation))
    throw UsageError("pose: its angles are not those of X_FM");
}

DepthAnswer answer_depth(const contact::JointContact& bodies, const Joint& joint,
                         const DepthRequest& request) {
  check_depth_request(joint, request);
  DepthAnswer answer{.request = request, .measures = {}, .depths = {}, .caveats = caveats_of(request)};
  if (!request.pose) answer.request.pose = angles_at(joint.coordinates(), request.X_FM);
  switch (request.method) {
    case DepthMethod::reliable:
    case DepthMethod::radial:
      add_ray_depths(answer, bodies, joint);
      break;
    case DepthMethod::tangential:
      add_arc_depths(answer, bodies, joint);
      break;
    case DepthMethod::normal:
      add_normal_depths(answer, bodies);
      break;
  }
  add_cut_caveats(answer, joint);
  if (request.deepest_place && answer.in_contact())
    answer.deepest_place =
        answer_touch(bodies, {.X_FM = request.X_FM, .measures = TouchMeasures::depth}).deepest;
  if (request.limits)
    answer.standing =
        pose_standing(*request.limits, *answer.request.pose, request.X_FM.translation(), answer.in_contact());
  return answer;
}

DepthAnswer answer_depth(const Joint& joint, const DepthRequest& request) {
  return answer_depth(contact::JointContact(joint), joint, request);
}

}  // namespace condyle
