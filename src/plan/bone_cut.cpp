#include "plan/bone_cut.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "kinematics/hip_parts.hpp"
#include "mesh/require_solid.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/surface_distance.hpp"
#include "mesh/triangle_distance.hpp"
#include "plan/burr.hpp"
#include "plan/grown.hpp"
#include "plan/refine.hpp"
#include "plan/removed_bone.hpp"
#include "plan/triangle_points.hpp"

namespace condyle::plan {
namespace {

/// Margin beyond a target, so that the remaining bone meets the other bone only past it.
constexpr Angle beyond = Angle::degrees(0.0005);
/// A motion that kept bone stops is planned short of that.
constexpr Angle short_of_kept = Angle::degrees(0.001);
/// Where surfaces still meet they go down to where they are clear, and by this, mm, as often as that was; so often at most.
constexpr double correction_mm = 0.002;
constexpr int most_corrections = 60;
/// Edges are split at bends of the depth that straight lines miss by more than this, mm at edges of 1 mm, and as the edges' square; in so
/// many passes.
constexpr double missed_at_bends = 0.04;
constexpr int passes_at_bends = 5;
/// A cut that folds is tried with edges half as long, so often, if that makes no more small triangles than this.
constexpr int most_shorter_edges = 2;
constexpr std::size_t most_triangles_of_shorter = 60'000;
/// A surface of which more triangles are turned over before anything is corrected is refused: no other direction mended so many, and each that is
/// tried takes as long again. Cuts of real hips have 10,000 triangles at edges of 0.5 mm.
constexpr std::size_t most_turned = 10'000;
/// So many points of triangles are looked at at a time.
constexpr std::size_t points_at_once = 200'000;
/// A burr's cut is unfolded and made again so often.
constexpr int most_burrs = 3;
/// Kept bone is found anew so often: each time the motions go less far.
constexpr int most_stops = 20;
/// Points in which a surface is asked for what goes: so far apart, and so far outside of it too, mm.
constexpr double search_spacing_mm = 1, search_outside_mm = 1;

std::vector<Index> all_triangles(const Mesh& mesh) {
  std::vector<Index> all(mesh.triangles().size());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

/// These triangles of a body, without soft meshes and without those in the ball; and which triangles of the mesh remain.
motion::PartOfMesh counted(const Body& body, const Mesh& mesh, const Included& counts,
                           const std::optional<BearingBall>& ball, const std::vector<Index>& triangles) {
  TriMesh part{mesh.vertices(), {}};
  std::vector<Index> in_whole;
  for (const Index t : triangles) {
    if (!counts(body, t)) continue;
    if (ball && ball->holds(mesh.corner(t, 0)) && ball->holds(mesh.corner(t, 1)) &&
        ball->holds(mesh.corner(t, 2)))
      continue;
    part.triangles.push_back(mesh.triangles()[t]);
    in_whole.push_back(t);
  }
  return {Mesh(std::move(part)), std::move(in_whole)};
}

/// With all triangles that share a vertex with one of these.
std::vector<std::uint8_t> with_neighbours(const TriMesh& mesh, std::vector<std::uint8_t> triangles) {
  std::vector<std::uint8_t> vertices(mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (triangles[t])
      for (const Index v : mesh.triangles[t]) vertices[v] = 1;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const Index v : mesh.triangles[t])
      if (vertices[v]) triangles[t] = 1;
  return triangles;
}

}  // namespace

bool Included::operator()(const Body& body, std::size_t triangle) const {
  const BodyPart* part = part_of_triangle(body, triangle);
  return !part || part->contact == PartContact::ends ||
         (part->contact == PartContact::bearing && !leaves_out_bearing);
}

BoneCut::BoneCut(const Joint& joint, BodyRole cut_role, const ResectionOptions& request,
                 std::vector<CutTarget> targets, double share)
    : joint_(joint),
      role_(cut_role),
      bone_(cut_role == BodyRole::mobile ? joint.mobile : joint.fixed),
      request_(request),
      targets_(std::move(targets)),
      share_(share),
      stopped_(targets_.size()),
      edge_mm_(request.edge_mm) {
  bearing_ = motion::find_bearing_surface(joint, request.range.bearing).surface;
  if (!bearing_ && kept().within_mm)
    throw UsageError("resection: bone is to stay by its distance from the bearing surface, and " +
                     joint.name + " has none that is known");
  if (bearing_ && request.range.bearing.rule == motion::BearingRule::leave_out) ball_.emplace(*bearing_);
  const bool cuts_mobile = role_ == BodyRole::mobile;
  const Body& other = cuts_mobile ? joint.fixed : joint.mobile;
  const Included of_other = included(cuts_mobile ? BodyRole::fixed : BodyRole::mobile);
  const std::vector<Index> whole = all_triangles(other.mesh);
  const Mesh solid = counted(other, other.mesh, of_other, std::nullopt, whole).mesh;
  if (!solid.is_closed())
    throw MeshError(other.name + ": its mesh is open, so the bone that it sweeps over cannot be computed");
  if (!bone_.mesh.is_closed())
    throw MeshError(bone_.name + ": its mesh is open, and no bone can be removed from it");
  // Nothing is inside a body whose triangles are wound the other way.
  mesh::require_oriented(solid, other.name);
  mesh::require_oriented(bone_.mesh, bone_.name);
  const Mesh around = grown(solid, request.margin_mm);
  const Mesh ending = cuts_mobile
                          ? around
                          : counted(other, grown(other.mesh, request.margin_mm), of_other, ball_, whole).mesh;
  for (const CutTarget& target : targets_) {
    sweeps_.push_back(std::make_unique<Sweep>(joint, role_, around, target.motion, ball_));
    exact_.push_back(std::make_unique<ExactReach>(joint, role_, ending, target.motion));
    reach_.push_back(target.reach);
  }
  refine();
  cut();
}

Included BoneCut::included(BodyRole role) const {
  return {role == BodyRole::mobile && request_.range.bearing.rule == motion::BearingRule::leave_out};
}

std::vector<SweepTo> BoneCut::sweeps_to_reach() const {
  std::vector<SweepTo> all;
  for (std::size_t i = 0; i < sweeps_.size(); ++i) all.push_back({sweeps_[i].get(), reach_[i] + beyond});
  return all;
}

/// The pieces, among those that are asked for, with a point that is swept, on the surface or a little outside of it, and all that are in a
/// place that was met.
std::vector<std::uint8_t> BoneCut::to_cut(const TriMesh& pieces, const std::vector<Index>& before,
                                          const std::vector<std::uint8_t>& asked) const {
  const Included counts = included(role_);
  const auto bears = [&](const std::array<Vec3, 3>& corners) {
    return role_ == BodyRole::mobile && ball_ && ball_->holds(corners[0]) && ball_->holds(corners[1]) &&
           ball_->holds(corners[2]);
  };
  std::vector<std::uint8_t> marks(pieces.triangles.size(), 0);
  const std::vector<SweepTo> sweeps = sweeps_to_reach();
  Points points;
  std::vector<Index> of;
  const auto mark_swept = [&] {
    for (const SweepTo& sweep : sweeps) {
      const std::vector<double> first = sweep.sweep->first_inside(points, sweep.reach);
      for (std::size_t i = 0; i < first.size(); ++i)
        if (std::isfinite(first[i])) marks[of[i]] = 1;
    }
    points = {}, of.clear();
  };
  for (Index t = 0; t < pieces.triangles.size(); ++t) {
    if (!asked[t] || !counts(bone_, before[t])) continue;
    const std::array<Vec3, 3> corners{pieces.corner(t, 0), pieces.corner(t, 1), pieces.corner(t, 2)};
    if (bears(corners)) continue;
    const Vec3 outwards = (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
    for (const Vec3& p : points_of_triangle(corners, search_spacing_mm))
      for (const double off : {0.0, search_outside_mm}) {
        points.push_back(p + off * outwards);
        of.push_back(t);
      }
    if (of.size() >= points_at_once) mark_swept();
  }
  mark_swept();
  for (const Place& place : met_)
    for (Index t = 0; t < pieces.triangles.size(); ++t) {
      const std::array<Vec3, 3> corners{pieces.corner(t, 0), pieces.corner(t, 1), pieces.corner(t, 2)};
      if ((mesh::nearest_on_triangle(place.centre, corners) - place.centre).norm() <= place.radius_mm)
        marks[t] = 1;
    }
  return marks;
}

const KeptBone& BoneCut::kept() const {
  return role_ == BodyRole::mobile ? request_.mobile : request_.fixed;
}

/// Reasons why vertices of the refined body are kept.
std::vector<std::optional<KeptBy>> BoneCut::kept_vertices(const Body& body) const {
  const KeptBone& keep = kept();
  const Mesh& mesh = body.mesh;
  std::vector<std::optional<KeptBy>> kept(mesh.vertices().size());
  if (keep.within_mm && bearing_) {
    const BearingBall ball(*bearing_);
    for (std::size_t v = 0; v < kept.size(); ++v)
      if ((mesh.vertices()[v] - ball.centre).norm() > ball.radius_mm + *keep.within_mm)
        kept[v] = KeptBy::zone;
  }
  if (bearing_ && role_ == BodyRole::mobile) {
    const BearingBall ball(*bearing_);
    for (std::size_t v = 0; v < kept.size(); ++v)
      if (ball.holds(mesh.vertices()[v])) kept[v] = KeptBy::bearing;
  }
  for (const BodyPart& part : body.parts)
    if (part.contact != PartContact::ends)
      std::fill_n(kept.begin() + static_cast<std::ptrdiff_t>(part.first_vertex), part.vertices,
                  KeptBy::bearing);
  // Triangles that have a marked corner stay whole.
  if (!keep.vertices.empty())
    for (std::size_t t = 0; t < triangle_before_.size(); ++t) {
      const Triangle& before = bone_.mesh.triangles()[triangle_before_[t]];
      if (std::any_of(before.begin(), before.end(), [&](Index v) { return keep.vertices[v] != 0; }))
        for (const Index v : mesh.triangles()[t]) kept[v] = KeptBy::marked;
    }
  return kept;
}

/// The surface to be lowered, its triangles small around what goes, and with edges along the bends of its bottom. Edges are longer than
/// requested if there would be too many.
void BoneCut::refine() {
  while (!refine_to_edge()) edge_mm_ *= 2, edge_reason_ = EdgeReason::too_many;
}

/// False if that would make too many triangles.
bool BoneCut::refine_to_edge() {
  std::vector<std::uint8_t> near;
  std::optional<RefinedBody> small = refined(
      bone_,
      [&](const TriMesh& pieces, const std::vector<Index>& before, const std::vector<std::uint8_t>& asked) {
        return near = with_neighbours(pieces, to_cut(pieces, before, asked));
      },
      edge_mm_, most_triangles_added);
  if (!small) return false;
  RefinedBody& fine = *small;
  triangle_before_ = std::move(fine.triangle_before);
  const auto put_surface = [&] {
    // This body is cut for a share of the depth only.
    std::optional<double> deepest = kept().deepest_mm;
    if (deepest) *deepest /= share_;
    surface_.emplace(fine.body, near, kept_vertices(fine.body), deepest, edge_mm_);
  };
  put_surface();
  surface_->smooth_directions(smoothing_mm_);
  const std::vector<SweepTo> sweeps = sweeps_to_reach();
  for (int pass = 0; pass < passes_at_bends; ++pass) {
    const std::vector<double> bends = surface_->bends(sweeps, missed_at_bends * edge_mm_ * edge_mm_);
    // Smaller triangles reach no deeper.
    if (pass == 0) refuse_too_deep(surface_->left_at_room(sweeps));
    if (std::all_of(bends.begin(), bends.end(), [](double share) { return share == 0; })) break;
    std::optional<SplitBody> split =
        split_at(fine.body, bends, bone_.mesh.triangles().size() + most_triangles_added);
    if (!split) return false;
    fine = std::move(split->refined);
    std::vector<std::uint8_t> near_pieces;
    for (Index& before : fine.triangle_before) {
      near_pieces.push_back(near[before]);
      before = triangle_before_[before];
    }
    near = std::move(near_pieces);
    triangle_before_ = std::move(fine.triangle_before);
    const CutSurface whole = std::move(*surface_);
    put_surface();
    surface_->go_on_from(whole, split->vertices);
  }
  return true;
}

/// Bone that no vertex reaches from its place may be reached from elsewhere: no bone stops that motion, but no depth can follow it.
void BoneCut::refuse_too_deep(const std::vector<Obstruction>& left) const {
  if (kept().deepest_mm) return;
  for (const Obstruction& each : left)
    if (each.by == KeptBy::depth)
      throw MeshError(bone_.name + ": a cut for " + asked(each.target) +
                      " goes deeper than a depth below the surface can follow: ask for less");
}

bool BoneCut::stop(std::size_t target, Angle at, KeptBy by, const Vec3& point) {
  refuse_too_deep({{target, at.radians(), by, point}});
  const Angle possible = std::max(targets_[target].now, at) - short_of_kept;
  if (!(possible < reach_[target])) return false;
  reach_[target] = possible;
  stopped_[target] = StoppedAt{possible, {by, role_, point}};
  return true;
}

std::string BoneCut::asked(std::size_t target) const {
  return targets_[target].motion.name +
         core::formatted(" of %.6g degrees", targets_[target].reach.degrees()) +
         (request_.margin_mm > 0 ? core::formatted(" with a margin of %.6g mm", request_.margin_mm) : "");
}

bool BoneCut::lower_for_reach() {
  surface_->restore();
  const std::vector<Obstruction> left = surface_->lower(sweeps_to_reach());
  bool stopped = false;
  for (const Obstruction& obstruction : left)
    stopped =
        stop(obstruction.target, Angle::radians(obstruction.from_rad), obstruction.by, obstruction.point) ||
        stopped;
  return !stopped;
}

/// Looks for what goes around these places, too.
void BoneCut::want_too(const std::vector<Place>& places) {
  met_.insert(met_.end(), places.begin(), places.end());
  refine();
}

/// All of these triangles that still meets the other bone. Empty if every target is reached.
std::vector<Met> BoneCut::what_meets(const std::vector<Index>& triangles) const {
  const motion::PartOfMesh part = counted(surface_->body(), surface_->mesh(), included(role_),
                                          role_ == BodyRole::mobile ? ball_ : std::nullopt, triangles);
  const motion::FeatureTree tree(part.mesh);
  std::vector<Met> met;
  for (std::size_t t = 0; t < targets_.size(); ++t) {
    const auto contacts = exact_[t]->obstructions(tree, reach_[t]);
    if (!contacts)
      throw MeshError(bone_.name + ": the remaining bone would lie inside the other bone at the start of " +
                      targets_[t].motion.name);
    for (motion::FeatureContact contact : *contacts) {
      if (contact.feature.kind == motion::FeatureKind::face)
        contact.feature.id = part.triangle_in_whole[contact.feature.id];
      met.push_back({surface_->on_surface(contact.feature, contact.point), {t, contact.turned.radians()}});
    }
  }
  return met;
}

/// False if the surface must be lowered anew: with more of it near, or for a motion that kept bone stops.
bool BoneCut::may_all_go(const std::vector<Met>& met) {
  std::vector<Place> elsewhere;
  bool all = true;
  for (const Met& each : met) {
    const CutSurface::MayGo may = surface_->may_go(each.point);
    if (may == CutSurface::MayGo::elsewhere)
      elsewhere.push_back({surface_->before(each.point), search_spacing_mm});
    if (may != CutSurface::MayGo::kept) continue;
    all = false;
    stop(each.need.target, Angle::radians(each.need.from_rad), surface_->kept_by(each.point),
         surface_->before(each.point));
  }
  if (all && elsewhere.empty()) return true;
  if (!elsewhere.empty()) want_too(elsewhere);
  return false;
}

/// Lowers the bone that the exact search still finds obstructing. False if the surface must be lowered anew.
bool BoneCut::correct() {
  const std::vector<SweepTo> sweeps = sweeps_to_reach();
  const std::vector<Index> all = all_triangles(surface_->body().mesh);
  std::vector<Index> may_meet = all;
  std::vector<Met> met;
  for (int i = 0; i < most_corrections; ++i) {
    met = what_meets(may_meet);
    if (met.empty()) return true;
    if (!may_all_go(met)) return false;
    const std::vector<CutSurface::Vertex> before = surface_->vertices();
    surface_->lower_met(met, sweeps, (i + 1) * correction_mm);
    may_meet = surface_->beside_changed(before, met);
    // The search names one place of contact at the start, and there may be others.
    if (met.front().need.from_rad == 0) may_meet = all;
  }
  throw MeshError(bone_.name + ": after " + std::to_string(most_corrections) +
                  " corrections its cut surface still meets the other bone before " +
                  asked(met.front().need.target) + ": ask for less");
}

/// The share of a cut that reaches its targets, as a burr can make it. False if the surface must be lowered anew, with more of it near.
bool BoneCut::finish() {
  surface_->scale_depths(share_);
  surface_->unfold();
  if (!request_.burr_mm) return true;
  before_burr_mm3_ = removed_mm3(*surface_);
  // An unfolded surface may block another ball.
  for (int i = 0; i < most_burrs; ++i) {
    Burr burr(*surface_, *request_.burr_mm / 2);
    if (!burr.make()) {
      want_too(burr.elsewhere());
      return false;
    }
    burr_in_kept_mm_ = burr.in_kept_mm();
    const double made_mm3 = removed_mm3(*surface_);
    surface_->unfold();
    if (removed_mm3(*surface_) == made_mm3) break;
  }
  return true;
}

/// Triangles that face the other way than before, of the surface in its present state.
std::size_t BoneCut::turned(const TriMesh& mesh) const {
  const TriMesh& before = surface_->body().mesh;
  std::size_t turned = 0;
  for (const Index t : surface_->moving()) {
    const auto normal = [&](const TriMesh& m) {
      return Vec3((m.corner(t, 1) - m.corner(t, 0)).cross(m.corner(t, 2) - m.corner(t, 0)));
    };
    if (normal(before).dot(normal(mesh)) < 0) ++turned;
  }
  return turned;
}

void BoneCut::refuse_many_folds() const {
  if (turned(surface_->mesh()) > most_turned)
    throw MeshError(
        bone_.name + ": a cut so deep turns more than " + std::to_string(most_turned) +
        " triangles over: ask for less, or give the bone more even triangles if these are slender");
}

/// Defect of the surface in its present state; empty if there is none.
std::string BoneCut::fault() const {
  const Mesh mesh = surface_->mesh();
  if (const std::size_t over = turned(mesh); over > 0)
    return "turns " + std::to_string(over) + " triangles over";
  if (mesh::self_crossings_of(mesh).pairs > mesh::self_crossings_of(surface_->body().mesh).pairs)
    return "runs through itself";
  return {};
}

/// Why there is no cut with edges so long; empty if there is one.
std::optional<BoneCut::Failure> BoneCut::cut_at_edge() {
  Failure failure;
  for (const double smoothing_mm : {first_smoothing_mm, 6., 12., 24., 48.}) {
    for (std::size_t t = 0; t < targets_.size(); ++t) reach_[t] = targets_[t].reach, stopped_[t].reset();
    if (smoothing_mm != smoothing_mm_) {
      smoothing_mm_ = smoothing_mm;
      refine();
    }
    bool finished = false;
    for (int i = 0; i < most_stops && !finished; ++i)
      finished = lower_for_reach() && (surface_->unfold(), refuse_many_folds(), correct()) && finish();
    failure = finished ? Failure{fault(), true} : Failure{"meets kept bone anew each time", false};
    if (failure.why.empty()) return std::nullopt;
  }
  return failure;
}

/// Shorter edges follow a narrow cut without turning triangles over.
bool BoneCut::cut_with_shorter_edges() {
  for (int i = 0; i < most_shorter_edges && edge_reason_ != EdgeReason::too_many; ++i) {
    if (4 * surface_->near().size() > most_triangles_of_shorter) return false;
    edge_mm_ /= 2, edge_reason_ = EdgeReason::turned_over;
    smoothing_mm_ = first_smoothing_mm;
    refine();
    if (!cut_at_edge()) return true;
  }
  return false;
}

void BoneCut::cut() {
  const auto failure = cut_at_edge();
  if (!failure) return;
  std::string with_shorter;
  if (failure->folds) {
    const double tried_mm = edge_mm_;
    if (cut_with_shorter_edges()) return;
    if (edge_mm_ < tried_mm)
      with_shorter = core::formatted(", with edges of %g mm and of %g mm", tried_mm, edge_mm_);
  }
  throw MeshError(bone_.name + ": a cut so deep " + failure->why + ", whichever way it goes inwards" +
                  with_shorter);
}

Joint BoneCut::joint() const {
  Joint joint = joint_;
  Body& bone = role_ == BodyRole::mobile ? joint.mobile : joint.fixed;
  bone = surface_->body();
  bone.mesh = surface_->mesh();
  // Smaller triangles around a cut weigh more in a fit, and a rim that is cut is farther from the head: the bearing surface stays that of the uncut joint.
  if (!bearing_) return joint;
  joint.mobile.bearing_margin_mm = bearing_->margin_mm;
  if (bearing_->parts.empty()) {
    joint.mobile.head = bearing_->head;
  } else if (!joint.mobile.head) {
    // Meshes that bear are not cut, and found again as they are; the head that is stated is the bone's, which is measured.
    const Mesh ends =
        counted(joint_.mobile, joint_.mobile.mesh, {true}, std::nullopt, all_triangles(joint_.mobile.mesh))
            .mesh;
    if (const auto& head = kinematics::head_near_centre(ends)) joint.mobile.head = head->fit.sphere;
  }
  const auto is_bone = [](const BodyPart& part) { return part.contact == PartContact::ends; };
  if (std::all_of(joint.fixed.parts.begin(), joint.fixed.parts.end(), is_bone))
    joint.fixed.head = bearing_->socket;
  return joint;
}

bool BoneCut::removes_any() const {
  return std::any_of(surface_->vertices().begin(), surface_->vertices().end(),
                     [](const CutSurface::Vertex& vertex) { return vertex.depth_mm > 0; });
}

bool BoneCut::reaches_by_smaller_triangles() const {
  for (std::size_t t = 0; t < targets_.size(); ++t)
    if (reach_[t] > targets_[t].now) return true;
  return false;
}

CutBone BoneCut::cut_bone(CutFacts facts) const {
  CutBone cut{surface_->body(), surface_->body().mesh, {}, {}, {}};
  cut.body.mesh = surface_->mesh();
  // Along a wall the distance inwards is longer than the wall is deep.
  const mesh::SurfaceDistance from_before(cut.before);
  for (Index v = 0; v < surface_->vertices().size(); ++v) {
    const CutSurface::Vertex& vertex = surface_->vertices()[v];
    const bool goes = vertex.depth_mm > 0 && vertex.need;
    const double depth = vertex.depth_mm > 0 ? from_before(surface_->at(v)) : 0;
    cut.depth_mm.push_back(depth);
    cut.needed_by.push_back(goes ? static_cast<int>(targets_[vertex.need->target].number) : -1);
    cut.needed_from_deg.push_back(goes ? Angle::radians(vertex.need->from_rad).degrees() : 0);
    if (depth > cut.deepest_mm) cut.deepest_mm = depth, cut.deepest_at = vertex.before;
  }
  cut.edge_mm = edge_mm_;
  cut.edge_reason = edge_reason_;
  cut.area_mm2 = removed_mm2(*surface_);
  cut.volume_mm3 = removed_mm3(*surface_);
  if (request_.burr_mm) cut.burr_volume_mm3 = cut.volume_mm3 - before_burr_mm3_;
  cut.burr_in_kept_mm = burr_in_kept_mm_;
  if (facts == CutFacts::curve) return cut;
  std::vector<SweepTo> targets;
  for (std::size_t i = 0; i < sweeps_.size(); ++i) targets.push_back({sweeps_[i].get(), reach_[i]});
  cut.least_volume_mm3 = cut.volume_mm3 * swept_share(*surface_, targets);
  return cut;
}

bool BoneCut::sweeps_bearing() const {
  if (!ball_ || role_ == BodyRole::fixed) return false;
  Points points;
  for (const Triangle& t : bone_.mesh.triangles())
    for (const Index v : t)
      if (ball_->holds(bone_.mesh.vertices()[v])) points.push_back(bone_.mesh.vertices()[v]);
  for (std::size_t i = 0; i < sweeps_.size(); ++i) {
    const std::vector<double> first = sweeps_[i]->including_all().first_inside(points, reach_[i]);
    if (std::any_of(first.begin(), first.end(), [](double angle) { return std::isfinite(angle); }))
      return true;
  }
  return false;
}

}  // namespace condyle::plan
