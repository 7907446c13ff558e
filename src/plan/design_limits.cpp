#include "plan/design_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/implant.hpp"
#include "core/formatted.hpp"
#include "core/lazy.hpp"
#include "core/per_thread.hpp"
#include "core/trigonometry.hpp"
#include "kinematics/posed_parts.hpp"
#include "mesh/triangle_distance.hpp"
#include "motion/rom/overlap.hpp"
#include "motion/search/first_contact.hpp"

namespace condyle::plan {
namespace {

/// Meshes of floats and rounded poses move a limit by less.
constexpr Angle closed_form_slack = Angle::degrees(1e-3);

/// Distances from the centre that are no farther apart may meet.
constexpr double shell_gap_mm = 1e-6;

/// Results kept of one pair and one motion, some 10 MB, and of all: displaced designs hardly ever have the same values again.
constexpr std::size_t most_kept = 100'000, most_kept_in_all = 2'000'000;

/// Tables of motions are kept as long as they take about so much memory, those of meshes that designs move for each thread: a table takes so
/// much for each triangle. Motions beyond have theirs made when they are searched.
constexpr std::size_t most_table_bytes = 256 << 20, table_bytes_per_triangle = 256;

/// One mesh of a body, or what of it counts.
struct SweptMesh {
  BodyRole role;
  std::string name;  ///< of the BodyPart; empty of a body that is one mesh
  Mesh mesh;
  motion::FeatureTree tree;
  std::vector<std::size_t> moved_by;       ///< swept parameters, ascending
  Eigen::Affine3d back;                    ///< from where it is in the joint given to where its parts find it
  bool rotates_about_centre;               ///< whatever the swept parameters are
  double nearest_mm = 0, farthest_mm = 0;  ///< distances of its surface from the centre

  SweptMesh(BodyRole body, std::string_view part, TriMesh triangles)
      : role(body), name(part), mesh(std::move(triangles)), tree(mesh) {}
};

/// Between a triangle and the centre.
double distance_from_centre(const TriMesh& mesh, const Triangle& triangle) {
  const Vec3 zero = Vec3::Zero();
  return std::sqrt(mesh::between_triangles(
                       {mesh.vertices[triangle[0]], mesh.vertices[triangle[1]], mesh.vertices[triangle[2]]},
                       {zero, zero, zero})
                       .squared_distance);
}

void measure_shell(SweptMesh& swept) {
  const TriMesh& mesh = swept.mesh;
  swept.nearest_mm = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : mesh.triangles)
    swept.nearest_mm = std::min(swept.nearest_mm, distance_from_centre(mesh, triangle));
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
    swept.farthest_mm = std::max(swept.farthest_mm, mesh.vertices[v].norm());
}

/// A body as it counts, by the meshes it consists of.
std::vector<TriMesh> meshes_by_part(const motion::PartOfMesh& counted, const Body& body) {
  std::vector<TriMesh> meshes(std::max<std::size_t>(1, body.parts.size()));
  std::vector<std::vector<Index>> number(meshes.size(),
                                         std::vector<Index>(counted.mesh.vertices().size(), no_index));
  for (std::size_t t = 0; t < counted.triangle_in_whole.size(); ++t) {
    const BodyPart* part = part_of_triangle(body, counted.triangle_in_whole[t]);
    const std::size_t at = part ? static_cast<std::size_t>(part - body.parts.data()) : 0;
    Triangle triangle = counted.mesh.triangles()[t];
    for (Index& v : triangle) {
      Index& known = number[at][v];
      if (known == no_index) {
        known = static_cast<Index>(meshes[at].vertices.size());
        meshes[at].vertices.push_back(counted.mesh.vertices()[v]);
      }
      v = known;
    }
    meshes[at].triangles.push_back(triangle);
  }
  return meshes;
}

/// The part and the parameter of a full name.
struct ParameterPlace {
  std::size_t part, parameter;
};

ParameterPlace place_of(const PosedParts& posed, const std::string& name) {
  for (std::size_t p = 0; p < posed.parts.size(); ++p)
    for (std::size_t i = 0; i < posed.parts[p].parameters.size(); ++i)
      if (posed.parts[p].name + "." + posed.parts[p].parameters[i].name == name) return {p, i};
  throw UsageError("there is no parameter \"" + name + "\"");  // callers have checked it
}

Pose rigid(const Eigen::Affine3d& motion) {
  Pose X = Pose::Identity();
  X.linear() = motion.linear();
  X.translation() = motion.translation();
  return X;
}

/// Where a search ended.
struct Ended {
  double turned = 0;  ///< rad
  motion::LimitReason reason = motion::LimitReason::end_of_range;

