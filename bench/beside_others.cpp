#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "accuracy.hpp"
#include "condyle/motion_map.hpp"
#include "contest.hpp"
#include "method.hpp"
#include "questions.hpp"
#include "stepping.hpp"

namespace bench {
namespace {

using condyle::Angle;
using condyle::JointAngle;
using condyle::Pose;
using condyle::Vec3;

/// An angle that is off by more is counted as a wrong one, as the steps of those who step are.
constexpr Angle wrong_angle = Angle::degrees(0.1);
constexpr Angle coarse_step = Angle::degrees(1), fine_step = Angle::degrees(0.1),
                bisected_to = Angle::degrees(1e-4);
/// Beyond half a turn a rotation between two poses is that of the other sense.
constexpr Angle longest_turn = Angle::degrees(170);

/// What all contests of a run share.
struct Arena {
  Arena(const Scene& of, Effort with)
      : scene(of), effort(with), bodies{of.joint.fixed.mesh, of.joint.mobile.mesh} {
    const std::size_t count = effort == Effort::full ? 36 : 6;
    for (std::size_t p = 0; p < count; ++p) poses.push_back(scene.poses[p].X_FM);
    truth = std::make_unique<Reference>(bodies, poses);
    for (const char* exact : {"cgal_rigid", "trees"})
      if (const auto kind = method_named(exact); kind && !judge) judge = kind->make(bodies);
  }

  double seconds() const { return effort == Effort::full ? 1.5 : 0.05; }

