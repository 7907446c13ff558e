#include "condyle/io/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "condyle/error.hpp"
#include "core/parallel.hpp"
#include "io/picture/annotations.hpp"
#include "io/picture/camera.hpp"
#include "io/picture/colour_scale.hpp"
#include "io/picture/legend.hpp"
#include "io/picture/rasteriser.hpp"
#include "io/picture/surface_values.hpp"
#include "io/picture/touch_marks.hpp"
#include "io/result/ligament_mesh.hpp"
#include "mesh/vertex_normals.hpp"

namespace condyle::io {
namespace {

/// Rows of pixels that a thread draws at a time: samples of two bodies stay within some megabytes.
constexpr std::size_t strip_pixels = 8;
constexpr double usual_range_mm = 8;

/// How strongly glass covers what is behind it: least where it faces the viewer, more towards its outline.
double cover_of_glass(double facing) noexcept {
  return 0.2 + 0.6 * (1 - facing) * (1 - facing);
}

/// How strongly a mark covers what is before it.
constexpr double cover_of_mark_behind = 0.45;

/// Light from the viewer, and a little more from above: 1 for what faces the viewer.
double brightness(double facing, double upward) noexcept {
  return std::clamp(0.4 + 0.6 * facing + 0.1 * upward, 0.0, 1.0);
}

/// A body as it is drawn.
class Surface {
 public:
  Surface(const TriMesh& posed_mesh, const SurfaceValues& values, const ColourScale& scale, Rgb bone,
          BodyStyle style, const Camera& camera, std::size_t columns, std::size_t rows)
      : normals_(mesh::area_normals(posed_mesh)),
        values_(values),
        scale_(scale),
        bone_(bone),
        style_(style),
        camera_(camera),
        mesh_(camera.laid(posed_mesh)),
        rasteriser_(mesh_, columns, rows, strip_pixels * samples) {}
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  void draw(std::size_t strip, std::span<Hit> hits) const {
    if (style_ != BodyStyle::hidden) rasteriser_.draw(strip, hits);
  }

  /// Colour at a sample, laid over the colour behind it.
  Rgb over(const Rgb& behind, Index triangle, double x, double y) const {
    const auto shares = corner_shares(mesh_, triangle, x, y);
    const Triangle& corners = mesh_.triangles[triangle];
    Vec3 normal = Vec3::Zero();
    for (std::size_t k = 0; k < 3; ++k) normal += shares[k] * normals_[corners[k]];
    const double length = normal.norm();
    if (length > 0) normal /= length;
    // An open sheet seen from behind is lit as from its front.
    if (normal.dot(camera_.towards_viewer) < 0) normal = -normal;
    const double facing = std::min(1.0, normal.dot(camera_.towards_viewer));
    const double light = brightness(facing, normal.dot(camera_.up));
    const double cover = style_ == BodyStyle::transparent ? cover_of_glass(facing) : 1;
    Rgb colour = own_colour(corners, shares, x, y);
    for (std::size_t k = 0; k < 3; ++k) colour[k] = cover * light * colour[k] + (1 - cover) * behind[k];
    return colour;
  }

 private:
  Rgb own_colour(const Triangle& corners, const std::array<double, 3>& shares, double x, double y) const {
    const auto mean = [&](const std::vector<double>& values) {
      return shares[0] * values[corners[0]] + shares[1] * values[corners[1]] + shares[2] * values[corners[2]];
    };
    if (values_.mm.empty()) return bone_;
    const double mm = mean(values_.mm);
    if (!std::isfinite(mm)) return bone_;
    if (!values_.outside.empty()) {
      if (mean(values_.outside) >= 0) return bone_;
      if (mean(values_.is_bound) > 0.5) return hatching(x / samples, y / samples);
    }
    const Rgb colour = scale_.at(mm).value_or(bone_);
    return scale_.is_beyond(mm) ? striped(colour, x / samples, y / samples) : colour;
  }