  bool is_before(const Ended& other) const noexcept {
    return reason != motion::LimitReason::end_of_range &&
           (other.reason == motion::LimitReason::end_of_range || turned < other.turned);
  }
};

}  // namespace

struct DesignLimits::Parts {
  /// Inputs of a search of two meshes beside a motion.
  struct PairOfMeshes {
    std::size_t fixed, mobile;
    std::uint16_t name;
    BodyRole stationary;                ///< whose table carries the motion
    std::vector<std::size_t> moved_by;  ///< swept parameters of either
    enum class Known : std::uint8_t { by_search, never, always, by_form } known = Known::by_search;
    bool is_kept = false;  ///< results are kept by the values that they depend on
  };
  struct Kept {
    std::mutex mutex;
    std::map<std::vector<double>, Ended> by_values;
  };
  /// A motion as all pairs see it: the last one is the check of the reference pose, without range.
  struct Turn {
    motion::Motion motion;
    Pose X_FM;
    Vec3 axis_F;  ///< about which M turns
  };
  using Table = std::optional<motion::RotationTable>;
  struct TableAt {
    std::vector<double> values;
    std::unique_ptr<motion::RotationTable> table;
  };
  using MeshAndTurn = std::pair<std::size_t, std::size_t>;
  struct Worker {
    std::vector<motion::RotatingBody> rotating;
    std::map<MeshAndTurn, TableAt> tables;  ///< of meshes that move
    std::pair<MeshAndTurn, TableAt> last;   ///< of a turn whose tables are not kept

    explicit Worker(const Parts& parts) {
      for (const auto& mesh : parts.meshes) rotating.emplace_back(mesh->tree);
    }
  };

  Joint joint;
  std::vector<SweepTarget> targets;
  std::vector<ParameterPlace> swept;
  motion::ReferenceContact reference_contact;
  std::vector<std::unique_ptr<SweptMesh>> meshes;
  std::vector<PairOfMeshes> pairs;
  std::vector<EndingPair> names;
  std::vector<Turn> turns;
  std::vector<std::size_t> turn_of;  ///< of each target: targets of one motion share it
  /// For each target the number of the first one with its motion and reach: they share a limit.
  std::vector<std::size_t> first_like;
  std::size_t turns_with_tables = 0;
  std::vector<core::Lazy<Table>> tables;  ///< by mesh and turn, of meshes that do not move
  mutable std::vector<Kept> kept;         ///< by pair and turn
  mutable core::PerThread<Worker> workers;

  Parts(const Joint& given, const motion::RangeOptions& options, std::span<const SweepTarget> all,
        std::span<const std::string> names_swept)
      : joint(given),
        targets(all.begin(), all.end()),
        reference_contact(options.overlap.reference_contact),
        workers([this] { return Worker(*this); }) {
    for (const std::string& name : names_swept) swept.push_back(place_of(*joint.posed, name));
    add_turns(options.overlap.reference_pose);
    const motion::BearingFinding bearing = motion::find_bearing_surface(joint, options.bearing);
    const motion::BearingRule rule =
        bearing.roles.distinguish_bearing() ? options.bearing.rule : motion::BearingRule::count;
    add_meshes(motion::parts_that_count(joint, options.overlap, bearing, rule));
  }

  void add_turns(const JointAngles& reference_pose) {
    using Key = std::tuple<JointAngle, RotationSense, double, double, double, double>;
    std::map<Key, std::size_t> known;
    std::map<std::pair<std::size_t, double>, std::size_t> known_reaches;
    const auto add = [&](const motion::Motion& motion) {
      turns.push_back({motion, pose_at(joint.coordinates(), motion.start),
                       axis_of(motion.vary, joint.coordinates(), motion.start) * sign_of(motion.sense)});
    };
    for (const SweepTarget& target : targets) {
      const motion::Motion motion = target.without_tilt();
      const JointAngles& start = motion.start;
      const Key key{motion.vary,
                    motion.sense,
                    start.flexion.radians(),
                    start.adduction.radians(),
                    start.internal_rotation.radians(),
                    motion.range.radians()};
      const auto [at, is_new] = known.emplace(key, turns.size());
      if (is_new) add(motion);
      turn_of.push_back(at->second);
      first_like.push_back(
          known_reaches.try_emplace({at->second, target.reach.radians()}, first_like.size()).first->second);
    }
    add({.name = "reference pose", .start = reference_pose});
  }