  const Scene& scene;
  Effort effort;
  Bodies bodies;
  std::vector<Pose> poses;
  std::unique_ptr<Reference> truth;
  /// Decides whether two surfaces meet by exact predicates: CGAL's, or ours where it is not there.
  std::unique_ptr<Method> judge;
};

/// Methods of packages: what others made. Published ones in code of ours are in the experiment, though CGAL may have made their
/// tetrahedra.
std::vector<MethodKind> of_others(const Arena& arena, const std::function<bool(const MethodKind&)>& takes) {
  std::vector<MethodKind> kinds;
  for (MethodGroup& group : method_groups())
    for (MethodKind& kind : group.kinds)
      if (!group.package.empty() && kind.family != "spatial hashing" && !kind.is_slow_to_make &&
          takes(kind) &&
          arena.bodies.fixed.triangles.size() + arena.bodies.mobile.triangles.size() <= kind.most_triangles)
        kinds.push_back(std::move(kind));
  return kinds;
}

/// A method asked at every pose, with an answer of each.
template <class Answer>
Contestant at_poses(const Arena& arena, const MethodKind& kind, void (*ask)(Method&, const Pose&, Answer&),
                    Wrong (*count)(const Arena&, const MethodKind&, std::vector<Answer>&)) {
  return {kind.name, kind.title, [&arena, kind, ask, count] {
            const std::shared_ptr<Method> method = kind.make(arena.bodies);
            const auto answers = std::make_shared<std::vector<Answer>>(arena.poses.size());
            return Ready{[=, &arena] {
                           for (std::size_t p = 0; p < answers->size(); ++p)
                             ask(*method, arena.poses[p], (*answers)[p]);
                         },
                         [=, &arena] { return count(arena, kind, *answers); }};
          }};
}

template <class Answer>
void hold_at_poses(Contest contest, const Arena& arena, const char* ours,
                   const std::function<bool(const MethodKind&)>& takes,
                   void (*ask)(Method&, const Pose&, Answer&),
                   Wrong (*count)(const Arena&, const MethodKind&, std::vector<Answer>&), Report& report) {
  std::vector<Contestant> others;
  for (const MethodKind& kind : of_others(arena, takes)) others.push_back(at_poses(arena, kind, ask, count));
  contest.asked = arena.poses.size();
  hold(contest, at_poses(arena, *method_named(ours), ask, count), others, arena.seconds());
  report_contest(contest, arena.scene.joint.name, report);
}

// Vertices, and pairs.

using Vertices = std::vector<InsideVertex>;
void ask_inside(Method& method, const Pose& X_FM, Vertices& out) {
  method.find_inside(X_FM, out);
}

InsideAccuracy accuracy_of(const Arena& arena, const MethodKind& kind, std::vector<Vertices>& answers) {
  InsideAccuracy all;
  for (std::size_t p = 0; p < answers.size(); ++p) compare(answers[p], *arena.truth, p, kind.depth, all);
  return all;
}

Wrong count_inside(const Arena& arena, const MethodKind& kind, std::vector<Vertices>& answers) {
  const InsideAccuracy all = accuracy_of(arena, kind, answers);
  return {.missed = all.false_outside, .invented = all.false_inside, .of = all.inside};
}

Wrong count_depths(const Arena& arena, const MethodKind& kind, std::vector<Vertices>& answers) {
  const InsideAccuracy all = accuracy_of(arena, kind, answers);
  return {.missed = all.false_outside, .invented = all.false_inside, .off = all.depths_off, .of = all.inside};
}

using Pairs = std::vector<condyle::contact::TrianglePair>;
void ask_pairs(Method& method, const Pose& X_FM, Pairs& out) {
  method.find_pairs(X_FM, out);
}

Wrong count_pairs(const Arena& arena, const MethodKind&, std::vector<Pairs>& answers) {
  PairAccuracy all;
  for (std::size_t p = 0; p < answers.size(); ++p) compare(answers[p], *arena.truth, p, all);
  return {.missed = all.missed, .invented = all.invented, .of = all.pairs};
}

// Two meshes without a joint.

void ask_touch(Method& method, const Pose& X_FM, BodyDepth& out) {
  out.in_contact = method.touch(X_FM);
}

Wrong count_touch(const Arena& arena, const MethodKind&, std::vector<BodyDepth>& answers) {
  TouchAccuracy all;
  for (std::size_t p = 0; p < answers.size(); ++p) compare(answers[p].in_contact, *arena.truth, p, all);
  return {.missed = all.missed, .invented = all.invented, .of = all.poses};
}

void ask_depth(Method& method, const Pose& X_FM, BodyDepth& out) {
  out = method.find_depth(X_FM);
}

/// A pose is wrong once: contact missed or invented, or else its depth off. No body of a scene is wholly inside the other.
Wrong count_deepest(const Arena& arena, const MethodKind&, std::vector<BodyDepth>& answers) {
  Wrong wrong{.of = static_cast<std::int64_t>(answers.size())};
  for (std::size_t p = 0; p < answers.size(); ++p) {
    const bool truly = !arena.truth->pairs(p).empty();
    if (answers[p].in_contact != truly)
      ++(truly ? wrong.missed : wrong.invented);
    else if (const auto bounds = truly ? arena.truth->depth(p) : Reference::DepthBounds{};
             answers[p].depth_mm < bounds.low_mm - wrong_depth_mm ||
             answers[p].depth_mm > bounds.high_mm + wrong_depth_mm)
      ++wrong.off;
  }
  return wrong;
}

/// Whoever knows the distance of a vertex inside, asked both ways: the deepest vertex of either body.
class DeepestVertex final : public Method {
 public:
  DeepestVertex(const MethodKind& kind, const Bodies& bodies)
      : mobile_(kind.make(bodies)),
        fixed_(kind.make({bodies.mobile, bodies.fixed})),
        touches_(kind.answers.touch) {}

  BodyDepth find_depth(const Pose& X_FM) override {
    BodyDepth found;
    const auto take = [&](Method& method, const Pose& X) {
      method.find_inside(X, vertices_);
      for (const InsideVertex& v : vertices_) found.depth_mm = std::max(found.depth_mm, v.depth_mm);
      found.in_contact |= !vertices_.empty();
    };
    take(*mobile_, X_FM);
    take(*fixed_, X_FM.inverse());
    if (!found.in_contact && touches_) found.in_contact = mobile_->touch(X_FM);
    return found;
  }

