#include "plan/bone_cut.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/error.hpp"
#include "core/formatted.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/self_crossings.hpp"
#include "mesh/surface_distance.hpp"
#include "plan/burr.hpp"
#include "plan/refine.hpp"

namespace condyle::plan {
namespace {

/// Asked beyond a target, so that what is left meets the other bone only past it.
constexpr Angle beyond = Angle::degrees(0.005);
/// A motion that kept bone stops is planned short of that.
constexpr Angle short_of_kept = Angle::degrees(0.001);
/// Where surfaces still meet, the feature that does is lowered by this, mm, and so often at most.
constexpr double correction_mm = 0.02;
constexpr int most_corrections = 300;
/// After so many by twice as much, three times, and so on.
constexpr int corrections_of_a_step = 25;
constexpr double largest_correction_mm = 0.2;
/// Edges are split at bends of the depth that straight lines miss by more than this, mm at edges of 1 mm, and as the edges' square; in so
/// many passes.
constexpr double missed_at_bends = 0.04;
constexpr int passes_at_bends = 5;
/// A burr's cut is unfolded and made again so often.
constexpr int most_burrs = 3;
/// Kept bone is found anew so often: each time the motions go less far.
constexpr int most_stops = 20;
/// Points in which a surface is asked for what goes: so far apart, and so far outside of it too, mm.
constexpr double search_spacing_mm = 1, search_outside_mm = 1;
/// A margin's tip around a sharp edge goes no farther than this many margins; directions across which triangles bend less than this
/// share are flat.
constexpr double longest_tip = 2, flat_share = 1e-3;
/// What is removed is asked so far apart for what had to be, mm.
constexpr double least_spacing_mm = 0.15;

/// A body without what is soft, and without what lies in the ball; which triangles of the mesh these are.
motion::PartOfMesh counted(const Body& body, const Mesh& mesh, const Counting& counts,
                           const std::optional<BearingBall>& ball) {
  TriMesh part{mesh.vertices(), {}};
  std::vector<Index> in_whole;
  for (Index t = 0; t < mesh.triangles().size(); ++t) {
    if (!counts(body, t)) continue;
    if (ball && ball->holds(mesh.corner(t, 0)) && ball->holds(mesh.corner(t, 1)) &&
        ball->holds(mesh.corner(t, 2)))
      continue;
    part.triangles.push_back(mesh.triangles()[t]);
    in_whole.push_back(t);
  }
  return {Mesh(std::move(part)), std::move(in_whole)};
}

/// With its surface moved outwards, mm: each vertex to where the planes of its triangles are, moved so far; in the sense of least squares
/// with the angles that they have there as weights, where there are more than three, and then farther, until it is outside of all.
Mesh grown(const Mesh& mesh, double by_mm) {
  if (by_mm == 0) return mesh;
  const std::size_t count = mesh.vertices().size();
  std::vector<Eigen::Matrix3d> squares(count, Eigen::Matrix3d::Zero());
  std::vector<Vec3> sums(count, Vec3::Zero());
  const auto normal_of = [&](std::size_t t) {
    return Vec3((mesh.corner(t, 1) - mesh.corner(t, 0))
                    .cross(mesh.corner(t, 2) - mesh.corner(t, 0))
                    .stableNormalized());
  };
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Triangle& v = mesh.triangles()[t];
    const Vec3 normal = normal_of(t);
    for (int k = 0; k < 3; ++k) {
      const Vec3 to_next = (mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k)).stableNormalized(),
                 to_last = (mesh.corner(t, (k + 2) % 3) - mesh.corner(t, k)).stableNormalized();
      const double angle = std::acos(std::clamp(to_next.dot(to_last), -1.0, 1.0));
      squares[v[k]] += angle * normal * normal.transpose();
      sums[v[k]] += angle * normal;
    }
  }
  std::vector<Vec3> tips(count, Vec3::Zero());
  for (std::size_t v = 0; v < count; ++v) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(squares[v]);
    for (int k = 0; k < 3; ++k)
      if (axes.eigenvalues()[k] > flat_share * axes.eigenvalues()[2]) {
        const Vec3 axis = axes.eigenvectors().col(k);
        tips[v] += axis.dot(sums[v]) / axes.eigenvalues()[k] * axis;
      }
  }
  std::vector<double> least(count, 1);  // that a plane moves by
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    if (const Vec3 normal = normal_of(t); normal != Vec3::Zero())
      for (const Index v : mesh.triangles()[t]) least[v] = std::min(least[v], normal.dot(tips[v]));
  Points moved = mesh.vertices();
  for (std::size_t v = 0; v < count; ++v) {
    if (tips[v] == Vec3::Zero()) continue;
    const double most = longest_tip / tips[v].norm(), enough = least[v] > 0 ? 1 / least[v] : most;
    moved.set(v, moved[v] + by_mm * std::min(enough, most) * tips[v]);
  }
  return mesh.moved_to(std::move(moved));
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