  void add_meshes(const motion::PartsOfJoint& counted) {
    // By body and part that counts, the places of its meshes.
    std::vector<std::vector<std::size_t>> of_fixed, of_mobile;
    const auto add = [&](const std::vector<motion::PartOfMesh>& parts, const Body& body, BodyRole role,
                         std::vector<std::vector<std::size_t>>& places) {
      for (const motion::PartOfMesh& part : parts) {
        std::vector<std::size_t>& in = places.emplace_back();
        std::vector<TriMesh> split = meshes_by_part(part, body);
        for (std::size_t i = 0; i < split.size(); ++i) {
          if (split[i].triangles.empty()) continue;
          in.push_back(meshes.size());
          meshes.push_back(std::make_unique<SweptMesh>(
              role, body.parts.empty() ? std::string_view() : std::string_view(body.parts[i].name),
              std::move(split[i])));
          describe(*meshes.back());
        }
      }
    };
    add(counted.fixed, joint.fixed, BodyRole::fixed, of_fixed);
    add(counted.mobile, joint.mobile, BodyRole::mobile, of_mobile);
    for (const motion::PairOfParts& pair : counted.impinging)
      for (const std::size_t f : of_fixed[pair.fixed])
        for (const std::size_t m : of_mobile[pair.mobile]) add_pair(f, m);
    std::size_t triangles = 1;
    for (const auto& mesh : meshes) triangles += mesh->mesh.triangles().size();
    turns_with_tables = std::min(turns.size(), most_table_bytes / (table_bytes_per_triangle * triangles) + 1);
    tables = std::vector<core::Lazy<Table>>(meshes.size() * turns.size());
    kept = std::vector<Kept>(pairs.size() * turns.size());
    for (PairOfMeshes& pair : pairs) judge_shells(pair);
  }

  void describe(SweptMesh& mesh) const {
    const std::vector<PosedPart>& parts = joint.posed->parts;
    mesh.rotates_about_centre = true;
    for (std::size_t s = 0; s < swept.size(); ++s) {
      const PosedPart& part = parts[swept[s].part];
      if (!kinematics::moves_mesh(part, mesh.role, mesh.name)) continue;
      mesh.moved_by.push_back(s);
      if (part.parameters[swept[s].parameter].kind == ParameterKind::translation ||
          part.centre != Vec3::Zero())
        mesh.rotates_about_centre = false;
    }
    mesh.back = kinematics::motion_of_mesh(parts, joint.side, mesh.role, mesh.name).inverse();
    measure_shell(mesh);
  }

  void add_pair(std::size_t f, std::size_t m) {
    PairOfMeshes pair{f, m, name_of(f, m), BodyRole::fixed, meshes[f]->moved_by};
    for (const std::size_t s : meshes[m]->moved_by) pair.moved_by.push_back(s);
    std::sort(pair.moved_by.begin(), pair.moved_by.end());
    pair.moved_by.erase(std::unique(pair.moved_by.begin(), pair.moved_by.end()), pair.moved_by.end());
    pair.is_kept = pair.moved_by.size() < swept.size();
    // The one whose parameters change less often carries the tables: designs are counted with the last parameter fastest.
    const auto changes = [&](std::size_t mesh) {
      const auto& by = meshes[mesh]->moved_by;
      return by.empty() ? std::size_t{0} : by.back() + 1;
    };
    if (changes(m) < changes(f)) pair.stationary = BodyRole::mobile;
    const bool is_implant = joint.implant && joint.implant->pair &&
                            meshes[f]->name == joint.implant->fixed_mesh &&
                            meshes[m]->name == joint.implant->mobile_mesh;
    if (is_implant) pair.known = PairOfMeshes::Known::by_form;
    pairs.push_back(std::move(pair));
  }

