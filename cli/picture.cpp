#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "choice.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/io/picture.hpp"
#include "condyle/io/pose_text.hpp"
#include "io/file/output_file.hpp"
#include "joint_command.hpp"

namespace condyle::cli {
namespace {

struct PictureArguments : JointArguments {
  std::string pose;
  std::string view = "anterior", size = "1200x900";
  std::optional<std::string> about;
  std::optional<BodyRole> hidden, transparent;
  io::PictureOptions picture;
  bool measures = false;
};

/// Two whole numbers with an x between them.
void read_size(const std::string& text, io::PictureOptions& picture) {
  const std::size_t x = text.find('x');
  unsigned width = 0, height = 0;
  if (text.find_first_not_of("0123456789x") != text.npos || x == text.npos ||
      !CLI::detail::lexical_cast(text.substr(0, x), width) ||
      !CLI::detail::lexical_cast(text.substr(x + 1), height))
    throw UsageError("--size: '" + text + "' is not such as 1200x900");
  picture.width = width, picture.height = height;
}

/// A height in mm, or all.
void read_field(const std::string& text, io::PictureOptions& picture) {
  double mm = std::numeric_limits<double>::infinity();
  if (text != "all" && !CLI::detail::lexical_cast(text, mm))
    throw UsageError("--field: '" + text + "' is neither mm nor all");
  picture.field_mm = mm;
}

io::BodyStyle style_of(BodyRole body, const PictureArguments& options) {
  return options.hidden == body        ? io::BodyStyle::hidden
         : options.transparent == body ? io::BodyStyle::transparent
                                       : io::BodyStyle::solid;
}

/// Notes the parts that were not found and are missing from the picture.
std::vector<io::PictureMark> marks_of(const Joint& joint, const Pose& X_FM) {
  const measure::HipMeasures measures = measure::measure_hip(joint);
  if (!measures.femur.neck) note("no axis of a neck is drawn: " + measures.femur.neck_shaft.why_none);
  if (!measures.acetabulum.plane)
    note("no plane of a rim is drawn: " + measures.acetabulum.inclination.why_none);
  return io::measure_marks(measures, X_FM);
}

void picture_command(const PictureArguments& options, const CLI::App& command) {
  const io::InputRecorder read;
  const io::LoadedJoint loaded = joint_of(options);
  const Joint& joint = loaded.joint;
  const io::PoseArgument given = io::given_pose(options.pose, joint);
  for (const std::string& remark : given.notes) note("pose: " + remark);
  io::PictureOptions picture = options.picture;
  if (options.about) picture.about = io::arcs_about(*options.about, joint.anatomy);
  read_size(options.size, picture);
  picture.view = io::view_named(options.view, joint.side);
  picture.fixed = style_of(BodyRole::fixed, options);
  picture.mobile = style_of(BodyRole::mobile, options);
  noted(loaded, options.strictness);
  io::Provenance from = provenance_of(options, loaded, command);
  io::check_output_file(options.out, from.read, {"a picture", {".png"}});
  if (options.measures) picture.marks = answered(options, [&] { return marks_of(joint, given.X_FM); });
  const io::Picture drawn =
      answered(options, [&] { return io::draw_joint(joint, given.pose.angles(), given.X_FM, picture); });
  io::add_other_files(from, read);
  io::write_png(options.out, drawn, &from);
  say_written({options.out});
  print(drawn.caption + '\n');
}

void add_body(CLI::App& command, const char* name, std::optional<BodyRole>& body, const char* what) {
  add_choice(command, name, body, {{"fixed", BodyRole::fixed}, {"mobile", BodyRole::mobile}}, what);
}

}  // namespace

void add_picture(CLI::App& app) {
  auto* command = app.add_subcommand("picture", "Draw the joint in one pose, without a display");
  command->footer(
      "Example: condyle sample hip --out sample\n"
      "         condyle picture sample/hip.toml --pose \"flexion=110 internal_rotation=35\" --view "
      "anterior-superior --hide fixed --out deep.png");
  auto options = std::make_shared<PictureArguments>();
  add_joint(*command, *options);
  add_value(*command, "--pose", options->pose, "POSE (all 0)",
            "Draw this pose: angles in degrees, and x, y, z of a free joint in mm, such as "
            "\"flexion=110\"; or 16 numbers, the matrix X_FM row by row");
  add_value(*command, "--view", options->view,
            "anterior|posterior|left|right|superior|inferior|medial|lateral (anterior)",
            "View from this side; several with hyphens give a view from between them");
  add_choice(
      *command, "--colour", options->picture.colour,
      {{"depth", io::PictureColour::depth},
       {"gap", io::PictureColour::gap},
       {"nearest", io::PictureColour::nearest},
       {"none", io::PictureColour::none}},
      "Colour by depth in the other bone, as condyle depth computes it; by the gap along rays from the "
      "centre; by the distance to the nearest point; or not",
      "depth");
  add_value(*command, "--about", options->about, "ANGLE|AXIS [POINT]",
            "Colour by the depth along arcs about this angle's axis, or about an axis, as condyle depth "
            "takes it");
  add_value(*command, "--range", options->picture.range_mm, "MM",
            "Colours end at this distance or depth. Default: 8 mm, and for depths enough for all");
  command
      ->add_option_function<std::string>(
          "--field", [options](const std::string& text) { read_field(text, options->picture); },
          "Show this height about the joint centre, or all of both bodies. Default: the contact and "
          "its surroundings, else the joint; without a head all")
      ->option_text("MM|all");
  command->add_flag("--measures", options->measures,
                    "Draw the marks of condyle measure: axis of the neck, points and plane of the rim, where "
                    "the head's contour ends");
  add_flag(
      *command, "--plain", options->picture.is_annotated, false,
      "Leave out the scale bar, the letters of the sides, the line of the pose and the key of --measures");
  add_body(*command, "--hide", options->hidden, "Do not draw this body");
  add_body(*command, "--transparent", options->transparent,
           "Draw this body as glass. If depths are shown without this and --hide, the outer one is");
  add_value(*command, "--size", options->size, "WIDTHxHEIGHT (1200x900)",
            "Width and height in pixels, 64 to 8192 each");
  add_value(*command, "--out", options->out, "FILE", "Write the picture to this file, .png")->required();
  add_strict(*command, options->strictness);
  group_help(*command, {{"Most used", {"--pose", "--view", "--colour", "--hide", "--out"}},
                        {"Output",
                         {"--set", "--about", "--transparent", "--measures", "--range", "--field", "--plain",
                          "--size", "--strict", "--help"}}});
  command->callback([options, command] { picture_command(*options, *command); });
}

}  // namespace condyle::cli
