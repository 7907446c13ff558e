#include "condyle/answer/depth.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "answer/require_surface.hpp"
#include "condyle/error.hpp"
#include "contact/body_pair.hpp"
#include "contact/deepest_place.hpp"
#include "contact/overlap.hpp"
#include "core/coordinate_range.hpp"
#include "core/formatted.hpp"
#include "core/lazy.hpp"
#include "core/ordered_sums.hpp"
#include "core/parallel.hpp"
#include "kinematics/bone_sizes.hpp"
#include "kinematics/hip_parts.hpp"
#include "kinematics/surface_notes.hpp"
#include "mesh/enclosed_volume.hpp"
#include "mesh/findings.hpp"
#include "mesh/surface_to_surface.hpp"
#include "mesh/triangle_tree.hpp"
#include "mesh/winding_number.hpp"

namespace condyle {
namespace {

/// Kept with the mesh, which may be asked at many poses; notes by its role, which they name.
struct KeptSurface {
  core::Lazy<bool> is_solid;
  std::array<core::Lazy<std::vector<JointNote>>, 2> notes, unit_notes;
};

const KeptSurface& kept_with(const Mesh& mesh) {
  return mesh::findings_of(mesh).get<KeptSurface>();
}

bool is_solid(const Mesh& mesh) {
  return kept_with(mesh).is_solid.get([&](bool& is) { is = kinematics::is_solid(mesh); });
}

/// Lengths are taken as they are: a size, or a head, that suggests another unit. A whole ball is none, nor is what is as large as a bone.
std::vector<JointNote> unit_notes(const std::string& body, const Mesh& mesh) {
  constexpr double smallest_whole_bone = 100, fullest_head = 0.9, least_head = 0.4;
  const double size = mesh::bounds_of_surface(mesh).diagonal();
  std::optional<double> radius;
  if (size < smallest_whole_bone)
    if (const auto& head = kinematics::head_anywhere(mesh);
        head && head->coverage > least_head && head->coverage < fullest_head)
      radius = head->fit.sphere.radius;
  const bool is_small = size < kinematics::shortest_bone;
  if (!is_small && size <= kinematics::longest_bone && !radius) return {};
  const std::string unit =
      kinematics::likely_unit_text(is_small || size > kinematics::longest_bone ? size : 0, radius);
  if (unit.empty()) return {};
  return {{JointNoteCode::unlikely_size,
           body + core::formatted(" is %.4g mm across", size) +
               (radius ? core::formatted(", with a head of radius %.3g mm", *radius) : "") + unit +
               " Lengths are taken as mm; --units, or units, says otherwise"}};
}

/// What the answer must be read with. Trees of both bodies are most of the work of one answer: they are made side by side, and stay with the
/// meshes.
std::vector<JointNote> notes_of(const Mesh& fixed, const Mesh& mobile, bool units_are_stated) {
  require_surface(fixed, "the fixed body");
  require_surface(mobile, "the mobile body");
  const std::array<const Mesh*, 2> meshes{&fixed, &mobile};
  std::array<std::vector<JointNote>, 2> notes;
  const auto look = [&](std::size_t k) {
    const std::string body = k == 0 ? "the fixed body" : "the mobile body";
    const KeptSurface& kept = kept_with(*meshes[k]);
    static_cast<void>(is_solid(*meshes[k]));
    // The tree says that most surfaces are one piece at less cost than a table of edges.
    const bool is_one_piece = mesh::tree_of(*meshes[k])->one_vertex_of_each_piece().size() < 2;
    notes[k] = kept.notes[k].get(
        [&](auto& made) { made = kinematics::surface_notes(body, *meshes[k], is_one_piece); });
    if (units_are_stated) return;
    const auto& units = kept.unit_notes[k].get([&](auto& made) { made = unit_notes(body, *meshes[k]); });
    notes[k].insert(notes[k].begin(), units.begin(), units.end());
  };
  core::parallel_pair([&] { look(0); }, [&] { look(1); });
  notes[0].insert(notes[0].end(), notes[1].begin(), notes[1].end());
  return std::move(notes[0]);
}

void require_direction(const Vec3& direction, const char* name) {
  if (!direction.allFinite() || direction.isZero(0))
    throw UsageError(std::string(name) + ": a direction is finite and not zero");
}

/// Of the surface of one body, in F; `X_FO` brings the other body's frame there.
TouchDepth depth_of(BodyRole of, const contact::DeepestPlace& found, const Pose& X_FO) {
  const Vec3 place = posed(X_FO, found.place), exit = posed(X_FO, found.exit);
  return {of,
          found.depth_mm,
          0,
          place,
          exit,
          core::ordered_direction(exit - place),
          found.triangle,
          found.target_triangle};
}

/// Answers one request about two bodies.
class Touch {
 public:
  Touch(const contact::JointContact& bodies, const TouchRequest& request, std::vector<JointNote> notes)
      : bodies_(bodies),
        pair_(contact::body_pair_of(bodies)),
        answer_{.request = request, .notes = std::move(notes)} {}