bool Counting::operator()(const Body& body, std::size_t triangle) const {
  const BodyPart* part = part_of_triangle(body, triangle);
  return !part || part->contact == PartContact::ends ||
         (part->contact == PartContact::bearing && !leaves_out_bearing);
}

BoneCut::BoneCut(const Joint& joint, BodyRole cut_role, const ResectionRequest& request,
                 std::vector<CutTarget> targets, double share)
    : joint_(joint),
      role_(cut_role),
      bone_(cut_role == BodyRole::mobile ? joint.mobile : joint.fixed),
      request_(request),
      targets_(std::move(targets)),
      share_(share),
      stopped_(targets_.size()) {
  bearing_ = find_bearing_surface(joint, request.range.bearing).surface;
  if (!bearing_ && kept().within_mm)
    throw UsageError("resection: bone is to stay by its distance from the bearing surface, and " +
                     joint.name + " has none that is known");
  if (bearing_ && request.range.bearing.rule == BearingRule::leave_out) ball_.emplace(*bearing_);
  const bool cuts_mobile = role_ == BodyRole::mobile;
  const Body& other = cuts_mobile ? joint.fixed : joint.mobile;
  const Counting of_other = counting(cuts_mobile ? BodyRole::fixed : BodyRole::mobile);
  const Mesh solid = counted(other, other.mesh, of_other, std::nullopt).mesh;
  if (!solid.is_closed())
    throw MeshError(other.name + ": its mesh is open, and bone that an open mesh sweeps over cannot be told");
  if (!bone_.mesh.is_closed())
    throw MeshError(bone_.name + ": its mesh is open, and no bone can be removed from it");
  const Mesh around = grown(solid, request.margin_mm);
  const Mesh ending =
      cuts_mobile ? around : counted(other, grown(other.mesh, request.margin_mm), of_other, ball_).mesh;
  for (const CutTarget& target : targets_) {
    sweeps_.push_back(std::make_unique<Sweep>(joint, role_, around, target.motion, ball_));
    exact_.push_back(std::make_unique<ExactReach>(joint, role_, ending, target.motion));
    reach_.push_back(target.reach);
  }
  met_.assign(bone_.mesh.triangles().size(), 0);
  wanted_ = with_neighbours(bone_.mesh, triangles_to_cut(bone_));
  refine();
  cut();
}

Counting BoneCut::counting(BodyRole role) const {
  return {role == BodyRole::mobile && request_.range.bearing.rule == BearingRule::leave_out};
}

std::vector<SweepTo> BoneCut::sweeps_to_reach() const {
  std::vector<SweepTo> all;
  for (std::size_t i = 0; i < sweeps_.size(); ++i) all.push_back({sweeps_[i].get(), reach_[i] + beyond});
  return all;
}

std::vector<std::uint8_t> BoneCut::triangles_to_cut(const Body& body) const {
  const Mesh& mesh = body.mesh;
  const std::optional<BearingBall> mobile_ball = role_ == BodyRole::mobile ? ball_ : std::nullopt;
  const Counting counts = counting(role_);
  Points points;
  std::vector<Index> of;
  for (Index t = 0; t < mesh.triangles().size(); ++t) {
    const Vec3 a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    if (!counts(body, t) ||
        (mobile_ball && mobile_ball->holds(a) && mobile_ball->holds(b) && mobile_ball->holds(c)))
      continue;
    const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    const int n = std::max(1, static_cast<int>(std::ceil(longest / search_spacing_mm)));
    const Vec3 outwards = (b - a).cross(c - a).stableNormalized();
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        for (const double off : {0.0, search_outside_mm}) {
          points.push_back((i * a + j * b + (n - i - j) * c) / n + off * outwards);
          of.push_back(t);
        }
  }
  std::vector<std::uint8_t> marks(mesh.triangles().size(), 0);
  for (const SweepTo& sweep : sweeps_to_reach()) {
    const std::vector<double> first = sweep.sweep->first_inside(points, sweep.reach);
    for (std::size_t i = 0; i < first.size(); ++i)
      if (std::isfinite(first[i])) marks[of[i]] = 1;
  }
  return marks;
}