 private:
  std::unique_ptr<Method> mobile_, fixed_;
  bool touches_;
  Vertices vertices_;
};

void hold_deepest(const Arena& arena, Report& report) {
  std::vector<Contestant> others;
  for (const MethodKind& kind : of_others(arena, [](const MethodKind& k) { return k.answers.depth; }))
    others.push_back(at_poses(arena, kind, ask_depth, count_deepest));
  for (MethodKind& kind : of_others(arena, [](const MethodKind& k) {
         return k.answers.inside && k.depth == DepthKind::nearest_surface;
       })) {
    const MethodKind vertices = kind;
    kind.title += ", deepest vertex both ways";
    kind.make = [vertices](const Bodies& bodies) {
      return std::make_unique<DeepestVertex>(vertices, bodies);
    };
    others.push_back(at_poses(arena, kind, ask_depth, count_deepest));
  }
  Contest contest{
      "deepest", "deepest place: do two meshes meet, and how deep are they", "poses", arena.poses.size(), {}};
  hold(contest, at_poses(arena, *method_named("two_meshes"), ask_depth, count_deepest), others,
       arena.seconds());
  report_contest(contest, arena.scene.joint.name, report);
}

// First contact.

/// How far the body turns about each axis; longest_turn where nothing meets.
using Turns = std::vector<Angle>;

/// All that the contestants of first contact share; each leaves its answers here.
struct Axes {
  const Arena& arena;
  std::vector<Vec3> directions = {};
  std::vector<std::shared_ptr<Turns>> answers = {};

  Pose at(std::size_t axis, Angle turn) const {
    return Pose(Eigen::AngleAxisd(turn.radians(), directions[axis]));
  }

  /// The first angle at which anybody says that the bodies meet and exact predicates agree.
  Angle truth(std::size_t axis) const {
    constexpr Angle beyond = Angle::degrees(1e-6);
    Angle first = longest_turn;
    for (const auto& answer : answers)
      if ((*answer)[axis] < first && arena.judge->touch(at(axis, (*answer)[axis] + beyond)))
        first = (*answer)[axis];
    return first;
  }
};

/// Distinguishes several ways to ask one method.
struct How {
  std::string in_name, in_title;
};

using Turning = std::function<std::optional<Angle>(Method&, std::size_t)>;

Contestant about_axes(const std::shared_ptr<Axes>& axes, const MethodKind& kind, const How& how,
                      const Turning& turn) {
  return {kind.name + how.in_name, kind.title + how.in_title, [=] {
            const std::shared_ptr<Method> method = kind.make(axes->arena.bodies);
            const auto turns =
                axes->answers.emplace_back(std::make_shared<Turns>(axes->directions.size(), longest_turn));
            return Ready{[=] {
                           for (std::size_t a = 0; a < turns->size(); ++a)
                             (*turns)[a] = turn(*method, a).value_or(longest_turn);
                         },
                         [=] {
                           Wrong wrong{.of = static_cast<std::int64_t>(turns->size())};
                           for (std::size_t a = 0; a < turns->size(); ++a) {
                             const Angle late = (*turns)[a] - axes->truth(a);
                             wrong.missed += late > wrong_angle;
                             wrong.off += late < -wrong_angle;
                           }
                           return wrong;
                         }};
          }};
}

void hold_first_contact(const Arena& arena, Report& report) {
  const auto axes = std::make_shared<Axes>(Axes{arena});
  const std::size_t count = arena.effort == Effort::full ? 16 : 3;
  // Every third pose is one further turn about a new axis.
  for (std::size_t p = 0; p < 3 * count; p += 3)
    axes->directions.emplace_back(Eigen::AngleAxisd(arena.scene.poses[p].X_FM.linear()).axis());

  const auto stepping = [axes](Angle step, std::optional<Angle> width) {
    return Turning([=](Method& method, std::size_t axis) -> std::optional<Angle> {
      const TouchAt touch = [&](Angle turn) { return method.touch(axes->at(axis, turn)); };
      std::optional<Bracket> bracket = step_to_contact(touch, step, longest_turn);
      if (bracket && width) bracket = bisected(touch, *bracket, *width);
      return bracket ? std::optional(bracket->touching) : std::nullopt;
    });
  };
  const Turning asked = [axes](Method& method, std::size_t axis) {
    return method.find_first_contact(axes->directions[axis], longest_turn);
  };
  std::vector<Contestant> others;
  for (const MethodKind& kind :
       of_others(arena, [](const MethodKind& k) { return k.answers.first_contact; })) {
    others.push_back(about_axes(axes, kind, {"_continuous", ", conservative advancement"}, asked));
    others.push_back(about_axes(axes, kind, {"_stepped", ", by 0.1°"}, stepping(fine_step, {})));
  }
  for (const char* name : {"fcl_obbrss", "ode_trimesh", "bullet_gimpact", "cgal_rigid"})
    if (const auto kind = method_named(name))
      others.push_back(
          about_axes(axes, *kind, {"_bisected", ", by 1° and bisected"}, stepping(coarse_step, bisected_to)));
  Contest contest{"first_contact", "first contact: about an axis, its table included", "axes", count, {}};
  hold(contest, about_axes(axes, *method_named("two_meshes"), {}, asked), others, arena.seconds());
  report_contest(contest, arena.scene.joint.name, report);
}

// The map.

/// Free from the first angle to the second one; ascending.
using Free = std::vector<std::pair<Angle, Angle>>;
constexpr Angle half_turn = Angle::degrees(180);

bool is_free(const Free& free, Angle at) {
  return std::any_of(free.begin(), free.end(),
                     [&](const auto& f) { return f.first <= at && at <= f.second; });
}

/// Ends of free intervals and of the range, and the middles between them.
std::vector<Angle> ends_of(const Free& free) {
  std::vector<Angle> ends{-half_turn};
  for (const auto& [low, high] : free) ends.insert(ends.end(), {low, high});
  ends.push_back(half_turn);
  return ends;
}

struct Grid {
  const Arena& arena;
  condyle::motion::MapGrid grid;
  std::vector<std::shared_ptr<std::vector<Free>>> answers = {};