  std::uint16_t name_of(std::size_t f, std::size_t m) {
    const EndingPair pair{meshes[f]->name.empty() ? joint.fixed.name : meshes[f]->name,
                          meshes[m]->name.empty() ? joint.mobile.name : meshes[m]->name};
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].fixed == pair.fixed && names[i].mobile == pair.mobile)
        return static_cast<std::uint16_t>(i);
    names.push_back(pair);
    return static_cast<std::uint16_t>(names.size() - 1);
  }

  /// Surfaces at different distances from the centre never meet; then one body is inside the other always or never.
  void judge_shells(PairOfMeshes& pair) {
    const SweptMesh &f = *meshes[pair.fixed], &m = *meshes[pair.mobile];
    if (!f.rotates_about_centre || !m.rotates_about_centre) return;
    if (f.nearest_mm <= m.farthest_mm + shell_gap_mm && m.nearest_mm <= f.farthest_mm + shell_gap_mm) return;
    const std::vector<PosedPart>& parts = joint.posed->parts;
    const Ended ended = search(pair, turns.size() - 1, parts, {}, Angle());
    pair.known = ended.reason == motion::LimitReason::contact_at_start ? PairOfMeshes::Known::always
                                                                       : PairOfMeshes::Known::never;
  }

  /// The first contact of two meshes along a turn.
  Ended search(const PairOfMeshes& pair, std::size_t turn, std::span<const PosedPart> parts,
               std::span<const double> values, Angle range) const {
    Worker& worker = workers.local();
    const Turn& of = turns[turn];
    const SweptMesh &f = *meshes[pair.fixed], &m = *meshes[pair.mobile];
    const Pose T_f = moved(f, parts), T_m = moved(m, parts);
    const bool is_fixed_stationary = pair.stationary == BodyRole::fixed;
    const Pose& T_s = is_fixed_stationary ? T_f : T_m;
    const Pose X_MF = inverted(of.X_FM);
    const Vec3 axis = is_fixed_stationary ? of.axis_F : Vec3(-(X_MF.linear() * of.axis_F));
    const Pose back = inverted(T_s);
    const Pose X_RT = is_fixed_stationary ? Pose(back * of.X_FM * T_m) : Pose(back * X_MF * T_f);
    const AxisFrame frame(back.translation(), back.linear() * axis);
    const std::size_t stationary = is_fixed_stationary ? pair.fixed : pair.mobile,
                      rotating = is_fixed_stationary ? pair.mobile : pair.fixed;
    const motion::RotationTable& table = table_of(worker, stationary, turn, frame, values);
    motion::RotatingBody& body = worker.rotating[rotating];
    body.start_at(table.frame(), X_RT);
    const motion::Limit limit = motion::first_contact(table, body, {Angle(), range}).positive;
    return {limit.turned.radians(), limit.reason};
  }

  Pose moved(const SweptMesh& mesh, std::span<const PosedPart> parts) const {
    if (mesh.moved_by.empty()) return Pose::Identity();
    return rigid(kinematics::motion_of_mesh(parts, joint.side, mesh.role, mesh.name) * mesh.back);
  }

  const motion::RotationTable& table_of(Worker& worker, std::size_t stationary, std::size_t turn,
                                        const AxisFrame& frame, std::span<const double> values) const {
    const SweptMesh& mesh = *meshes[stationary];
    // The reference pose, the last one, is looked at for each design.
    const bool is_kept = turn < turns_with_tables || turn + 1 == turns.size();
    if (is_kept && mesh.moved_by.empty())
      return *tables[stationary * turns.size() + turn].get(
          [&](Table& table) { table.emplace(mesh.tree, frame); });
    const MeshAndTurn of{stationary, turn};
    if (!is_kept && worker.last.first != of) worker.last = std::pair(of, TableAt());
    TableAt& at = is_kept ? worker.tables[of] : worker.last.second;
    std::vector<double> of_mesh;
    if (!values.empty())
      for (const std::size_t s : mesh.moved_by) of_mesh.push_back(values[s]);
    if (!at.table || at.values != of_mesh) {
      at.table = std::make_unique<motion::RotationTable>(mesh.tree, frame);
      at.values = std::move(of_mesh);
    }
    return *at.table;
  }

  /// As search(), or as it was kept.
  Ended ended(std::size_t p, std::size_t turn, std::span<const PosedPart> parts,
              std::span<const double> values, Angle range) const {
    const PairOfMeshes& pair = pairs[p];
    if (!pair.is_kept) return search(pair, turn, parts, values, range);
    std::vector<double> key;
    for (const std::size_t s : pair.moved_by) key.push_back(values[s]);
    Kept& at = kept[p * turns.size() + turn];
    {
      const std::lock_guard lock(at.mutex);
      if (const auto known = at.by_values.find(key); known != at.by_values.end()) return known->second;
    }
    const Ended found = search(pair, turn, parts, values, turns[turn].motion.range);
    const std::lock_guard lock(at.mutex);
    if (at.by_values.size() < std::min(most_kept, most_kept_in_all / kept.size()))
      at.by_values.emplace(std::move(key), found);
    return found;
  }

  struct Best {
    Ended ended;
    LimitKnownBy by = LimitKnownBy::meshes;
    std::uint16_t pair = DesignLimit::no_pair;

    void take(const Ended& other, std::uint16_t name, LimitKnownBy known_by = LimitKnownBy::meshes) {
      if (other.is_before(ended)) *this = {other, known_by, name};
    }
  };

  /// Where a turn ends first. `reach`: on which side of it the limit lies must be certain.
  Best first_end(std::size_t turn, Angle range, Angle reach, const ClosedForm& form,
                 std::span<const PosedPart> parts, std::span<const double> values) const {
    motion::Motion motion = turns[turn].motion;
    motion.range = range;
    Best best{{range.radians(), motion::LimitReason::end_of_range}};
    const auto search_pair = [&](std::size_t p) {
      best.take(ended(p, turn, parts, values, Angle::radians(best.ended.turned)), pairs[p].name);
    };
    // Kept results, and motions that are answered, narrow the range of the search.
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      if (pairs[p].known == PairOfMeshes::Known::always)
        best.take({0, motion::LimitReason::contact_at_start}, pairs[p].name);
      if (pairs[p].known == PairOfMeshes::Known::by_search && pairs[p].is_kept) search_pair(p);
    }
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (pairs[p].known == PairOfMeshes::Known::by_search && !pairs[p].is_kept) search_pair(p);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (pairs[p].known == PairOfMeshes::Known::by_form && !take_form(best, pairs[p], motion, reach, form))
        search_pair(p);
    return best;
  }

  /// The same of a pose: liner and neck are free where their axes are near enough.
  bool take_start(Best& best, const PairOfMeshes& pair, const motion::Motion& at,
                  const RevolvedPair& form) const {
    const Vec3 neck = posed(pose_at(joint.coordinates(), at.start), form.mobile_axis);
    const Angle apart =
        Angle::radians(core::arctangent(form.fixed_axis.cross(neck).norm(), form.fixed_axis.dot(neck)));
    if (apart < form.of_facets_low - closed_form_slack) return true;
    if (!(apart > form.of_facets_high + closed_form_slack)) return false;
    best.take({0, motion::LimitReason::contact_at_start}, pair.name, LimitKnownBy::closed_form);
    return true;
  }

  /// False if the closed form does not decide.
  bool take_form(Best& best, const PairOfMeshes& pair, const motion::Motion& motion, Angle reach,
                 const ClosedForm& form) const {
    if (!form.pair) return false;
    if (motion.range == Angle()) return take_start(best, pair, motion, *form.pair);
    // Past the range too: an end just beyond it is one that is certain.
    motion::Motion wide = motion;
    wide.range = motion.range + Angle::degrees(1);
    const ClosedLimit closed = closed_limit(*form.pair, joint.coordinates(), wide);
    const Angle low = closed.of_facets_low - closed_form_slack,
                high = closed.of_facets_high + closed_form_slack;
    if (!(low < motion.range)) return true;
    const Angle other = Angle::radians(best.ended.turned);
    if (best.ended.reason != motion::LimitReason::end_of_range && other < low) return true;
    if (reach > low && !(reach > high)) return false;
    if (best.ended.reason != motion::LimitReason::end_of_range && other < high) return false;
    if (!(closed.turned < motion.range)) return true;
    best.take({closed.turned.radians(), closed.reason}, pair.name, LimitKnownBy::closed_form);
    return true;
  }

  /// Contact in the reference pose, unless it is accepted.
  std::optional<Best> reference_end(const ClosedForm& form, std::span<const PosedPart> parts,
                                    std::span<const double> values) const {
    if (reference_contact == motion::ReferenceContact::accept) return std::nullopt;
    const Best at = first_end(turns.size() - 1, Angle(), Angle(), form, parts, values);
    return at.ended.reason == motion::LimitReason::contact_at_start ? std::optional(at) : std::nullopt;
  }

  std::vector<PosedPart> parts_at(std::span<const double> values) const {
    std::vector<PosedPart> parts = joint.posed->parts;
    for (std::size_t s = 0; s < swept.size(); ++s)
      parts[swept[s].part].parameters[swept[s].parameter].value = values[s];
    return parts;
  }
};