const KeptBone& BoneCut::kept() const {
  return role_ == BodyRole::mobile ? request_.mobile : request_.fixed;
}

/// Of the refined body.
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

/// The surface to be lowered, its triangles small around what goes, and with edges along the bends of its bottom.
void BoneCut::refine() {
  RefinedBody fine = refined(bone_, wanted_, request_.edge_mm);
  triangle_before_ = std::move(fine.triangle_before);
  std::vector<std::uint8_t> near = with_neighbours(fine.body.mesh, triangles_to_cut(fine.body));
  for (std::size_t t = 0; t < near.size(); ++t) {
    const Index before = triangle_before_[t];
    near[t] = (near[t] && wanted_[before]) || met_[before];
  }
  const auto put_surface = [&] {
    // Of the depth that is taken a share is cut.
    std::optional<double> deepest = kept().deepest_mm;
    if (deepest) *deepest /= share_;
    surface_.emplace(fine.body, near, kept_vertices(fine.body), deepest, request_.edge_mm);
  };
  put_surface();
  surface_->smooth_directions(smoothing_mm_);
  const std::vector<SweepTo> sweeps = sweeps_to_reach();
  for (int pass = 0; pass < passes_at_bends; ++pass) {
    const std::vector<double> bends =
        surface_->bends(sweeps, missed_at_bends * request_.edge_mm * request_.edge_mm);
    if (std::all_of(bends.begin(), bends.end(), [](double share) { return share == 0; })) return;
    SplitBody split = split_at(fine.body, bends);
    fine = std::move(split.refined);
    std::vector<std::uint8_t> near_pieces;
    for (Index& before : fine.triangle_before) {
      near_pieces.push_back(near[before]);
      before = triangle_before_[before];
    }
    near = std::move(near_pieces);
    triangle_before_ = std::move(fine.triangle_before);
    const CutSurface whole = std::move(*surface_);
    put_surface();
    surface_->go_on_from(whole, split.vertices);
  }
}

bool BoneCut::stop(std::size_t target, Angle at, KeptBy by, const Vec3& point) {
  // What no vertex reaches from where it is may go from elsewhere: no bone stops that motion, but no depth can follow it.
  if (by == KeptBy::depth && !kept().deepest_mm)
    throw MeshError(bone_.name + ": a cut for " + asked(target) +
                    " goes deeper than a depth below the surface can follow: ask for less");
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
  const std::vector<InTheWay> left = surface_->lower(sweeps_to_reach());
  bool stopped = false;
  for (const InTheWay& in_the_way : left)
    stopped = stop(in_the_way.target, Angle::radians(in_the_way.from_rad), in_the_way.by, in_the_way.point) ||
              stopped;
  return !stopped;
}

/// False if the surface must be lowered anew: with more of it near, or for a motion that kept bone stops.
bool BoneCut::lower_at(std::size_t target, const Limit& limit, const Feature& feature, double by_mm) {
  using Lowered = CutSurface::Lowered;
  const Lowered lowered = surface_->lower_feature(feature, {target, limit.turned.radians()}, by_mm);
  if (lowered == Lowered::some) return true;
  const Mesh& mesh = surface_->body().mesh;
  const Index corner = feature.kind == FeatureKind::face ? mesh.triangles()[feature.id][0] : feature.id;
  if (lowered == Lowered::kept) {
    stop(target, limit.turned, surface_->vertices()[corner].kept.value_or(KeptBy::depth),
         limit.contact->mobile_point);
    return false;
  }
  std::vector<Index> met;
  for (Index t = 0; t < mesh.triangles().size(); ++t)
    if (const Triangle& v = mesh.triangles()[t]; std::find(v.begin(), v.end(), corner) != v.end())
      met.push_back(t);
  want_too(met);
  return false;
}

/// Refines what these triangles of the surface are pieces of, with their neighbours.
void BoneCut::want_too(const std::vector<Index>& met) {
  for (const Index t : met) met_[triangle_before_[t]] = 1;
  met_ = with_neighbours(bone_.mesh, std::move(met_));
  for (std::size_t t = 0; t < met_.size(); ++t) wanted_[t] |= met_[t];
  refine();
}