  Pose at(std::size_t point, Angle turn) const {
    return condyle::pose_at(arena.scene.joint.coordinates(),
                            condyle::motion::turned_by(grid.start_of(point).angles, grid.vary.angle(), turn));
  }

  /// A point is wrong if it says free, or contact, at an angle at which exact predicates say the contrary, further from
  /// its own ends than wrong_angle. Asked are the middles between all ends that anybody found.
  void judge(std::size_t point, const Free& free, Wrong& wrong) const {
    const std::vector<Angle> own = ends_of(free);
    bool missed = false, invented = false;
    for (const auto& answer : answers) {
      const std::vector<Angle> ends = ends_of((*answer)[point]);
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const Angle middle = (ends[i] + ends[i + 1]) * 0.5;
        const bool is_near = std::any_of(own.begin() + 1, own.end() - 1, [&](Angle end) {
          return std::abs((end - middle).radians()) <= wrong_angle.radians();
        });
        if (is_near) continue;
        const bool says_free = is_free(free, middle), touches = arena.judge->touch(at(point, middle));
        missed |= says_free && touches;
        invented |= !says_free && !touches;
      }
    }
    wrong.missed += missed, wrong.invented += invented;
  }
};

using Mapping = std::function<void(std::vector<Free>&)>;

Contestant over_grid(const std::shared_ptr<Grid>& grid, const std::string& name, const std::string& title,
                     const std::function<Mapping()>& make) {
  return {name, title, [=] {
            const Mapping map = make();
            const auto points =
                grid->answers.emplace_back(std::make_shared<std::vector<Free>>(grid->grid.size()));
            return Ready{[=] { map(*points); },
                         [=] {
                           Wrong wrong{.of = static_cast<std::int64_t>(points->size())};
                           for (std::size_t p = 0; p < points->size(); ++p)
                             grid->judge(p, (*points)[p], wrong);
                           return wrong;
                         }};
          }};
}

/// Every degree, and each change of the answer bisected.
Free stepped_free(const TouchAt& touch) {
  Free free;
  Angle low = -half_turn;
  bool was_free = !touch(low);
  for (int i = 1; i <= 360; ++i) {
    const Angle last = -half_turn + coarse_step * (i - 1), at = -half_turn + coarse_step * i;
    const bool now_free = !touch(at);
    if (now_free == was_free) continue;
    const Bracket change = bisected([&](Angle a) { return touch(a) != now_free; }, {last, at}, bisected_to);
    if (now_free)
      low = change.touching;
    else
      free.emplace_back(low, change.free);
    was_free = now_free;
  }
  if (was_free) free.emplace_back(low, half_turn);
  return free;
}

void hold_map(const Arena& arena, Report& report) {
  const double step = arena.effort == Effort::full ? 14 : 70;
  const auto grid = std::make_shared<Grid>(Grid{arena,
                                                {.row = {JointAngle::adduction, -40, 30, step},
                                                 .column = {JointAngle::flexion, -20, 120, step},
                                                 .vary = JointAngle::internal_rotation}});
  const auto ours = over_grid(grid, "map", "motion_map", [grid] {
    const auto range = std::make_shared<condyle::motion::RangeOfMotion>(
        grid->arena.scene.joint,
        condyle::motion::RangeOptions{
            .bearing = {.rule = condyle::motion::BearingRule::count},
            .overlap = {.reference_contact = condyle::motion::ReferenceContact::accept}});
    return Mapping([=](std::vector<Free>& out) {
      const condyle::motion::MotionMap map = motion_map(grid->grid, *range);
      for (std::size_t p = 0; p < out.size(); ++p) {
        out[p].clear();
        for (const auto& free : map.points[p].intervals) out[p].emplace_back(free.low, free.high);
      }
    });
  });
  std::vector<Contestant> others;
  for (const char* name : {"fcl_obbrss", "ode_trimesh"})
    if (const auto kind = method_named(name))
      others.push_back(
          over_grid(grid, kind->name + "_bisected", kind->title + ", by 1° and bisected", [grid, kind] {
            const std::shared_ptr<Method> method = kind->make(grid->arena.bodies);
            return Mapping([=](std::vector<Free>& out) {
              for (std::size_t p = 0; p < out.size(); ++p)
                out[p] = stepped_free([&](Angle at) { return method->touch(grid->at(p, at)); });
            });
          }));
  Contest contest{"map", "map: all free angles of a third angle", "points", grid->grid.size(), {}};
  hold(contest, ours, others, arena.seconds());
  report_contest(contest, arena.scene.joint.name, report);
}

}  // namespace

