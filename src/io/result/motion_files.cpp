#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "condyle/error.hpp"
#include "condyle/io/jam_file.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/figure_ending.hpp"
#include "io/file/output_folder.hpp"
#include "io/file/whole_file.hpp"
#include "io/result/jam_contact.hpp"
#include "io/result/ligament_mesh.hpp"
#include "io/result/motion_result.hpp"
#include "io/result/pressure_map.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_parts.hpp"

namespace condyle::io {
namespace {

/// Whether some motion has a file of this name.
bool is_of_motion(std::string_view name) {
  static constexpr std::string_view names[] = {
      "curves.csv",  "curves.sto", "cycle.csv",     "motion.json",   "motion.pvd",   "contacts.csv",
      "regions.csv", "jam.h5",     "map_fixed.vtp", "ligaments.csv", "ligaments.sto"};
  if (std::find(std::begin(names), std::end(names), name) != std::end(names)) return true;
  // Figures that condyle.plot drew of an earlier motion would contradict this one.
  for (const std::string_view stem : {"curves", "cycle", "pressure_map", "depth_map"})
    if (name.starts_with(stem) && io::is_figure_ending(name.substr(stem.size()))) return true;
  return (name.starts_with("map_fixed_") || name.starts_with("map_mobile_") ||
          name.starts_with("map_ligaments_")) &&
         name.ends_with(".vtp");
}

/// Where the bodies meet as a contact begins or ends; empty if no features are known to.
std::string meeting_fields(const MotionQuestion& question, const motion::ContactEnd& end) {
  if (!end.contact) return ",,,,,";
  const auto& [fixed, mobile] = question.surfaces;
  const auto part = [](const Body& body, const motion::Feature& feature) {
    const BodyPart* of = part_of(body, feature);
    return of ? io::csv_field(of->name) : std::string();
  };
  const AnswerFrame frame = question.provenance ? question.provenance->frame : AnswerFrame{};
  const Vec3 at = frame.fixed_point(end.contact->fixed_point) + Vec3::Zero();  // without the sign of 0
  return fmt::format(",{},{},{},{},{}", at.x(), at.y(), at.z(), part(fixed, end.contact->fixed_feature),
                     part(mobile, end.contact->mobile_feature));
}

/// When a contact begins or ends; without an uncertainty where the recording does before it.
std::string end_fields(const motion::ContactEnd& end, ContactEndRole role) {
  return fmt::format(
      "{},{},{},{}", end.time_s, name_of(end.kind, role),
      end.kind == motion::ContactEndKind::recording ? "" : fmt::format("{}", end.uncertainty_s),
      end.turned.degrees());
}

std::string contacts_csv(const MotionQuestion& question, const motion::RecordedContact& between) {
  std::string text =
      "entry_s,entry_kind,entry_uncertainty_s,entry_turned_deg,exit_s,exit_kind,exit_uncertainty_s,"
      "exit_turned_deg,is_certain";
  for (const char* end : {"entry", "exit"})
    text += fmt::format(",{0}_x_mm,{0}_y_mm,{0}_z_mm,{0}_fixed_part,{0}_mobile_part", end);
  text += "\n";
  for (const motion::ContactInterval& contact : between.contacts)
    text += fmt::format("{},{},{}{}{}\n", end_fields(contact.entry, ContactEndRole::entry),
                        end_fields(contact.exit, ContactEndRole::exit), contact.is_certain ? 1 : 0,
                        meeting_fields(question, contact.entry), meeting_fields(question, contact.exit));
  return text;
}

void write_maps(OutputFolder& out, const MotionQuestion& question, const MotionAnswer& answer,
                VtpEncoding encoding) {
  const ContactSurfaces& surfaces = question.surfaces;
  const AnswerFrame frame_of_answer = question.provenance ? question.provenance->frame : AnswerFrame{};
  const VtpOptions options{encoding, io::provenance_fields(question.provenance)};
  const bool fixed_casts = question.contact.casting == contact::Casting::fixed;
  const Body& casting = fixed_casts ? surfaces.fixed : surfaces.mobile;
  const std::vector<MeshArray> of_target = io::part_map(fixed_casts ? surfaces.mobile : surfaces.fixed);
  std::vector<SeriesFile> series;
  if (!fixed_casts)
    write_vtp(out.file("map_fixed.vtp"), frame_of_answer.fixed_mesh(surfaces.fixed.mesh), {}, of_target,
              options);
  for (std::size_t i = 0; i < answer.frames.size(); ++i) {
    if (!answer.frames[i]) continue;
    const motion::FrameContact& frame = *answer.frames[i];
    const auto arrays = io::pressure_map(frame.surface, casting, question.with_pressure);
    const double time = question.motion.times.values[i];
    const std::string mobile = fmt::format("map_mobile_{:05}.vtp", i);
    const std::string fixed = fixed_casts ? fmt::format("map_fixed_{:05}.vtp", i) : "map_fixed.vtp";
    write_vtp(out.file(mobile), frame_of_answer.fixed_mesh(posed(frame.X_FM, surfaces.mobile.mesh)), {},
              fixed_casts ? of_target : arrays, options);
    if (fixed_casts)
      write_vtp(out.file(fixed), frame_of_answer.fixed_mesh(surfaces.fixed.mesh), {}, arrays, options);
    const std::vector<Ligament>& ligaments = question.joint.joint.ligaments;
    if (!ligaments.empty()) {
      LigamentMesh drawn = ligament_mesh(ligaments, frame.X_FM);
      const std::string name = fmt::format("map_ligaments_{:05}.vtp", i);
      write_vtp(out.file(name), frame_of_answer.fixed_mesh(drawn.mesh), {}, drawn.arrays, options);
      series.push_back({time, "ligaments", name});
    }
    series.push_back({time, "fixed", fixed});
    series.push_back({time, "mobile", mobile});
  }
  write_pvd(out.file("motion.pvd"), series);
}

}  // namespace

void check_motion_folder(const std::filesystem::path& folder, const Provenance* from) {
  OutputFolder{folder, is_of_motion, io::files_read(from)};
}

std::vector<std::filesystem::path> write_motion(const std::filesystem::path& folder,
                                                const MotionQuestion& question, const MotionAnswer& answer,
                                                const MotionFiles& files) {
  if ((files.cycle || files.jam) && !question.motion.times.in_seconds)
    throw UsageError("a cycle and jam.h5 need times, and this motion has frame numbers only");
  OutputFolder out(folder, is_of_motion, io::files_read(question.provenance), "motion.json");
  Curves curves = curves_of(question, answer);
  // Without comments, so that every reader of tables takes it; motion.json says where it comes from.
  write_curves_csv(out.file("curves.csv"), curves);
  if (question.motion.times.in_seconds) {
    curves.axis = "time";
    write_sto(out.file("curves.sto"), question.joint.joint.name, curves, AngleUnit::degrees);
    if (files.cycle)
      write_curves_csv(out.file("cycle.csv"), cycle_of(curves, files.cycle->start_s, files.cycle->end_s));
  }
  if (!question.contact.regions.empty())
    write_curves_csv(out.file("regions.csv"), region_curves_of(question, answer));
  if (!answer.ligaments.empty()) {
    write_curves_csv(out.file("ligaments.csv"), ligament_curves_of(question, answer, LigamentNames::ours));
    if (question.motion.times.in_seconds)
      write_sto(out.file("ligaments.sto"), question.joint.joint.name,
                ligament_curves_of(question, answer, LigamentNames::of_opensim), AngleUnit::radians);
  }
  if (answer.between) io::write_whole_file(out.file("contacts.csv"), contacts_csv(question, *answer.between));
  if (files.maps) write_maps(out, question, answer, files.encoding);
  if (files.jam) {
    const JamContact contact = io::jam_contact(question, answer);
    write_jam_file(out.file("jam.h5"), question.motion.times.values, {&contact, 1},
                   io::jam_coordinates(question, answer));
  }
  io::write_whole_file(out.file("motion.json"), io::motion_json(question, answer));
  return out.commit();
}

}  // namespace condyle::io
