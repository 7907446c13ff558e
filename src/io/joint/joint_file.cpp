#include "condyle/io/joint_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "condyle/error.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/joint_checks.hpp"
#include "core/one_line.hpp"
#include "io/file/format_version.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/whole_file.hpp"
#include "io/joint/contact_table.hpp"
#include "io/joint/implant_table.hpp"
#include "io/joint/ligament_tables.hpp"
#include "io/joint/load_joint.hpp"
#include "io/joint/mesh_path.hpp"
#include "io/joint/other_file.hpp"
#include "io/joint/part_tables.hpp"
#include "io/joint/pose_matrix.hpp"
#include "io/joint/recorded_motion_table.hpp"
#include "io/joint/toml_nesting.hpp"
#include "io/joint/toml_table.hpp"
#include "io/result/repair_text.hpp"

namespace condyle::io {
namespace {

using io::TomlTable;

/// TOML knows no line that ends with a carriage return alone, as some editors write.
std::string with_line_feeds(std::string_view text) {
  std::string lines(text);
  if (lines.find('\n') == lines.npos) std::replace(lines.begin(), lines.end(), '\r', '\n');
  return lines;
}

toml::table parsed(std::string_view text, const std::filesystem::path& path) {
  const auto error_at = [&](std::size_t line, const std::string& what) {
    const std::string other = io::other_file(text, path);
    return FileError(
        fmt::format("{}: {}", path.string(), other.empty() ? fmt::format("line {}: {}", line, what) : other));
  };
  if (const auto line = io::line_nested_too_deep(text))
    throw error_at(
        *line, fmt::format("keys, lists and tables may be nested {} deep, not deeper", io::most_toml_levels));
  try {
    return toml::parse(with_line_feeds(text), path.string());
  } catch (const toml::parse_error& error) {
    throw error_at(error.source().begin.line,
                   fmt::format("not TOML: {}", core::one_line(error.description(), 300)));
  }
}

/// Points of the file in mm.
class Lengths {
 public:
  explicit Lengths(LengthUnit unit) : scale_(mm_per(unit)) {}

  Vec3 required_point(TomlTable& table, std::string_view key) const {
    return scale_ * table.required(key, table.triple(key));
  }
  Vec3 in_mm(const Vec3& lengths) const { return scale_ * lengths; }
  double positive(TomlTable& table, std::string_view key) const {
    const double value = table.required(key, table.number(key));
    if (!(value > 0)) table.fail(key, "must be above 0");
    return scale_ * value;
  }
  Vec3 optional_components(TomlTable& table) const {
    return scale_ *
           Vec3(table.number("x").value_or(0), table.number("y").value_or(0), table.number("z").value_or(0));
  }
  double not_negative(TomlTable& table, std::string_view key) const {
    const double value = table.required(key, table.number(key));
    if (value < 0) table.fail(key, "must be 0 or more");
    return scale_ * value;
  }