  TouchAnswer run() {
    const Pose& X_FM = answer_.request.X_FM;
    fixed_is_solid_ = is_solid(bodies_.fixed()), mobile_is_solid_ = is_solid(bodies_.mobile());
    answer_.pairs = pair_.pairs(X_FM);
    answer_.in_contact = !answer_.pairs.empty() || pair_.touch(X_FM);
    if (answer_.pairs.empty()) {
      const auto closest = mesh::closest_points(pair_.fixed_tree(), pair_.mobile_tree(), X_FM);
      answer_.nearest = {closest->distance_mm, closest->a_point, closest->b_point};
    }
    if (answer_.in_contact) {
      if (answer_.pairs.empty()) answer_.inside = wholly_inside();
      find_deepest();
      if (answer_.request.centre && fixed_is_solid_ && mobile_is_solid_)
        answer_.ray_depth_mm = depth_along_rays(*answer_.request.centre);
      if (answer_.request.measures == TouchMeasures::all) measure();
    }
    find_translations();
    return std::move(answer_);
  }

 private:
  /// Vertices of M in F and of F in M, as contact has them.
  Points mobile_in_F() const { return posed(answer_.request.X_FM, bodies_.mobile().vertices()); }
  Points fixed_in_M() const { return posed(inverted(answer_.request.X_FM), bodies_.fixed().vertices()); }

  /// Surfaces that do not meet: a piece is inside with every vertex or with none.
  std::optional<BodyRole> wholly_inside() const {
    const auto all_inside = [](const mesh::TriangleTree& tree, const Points& vertices, const Mesh& other) {
      const mesh::WindingNumber winding(other);
      const std::vector<Index>& pieces = tree.one_vertex_of_each_piece();
      return std::all_of(pieces.begin(), pieces.end(), [&](Index v) {
        return winding.at(vertices[tree.mesh_vertices()[v]]).state == PointState::inside;
      });
    };
    if (fixed_is_solid_ && all_inside(pair_.mobile_tree(), mobile_in_F(), bodies_.fixed()))
      return BodyRole::mobile;
    if (mobile_is_solid_ && all_inside(pair_.fixed_tree(), fixed_in_M(), bodies_.mobile()))
      return BodyRole::fixed;
    return std::nullopt;
  }

  void find_deepest() {
    const Pose& X_FM = answer_.request.X_FM;
    contact::Reaching mobile_reaching, fixed_reaching;
    core::parallel_pair(
        [&] {
          if (fixed_is_solid_) mobile_reaching = pair_.reaching(BodyRole::mobile, X_FM, answer_.pairs);
        },
        [&] {
          if (mobile_is_solid_) fixed_reaching = pair_.reaching(BodyRole::fixed, X_FM, answer_.pairs);
        });
    contact::DepthSearched of_mobile, of_fixed;
    if (fixed_is_solid_)
      of_mobile =
          contact::deepest_place(pair_.fixed_tree(), pair_.mobile_tree(), X_FM, std::move(mobile_reaching));
    const double known = of_mobile.deepest ? of_mobile.deepest->depth_mm : 0;
    if (mobile_is_solid_)
      of_fixed = contact::deepest_place(pair_.mobile_tree(), pair_.fixed_tree(), inverted(X_FM),
                                        std::move(fixed_reaching), known);
    if (of_fixed.deepest)
      answer_.deepest = depth_of(BodyRole::fixed, *of_fixed.deepest, X_FM);
    else if (of_mobile.deepest)
      answer_.deepest = depth_of(BodyRole::mobile, *of_mobile.deepest, Pose::Identity());
    if (!fixed_is_solid_ && !mobile_is_solid_) return;
    answer_.depth_bound_mm = std::max(of_mobile.bound_mm, of_fixed.bound_mm);
    if (answer_.deepest) answer_.deepest->error_mm = *answer_.depth_bound_mm - answer_.deepest->depth_mm;
  }

  /// About a centre, which becomes the origin of both bodies.
  double depth_along_rays(const Vec3& centre) const {
    Pose to_centre = Pose::Identity();
    to_centre.translation() = -centre;
    const contact::JointContact about(bodies_.fixed().moved_to(posed(to_centre, bodies_.fixed().vertices())),
                                      bodies_.mobile().moved_to(posed(to_centre, mobile_in_F())));
    const contact::RadialContact met = about.radial(Pose::Identity());
    const auto depths = contact::reliable_radial_depths(
        met, contact::nearest_distances(about, Pose::Identity(), contact::MeasuredContact(met),
                                        contact::DistancesOf::vertices_inside));
    const auto deepest = contact::deepest_of(depths);
    return deepest ? deepest->vertex.depth_mm : 0;
  }

