#include "io/result/touch_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "answer/records/touch_table.hpp"
#include "condyle/version.hpp"
#include "core/rounded.hpp"
#include "io/file/format_version.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/shown_point.hpp"
#include "io/file/whole_file.hpp"
#include "io/picture/png.hpp"
#include "io/record/json_of.hpp"
#include "io/result/line_mesh.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle::io {
namespace {

/// The rows of X_FM one after the other.
Json matrix_rows(const Pose& X) {
  Json rows = Json::array();
  for (int i = 0; i < 16; ++i) rows.push_back(X.matrix()(i / 4, i % 4));
  return rows;
}

template <class Answer>
Json touch_answer_object(const Answer& answer, const TouchFiles* files) {
  Json json{{"condyle", format_version}};
  if (files) {
    json["fixed"] = files->fixed.path.string(), json["mobile"] = files->mobile.path.string();
    json["X_FM"] = matrix_rows(files->X_FM);
  }
  json.update(io::json_of(answer, {{}, Anatomy::hip}));
  if (files)
    json["provenance"] = {{"version", version},
                          {"command", files->command},
                          {"meshes",
                           {file_json(files->fixed.path, files->fixed.digest),
                            file_json(files->mobile.path, files->mobile.digest)}}};
  return json;
}

std::string both_names(const TouchFiles& files) {
  return fmt::format("{} and {}", files.fixed.path.string(), files.mobile.path.string());
}

const std::filesystem::path& file_in_role(const TouchFiles& files, BodyRole role) {
  return role == BodyRole::fixed ? files.fixed.path : files.mobile.path;
}

std::string place_text(const std::optional<motion::ContactWitness>& contact) {
  return contact ? ", at " + shown(contact->fixed_point) : "";
}

/// "12.3 degrees", or why there is none.
std::string touch_end_text(const motion::Limit& end) {
  if (end.reason == motion::LimitReason::end_of_range) return "nothing is met in a whole turn";
  return fmt::format("{:.9g} degrees{}", shown(end.turned.degrees()), place_text(end.contact));
}
std::string touch_end_text(const motion::SlideEnd& end) {
  if (!end.at_mm) return "nothing is met";
  return fmt::format("{:.9g} mm{}", shown(*end.at_mm), place_text(end.contact));
}

/// `bounds(each)` of each interval, in words of `unit`.
template <class End, class Interval>
std::string free_intervals_text(bool free_at_start, const End& negative, const End& positive,
                                const std::vector<Interval>& free, std::string_view unit,
                                const auto& bounds) {
  std::string text;
  if (free_at_start)
    text += fmt::format("  first contact on: {}\n  first contact back: {}\n", touch_end_text(positive),
                        touch_end_text(negative));
  else
    text += "  in contact where they are given\n";
  if (free.empty()) return text + "  nowhere free\n";
  text += "  free:";
  for (const Interval& each : free) {
    const auto [low, high] = bounds(each);
    text += fmt::format(" {} to {}{}", low, high, &each == &free.back() ? "" : ",");
  }
  return text + fmt::format(" {}\n", unit);
}

bool is_of_touch(std::string_view name) {
  static constexpr std::string_view names[] = {"touch.json", "fixed.vtp", "mobile.vtp", "place.vtp"};
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

/// Where an answer comes from.
std::vector<VtpField> origin_fields(const TouchFiles& files) {
  // One by one: GCC 12 destroys what an initializer list never built if one of its elements throws.
  std::vector<VtpField> fields;
  fields.push_back({"condyle_version", std::string(version)});
  fields.push_back({"condyle_command", command_text(files.command)});
  fields.push_back({"fixed_mesh", file_text(files.fixed.path, files.fixed.digest)});
  fields.push_back({"mobile_mesh", file_text(files.mobile.path, files.mobile.digest)});
  return fields;
}

/// 1 for each triangle that is in a pair.
MeshArray marks_of(const TouchAnswer& answer, std::size_t triangles, Index contact::TrianglePair::*of) {
  std::vector<std::uint8_t> marks(triangles);
  for (const contact::TrianglePair& pair : answer.pairs) marks[pair.*of] = 1;
  return {"in_contact", std::move(marks)};
}

}  // namespace

Json touch_object(const TouchAnswer& answer, const TouchFiles* files) {
  return touch_answer_object(answer, files);
}
Json turn_object(const TurnAnswer& answer, const TouchFiles* files) {
  return touch_answer_object(answer, files);
}
Json slide_object(const SlideAnswer& answer, const TouchFiles* files) {
  return touch_answer_object(answer, files);
}

std::string touch_text(const TouchAnswer& answer, const TouchFiles& files) {
  std::string text = fmt::format("{}: {}\n", both_names(files), answer.in_contact ? "in contact" : "apart");
  if (answer.inside)
    text += fmt::format("  {} is wholly inside the other\n", file_in_role(files, *answer.inside).string());
  if (const auto& nearest = answer.nearest)
    text += fmt::format("  nearest distance of the surfaces: {:.6g} mm, at {} and {}\n", nearest->distance_mm,
                        shown(nearest->on_fixed), shown(nearest->on_mobile));
  if (!answer.pairs.empty()) text += fmt::format("  pairs of triangles that meet: {}\n", answer.pairs.size());
  if (const auto& deepest = answer.deepest)
    text += fmt::format(
        "  depth: {:.6g} mm to the nearest surface{}, at {} of {}, out along {}\n", deepest->depth_mm,
        deepest->error_mm > 1e-6 * deepest->depth_mm
            ? fmt::format(" (no place is deeper by more than {} mm)", core::at_most(deepest->error_mm, 1))
            : "",
        shown(deepest->place), file_in_role(files, deepest->of).string(), shown(deepest->normal));
  else if (answer.depth_bound_mm)
    text += fmt::format("  depth: none found; no place of a surface is deeper in the other body than {} mm\n",
                        core::at_most(*answer.depth_bound_mm, 1));
  if (answer.ray_depth_mm)
    text += fmt::format("    {:.6g} mm along rays from the centre\n", *answer.ray_depth_mm);
  const TouchOverlap overlap = answer.overlap.value_or(TouchOverlap{});
  if (overlap.volume_mm3)
    text += fmt::format("  penetration volume: {:.6g} mm3, off by {} at most\n", *overlap.volume_mm3,
                        core::at_most(overlap.volume_error_mm3, 1));
  const auto add_again = [&](const std::filesystem::path& path, double again) {
    if (overlap.volume_mm3 && again > 0)
      text += fmt::format("    of it {:.6g} mm3 are counted again: {} covers them more than once\n", again,
                          path.string());
  };
  add_again(files.fixed.path, overlap.fixed_covered_again_mm3);
  add_again(files.mobile.path, overlap.mobile_covered_again_mm3);
  const auto add_area = [&](const std::filesystem::path& path, const std::optional<double>& area_mm2) {
    if (area_mm2) text += fmt::format("  surface of {} inside: {:.6g} mm2\n", path.string(), *area_mm2);
  };
  add_area(files.fixed.path, overlap.fixed_area_mm2);
  add_area(files.mobile.path, overlap.mobile_area_mm2);
  if (answer.in_contact)
    for (const FreeTranslation& each : answer.free)
      text += fmt::format("  free once {} has moved {:.9g} mm along {}\n", files.mobile.path.string(),
                          each.distance_mm, shown(each.along));
  return text;
}

std::string turn_text(const TurnAnswer& answer, const TouchFiles& files) {
  const motion::RotationLimits& ends = answer.free.from_start;
  return fmt::format("{}: the second turns about {} through {}\n", both_names(files),
                     shown(answer.request.axis), shown(answer.request.centre)) +
         free_intervals_text(ends.free_at_start(), ends.negative, ends.positive, answer.free.intervals,
                             "degrees", [](const motion::FreeInterval& each) {
                               return std::pair(fmt::format("{:.9g}", shown(each.low.degrees())),
                                                fmt::format("{:.9g}", shown(each.high.degrees())));
                             });
}

std::string slide_text(const SlideAnswer& answer, const TouchFiles& files) {
  const motion::FreeSlides& free = answer.free;
  const auto end = [](const motion::SlideEnd& at) {
    return at.at_mm ? fmt::format("{:.9g}", shown(*at.at_mm)) : "any";
  };
  return fmt::format("{}: the second slides along {}\n", both_names(files),
                     shown(core::ordered_direction(answer.request.along))) +
         free_intervals_text(
             free.free_at_start, free.negative, free.positive, free.intervals, "mm",
             [&](const motion::FreeSlide& each) { return std::pair(end(each.low), end(each.high)); });
}

void check_touch_folder(const std::filesystem::path& folder, const TouchFiles& files) {
  OutputFolder{folder, is_of_touch, files.read};
}

std::vector<std::filesystem::path> write_touch(const std::filesystem::path& folder, const TouchAnswer& answer,
                                               const TouchFiles& files, VtpEncoding encoding) {
  OutputFolder out(folder, is_of_touch, files.read, "touch.json");
  const VtpOptions options{encoding, origin_fields(files)};
  const auto write = [&](const char* name, const TriMesh& mesh, std::vector<MeshArray> triangles) {
    write_vtp(out.file(name), mesh, {}, triangles, options);
  };
  write("fixed.vtp", files.fixed.mesh,
        {marks_of(answer, files.fixed.mesh.triangles().size(), &contact::TrianglePair::fixed)});
  write("mobile.vtp", posed(files.X_FM, TriMesh(files.mobile.mesh)),
        {marks_of(answer, files.mobile.mesh.triangles().size(), &contact::TrianglePair::mobile)});
  if (const auto& deepest = answer.deepest) {
    TriMesh line;
    add_line(line, deepest->place, deepest->exit, deepest->depth_mm / 20);
    if (!line.triangles.empty()) write("place.vtp", line, {});
  }
  write_whole_file(out.file("touch.json"), document(touch_object(answer, &files)));
  return out.commit();
}

void write_touch_picture(const std::filesystem::path& path, const TouchAnswer& answer,
                         const TouchFiles& files) {
  const Picture drawn =
      draw_touch(files.fixed.mesh, files.mobile.mesh, answer, {.view = view_of_touch(answer)});
  write_png(path, drawn, origin_fields(files), files.read);
}

}  // namespace condyle::io
