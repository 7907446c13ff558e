#include <algorithm>

#include "condyle/hip_measures.hpp"
#include "measure/measure_acetabulum.hpp"
#include "measure/measure_femur.hpp"

namespace condyle::measure {
namespace {

using M = HipMeasures;

// Sources of definitions.
constexpr std::string_view here = "Condyle, mathematics 11";
constexpr std::string_view noetzli = "Noetzli et al. 2002, from the neck's side: mathematics 11";
constexpr std::string_view axis_of_sphere = "enlarged sphere of 1.4 R: JEO 2023 10:141";
constexpr std::string_view condylar = "posterior condylar line, axis of an enlarged sphere (JEO 2023 10:141)";
constexpr std::string_view murray = "Murray 1993";
constexpr std::string_view section = "Wiberg 1939, in a section: mathematics 11";

// Normal ranges, only of a definition like ours.
constexpr bool patients = true, not_patients = false;
constexpr std::string_view mature_femora = "data sets of skeletally mature femora, by 3D CT";
constexpr NormalRange alpha_normal{30,
                                   66,
                                   "people whom the source at hand does not describe",
                                   0,
                                   not_patients,
                                   "anatomic range",
                                   "Acta Orthop 2014 85:147"};
constexpr NormalRange neck_shaft_normal{
    118, 126, mature_femora, 1070, not_patients, "interquartile range, median 122.2", "PMC4775021"};
constexpr NormalRange femoral_version_normal{
    7,
    20,
    mature_femora,
    1070,
    not_patients,
    "interquartile range, median 14.2; other methods have means from 3.4 to 23.2",
    "PMC4775021; Orthoglobe 42116605"};
constexpr NormalRange version_normal{8.8,
                                     22.6,
                                     "patients who were investigated for impingement, by 3D CT",
                                     17,
                                     patients,
                                     "mean 15.7, one standard deviation either way",
                                     "PubMed 21181403"};
constexpr NormalRange lateral_edge_normal{
    23,
    33,
    "patients whose hip was dislocated in surgery and needed no trimming of its rim, on radiographs",
    21,
    patients,
    "reference values; of the silhouette, not a section",
    "PMC4353515"};
constexpr NormalRange ischiofemoral_normal{
    21,
    34,
    "patients with a painful hip and without ischiofemoral impingement, by MRI",
    44,
    patients,
    "mean 27.5, one standard deviation either way; 17 or less is narrow",
    "rb.org.br 3162; PMC7901394"};

// A row for each part: key, unit, definition, what it is measured by, source, normal range.
template <Measure FemurMeasures::*member>
constexpr MeasureDefinition femur(std::string_view key, std::string_view unit, std::string_view definition,
                                  std::string_view measured_by, std::string_view source = here,
                                  std::optional<NormalRange> normal = std::nullopt) {
  return {key,    unit,       MeasuredPart::femur,
          false,  definition, measured_by,
          source, normal,     [](const M& m) -> const Measure& {
        return m.femur.*member; }};
}

template <Measure AcetabulumMeasures::*member>
constexpr MeasureDefinition acetabulum(std::string_view key, std::string_view unit, bool in_pelvis_frame,
                                       std::string_view definition, std::string_view measured_by,
                                       std::string_view source = here,
                                       std::optional<NormalRange> normal = std::nullopt) {
  return {key,
          unit,
          MeasuredPart::acetabulum,
          in_pelvis_frame,
          definition,
          measured_by,
          source,
          normal,
          [](const M& m) -> const Measure& { return m.acetabulum.*member; }};
}

template <Measure BothMeasures::*member>
constexpr MeasureDefinition both(std::string_view key, std::string_view unit, std::string_view definition,
                                 std::string_view measured_by, std::string_view source = here,
                                 std::optional<NormalRange> normal = std::nullopt) {
  return {key,    unit,       MeasuredPart::both,
          false,  definition, measured_by,
          source, normal,     [](const M& m) -> const Measure& {
            return m.both.*member; }};
}

using F = FemurMeasures;
using A = AcetabulumMeasures;
using B = BothMeasures;

constexpr MeasureDefinition definitions[] = {
    femur<&F::head_radius>("head_radius_mm", "mm",
                           "radius of the sphere fitted to the head's part of the surface", "head"),
    femur<&F::head_rms>("head_rms_mm", "mm",
                        "root mean square distance of the head's vertices from the sphere fitted to them",
                        "head"),
    femur<&F::head_largest_residual>(
        "head_largest_residual_mm", "mm",
        "largest distance of a vertex of the head from the sphere fitted to them", "head"),
    femur<&F::head_roundness>(
        "head_roundness", "1",
        "root mean square distance of the head's vertices from their sphere, over its radius: 0 is round",
        "head"),
    femur<&F::head_coverage>(
        "head_coverage", "1",
        "share of all directions from the head's centre in which its part of the surface lies", "head"),
    femur<&F::neck_shaft>("neck_shaft_angle_deg", "deg",
                          "between neck and shaft axis, both away from where they meet", "neck, shaft",
                          axis_of_sphere, neck_shaft_normal),
    femur<&F::version>(
        "femoral_version_deg", "deg",
        "neck in front of the posterior condylar line, seen along the line from head to condyles",
        "neck, condyles", condylar, femoral_version_normal),
    femur<&F::torsion_in_frame>(
        "torsion_in_frame_deg", "deg",
        "neck in front of the frame's lateral axis, seen along the shaft: no femoral version", "neck, shaft"),
    femur<&F::alpha_12>("alpha_12_deg", "deg", "alpha angle at 12 o'clock, tolerance 0.5 mm of a head of 24",
                        "neck, clock", noetzli, alpha_normal),
    femur<&F::alpha_1_30>("alpha_1_30_deg", "deg",
                          "alpha angle at 1:30, anterosuperior, tolerance 0.5 mm of a head of 24",
                          "neck, clock", noetzli, alpha_normal),
    femur<&F::alpha_3>("alpha_3_deg", "deg",
                       "alpha angle at 3 o'clock, anterior, tolerance 0.5 mm of a head of 24", "neck, clock",
                       noetzli, alpha_normal),
    femur<&F::alpha_12_at_1mm>("alpha_12_at_1mm_deg", "deg",
                               "alpha angle at 12 o'clock, tolerance 1 mm of a head of 24", "neck, clock",
                               noetzli),
    femur<&F::alpha_1_30_at_1mm>("alpha_1_30_at_1mm_deg", "deg",
                                 "alpha angle at 1:30, tolerance 1 mm of a head of 24", "neck, clock",
                                 noetzli),
    femur<&F::alpha_3_at_1mm>("alpha_3_at_1mm_deg", "deg",
                              "alpha angle at 3 o'clock, tolerance 1 mm of a head of 24", "neck, clock",
                              noetzli),
    femur<&F::alpha_largest>("alpha_largest_deg", "deg",
                             "largest alpha angle from 11 to 4 o'clock, tolerance 0.5 mm of a head of 24",
                             "neck, clock", noetzli),
    femur<&F::alpha_largest_hour>("alpha_largest_hour", "h",
                                  "hour of the largest alpha angle from 11 to 4 o'clock at 0.5 mm of a head "
                                  "of 24, in steps of five minutes",
                                  "neck, clock", noetzli),
    femur<&F::alpha_largest_at_1mm>(
        "alpha_largest_at_1mm_deg", "deg",
        "largest alpha angle from 11 to 4 o'clock, tolerance 1 mm of a head of 24", "neck, clock", noetzli),
    femur<&F::offset_12>("head_neck_offset_12_mm", "mm",
                         "head radius less the neck's least distance from its axis, at 12 o'clock",
                         "neck, clock"),
    femur<&F::offset_1_30>("head_neck_offset_1_30_mm", "mm",
                           "head radius less the neck's least distance from its axis, at 1:30",
                           "neck, clock"),
    femur<&F::offset_3>("head_neck_offset_3_mm", "mm",
                        "head radius less the neck's least distance from its axis, at 3 o'clock",
                        "neck, clock"),
    femur<&F::offset_ratio_12>("head_neck_offset_ratio_12", "1",
                               "offset over the head's diameter, at 12 o'clock", "neck, clock"),
    femur<&F::offset_ratio_1_30>("head_neck_offset_ratio_1_30", "1",
                                 "offset over the head's diameter, at 1:30", "neck, clock"),
    femur<&F::offset_ratio_3>("head_neck_offset_ratio_3", "1",
                              "offset over the head's diameter, at 3 o'clock", "neck, clock"),
    femur<&F::trochanter_height>("trochanter_height_mm", "mm",
                                 "top of the greater trochanter over the head's centre, along the shaft",
                                 "head, shaft, trochanter"),
    acetabulum<&A::inclination>("acetabular_inclination_deg", "deg", true,
                                "opening of the rim's plane from straight down, anatomic",
                                "rim_plane, pelvis", murray),
    acetabulum<&A::version>("acetabular_version_deg", "deg", true,
                            "opening of the rim's plane in front of lateral, seen from above, anatomic",
                            "rim_plane, pelvis", murray, version_normal),
    acetabulum<&A::inclination_radiographic>(
        "acetabular_inclination_radiographic_deg", "deg", true,
        "opening of the rim's plane from straight down, seen from the front, radiographic",
        "rim_plane, pelvis", murray),
    acetabulum<&A::version_radiographic>(
        "acetabular_version_radiographic_deg", "deg", true,
        "opening of the rim's plane in front of the frontal plane, radiographic", "rim_plane, pelvis",
        murray),
    acetabulum<&A::version_0mm>("acetabular_version_0mm_deg", "deg", true,
                                "front and back of the rim in the transverse plane of the head's centre",
                                "chords, pelvis"),
    acetabulum<&A::version_5mm>(
        "acetabular_version_5mm_deg", "deg", true,
        "front and back of the rim in the transverse plane 5 mm above the head's centre", "chords, pelvis"),
    acetabulum<&A::version_10mm>("acetabular_version_10mm_deg", "deg", true,
                                 "front and back of the rim in the transverse plane 10 mm above the head's "
                                 "centre; below 0 retroverted there",
                                 "chords, pelvis"),
    acetabulum<&A::version_15mm>(
        "acetabular_version_15mm_deg", "deg", true,
        "front and back of the rim in the transverse plane 15 mm above the head's centre", "chords, pelvis"),
    acetabulum<&A::centre_edge_lateral>(
        "centre_edge_lateral_section_deg", "deg", true,
        "from superior to the roof's lateral edge, in the frontal section of the head's centre",
        "head, edges, pelvis", section, lateral_edge_normal),
    acetabulum<&A::centre_edge_anterior>("centre_edge_anterior_section_deg", "deg", true,
                                         "from superior to the roof's anterior edge, in the sagittal section",
                                         "head, edges, pelvis", section),
    acetabulum<&A::centre_edge_posterior>(
        "centre_edge_posterior_section_deg", "deg", true,
        "from superior to the roof's posterior edge, in the sagittal section", "head, edges, pelvis",
        section),
    acetabulum<&A::coverage>("head_covered_share", "1", false,
                             "share of all directions from the head's centre that lie inside the rim",
                             "head, rim"),
    acetabulum<&A::rim_radius>("rim_radius_mm", "mm", false,
                               "radius of the circle fitted to the rim in its plane", "rim_plane"),
    acetabulum<&A::rim_height>(
        "rim_height_mm", "mm", false,
        "plane of the rim beyond the head's centre, outwards: above 0 it covers more than half",
        "head, rim_plane"),
    both<&B::joint_space_least>("joint_space_least_mm", "mm",
                                "least radial gap between the head and the socket's sphere",
                                "head, joint_space"),
    both<&B::joint_space_median>(
        "joint_space_median_mm", "mm",
        "median radial gap between the head and the socket's sphere, by area of the socket",
        "head, joint_space"),
    both<&B::ischiofemoral>("ischiofemoral_distance_mm", "mm",
                            "least distance of femur and hip bone below the head, at the stated pose",
                            "ischiofemoral", here, ischiofemoral_normal),
};

}  // namespace

std::string_view name_of(MeasuredPart part) noexcept {
  return part == MeasuredPart::femur ? "femur" : part == MeasuredPart::acetabulum ? "acetabulum" : "both";
}

std::span<const MeasureDefinition> measure_definitions() noexcept {
  return definitions;
}

const MeasureDefinition* measure_definition(std::string_view key) noexcept {
  const auto* found = std::find_if(std::begin(definitions), std::end(definitions),
                                   [&](const auto& d) { return d.key == key; });
  return found == std::end(definitions) ? nullptr : found;
}

namespace {

/// The rows know the measures' places; those of `out` are ours to write.
void set_none(HipMeasures& out, MeasuredPart part, const std::string& why) {
  for (const MeasureDefinition& definition : measure_definitions())
    if (definition.part == part) const_cast<Measure&>(definition.of(out)) = not_measured(why);
}

}  // namespace

FemurMeasures femur_not_measured(const std::string& why) {
  HipMeasures out;
  set_none(out, MeasuredPart::femur, why);
  return std::move(out.femur);
}

AcetabulumMeasures acetabulum_not_measured(const std::string& why, const BodyAxes& axes) {
  HipMeasures out;
  set_none(out, MeasuredPart::acetabulum, why);
  out.acetabulum.anterior = axes.anterior;
  out.acetabulum.superior = axes.superior;
  out.acetabulum.lateral = axes.lateral;
  return std::move(out.acetabulum);
}

}  // namespace condyle::measure