DesignLimits::DesignLimits(const Joint& joint, const motion::RangeOptions& options,
                           std::span<const SweepTarget> targets, std::span<const std::string> swept,
                           bool closed_forms)
    : parts_(std::make_unique<Parts>(joint, options, targets, swept)) {
  if (closed_forms) return;
  for (Parts::PairOfMeshes& pair : parts_->pairs)
    if (pair.known == Parts::PairOfMeshes::Known::by_form) pair.known = Parts::PairOfMeshes::Known::by_search;
}

DesignLimits::~DesignLimits() = default;

void DesignLimits::limits(std::span<const double> values, std::span<DesignLimit> out) const {
  const std::vector<PosedPart> parts = parts_->parts_at(values);
  const ClosedForm form = closed_form(parts_->joint, parts);
  if (const auto at = parts_->reference_end(form, parts, values)) {
    for (DesignLimit& limit : out)
      limit = {std::numeric_limits<double>::quiet_NaN(), motion::LimitReason::contact_at_start, at->by,
               at->pair};
    return;
  }
  for (std::size_t t = 0; t < out.size(); ++t) {
    if (parts_->first_like[t] < t) {
      out[t] = out[parts_->first_like[t]];
      continue;
    }
    const Parts::Best end =
        parts_->first_end(parts_->turn_of[t], parts_->turns[parts_->turn_of[t]].motion.range,
                          parts_->targets[t].reach, form, parts, values);
    out[t] = {Angle::radians(end.ended.turned).degrees(), end.ended.reason, end.by, end.pair};
  }
}