 private:
  double scale_;
};

/// X_WB of a body: a matrix row by row, or a translation and the joint's angles, about the axes of W.
Pose body_pose(TomlTable& body, std::string_view key, CoordinateSystem system, const Lengths& lengths,
               std::vector<std::string>& notes) {
  if (body.is_list("pose")) {
    try {
      auto [X, skew] = io::pose_of_rows(*body.sixteen("pose"));
      if (skew > 0)
        notes.push_back(
            fmt::format("{}.pose: its rotation was off by {:.2g}; the nearest one is used", key, skew));
      X.translation() = lengths.in_mm(X.translation());
      return X;
    } catch (const UsageError& error) {
      body.fail("pose", error.what());
    }
  }
  std::optional<TomlTable> given = body.table("pose");
  if (!given) return Pose::Identity();
  TomlTable& table = *given;
  const auto angle = [&](JointAngle name) {
    return Angle::degrees(table.number(name_of(name, system.anatomy)).value_or(0));
  };
  Pose X = pose_at(system, JointAngles{angle(JointAngle::flexion), angle(JointAngle::adduction),
                                       angle(JointAngle::internal_rotation)});
  X.translation() = lengths.in_mm(table.triple("translation").value_or(Vec3::Zero()));
  table.finish();
  return X;
}

MeshEntry mesh_entry(TomlTable& table) {
  MeshEntry entry{{}, io::mesh_path(table, "mesh", table.required("mesh", table.text("mesh"))), {}};
  if (table.has("polygons"))
    entry.polygons = static_cast<PolygonRule>(table.required_word("polygons", {"refuse", "split", "guess"}));
  if (table.has("pieces"))
    entry.pieces =
        std::array{PieceRule::all, PieceRule::largest,
                   PieceRule::at_joint}[table.required_word("pieces", {"all", "largest", "at_joint"})];
  if (const auto scale = table.triple("scale")) {
    if (scale->cwiseAbs().minCoeff() == 0) table.fail("scale", "must have no 0 in it");
    entry.scale = *scale;
  }
  for (const std::string& word : table.texts("repair").value_or(std::vector<std::string>{})) {
    try {
      entry.repairs.push_back(repair_named(word));
    } catch (const UsageError& error) {
      table.fail("repair", error.what());
    }
  }
  return entry;
}

/// Where one mesh of several lies in the body's frame.
Pose mesh_pose(TomlTable& mesh, std::vector<std::string>& notes) {
  const auto rows = mesh.sixteen("pose");
  if (!rows) return Pose::Identity();
  try {
    auto [X, skew] = io::pose_of_rows(*rows);
    if (skew > 0)
      notes.push_back(fmt::format("{}: its rotation was off by {:.2g}; the nearest one is used",
                                  mesh.full("pose"), skew));
    return X;
  } catch (const UsageError& error) {
    mesh.fail("pose", error.what());
  }
}

/// Meaning of contact with one of several meshes. Files older than version 1 mark a bearing mesh by bearing = true.
PartContact part_contact(TomlTable& mesh) {
  const bool is_bearing = mesh.flag("bearing").value_or(false);
  if (!mesh.has("contact")) return is_bearing ? PartContact::bearing : PartContact::ends;
  if (mesh.has("bearing")) mesh.fail("bearing", "says what contact says: one of the two");
  constexpr std::array words{PartContact::ends, PartContact::bearing, PartContact::soft};
  return words[mesh.required_word("contact", {"ends", "bearing", "soft"})];
}

std::vector<MeshEntry> mesh_entries(TomlTable& body, std::string_view key, std::vector<std::string>& notes) {
  if (!body.has("meshes")) return {mesh_entry(body)};
  for (const auto of_one : {"mesh", "repair", "scale", "polygons", "pieces"})
    if (body.has(of_one)) body.fail(of_one, "with meshes each of them has its own");
  std::vector<MeshEntry> entries;
  std::set<std::string> names;
  for (TomlTable& table : body.tables("meshes")) {
    MeshEntry entry = mesh_entry(table);
    entry.X_BG = mesh_pose(table, notes);
    entry.part = table.required("name", table.text("name"));
    if (entry.part.empty()) table.fail("name", "must not be empty");
    entry.contact = part_contact(table);
    if (!names.insert(entry.part).second)
      table.fail("name", fmt::format("\"{}\" is given twice", entry.part));
    table.finish();
    entries.push_back(std::move(entry));
  }
  if (entries.empty()) body.fail("meshes", "must name one mesh or more");
  const auto may_end = [&](const MeshEntry& entry) {
    return entry.contact == PartContact::ends || (key == "fixed" && entry.contact == PartContact::bearing);
  };
  if (std::none_of(entries.begin(), entries.end(), may_end))
    body.fail("meshes", key == "fixed" ? "all of them are soft: nothing would be left to end a motion"
                                       : "none of them ends a motion: one needs contact = \"ends\"");
  return entries;
}

/// [fixed.image]: the edges of a voxel, the planes of the faces that close the bone where its image ends, and notes on its making.
std::optional<BodyImage> body_image(TomlTable& body, const Lengths& lengths) {
  std::optional<TomlTable> table = body.table("image");
  if (!table) return std::nullopt;
  BodyImage image;
  constexpr std::string_view edges[] = {"voxel_i", "voxel_j", "voxel_k"};
  for (int i = 0; i < 3; ++i) image.voxel.col(i) = lengths.required_point(*table, edges[i]);
  if (image.voxel.determinant() == 0) table->fail("voxel_k", "the edges of a voxel lie in one plane");
  for (TomlTable& cut : table->tables("cut")) {
    const Vec3 normal = cut.required("normal", cut.triple("normal"));
    if (!(std::abs(normal.norm() - 1) <= axis_tolerance)) cut.fail("normal", "must be a unit vector");
    const double offset = cut.required("offset", cut.number("offset"));
    image.cuts.push_back({normal.normalized(), lengths.in_mm({offset, 0, 0}).x()});
    cut.finish();
  }
  for (TomlTable& note : table->tables("note")) {
    const std::string word = note.required("code", note.text("code"));
    const auto code = image_note_code(word);
    if (!code) note.fail("code", "is none of an image's notes: " + in_quotes(word));
    image.notes.push_back({*code, core::one_line(note.required("text", note.text("text")), 1000)});
    note.finish();
  }
  table->finish();
  return image;
}

/// [mobile.head] and [fixed.socket], if they are known.
void read_known_sphere(TomlTable& body, std::string_view key, const Lengths& lengths, BodyEntry& entry) {
  const bool is_mobile = key == "mobile";
  if (body.table(is_mobile ? "socket" : "head"))
    body.fail(is_mobile ? "socket" : "head", is_mobile ? "is of the fixed body: what the head turns in"
                                                       : "is of the mobile body: the head that turns");
  std::optional<TomlTable> table = body.table(is_mobile ? "head" : "socket");
  if (!table) return;
  entry.head = {lengths.required_point(*table, "centre"), lengths.positive(*table, "radius")};
  if (is_mobile && table->has("margin")) entry.bearing_margin_mm = lengths.not_negative(*table, "margin");
  table->finish();
}

/// A body's table is read in two parts: its pose needs what is known of the joint.
BodyEntry body_entry(TomlTable& table, std::string_view key, const Lengths& lengths,
                     std::vector<std::string>& notes) {
  BodyEntry entry{table.text("name").value_or(std::string(key)), mesh_entries(table, key, notes),
                  body_image(table, lengths)};
  read_known_sphere(table, key, lengths, entry);
  if (entry.image)
    for (const MeshEntry& mesh : entry.meshes)
      if (mesh.is_moved()) table.fail("image", "stands beside a mesh with a scale or a pose of its own");
  return entry;
}

/// The mesh behind a layer is in the frame of its body: it has no scale or pose of its own with which to follow the layer's mesh.
void refuse_moved_layer(const TomlTable& contact, std::string_view key,
                        const std::optional<LayerEntry>& layer, const std::string& part,
                        const BodyEntry& body) {
  if (!layer || !layer->behind) return;
  for (const MeshEntry& mesh : body.meshes)
    if ((part.empty() || mesh.part == part) && mesh.is_moved())
      contact.fail(key,
                   "behind: the layer's mesh has a scale or a pose of its own; give thickness or "
                   "thickness_file instead");
}

/// Nor does it move with a part.
void refuse_layer_of_part(const TomlTable& contact, std::string_view key,
                          const std::optional<LayerEntry>& layer, const std::string& mesh, BodyRole body,
                          const std::vector<DescribedPart>& parts) {
  if (!layer || !layer->behind) return;
  for (const auto& [part, centre] : parts)
    if (part.body == body && (mesh.empty() || part.meshes.empty() ||
                              std::find(part.meshes.begin(), part.meshes.end(), mesh) != part.meshes.end()))
      contact.fail(key, fmt::format("behind: part {} moves the layer's mesh and not what lies behind it; "
                                    "give thickness or thickness_file instead",
                                    part.name));
}

/// Faces in which a part was cut carry no load.
void refuse_cut_contact(const TomlTable& contact, std::string_view key, const std::string& mesh,
                        BodyRole body, const std::vector<DescribedPart>& parts) {
  for (const auto& [part, centre] : parts)
    if (part.body == body && !part.cut.empty() &&
        (mesh.empty() || mesh == part.name || (!part.meshes.empty() && mesh == part.meshes.front())))
      contact.fail(key,
                   fmt::format("part {} is cut from that mesh: name one that is not cut, such as a cartilage",
                               part.name));
}

CentreFit centre_fit(TomlTable& frame, const Lengths& lengths) {
  CentreFit fit;
  if (frame.has("fit_body"))
    fit.body = frame.required_word("fit_body", {"fixed", "mobile"}) == 0 ? BodyRole::fixed : BodyRole::mobile;
  if (auto within = frame.table("fit_within")) {
    fit.within = Sphere{lengths.required_point(*within, "centre"), lengths.positive(*within, "radius")};
    within->finish();
  }
  return fit;
}

/// The landmarks present decide which frame is meant; every set is refused unless it is complete and nothing
/// else is there.
void read_landmarks(TomlTable& landmarks, const Lengths& lengths, FrameDescription& frame) {
  const auto point = [&](std::string_view key) { return lengths.required_point(landmarks, key); };
  const bool of_pelvis = landmarks.has("right_asis") || landmarks.has("left_asis");
  const bool of_femur = landmarks.has("medial_epicondyle") || landmarks.has("lateral_epicondyle");
  if (of_femur) {
    const FemurLandmarks femur{point("medial_epicondyle"), point("lateral_epicondyle")};
    if (of_pelvis)
      frame.mobile_axes = femur;
    else if (landmarks.has("hip_centre"))
      frame.axes =
          TransepicondylarAxis{femur.medial_epicondyle, femur.lateral_epicondyle, point("hip_centre")};
    else
      frame.axes = femur;
  }
  if (of_pelvis || !of_femur) {
    // One side's spines do not fix where the midline is: both sides are required by name.
    const Vec3 right = point("right_asis"), left = point("left_asis");
    if (landmarks.has("pubic_symphysis"))
      frame.axes = AnteriorPelvicPlane{right, left, point("pubic_symphysis")};
    else
      frame.axes = PelvisLandmarks{right, left, point("right_psis"), point("left_psis")};
  }
  landmarks.finish();
}

void read_axes(TomlTable& table, const Lengths& lengths, FrameDescription& frame) {
  if (auto landmarks = table.table("landmarks")) {
    for (const auto key : {"axes", "anterior", "superior"})
      if (table.has(key)) table.fail(key, "frame.landmarks gives the axes already: leave one of the two out");
    read_landmarks(*landmarks, lengths, frame);
    return;
  }
  if (table.has("axes")) {
    for (const auto key : {"anterior", "superior"})
      if (table.has(key)) table.fail(key, "frame.axes gives the axes already: leave one of the two out");
    frame.axes = table.required_word("axes", {"LPS", "RAS"}) == 0 ? lps_axes : ras_axes;
    return;
  }
  const auto anterior = table.triple("anterior"), superior = table.triple("superior");
  frame.axes = FrameDirections{table.required("anterior", anterior), table.required("superior", superior)};
}

void read_centre(TomlTable& table, const Lengths& lengths, FrameDescription& frame) {
  if (std::holds_alternative<TransepicondylarAxis>(frame.axes)) {
    if (table.has("centre"))
      table.fail("centre", "with hip_centre the epicondyles give the centre: leave it out");
    return;
  }
  const auto* text = "must be [x, y, z] or \"fit\"";
  if (!table.has("centre")) table.fail_missing("centre");
  if (table.is_text("centre")) {
    if (*table.text("centre") != "fit") table.fail("centre", text);
    frame.centre = centre_fit(table, lengths);
  } else {
    for (const auto key : {"fit_body", "fit_within"})
      if (table.has(key)) table.fail(key, "only with centre = \"fit\"");
    frame.centre = lengths.required_point(table, "centre");
  }
}

FrameDescription frame_description(TomlTable& file, const Lengths& lengths) {
  TomlTable table = file.required("frame", file.table("frame"));
  FrameDescription frame;
  read_axes(table, lengths, frame);
  read_centre(table, lengths, frame);
  table.finish();
  return frame;
}

std::string hinge_text(const JointDescription& joint) {
  return fmt::format("a hinge rotates in {} only", name_of(JointAngle::flexion, joint.anatomy));
}

/// The file's entry, else the anatomy of its frame.
Anatomy anatomy_of(TomlTable& file, const JointDescription& joint) {
  if (!file.has("joint")) {
    if (joint.kind == JointKind::free)
      file.fail_missing("joint",
                        "a free joint needs \"hip\", \"knee\", \"ankle\", \"elbow\" or \"shoulder\", which "
                        "name its angles");
    const bool of_knee = std::holds_alternative<TransepicondylarAxis>(joint.frame.axes);
    return joint.kind == JointKind::hinge && of_knee ? Anatomy::knee : Anatomy::hip;
  }
  const Anatomy anatomy =
      all_anatomies[file.required_word("joint", {"hip", "knee", "ankle", "elbow", "shoulder"})];
  if (joint.kind == JointKind::hinge && (anatomy == Anatomy::hip || anatomy == Anatomy::shoulder))
    file.fail("joint", fmt::format("a {} is no hinge; left out, a hinge flexes forwards", name_of(anatomy)));
  return anatomy;
}

TranslationFrame translation_frame_of(TomlTable& file, const JointDescription& joint) {
  if (!file.has("translation_frame")) return TranslationFrame::fixed;
  if (joint.kind != JointKind::free)
    file.fail("translation_frame", fmt::format("a {} does not translate", name_of(joint.kind)));
  if (file.required_word("translation_frame", {"fixed", "joint_axes"}) == 0) return TranslationFrame::fixed;
  if (joint.anatomy == Anatomy::shoulder)
    file.fail("translation_frame", "a shoulder has two of its axes along one line: use \"fixed\"");
  return TranslationFrame::joint_axes;
}

/// A table that is there states the pose, zero or not; one that has a word takes its angles from elsewhere.
ZeroFrom zero_from(TomlTable& pose, const JointDescription& joint) {
  if (!pose.has("from")) return ZeroFrom::stated;
  pose.required_word("from", {"anatomy"});
  if (joint.anatomy != Anatomy::hip || joint.kind == JointKind::hinge)
    pose.fail("from", "anatomy gives the reference pose of a hip only");
  if (joint.frame.mobile_axes)
    pose.fail("from", "the landmarks of both bodies give the reference pose already: leave it out");
  for (const JointAngle angle : all_joint_angles)
    if (const std::string_view name = name_of(angle, joint.anatomy); pose.has(name))
      pose.fail(name, "the angles follow from the anatomy: leave them out");
  return ZeroFrom::anatomy;
}

PoseDegrees reference_pose(TomlTable& file, JointDescription& joint, const Lengths& lengths) {
  auto table = file.table("reference_pose");
  if (!table) return {};
  joint.zero_from = zero_from(*table, joint);
  const auto degrees = [&](JointAngle name) {
    return table->number(name_of(name, joint.anatomy)).value_or(0);
  };
  PoseDegrees pose{degrees(JointAngle::flexion), degrees(JointAngle::adduction),
                   degrees(JointAngle::internal_rotation)};
  if (joint.kind == JointKind::hinge)
    for (const JointAngle name : {JointAngle::adduction, JointAngle::internal_rotation})
      if (pose[name] != 0) table->fail(name_of(name, joint.anatomy), hinge_text(joint));
  if (joint.kind == JointKind::free) {
    pose.translation_mm = lengths.optional_components(*table);
  } else {
    for (const auto key : {"x", "y", "z"})
      if (table->has(key)) table->fail(key, fmt::format("a {} does not translate", name_of(joint.kind)));
  }
  table->finish();
  return pose;
}

/// Names of the table of the reference pose elsewhere, farther from its own than a slip of the pen.
void refuse_other_names(const TomlTable& file) {
  for (const auto key : {"reference", "rest", "rest_pose"})
    if (file.has(key)) file.fail(key, "unknown key (did you mean \"reference_pose\"?)");
}

void read_uncertainty(TomlTable& file, const Lengths& lengths, JointFile& out) {
  motion::Uncertainty& sigma = out.uncertainty;
  auto table = file.table("uncertainty");
  if (!table) return;
  if (table->has("centre")) sigma.centre_mm = lengths.not_negative(*table, "centre");
  if (table->is_text("surface")) {
    sigma.surface_from = *table->text("surface");
    const auto origins = motion::surface_origins();
    const auto known = std::find_if(origins.begin(), origins.end(),
                                    [&](const auto& origin) { return origin.name == sigma.surface_from; });
    if (known == origins.end()) {
      std::string names;
      for (const auto& origin : origins) names += (names.empty() ? "" : ", ") + std::string(origin.name);
      table->fail("surface", fmt::format("a number, or where surfaces come from: {}", names));
    }
    sigma.surface_mm = known->sd_mm;
  } else if (table->has("surface")) {
    sigma.surface_mm = lengths.not_negative(*table, "surface");
    sigma.surface_voxels = 0;
  }
  if (const auto axes = table->number("axes")) {
    if (*axes < 0) table->fail("axes", "must be 0 or more");
    sigma.axes = Angle::degrees(*axes);
  }
  if (const auto seed = table->integer("seed")) {
    if (*seed < 0) table->fail("seed", "must be 0 or more");
    out.band_seed = static_cast<std::uint64_t>(*seed);
  }
  table->finish();
}

/// One [[motion]]: the range runs from where the varied angle starts to where it ends at the latest, and says
/// by its order which way it goes.
motion::Motion own_motion(TomlTable& table, const JointDescription& joint) {
  motion::Motion motion;
  motion.name = table.required("name", table.text("name"));
  if (motion.name.empty()) table.fail("name", "must not be empty");
  const auto vary = table.required("vary", table.text("vary"));
  try {
    motion.vary = joint_angle_named(vary, joint.anatomy);
  } catch (const UsageError& error) {
    table.fail("vary", error.what());
  }
  if (table.has(vary)) table.fail(vary, "is the angle that varies: its range says where it starts");
  const auto [start, end] = table.required("range", table.pair("range"));
  if (start == end) table.fail("range", "is empty");
  motion.sense = start < end ? RotationSense::positive : RotationSense::negative;
  motion.range = Angle::degrees(std::abs(end - start));
  for (const JointAngle angle : all_joint_angles) {
    const bool varies = angle == motion.vary;
    const std::string_view name = name_of(angle, joint.anatomy);
    const double held = varies ? start : table.number(name).value_or(0);
    if (joint.kind == JointKind::hinge && angle != JointAngle::flexion && (varies || held != 0))
      table.fail(varies ? "vary" : name, hinge_text(joint));
    motion.start = motion::turned_by(motion.start, angle, Angle::degrees(held));
  }
  table.finish();
  try {
    motion::check_motion(motion, joint.kind);
  } catch (const UsageError& error) {
    table.fail("range", error.what());
  }
  return motion;
}

std::vector<motion::Motion> own_motions(TomlTable& file, const JointDescription& joint) {
  std::vector<motion::Motion> motions;
  std::set<std::string> names;
  for (TomlTable& table : file.tables("motion")) {
    motion::Motion motion = own_motion(table, joint);
    if (!names.insert(motion.name).second)
      table.fail("name", fmt::format("\"{}\" is given twice", motion.name));
    motions.push_back(std::move(motion));
  }
  return motions;
}

Person person_of(TomlTable& file) {
  auto table = file.table("person");
  if (!table) return {};
  Person person{.age_years = table->number("age")};
  if (person.age_years && !is_age(*person.age_years)) table->fail("age", "must be 0 to 120 years");
  if (const auto sex = table->word("sex", {"female", "male"})) person.sex = all_sexes[*sex];
  person.species = table->text("species").value_or("");
  table->finish();
  return person;
}

plan::Implant implant_of_joint(TomlTable& table, const JointDescription& joint) {
  plan::Implant implant = io::implant_entry(table, mm_per(joint.units));
  const Anatomy anatomy = std::holds_alternative<plan::TotalHip>(implant) ? Anatomy::hip : Anatomy::shoulder;
  if (joint.kind != JointKind::ball || joint.anatomy != anatomy)
    table.fail("kind", fmt::format("a {} is of a ball that is a {}", name_of(implant), name_of(anatomy)));
  return implant;
}

}  // namespace

JointFile joint_file_of(std::string_view text, const std::filesystem::path& path) {
  const toml::table root = parsed(text, path);
  TomlTable file(path, root, "");
  // The version comes first: what follows may be spelt otherwise in another one.
  if (const auto version = file.required("condyle", file.integer("condyle")); version != io::format_version)
    file.fail("condyle",
              fmt::format("format version {} is not known; this is version {}", version, io::format_version));
  JointFile out;
  JointDescription& joint = out.joint;
  out.path = path;
  out.digest = digest_of(text);
  joint.name = file.required("name", file.text("name"));
  joint.planned = file.text("planned").value_or("");
  constexpr JointKind kinds[] = {JointKind::ball, JointKind::hinge, JointKind::free};
  joint.kind = kinds[file.required_word("kind", {"ball", "hinge", "free"})];
  joint.side = file.required_word("side", {"right", "left"}) == 0 ? Side::right : Side::left;
  joint.units = all_length_units[file.required_word("units", {"mm", "cm", "in", "m"})];
  TomlTable fixed = file.required("fixed", file.table("fixed"));
  TomlTable mobile = file.required("mobile", file.table("mobile"));
  out.fixed = body_entry(fixed, "fixed", Lengths(joint.units), out.processing);
  out.mobile = body_entry(mobile, "mobile", Lengths(joint.units), out.processing);
  for (BodyEntry* body : {&out.fixed, &out.mobile})
    for (MeshEntry& entry : body->meshes) entry.mesh = path.parent_path() / entry.mesh;
  joint.frame = frame_description(file, Lengths(joint.units));
  joint.anatomy = anatomy_of(file, joint);
  joint.translation_frame = translation_frame_of(file, joint);
  joint.fixed_in_W = body_pose(fixed, "fixed", joint.coordinates(), Lengths(joint.units), out.processing);
  joint.mobile_in_W = body_pose(mobile, "mobile", joint.coordinates(), Lengths(joint.units), out.processing);
  fixed.finish();
  mobile.finish();
  joint.parts = io::described_parts(file, joint.side, mm_per(joint.units));
  out.reference_pose = reference_pose(file, joint, Lengths(joint.units));
  joint.reference_pose = out.reference_pose.coordinates();
  joint.ligaments = io::described_ligaments(file, joint, mm_per(joint.units));
  out.motions = own_motions(file, joint);
  joint.person = person_of(file);
  read_uncertainty(file, Lengths(joint.units), out);
  if (auto table = file.table("contact")) {
    out.contact = io::contact_entry(*table, mm_per(joint.units), path.parent_path());
    refuse_moved_layer(*table, "fixed", out.contact->fixed, out.contact->fixed_part, out.fixed);
    refuse_moved_layer(*table, "mobile", out.contact->mobile, out.contact->mobile_part, out.mobile);
    refuse_layer_of_part(*table, "fixed", out.contact->fixed, out.contact->fixed_part, BodyRole::fixed,
                         joint.parts);
    refuse_layer_of_part(*table, "mobile", out.contact->mobile, out.contact->mobile_part, BodyRole::mobile,
                         joint.parts);
    refuse_cut_contact(*table, "fixed_part", out.contact->fixed_part, BodyRole::fixed, joint.parts);
    refuse_cut_contact(*table, "mobile_part", out.contact->mobile_part, BodyRole::mobile, joint.parts);
  }
  if (auto table = file.table("recorded_motion")) {
    if (auto zero = table->table("zero"))
      out.recorded_zero = io::zero_of_columns(std::move(*zero), mm_per(joint.units));
    out.recorded_motion = io::recorded_motion_mapping(
        *table, io::coordinate_names_of(joint.kind, joint.anatomy), path.parent_path());
    if (out.recorded_zero && !std::holds_alternative<std::vector<ColumnOfCoordinate>>(*out.recorded_motion))
      table->fail("zero", "is of columns of coordinates: poses have none");
  }
  if (auto table = file.table("implant")) out.implant = implant_of_joint(*table, joint);
  refuse_other_names(file);
  file.finish();
  return out;
}

JointFile read_joint_file(const std::filesystem::path& path) {
  return io::joint_file_of(io::read_whole_file(path), path);
}

std::vector<std::filesystem::path> files_of(const JointFile& file) {
  std::vector<std::filesystem::path> files = {file.path};
  for (const BodyEntry* body : {&file.fixed, &file.mobile})
    for (const MeshEntry& entry : body->meshes) files.push_back(entry.mesh);
  if (file.recorded_motion)
    if (const auto* poses = std::get_if<PosesOfModel>(&*file.recorded_motion)) files.push_back(poses->model);
  if (!file.contact) return files;
  for (const auto* layer : {&file.contact->fixed, &file.contact->mobile})
    if (*layer)
      for (const auto* path : {&(*layer)->behind, &(*layer)->thickness_file})
        if (*path) files.push_back(**path);
  return files;
}

}  // namespace condyle::io