/// Lowers what the exact search still finds in the way. False if kept bone stops a motion.
bool BoneCut::correct() {
  std::size_t last = 0;  // the target that was short
  for (int i = 0; i < most_corrections; ++i) {
    const motion::PartOfMesh part = counted(surface_->body(), surface_->mesh(), counting(role_),
                                            role_ == BodyRole::mobile ? ball_ : std::nullopt);
    bool reached = true;
    for (std::size_t t = 0; t < targets_.size(); ++t) {
      const Limit limit = exact_[t]->limit(part.mesh, reach_[t]);
      if (limit.reason == LimitReason::end_of_range) continue;
      if (!limit.contact)
        throw MeshError(bone_.name + ": what is left would lie inside the other bone at the start of " +
                        targets_[t].motion.name);
      reached = false;
      last = t;
      Feature feature = limit.contact->mobile_feature;
      if (feature.kind == FeatureKind::face) feature.id = part.triangle_in_whole[feature.id];
      if (!lower_at(t, limit, feature,
                    std::min(correction_mm * (1 + i / corrections_of_a_step), largest_correction_mm)))
        return false;
    }
    if (reached) return true;
  }
  throw MeshError(bone_.name + ": after " + std::to_string(most_corrections) +
                  " corrections its cut surface still meets the other bone before " + asked(last) +
                  ": ask for less");
}

/// The share of a cut that reaches its targets, as a burr can make it. False if the surface must be lowered anew, with more of it near.
bool BoneCut::finish() {
  surface_->scale_depths(share_);
  surface_->unfold();
  if (!request_.burr_mm) return true;
  before_burr_mm3_ = removed_mm3();
  // What is unfolded may be in the way of another ball.
  for (int i = 0; i < most_burrs; ++i) {
    Burr burr(*surface_, *request_.burr_mm / 2);
    if (!burr.make()) {
      want_too(burr.elsewhere());
      return false;
    }
    burr_in_kept_mm_ = burr.in_kept_mm();
    const double made_mm3 = removed_mm3();
    surface_->unfold();
    if (removed_mm3() == made_mm3) break;
  }
  return true;
}

/// What is wrong with the surface as it is now; empty if nothing is.
std::string BoneCut::fault() const {
  const Mesh mesh = surface_->mesh();
  const TriMesh& before = surface_->body().mesh;
  std::size_t turned = 0;
  for (const Index t : surface_->moving()) {
    const auto normal = [&](const TriMesh& m) {
      return Vec3((m.corner(t, 1) - m.corner(t, 0)).cross(m.corner(t, 2) - m.corner(t, 0)));
    };
    if (normal(before).dot(normal(mesh)) < 0) ++turned;
  }
  if (turned > 0) return "turns " + std::to_string(turned) + " triangles over";
  if (mesh::self_crossings_of(mesh).pairs > mesh::self_crossings_of(surface_->body().mesh).pairs)
    return "runs through itself";
  return {};
}

void BoneCut::cut() {
  std::string why;
  for (const double smoothing_mm : {3., 6., 12., 24., 48.}) {
    for (std::size_t t = 0; t < targets_.size(); ++t) reach_[t] = targets_[t].reach, stopped_[t].reset();
    if (smoothing_mm != smoothing_mm_) {
      smoothing_mm_ = smoothing_mm;
      refine();
    }
    bool finished = false;
    for (int i = 0; i < most_stops && !finished; ++i)
      finished = lower_for_reach() && (surface_->unfold(), correct()) && finish();
    why = finished ? fault() : "meets kept bone anew each time";
    if (why.empty()) return;
  }
  throw MeshError(bone_.name + ": a cut so deep " + why + ", whichever way it goes inwards");
}