  void measure() {
    std::vector<PointState> mobile, fixed;
    const auto states_in = [](const Mesh& solid, const Points& vertices) {
      std::vector<PointState> states;
      for (const mesh::PointWinding& at : mesh::WindingNumber(solid).at(vertices)) states.push_back(at.state);
      return states;
    };
    if (fixed_is_solid_) mobile = states_in(bodies_.fixed(), mobile_in_F());
    if (mobile_is_solid_) fixed = states_in(bodies_.mobile(), fixed_in_M());
    const TriMesh placed = posed(answer_.request.X_FM, TriMesh(bodies_.mobile()));
    const contact::Overlap found =
        contact::overlap_of({bodies_.fixed(), fixed}, {placed, mobile}, answer_.pairs);
    TouchOverlap& overlap = answer_.overlap.emplace();
    double area = 0;
    Vec3 moment = Vec3::Zero();
    const auto area_of = [&](const std::vector<contact::PatchPart>& patch) {
      mesh::CompensatedSum sum;
      for (const contact::PatchPart& part : patch) sum.add(part.area), moment += part.area * part.centroid;
      area += sum.value();
      return sum.value();
    };
    if (fixed_is_solid_) overlap.mobile_area_mm2 = area_of(found.mobile);
    if (mobile_is_solid_) overlap.fixed_area_mm2 = area_of(found.fixed);
    if (area > 0) overlap.centroid = moment / area;
    for (const auto& [name, mesh] :
         {std::pair("the fixed body", &bodies_.fixed()), {"the mobile body", &bodies_.mobile()}})
      if (auto note = kinematics::self_crossing_note(name, *mesh)) answer_.notes.push_back(std::move(*note));
    if (!fixed_is_solid_ || !mobile_is_solid_ || !found.has_volume()) return;
    overlap.volume_mm3 = found.volume, overlap.volume_error_mm3 = found.volume_error;
    overlap.fixed_covered_again_mm3 = found.fixed_covered_again;
    overlap.mobile_covered_again_mm3 = found.mobile_covered_again;
  }

  void find_translations() {
    std::optional<motion::FreeSlides> slides;  // along the last direction, which serve the opposite one too
    Vec3 last = Vec3::Zero();
    for (const Vec3& along : answer_.request.along) {
      FreeTranslation free{core::ordered_direction(along), 0, 0};
      if (answer_.in_contact) {
        const bool is_opposite = slides && along == -last;
        if (!is_opposite) {
          slides = motion::free_slides(bodies_.fixed(), bodies_.mobile(), along, answer_.request.X_FM);
          last = along;
        }
        if (is_opposite)
          std::for_each(slides->intervals.rbegin(), slides->intervals.rend(), FirstFree{free, -1});
        else
          std::for_each(slides->intervals.begin(), slides->intervals.end(), FirstFree{free, 1});
      }
      answer_.free.push_back(free);
    }
  }

  /// Takes the first interval, of those that are given in the order of a sense, that goes on beyond the start.
  struct FirstFree {
    FreeTranslation& free;
    double sense;
    bool is_found = false;

    void operator()(const motion::FreeSlide& each) {
      const motion::SlideEnd &from = sense > 0 ? each.low : each.high, &to = sense > 0 ? each.high : each.low;
      if (is_found || (to.at_mm && sense * *to.at_mm <= 0)) return;
      is_found = true;
      if (!from.at_mm || sense * *from.at_mm <= 0) return;
      free.distance_mm = sense * *from.at_mm, free.error_bound_mm = from.error_bound_mm;
    }
  };

  const contact::JointContact& bodies_;
  const contact::BodyPair& pair_;
  bool fixed_is_solid_ = false, mobile_is_solid_ = false;
  TouchAnswer answer_;
};

}  // namespace

TouchAnswer answer_touch(const contact::JointContact& bodies, const TouchRequest& request) {
  core::require_rotation(request.X_FM);
  for (const Vec3& along : request.along) require_direction(along, "along");
  std::vector<JointNote> notes = notes_of(bodies.fixed(), bodies.mobile(), request.units_are_stated);
  return Touch(bodies, request, std::move(notes)).run();
}

TouchAnswer answer_touch(const Mesh& fixed, const Mesh& mobile, const TouchRequest& request) {
  return answer_touch(contact::JointContact(fixed, mobile), request);
}

TurnAnswer answer_turn(const Mesh& fixed, const Mesh& mobile, const TurnRequest& request) {
  require_direction(request.axis, "axis");
  std::vector<JointNote> notes = notes_of(fixed, mobile, request.units_are_stated);
  return {request, motion::free_turns(fixed, mobile, AxisFrame(request.centre, request.axis), request.X_FM),
          std::move(notes)};
}

SlideAnswer answer_slide(const Mesh& fixed, const Mesh& mobile, const SlideRequest& request) {
  require_direction(request.along, "along");
  std::vector<JointNote> notes = notes_of(fixed, mobile, request.units_are_stated);
  return {request, motion::free_slides(fixed, mobile, request.along, request.X_FM), std::move(notes)};
}

}  // namespace condyle