void ask_beside_others(const Scene& scene, Effort effort, Report& report) {
  const Arena arena(scene, effort);
  const auto is_nearest = [](const MethodKind& k) {
    return k.answers.inside && k.depth == DepthKind::nearest_surface;
  };
  hold_at_poses<Vertices>(
      {"inside", "inside at a pose: which vertices", "vertices", 0, {}}, arena, "radial",
      [](const MethodKind& k) { return k.answers.inside; }, ask_inside, count_inside, report);
  hold_at_poses<Pairs>(
      {"pairs", "pairs: which triangles meet", "pairs", 0, {}}, arena, "trees",
      [](const MethodKind& k) { return k.answers.pairs; }, ask_pairs, count_pairs, report);
  hold_at_poses<BodyDepth>(
      {"touch", "touch: do two meshes meet", "poses", 0, {}}, arena, "trees",
      [](const MethodKind& k) { return k.answers.touch; }, ask_touch, count_touch, report);
  hold_deepest(arena, report);
  hold_first_contact(arena, report);
  hold_map(arena, report);
  hold_at_poses<Vertices>({"depth",
                           "depth of every vertex: of those inside, to the nearest point of the surface",
                           "vertices",
                           0,
                           {}},
                          arena, "nearest", is_nearest, ask_inside, count_depths, report);
}

}  // namespace bench
