#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/io/provenance.hpp"
#include "condyle/joint.hpp"

/// Pictures of a joint in one pose, drawn without a display: docs/figures.md.

namespace condyle {
struct TouchAnswer;
}  // namespace condyle

namespace condyle::measure {
struct HipMeasures;
}  // namespace condyle::measure

namespace condyle::io {

/// Quantity that colours the surfaces, mm.
enum class PictureColour {
  none,
  depth,  ///< of each body's part inside the other the depth to read; hatched where only the nearest distance is known
  gap,      ///< along rays from the joint centre, negative inside
  nearest,  ///< to the nearest point of the other surface, negative inside
};

enum class BodyStyle { solid, transparent, hidden };

/// Where the viewer is, as seen from the joint, and what points up in the picture: unit vectors in F at a right angle.
struct ViewDirection {
  Vec3 towards_viewer = Vec3::UnitX();
  Vec3 up = Vec3::UnitY();
};

/// "anterior", "posterior", "left", "right", "superior", "inferior", "medial", "lateral", or several of them with
/// hyphens for a view from between: "anterior-superior". Superior is up; where one looks along it, anterior is.
/// Throws UsageError.
[[nodiscard]] ViewDirection view_named(std::string_view name, Side side);

/// A body of one colour, in F, drawn over the others; it shines through what is before it.
struct PictureMark {
  TriMesh mesh;
  std::array<std::uint8_t, 3> rgb;  ///< red, green, blue
  std::string meaning = {};  ///< in the key under the picture, small letters and digits; empty: in none
};

/// Marks of a hip's measures. Blue: axes of neck and shaft, 12 o'clock, condylar line, the line that version is seen along, top of the
/// trochanter. Vermilion: the circle of the rim's plane, its normal and the rim's points that it was fitted to; grey: the other ones.
/// Green: where the head's contour ends at every hour around the neck. Orange: superior and the edges of the roof from the head's centre,
/// and the rim's chords. Purple: where the bones are nearest, in the poses that this is measured in. What was not found is left out.
[[nodiscard]] std::vector<PictureMark> measure_marks(const measure::HipMeasures& measures, const Pose& X_FM);

struct PictureOptions {
  ViewDirection view = {};
  PictureColour colour = PictureColour::depth;
  /// Depths are along arcs about this, whatever their rays are; UsageError with other colours.
  std::optional<contact::ArcsAbout> about = {};
  /// Where depths are shown and both are solid, the outer one is drawn as glass: they would be hidden.
  BodyStyle fixed = BodyStyle::solid, mobile = BodyStyle::solid;
  std::size_t width = 1200, height = 900;  ///< pixels, 64 to 8192
  /// End of the colours; where not given 8 mm, for depths the first of 1, 2, 5, 10 ... that holds them.
  std::optional<double> range_mm = {};
  /// Height of what is shown, about the joint centre, 0.1 mm to 100 m; infinite: both bodies fit, hidden or not. Where not given what lies
  /// inside the other body and its surroundings, by the values of the colours; without such values or contact 2.5 radii of a ball joint's
  /// head about the centre, and both bodies of other joints.
  std::optional<double> field_mm = {};
  std::vector<PictureMark> marks = {};
  bool is_annotated =
      true;  ///< with a scale bar, letters of where the sides are, the caption, and the key of the marks
};

/// Red, green, blue of each pixel, row by row from the top left.
struct Picture {
  std::size_t width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  std::string caption =
      {};  ///< the line over the bodies, drawn or not: the pose and what it is to the limits
};

/// Both bodies at a pose in parallel projection on white, smoothly shaded with the light at the viewer, 16
/// samples a pixel; under them the scale of the colours. The colours of a surface that faces the viewer are those
/// of the scale. Ligaments are thin tubes: grey while slack, green when taut, vermilion at the strain that ends motions, purple without a known length. `at` names the pose for depths along arcs, as reliable_depths() takes them if the mobile
/// body's centre is held.
///
/// Throws UsageError for options out of their domain, MeshError if a depth or a gap is requested of an open mesh. The
/// same bytes whatever the threads. Half a second to three of processor time for a picture of the usual size, by how much of it
/// is bone, and the cost of the values.
[[nodiscard]] Picture draw_joint(const Joint& joint, const JointAngles& at, const Pose& X_FM,
                                 const PictureOptions& options = {});

/// Two meshes as answer_touch() found them, in the same way: triangles that meet are vermilion, and shine through what is before them;
/// before all a blue line goes from the deepest place to its exit, or between the nearest points. Its colour and range are not used. The view of
/// view_of_touch() has the mobile body's way out upwards.
[[nodiscard]] Picture draw_touch(const Mesh& fixed, const Mesh& mobile, const TouchAnswer& answer,
                                 const PictureOptions& options = {});
[[nodiscard]] ViewDirection view_of_touch(const TouchAnswer& answer);

/// Writes PNG, with the provenance as texts; whole or not at all, in a folder that is made if it is missing. Throws
/// FileError.
void write_png(const std::filesystem::path& path, const Picture& picture, const Provenance* from = nullptr);

}  // namespace condyle::io