  Points normals_;
  const SurfaceValues& values_;
  const ColourScale& scale_;
  Rgb bone_;
  BodyStyle style_;
  const Camera& camera_;
  FlatMesh mesh_;
  Rasteriser rasteriser_;
};

/// All marks of a picture.
class Marks {
 public:
  Marks(const std::vector<PictureMark>& marks, const Camera& camera, std::size_t columns, std::size_t rows)
      : mesh_(gathered(marks)),
        flat_(camera.laid(mesh_)),
        rasteriser_(flat_, columns, rows, strip_pixels * samples) {
    for (const PictureMark& mark : marks)
      colours_.insert(colours_.end(), mark.mesh.triangles.size(),
                      Rgb{double(mark.rgb[0]), double(mark.rgb[1]), double(mark.rgb[2])});
  }
  Marks(const Marks&) = delete;
  Marks& operator=(const Marks&) = delete;

  bool none() const noexcept { return colours_.empty(); }
  void draw(std::size_t strip, std::span<Hit> hits) const { rasteriser_.draw(strip, hits); }
  Rgb over(const Rgb& behind, Index triangle, bool is_before_bones) const {
    const double cover = is_before_bones ? 1 : cover_of_mark_behind;
    Rgb colour = colours_[triangle];
    for (std::size_t k = 0; k < 3; ++k) colour[k] = cover * colour[k] + (1 - cover) * behind[k];
    return colour;
  }

 private:
  static TriMesh gathered(const std::vector<PictureMark>& marks) {
    TriMesh all;
    for (const PictureMark& mark : marks) {
      const auto first = static_cast<Index>(all.vertices.size());
      for (std::size_t v = 0; v < mark.mesh.vertices.size(); ++v)
        all.vertices.push_back(mark.mesh.vertices[v]);
      for (const auto& [a, b, c] : mark.mesh.triangles)
        all.triangles.push_back({first + a, first + b, first + c});
    }
    return all;
  }