Joint BoneCut::joint() const {
  Joint joint = joint_;
  Body& bone = role_ == BodyRole::mobile ? joint.mobile : joint.fixed;
  bone = surface_->body();
  bone.mesh = surface_->mesh();
  // Smaller triangles around a cut weigh more in a fit, and a rim that is cut is farther from the head: what bears is what it was.
  if (bearing_) {
    joint.mobile.head = bearing_->head;
    joint.mobile.bearing_margin_mm = bearing_->margin_mm;
    joint.fixed.head = bearing_->socket;
  }
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

double BoneCut::removed_mm3() const {
  const std::vector<CutSurface::Vertex>& vertices = surface_->vertices();
  const auto deepest = std::max_element(vertices.begin(), vertices.end(),
                                        [](const auto& a, const auto& b) { return a.depth_mm < b.depth_mm; });
  const TriMesh& before = surface_->body().mesh;
  const Mesh after = surface_->mesh();
  mesh::CompensatedSum volume;
  for (const Index t : surface_->moving())
    if (std::any_of(before.triangles[t].begin(), before.triangles[t].end(),
                    [&](Index v) { return vertices[v].depth_mm > 0; }))
      volume.add(mesh::volume_below(before, t, deepest->before) -
                 mesh::volume_below(after, t, deepest->before));
  return volume.value();
}

CutBone BoneCut::cut_bone() const {
  CutBone cut{surface_->body(), surface_->body().mesh, {}, {}, {}, 0, 0, 0, 0, 0, 0, Vec3::Zero()};
  cut.body.mesh = surface_->mesh();
  // Along a wall the way inwards is longer than the wall is deep.
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
  const TriMesh& before = cut.before;
  for (const Index t : surface_->moving())
    if (std::any_of(before.triangles[t].begin(), before.triangles[t].end(),
                    [&](Index v) { return surface_->vertices()[v].depth_mm > 0; }))
      cut.area_mm2 += (before.corner(t, 1) - before.corner(t, 0))
                          .cross(before.corner(t, 2) - before.corner(t, 0))
                          .norm() /
                      2;
  cut.volume_mm3 = removed_mm3();
  if (request_.burr_mm) cut.burr_volume_mm3 = cut.volume_mm3 - before_burr_mm3_;
  cut.burr_in_kept_mm = burr_in_kept_mm_;
  cut.least_volume_mm3 = cut.volume_mm3 * least_share();
  return cut;
}

/// Of what was removed, the share that the other bone sweeps over.
double BoneCut::least_share() const {
  Points points;
  std::vector<double> weight;
  for (const Index t : surface_->moving()) {
    std::array<Vec3, 3> p{}, d{};
    double deepest = 0;
    for (int k = 0; k < 3; ++k) {
      const CutSurface::Vertex& vertex = surface_->vertices()[surface_->body().mesh.triangles()[t][k]];
      p[k] = vertex.before, d[k] = vertex.depth_mm * vertex.inwards;
      deepest = std::max(deepest, vertex.depth_mm);
    }
    if (deepest == 0) continue;
    const int layers = static_cast<int>(std::ceil(deepest / least_spacing_mm));
    // The middles of the four triangles that halved sides make.
    constexpr std::array<std::array<double, 2>, 4> middles{
        {{1. / 3, 1. / 3}, {1. / 6, 1. / 6}, {2. / 3, 1. / 6}, {1. / 6, 2. / 3}}};
    for (const auto& [u, v] : middles)
      for (int layer = 0; layer < layers; ++layer) {
        const double s = (layer + 0.5) / layers;
        const Vec3 down = d[0] + u * (d[1] - d[0]) + v * (d[2] - d[0]);
        points.push_back(p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]) + s * down);
        const Vec3 along_u = p[1] - p[0] + s * (d[1] - d[0]), along_v = p[2] - p[0] + s * (d[2] - d[0]);
        weight.push_back(-down.dot(along_u.cross(along_v)) / layers);
      }
  }
  std::vector<std::uint8_t> goes(points.size(), 0);
  for (std::size_t i = 0; i < sweeps_.size(); ++i) {
    const std::vector<double> first = sweeps_[i]->first_inside(points, reach_[i]);
    for (std::size_t k = 0; k < goes.size(); ++k)
      if (std::isfinite(first[k])) goes[k] = 1;
  }
  double all = 0, gone = 0;
  for (std::size_t k = 0; k < goes.size(); ++k) all += weight[k], gone += goes[k] ? weight[k] : 0;
  return all > 0 ? gone / all : 0;
}

bool BoneCut::sweeps_bearing() const {
  if (!ball_ || role_ == BodyRole::fixed) return false;
  Points points;
  for (const Triangle& t : bone_.mesh.triangles())
    for (const Index v : t)
      if (ball_->holds(bone_.mesh.vertices()[v])) points.push_back(bone_.mesh.vertices()[v]);
  for (std::size_t i = 0; i < sweeps_.size(); ++i) {
    const std::vector<double> first = sweeps_[i]->counting_all().first_inside(points, reach_[i]);
    if (std::any_of(first.begin(), first.end(), [](double angle) { return std::isfinite(angle); }))
      return true;
  }
  return false;
}

}  // namespace condyle::plan
