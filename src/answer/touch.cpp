#include "condyle/answer/depth.hpp"

#include <algorithm>
#include <string>

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
#include "mesh/enclosed_volume.hpp"
#include "mesh/findings.hpp"
#include "mesh/surface_pieces.hpp"
#include "mesh/surface_to_surface.hpp"
#include "mesh/triangle_tree.hpp"
#include "mesh/winding_number.hpp"

namespace condyle {
namespace {

/// Kept with the mesh, which may be asked at many poses.
struct KeptSense {
  core::Lazy<bool> is_inside_out;
};

bool is_inside_out(const Mesh& mesh) {
  return mesh::findings_of(mesh).get<KeptSense>().is_inside_out.get(
      [&](bool& is) { is = mesh::is_inside_out(mesh); });
}

/// Trees of both bodies are most of the work of one answer: they are made side by side, and stay with the meshes.
void prepare(const contact::JointContact& bodies) {
  const auto of = [](const Mesh& mesh) {
    return [&] {
      static_cast<void>(mesh.is_closed() && is_inside_out(mesh));
      static_cast<void>(mesh::tree_of(mesh)->one_vertex_of_each_piece());
    };
  };
  core::parallel_pair(of(bodies.fixed()), of(bodies.mobile()));
}

/// Most surfaces are one piece, which the tree says at less cost.
std::optional<Index> inverted_piece(const Mesh& mesh) {
  if (mesh::tree_of(mesh)->one_vertex_of_each_piece().size() < 2) return std::nullopt;
  return mesh::inverted_piece(mesh);
}

/// Whether a mesh has an inside that means one: closed, its normals outwards. Notes why not.
bool is_solid(const Mesh& mesh, BodyRole role, std::vector<JointNote>& notes) {
  const std::string body = role == BodyRole::fixed ? "the fixed body" : "the mobile body";
  if (!mesh.is_closed())
    notes.push_back({JointNoteCode::open_mesh,
                     body + " is open and has no inside: the surfaces are answered for, and nothing that is "
                            "inside of it"});
  else if (is_inside_out(mesh))
    notes.push_back({JointNoteCode::inverted_mesh,
                     body + " is inside out, its volume is negative: nothing counts as inside of it; the "
                            "repair flip_inverted turns it"});
  else {
    if (const auto first = inverted_piece(mesh))
      notes.push_back({JointNoteCode::inverted_mesh,
                       core::formatted("%s has a piece that is inside out, that of triangle %u: nothing "
                                       "counts as inside of that piece",
                                       body.c_str(), *first)});
    return true;
  }
  return false;
}

void require_surfaces(const Mesh& fixed, const Mesh& mobile) {
  require_surface(fixed, "the fixed body");
  require_surface(mobile, "the mobile body");
}

void require_direction(const Vec3& direction, const char* name) {
  if (!direction.allFinite() || direction.isZero(0))
    throw UsageError(std::string(name) + ": a direction is finite and not zero");
}

std::vector<JointNote> notes_of(const Mesh& fixed, const Mesh& mobile) {
  require_surfaces(fixed, mobile);
  std::vector<JointNote> notes;
  is_solid(fixed, BodyRole::fixed, notes);
  is_solid(mobile, BodyRole::mobile, notes);
  return notes;
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
  Touch(const contact::JointContact& bodies, const TouchRequest& request)
      : bodies_(bodies), pair_(contact::body_pair_of(bodies)), answer_{.request = request} {}

  TouchAnswer run() {
    const Pose& X_FM = answer_.request.X_FM;
    fixed_is_solid_ = is_solid(bodies_.fixed(), BodyRole::fixed, answer_.notes);
    mobile_is_solid_ = is_solid(bodies_.mobile(), BodyRole::mobile, answer_.notes);
    answer_.pairs = pair_.pairs(X_FM);
    answer_.in_contact = !answer_.pairs.empty() || pair_.touch(X_FM);
    if (answer_.pairs.empty()) {
      const auto closest = mesh::closest_points(pair_.fixed_tree(), pair_.mobile_tree(), X_FM);
      answer_.nearest = {closest->distance_mm, closest->a_point, closest->b_point};
    }
    if (answer_.in_contact) {
      if (answer_.pairs.empty()) answer_.inside = wholly_inside();
      find_deepest();
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
    std::vector<Index> mobile_reaching, fixed_reaching;
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
    if (!fixed_is_solid_ || !mobile_is_solid_) return;
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
  require_surfaces(bodies.fixed(), bodies.mobile());
  core::require_rotation(request.X_FM);
  for (const Vec3& along : request.along) require_direction(along, "along");
  prepare(bodies);
  return Touch(bodies, request).run();
}

TouchAnswer answer_touch(const Mesh& fixed, const Mesh& mobile, const TouchRequest& request) {
  return answer_touch(contact::JointContact(fixed, mobile), request);
}

TurnAnswer answer_turn(const Mesh& fixed, const Mesh& mobile, const TurnRequest& request) {
  require_direction(request.axis, "axis");
  std::vector<JointNote> notes = notes_of(fixed, mobile);
  return {request, motion::free_turns(fixed, mobile, AxisFrame(request.centre, request.axis), request.X_FM),
          std::move(notes)};
}

SlideAnswer answer_slide(const Mesh& fixed, const Mesh& mobile, const SlideRequest& request) {
  require_direction(request.along, "along");
  std::vector<JointNote> notes = notes_of(fixed, mobile);
  return {request, motion::free_slides(fixed, mobile, request.along, request.X_FM), std::move(notes)};
}

}  // namespace condyle