bool DesignLimits::reaches_all(std::span<const double> values) const {
  const std::vector<PosedPart> parts = parts_->parts_at(values);
  const ClosedForm form = closed_form(parts_->joint, parts);
  if (parts_->reference_end(form, parts, values)) return false;
  for (std::size_t t = 0; t < parts_->targets.size(); ++t) {
    if (parts_->first_like[t] < t) continue;
    const Angle reach = parts_->targets[t].reach;
    const Parts::Best end = parts_->first_end(parts_->turn_of[t], reach, reach, form, parts, values);
    if (end.ended.reason != motion::LimitReason::end_of_range && end.ended.turned < reach.radians())
      return false;
  }
  return true;
}

std::string DesignLimits::difference_from_form(std::span<const double> values) const {
  const std::vector<PosedPart> parts = parts_->parts_at(values);
  const ClosedForm form = closed_form(parts_->joint, parts);
  std::string text;
  if (!form.pair) return text;
  for (const Parts::PairOfMeshes& pair : parts_->pairs) {
    if (pair.known != Parts::PairOfMeshes::Known::by_form) continue;
    for (std::size_t t = 0; t < parts_->targets.size(); ++t) {
      if (parts_->first_like[t] < t) continue;
      const std::size_t turn = parts_->turn_of[t];
      const motion::Motion& motion = parts_->turns[turn].motion;
      const Angle turned = Angle::radians(parts_->search(pair, turn, parts, values, motion.range).turned);
      const ClosedLimit closed = closed_limit(*form.pair, parts_->joint.coordinates(), motion);
      if (turned > closed.of_facets_low - closed_form_slack &&
          turned < closed.of_facets_high + closed_form_slack)
        continue;
      text += (text.empty() ? "" : ", ") + parts_->targets[t].name +
              core::formatted(" %.3f, closed form %.3f", turned.degrees(), closed.turned.degrees());
    }
  }
  return text;
}

const std::vector<EndingPair>& DesignLimits::pairs() const noexcept {
  return parts_->names;
}

}  // namespace condyle::plan