  TriMesh mesh_;
  FlatMesh flat_;
  Rasteriser rasteriser_;
  std::vector<Rgb> colours_;
};

void check(const PictureOptions& options) {
  for (const std::size_t side : {options.width, options.height})
    if (side < 64 || side > 8192)
      throw UsageError(
          fmt::format("a picture of {} x {} pixels: each side is 64 to 8192", options.width, options.height));
  if (options.range_mm && !(*options.range_mm > 0 && std::isfinite(*options.range_mm)))
    throw UsageError(fmt::format("the end of the colours: {:g} mm is not above 0", *options.range_mm));
  if (const auto& field = options.field_mm;
      field && !(*field >= smallest_field_mm && (*field <= largest_field_mm || std::isinf(*field))))
    throw UsageError(fmt::format("the height of the view: {:g} mm is not {:g} to {:g}", *field,
                                 smallest_field_mm, largest_field_mm));
}

/// The first of 1, 2, 5, 10, 20 ... mm that holds all depths.
double range_of_depths(const BothValues& values) {
  double deepest = 0;
  for (const SurfaceValues* body : {&values.fixed, &values.mobile})
    for (std::size_t v = 0; v < body->mm.size(); ++v)
      if (body->is_bound[v] == 0) deepest = std::max(deepest, body->mm[v]);
  for (double decade = 1;; decade *= 10)
    for (const double step : {1.0, 2.0, 5.0})
      if (step * decade >= deepest) return step * decade;
}

/// Samples of a coarse picture, in which it is found which body is before the other: along the longer side.
constexpr double coarse_samples = 400;

/// How much of a body's part inside the other one faces the viewer where that body is seen alone, in coarse samples.
std::size_t seen_inside(const TriMesh& mesh, const SurfaceValues& values, const Camera& camera,
                        std::size_t columns, std::size_t rows) {
  const FlatMesh flat = camera.laid(mesh);
  const Rasteriser rasteriser(flat, columns, rows, rows);
  std::vector<Hit> hits(columns * rows);
  rasteriser.draw(0, hits);
  const auto is_inside = [&](const Hit& hit) {
    if (hit.triangle == no_index) return false;
    const Triangle& corners = mesh.triangles[hit.triangle];
    return std::any_of(corners.begin(), corners.end(), [&](Index v) { return values.outside[v] < 0; });
  };
  return static_cast<std::size_t>(std::count_if(hits.begin(), hits.end(), is_inside));
}

/// A body's part inside the other is behind that one's surface: where both are solid no depth is seen. The outer one becomes glass, that
/// behind which more is seen; the fixed one where it is even.
void make_outer_glass(PictureOptions& options, const TriMesh& fixed, const TriMesh& mobile,
                      const BothValues& values, Camera camera, double columns, double rows) {
  if (options.colour != PictureColour::depth || options.fixed != BodyStyle::solid ||
      options.mobile != BodyStyle::solid)
    return;
  const double coarser = std::min(1.0, coarse_samples / std::max(columns, rows));
  camera.samples_per_mm *= coarser, camera.origin_x *= coarser, camera.origin_y *= coarser;
  const auto across = static_cast<std::size_t>(std::ceil(coarser * columns)),
             down = static_cast<std::size_t>(std::ceil(coarser * rows));
  const std::size_t of_mobile = seen_inside(mobile, values.mobile, camera, across, down),
                    of_fixed = seen_inside(fixed, values.fixed, camera, across, down);
  if (of_mobile + of_fixed == 0) return;
  (of_mobile >= of_fixed ? options.fixed : options.mobile) = BodyStyle::transparent;
}

/// Colour at a sample: the nearer body over the other one over white.
Rgb seen_at(const Surface& fixed, const Hit& of_fixed, const Surface& mobile, const Hit& of_mobile, double x,
            double y) {
  Rgb colour = white;
  const auto add = [&](const Surface& surface, const Hit& hit) {
    if (hit.triangle != no_index) colour = surface.over(colour, hit.triangle, x, y);
  };
  const bool fixed_behind =
      of_fixed.triangle == no_index || of_mobile.triangle == no_index || of_fixed.z <= of_mobile.z;
  if (fixed_behind) add(fixed, of_fixed);
  add(mobile, of_mobile);
  if (!fixed_behind) add(fixed, of_fixed);
  return colour;
}

bool is_before(const Hit& mark, const Hit& bone) noexcept {
  return bone.triangle == no_index || mark.z >= bone.z;
}

void draw_strip(const Surface& fixed, const Surface& mobile, const Marks& marks, std::size_t strip,
                Picture& picture, std::size_t rows_of_scene) {
  const std::size_t columns = picture.width * samples;
  std::vector<Hit> hits_fixed(columns * strip_pixels * samples), hits_mobile(hits_fixed.size()),
      hits_marks(marks.none() ? 0 : hits_fixed.size());
  fixed.draw(strip, hits_fixed);
  mobile.draw(strip, hits_mobile);
  if (!marks.none()) marks.draw(strip, hits_marks);
  const std::size_t first = strip * strip_pixels, end = std::min(first + strip_pixels, rows_of_scene);
  for (std::size_t row = first; row < end; ++row) {
    for (std::size_t column = 0; column < picture.width; ++column) {
      Rgb sum = {0, 0, 0};
      for (std::size_t i = 0; i < samples * samples; ++i) {
        const std::size_t sample_row = row * samples + i / samples,
                          sample_column = column * samples + i % samples;
        const std::size_t at = (sample_row - first * samples) * columns + sample_column;
        Rgb colour = seen_at(fixed, hits_fixed[at], mobile, hits_mobile[at],
                             static_cast<double>(sample_column) + 0.5, static_cast<double>(sample_row) + 0.5);
        if (!marks.none() && hits_marks[at].triangle != no_index)
          colour = marks.over(
              colour, hits_marks[at].triangle,
              is_before(hits_marks[at], hits_fixed[at]) && is_before(hits_marks[at], hits_mobile[at]));
        for (std::size_t k = 0; k < 3; ++k) sum[k] += colour[k];
      }
      set_pixel(picture, column, row,
                {sum[0] / (samples * samples), sum[1] / (samples * samples), sum[2] / (samples * samples)});
    }
  }
}

}  // namespace
ViewDirection view_named(std::string_view name, Side side) {
  const double to_right = side == Side::right ? 1 : -1;  // where lateral is
  const std::pair<std::string_view, Vec3> directions[] = {{"anterior", Vec3::UnitX()},
                                                          {"posterior", -Vec3::UnitX()},
                                                          {"superior", Vec3::UnitY()},
                                                          {"inferior", -Vec3::UnitY()},
                                                          {"right", Vec3::UnitZ()},
                                                          {"left", -Vec3::UnitZ()},
                                                          {"lateral", to_right * Vec3::UnitZ()},
                                                          {"medial", -to_right * Vec3::UnitZ()}};
  Vec3 sum = Vec3::Zero();
  for (std::string_view rest = name; !rest.empty();) {
    const std::size_t end = std::min(rest.find('-'), rest.size());
    const auto* found = std::find_if(std::begin(directions), std::end(directions),
                                     [&](const auto& each) { return each.first == rest.substr(0, end); });
    if (found == std::end(directions) || end + 1 == rest.size())
      throw UsageError(
          fmt::format("view '{}': there are anterior, posterior, left, right, superior, inferior, medial, "
                      "lateral, and several of them with hyphens",
                      name));
    sum += found->second;
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (sum.norm() < 0.5) throw UsageError(fmt::format("view '{}': is from no side", name));
  const Vec3 towards_viewer = sum.normalized();
  const Vec3 upright = towards_viewer.cwiseAbs() == Vec3::UnitY() ? Vec3(Vec3::UnitX()) : Vec3(Vec3::UnitY());
  const Vec3 up = (upright - upright.dot(towards_viewer) * towards_viewer).normalized();
  return {towards_viewer, up};
}

namespace {

/// A scene with its marks and legend, and a line of text over it; `sides` have letters if they are known.
Picture drawn(const Scene& scene, PictureOptions options, const ColourScale& scale, const std::string& line,
              const ViewDirection* sides) {
  Picture picture{options.width, options.height,
                  std::vector<std::uint8_t>(3 * options.width * options.height, 255), line};
  const std::size_t rows_of_scene = options.height - io::legend_height(options);
  const std::size_t columns = options.width * io::samples, rows = rows_of_scene * io::samples;
  const auto& [kind, fixed, mobile, values] = scene;
  const Camera camera =
      io::camera_of(options, scene, static_cast<double>(columns), static_cast<double>(rows));
  io::make_outer_glass(options, fixed, mobile, values, camera, static_cast<double>(columns),
                       static_cast<double>(rows));
  const Surface fixed_surface(fixed, values.fixed, scale, io::fixed_bone, options.fixed, camera, columns,
                              rows);
  const Surface mobile_surface(mobile, values.mobile, scale, io::mobile_bone, options.mobile, camera, columns,
                               rows);
  const Marks marks(options.marks, camera, columns, rows);
  const std::size_t strips = (rows_of_scene + io::strip_pixels - 1) / io::strip_pixels;
  core::parallel_chunks(strips, 1, [&](std::size_t first, std::size_t end) {
    for (std::size_t strip = first; strip < end; ++strip)
      io::draw_strip(fixed_surface, mobile_surface, marks, strip, picture, rows_of_scene);
  });
  if (options.is_annotated)
    io::draw_annotations(picture, rows_of_scene, sides, camera.samples_per_mm / io::samples, line);
  io::draw_legend(picture, options, scale);
  return picture;
}

}  // namespace

Picture draw_joint(const Joint& joint, const JointAngles& at, const Pose& X_FM, const PictureOptions& given) {
  PictureOptions options = given;
  io::check(options);
  for (PictureMark& mark : io::ligament_marks(joint.ligaments, X_FM))
    options.marks.push_back(std::move(mark));
  const BothValues values = io::surface_values(options.colour, joint, at, X_FM, options.about);
  const ColourScale scale{options.colour,
                          options.range_mm                         ? *options.range_mm
                          : options.colour == PictureColour::depth ? io::range_of_depths(values)
                                                                   : io::usual_range_mm,
                          options.range_mm || options.colour != PictureColour::depth};
  const TriMesh &fixed = joint.fixed.mesh.arrays(), mobile = posed(X_FM, joint.mobile.mesh.arrays());
  return io::drawn({joint.kind, fixed, mobile, values}, options, scale, io::caption_of(joint, at, X_FM),
                   &options.view);
}

Picture draw_touch(const Mesh& fixed, const Mesh& mobile, const TouchAnswer& answer,
                   const PictureOptions& given) {
  PictureOptions options = given;
  options.colour = PictureColour::none;
  io::check(options);
  const TriMesh &fixed_F = fixed.arrays(), mobile_F = posed(answer.request.X_FM, mobile.arrays());
  for (PictureMark& mark : io::touch_marks(fixed_F, mobile_F, answer, options.view.towards_viewer))
    options.marks.push_back(std::move(mark));
  return io::drawn({JointKind::free, fixed_F, mobile_F, io::values_of_touch(fixed_F, mobile_F, answer)},
                   options, {PictureColour::none, io::usual_range_mm}, io::touch_line(answer), nullptr);
}

}  // namespace condyle::io
