#include "condyle/motion_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/formatted.hpp"
#include "kinematics/ligament_path.hpp"
#include "mesh/enclosed_volume.hpp"

namespace condyle::motion {
namespace {

using core::formatted;

/// MPa: of cartilage in equilibrium 0.5 and more (Keenan et al. 2009), of alumina, the stiffest of implants, 380,000.
constexpr double softest = 0.1, stiffest = 5e5;
/// A layer is stiffer than Young's modulus by 34 times at this ratio and by 170 at 0.499: the digits decide.
constexpr double least_poisson = 0, largest_poisson = 0.495;
/// mm. Cartilage is 0.5 to 7 thick, bearings of polyethylene up to 20.
constexpr double thinnest = 0.1, thickest = 20;

/// Twice the volume over the area of a closed mesh is its mean thickness where it is a plate: 2 to 5 mm for cartilage, 10 to 20 for the
/// ends of bones. A mesh as thick as this, mm, and three times as thick as its layer is rather a bone.
constexpr double least_of_bone = 8, least_ratio_of_bone = 3;

/// N: ten times 75 kg. Stumbling loads a hip by 8.7 times the body's weight (Bergmann et al. 1993), nothing measured by more.
constexpr double body_weight = 736, most_body_weights = 10;

/// A patella at two body weights has 0.16 +- 0.07 (Guterl et al. 2009): this is two deviations more. Here the linear law's pressure is a sixth
/// below the logarithmic one's.
constexpr double large_strain = 0.3;

/// Degrees: two whole turns. And a metre, mm.
constexpr double largest_angle_deg = 720, largest_length_mm = 1000;

/// Half a turn in radians, and 17 degrees in radians: a motion of a joint turns by more, and a body at rest that is recorded in degrees
/// sways by little.
constexpr double half_turn_rad = 3.1416, least_motion_rad = 0.3;

/// Seconds. Cameras and simulations give tens to hundreds of frames in a second, magnetic resonance some tens in a minute: frames this far apart, or
/// a recording this long of frames of half a second or more, are not of a motion. A motion in per cent has steps of 1 up to 100.
constexpr double longest_step_s = 2, longest_recording_s = 120, longest_usual_step_s = 0.5;

/// mm. Bones of a joint are apart by its cartilage, some mm; and layers of a few mm overlap by less than these.
constexpr double far_apart = 20, far_within = 10;

/// Where a thickness that varies is beyond what is to be expected of it.
void note_bounds(const contact::ElasticLayer& layer, const std::string& name,
                 std::vector<ContactNote>& notes) {
  const auto* many = std::get_if<std::vector<double>>(&layer.thickness_mm);
  if (!many || many->empty() || !layer.thickness_bounds_mm) return;
  const auto [least, greatest] = *layer.thickness_bounds_mm;
  const double rounding = 1e-9 * greatest;
  std::size_t thinner = 0, thicker = 0;
  for (const double thickness : *many) {
    thinner += thickness < least - rounding;
    thicker += thickness > greatest + rounding;
  }
  if (thinner + thicker == 0) return;
  const auto [low, high] = std::minmax_element(many->begin(), many->end());
  std::string beyond;
  if (thinner > 0) beyond += formatted("%zu thinner, down to %.4g mm", thinner, *low);
  if (thicker > 0)
    beyond += formatted("%s%zu thicker, up to %.4g mm", thinner > 0 ? ", and " : "", thicker, *high);
  notes.push_back({ContactNoteCode::thickness_beyond_bounds,
                   "the layer on " + name +
                       formatted(" is %.4g to %.4g mm thick by its file, and measured at %zu vertices: ",
                                 least, greatest, many->size()) +
                       beyond});
}

void note_layer(const std::optional<contact::ElasticLayer>& layer, const Mesh& mesh, std::string_view body,
                std::vector<ContactNote>& notes) {
  if (!layer) return;
  const std::string name(body);
  if (const double e = layer->youngs_modulus_mpa; e < softest || e > stiffest)
    notes.push_back(
        {ContactNoteCode::unlikely_modulus,
         "the layer on " + name +
             formatted(" has a Young's modulus of %.4g MPa; tissue and implants have %g to %g%s", e, softest,
                       stiffest, e > stiffest ? ": is it in Pa?" : ": is it in GPa?")});
  if (const double nu = layer->poisson_ratio; nu < least_poisson || nu > largest_poisson)
    notes.push_back(
        {ContactNoteCode::unlikely_poisson_ratio,
         "the layer on " + name +
             (nu < least_poisson
                  ? formatted(" has a Poisson's ratio of %.4g: no tissue or implant widens when stretched",
                              nu)
                  : formatted(" has a Poisson's ratio of %.6g: it is %.3g times as stiff as Young's modulus, "
                              "and the last digit decides",
                              nu, layer->confined_modulus_mpa() / layer->youngs_modulus_mpa))});
  double least = 0, most = 0;
  if (const auto* one = std::get_if<double>(&layer->thickness_mm)) {
    least = most = *one;
  } else {
    const auto& many = std::get<std::vector<double>>(layer->thickness_mm);
    if (many.empty()) return;
    const auto [low, high] = std::minmax_element(many.begin(), many.end());
    least = *low, most = *high;
  }
  note_bounds(*layer, name, notes);
  if (least < thinnest || most > thickest)
    notes.push_back({ContactNoteCode::unlikely_thickness,
                     "the layer on " + name +
                         (most > thickest ? formatted(" is up to %.4g mm thick", most)
                                          : formatted(" is %.4g mm thick", least)) +
                         formatted("; cartilage and implants are %g to %g%s", thinnest, thickest,
                                   most > 50 * thickest ? ": is it in micrometres?"
                                   : most < thinnest    ? ": is it in metres?"
                                                        : "")});
  if (!mesh.is_closed()) return;
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    const Vec3 a = mesh.corner(t, 0);
    area += (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm() / 2;
  }
  const double thickness = area > 0 ? 2 * std::abs(mesh::enclosed_volume(mesh)) / area : 0;
  if (thickness > least_of_bone && thickness > least_ratio_of_bone * most)
    notes.push_back({ContactNoteCode::layer_on_bone,
                     name + formatted(" is %.1f mm thick in the mean and has a layer of %.3g mm: is its mesh "
                                      "the bone, without the cartilage? Its surface is taken for the layer's",
                                      thickness, most)});
}

void note_strain(double strain, std::string_view where, std::vector<ContactNote>& notes) {
  const std::string at(where);
  if (strain > 1)
    notes.push_back({ContactNoteCode::deeper_than_layers,
                     formatted("the bodies overlap by %.3g times the thickness of their layers", strain) +
                         at + ": no layer is compressed so far, and pressures are none"});
  else if (strain > large_strain)
    notes.push_back({ContactNoteCode::large_strain,
                     formatted("layers are compressed by %.0f %% of their thickness", 100 * strain) + at +
                         formatted(": beyond %.0f %% laws of thin layers differ by more than a sixth",
                                   100 * large_strain)});
}

void note_force(double force, std::string_view what, std::vector<ContactNote>& notes) {
  if (!(force > most_body_weights * body_weight)) return;
  notes.push_back({ContactNoteCode::unlikely_load,
                   std::string(what) + formatted(" is %.4g N, %.3g times a body weight of %g N (75 kg "
                                                 "assumed); stumbling loads a hip by 8.7 times it",
                                                 force, force / body_weight, body_weight)});
}

ContactNote oblique_peak(std::string_view body, const std::string& where) {
  return {ContactNoteCode::oblique_peak,
          "the largest values of " + std::string(body) + where +
              " come from a triangle whose ray meets the other surface more than 60 degrees off its normal, "
              "as along a rim: its length is no depth"};
}

double force_of(const FrameContact& frame) {
  return frame.on_mobile.force_n.norm();
}

}  // namespace

std::string_view name_of(ContactNoteCode code) noexcept {
  switch (code) {
    case ContactNoteCode::unlikely_modulus:
      return "unlikely_modulus";
    case ContactNoteCode::unlikely_poisson_ratio:
      return "unlikely_poisson_ratio";
    case ContactNoteCode::unlikely_thickness:
      return "unlikely_thickness";
    case ContactNoteCode::thickness_beyond_bounds:
      return "thickness_beyond_bounds";
    case ContactNoteCode::layer_on_bone:
      return "layer_on_bone";
    case ContactNoteCode::unlikely_load:
      return "unlikely_load";
    case ContactNoteCode::deeper_than_layers:
      return "deeper_than_layers";
    case ContactNoteCode::large_strain:
      return "large_strain";
    case ContactNoteCode::oblique_peak:
      return "oblique_peak";
    case ContactNoteCode::unlikely_angle:
      return "unlikely_angle";
    case ContactNoteCode::unlikely_times:
      return "unlikely_times";
    case ContactNoteCode::unlikely_translation:
      return "unlikely_translation";
    case ContactNoteCode::beyond_range:
      return "beyond_range";
    case ContactNoteCode::locked_coordinate:
      return "locked_coordinate";
    case ContactNoteCode::mostly_apart:
      return "mostly_apart";
    case ContactNoteCode::mostly_deep:
      return "mostly_deep";
    case ContactNoteCode::unknown_ligament_length:
      return "unknown_ligament_length";
    case ContactNoteCode::unlikely_strain:
      return "unlikely_strain";
  }
  return "";
}

void add_new(std::vector<ContactNote>& notes, std::vector<ContactNote> more) {
  const std::size_t before = notes.size();
  for (ContactNote& note : more)
    if (std::none_of(notes.begin(), notes.begin() + static_cast<std::ptrdiff_t>(before),
                     [&](const ContactNote& of) { return of.code == note.code; }))
      notes.push_back(std::move(note));
}

std::vector<ContactNote> check_layers(const Mesh& fixed, const Mesh& mobile,
                                      const contact::ElasticContactOptions& options, const BodyNames& names) {
  std::vector<ContactNote> notes;
  note_layer(options.fixed, fixed, names.fixed, notes);
  note_layer(options.mobile, mobile, names.mobile, notes);
  return notes;
}

std::vector<ContactNote> check_layers(const contact::ElasticContact& contact, const BodyNames& names) {
  return check_layers(contact.fixed(), contact.mobile(), contact.options(), names);
}

std::vector<ContactNote> check_load(const contact::Load& load) {
  std::vector<ContactNote> notes;
  note_force(load.on_mobile.force_n.norm(), "the force to be carried", notes);
  return notes;
}

std::vector<ContactNote> check_contact(const contact::ElasticContactResults& results,
                                       const BodyNames& names) {
  std::vector<ContactNote> notes;
  double strain = 0;
  for (const auto* cast : {&results.fixed, &results.mobile})
    if (*cast) strain = std::max(strain, (*cast)->max_strain);
  note_strain(strain, "", notes);
  note_force(results.on_mobile.force_n.norm(), "the contact's force", notes);
  if (results.fixed && results.fixed->peak_is_oblique) notes.push_back(oblique_peak(names.fixed, ""));
  if (results.mobile && results.mobile->peak_is_oblique) notes.push_back(oblique_peak(names.mobile, ""));
  return notes;
}

std::vector<ContactNote> check_contact(const contact::ContactForces& forces) {
  std::vector<ContactNote> notes;
  note_strain(forces.max_strain, "", notes);
  note_force(forces.on_mobile_body.force_n.norm(), "the contact's force", notes);
  return notes;
}

std::vector<ContactNote> check_motion(std::span<const std::optional<FrameContact>> frames,
                                      const BodyNames& names) {
  std::vector<ContactNote> notes;
  std::size_t answered = 0, apart = 0, deep = 0, strained = 0, crushed = 0, oblique = 0;
  double strain = 0, force = 0;
  std::vector<double> gaps, depths;
  for (const auto& frame : frames) {
    if (!frame) continue;
    ++answered;
    const contact::SurfaceContact& surface = frame->surface;
    strain = std::max(strain, surface.max_strain);
    force = std::max(force, force_of(*frame));
    crushed += surface.max_strain > 1;
    strained += surface.max_strain > large_strain;
    oblique += surface.peak_is_oblique;
    if (frame->smallest_gap_mm > far_apart) ++apart, gaps.push_back(frame->smallest_gap_mm);
    if (surface.totals.max_depth_mm > far_within) ++deep, depths.push_back(surface.totals.max_depth_mm);
  }
  const auto of_frames = [&](std::size_t count) {
    return formatted(" (in %zu of %zu frames)", count, answered);
  };
  note_strain(strain, of_frames(strain > 1 ? crushed : strained), notes);
  note_force(force, "the contact's largest force", notes);
  if (oblique > 0) notes.push_back(oblique_peak("the surface that casts", of_frames(oblique)));
  const auto median = [](std::vector<double>& of) {
    const auto middle = of.begin() + static_cast<std::ptrdiff_t>(of.size() / 2);
    std::nth_element(of.begin(), middle, of.end());
    return *middle;
  };
  if (2 * apart > answered)
    notes.push_back({ContactNoteCode::mostly_apart,
                     formatted("%s and %s are apart by %.4g mm", std::string(names.fixed).c_str(),
                               std::string(names.mobile).c_str(), median(gaps)) +
                         of_frames(apart) + ": do the motion's unit, frame and signs fit the joint?"});
  if (2 * deep > answered)
    notes.push_back({ContactNoteCode::mostly_deep,
                     formatted("%s and %s are %.4g mm within each other", std::string(names.fixed).c_str(),
                               std::string(names.mobile).c_str(), median(depths)) +
                         of_frames(deep) + ": do the motion's unit, frame and signs fit the joint?"});
  return notes;
}

std::vector<ContactNote> check_ligaments(std::span<const LigamentAlong> ligaments,
                                         std::span<const std::optional<Pose>> X_FM) {
  std::string unknown, strained;
  for (const LigamentAlong& ligament : ligaments) {
    std::size_t without = 0;
    double largest = 0;
    for (std::size_t i = 0; i < X_FM.size(); ++i) {
      if (ligament.frames[i])
        largest = std::max(largest, ligament.frames[i]->strain);
      else
        without += X_FM[i].has_value();
    }
    if (without > 0) unknown += (unknown.empty() ? "" : ", ") + ligament.name + formatted(" in %zu", without);
    if (largest > kinematics::largest_strain)
      strained += (strained.empty() ? "" : ", ") + ligament.name + formatted(" %.3g", largest);
  }
  std::vector<ContactNote> notes;
  if (!unknown.empty())
    notes.push_back(
        {ContactNoteCode::unknown_ligament_length,
         formatted("ligaments meet an ellipsoid or end inside what they wrap, and have no known length "
                   "in some of %zu frames: ",
                   X_FM.size()) +
             unknown});
  if (!strained.empty())
    notes.push_back({ContactNoteCode::unlikely_strain, "no ligament bears such a strain: " + strained +
                                                           ": are points and slack length right?"});
  return notes;
}

std::optional<ContactNote> check_recorded(std::string_view coordinate, RecordedKind kind, double largest) {
  const std::string name(coordinate);
  if (kind == RecordedKind::angle_deg && largest > largest_angle_deg)
    return ContactNote{
        ContactNoteCode::unlikely_angle,
        name +
            formatted(
                " reaches %.4g degrees, more than two turns: is its column in degrees, and read as radians?",
                largest)};
  if (kind == RecordedKind::length_mm && largest > largest_length_mm)
    return ContactNote{
        ContactNoteCode::unlikely_translation,
        name + formatted(
                   " reaches %.4g mm, more than a metre: is its column in millimetres, and read as metres?",
                   largest)};
  return std::nullopt;
}

std::optional<ContactNote> check_degrees(std::span<const std::vector<double>> columns) {
  double largest = 0, widest = 0;
  for (const std::vector<double>& column : columns) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double value : column) {
      if (std::isnan(value)) continue;
      low = std::min(low, value), high = std::max(high, value);
    }
    if (low > high) continue;
    largest = std::max({largest, std::abs(low), std::abs(high)});
    widest = std::max(widest, high - low);
  }
  if (largest > half_turn_rad || widest < least_motion_rad) return std::nullopt;
  return ContactNote{ContactNoteCode::unlikely_angle,
                     formatted("all recorded angles are within %.3g degrees and move by at most %.3g: are "
                               "they in radians, though the header says inDegrees=yes?",
                               largest, widest)};
}

std::optional<ContactNote> check_times(std::span<const double> seconds) {
  if (seconds.size() < 2) return std::nullopt;
  std::vector<double> steps;
  for (std::size_t i = 1; i < seconds.size(); ++i) steps.push_back(seconds[i] - seconds[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double step = *middle, lasts = seconds.back() - seconds.front();
  if (step < longest_step_s && !(step >= longest_usual_step_s && lasts > longest_recording_s))
    return std::nullopt;
  return ContactNote{
      ContactNoteCode::unlikely_times,
      formatted("frames are %.4g s apart and the recording lasts %.4g s: are its times in milliseconds?",
                step, lasts)};
}

}  // namespace condyle::motion
