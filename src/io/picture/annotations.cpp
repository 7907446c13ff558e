#include "io/picture/annotations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "condyle/answer/case.hpp"
#include "condyle/contact.hpp"
#include "condyle/joint_coordinates.hpp"
#include "io/picture/text.hpp"
#include "io/result/movement_words.hpp"
#include "io/result/pose_state.hpp"

namespace condyle::io {
namespace {

/// An axis that goes less than this along an edge, of 1, is not named there.
constexpr double least_named = 0.4;
constexpr double longest_bar = 0.2;  ///< of the width

/// To a tenth, without a zero behind the point and without its sign.
std::string tenths(double value) {
  const double rounded = std::round(10 * value) / 10;
  return fmt::format("{:g}", rounded == 0 ? 0 : rounded);
}

}  // namespace

std::string orientation_letters(const Vec3& direction) {
  std::array<std::pair<double, char>, 3> shares;
  constexpr std::array<std::array<char, 2>, 3> letters{{{'A', 'P'}, {'S', 'I'}, {'R', 'L'}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const double share = direction[static_cast<Eigen::Index>(k)];
    shares[k] = {std::abs(share), letters[k][share < 0 ? 1 : 0]};
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::string text{shares[0].second};
  for (std::size_t k = 1; k < 3; ++k)
    if (shares[k].first >= least_named) text += shares[k].second;
  return text;
}

double scale_bar_mm(double longest_mm) noexcept {
  double decade = 1;
  while (decade > longest_mm) decade /= 10;
  while (10 * decade <= std::min(longest_mm, 1e300)) decade *= 10;
  return decade * (longest_mm >= 5 * decade ? 5 : longest_mm >= 2 * decade ? 2 : 1);
}

std::string pose_line(const Joint& joint, const JointAngles& at, const Pose& X_FM) {
  const auto& names = coordinate_names(joint.anatomy);
  const Angle angles[] = {at.flexion, at.adduction, at.internal_rotation};
  std::string line;
  for (std::size_t k = 0; k < (joint.kind == JointKind::hinge ? 1 : 3); ++k)
    line +=
        fmt::format("{}{} {}", k == 0 ? "" : ", ", spaced(names[k].positive), tenths(angles[k].degrees()));
  line += " deg";
  if (joint.kind != JointKind::free) return line;
  const Vec3 along = coordinates_at(joint.coordinates(), X_FM, joint.translation_frame).translation_mm;
  return line + fmt::format(", x {}, y {}, z {} mm", tenths(along.x()), tenths(along.y()), tenths(along.z()));
}

std::string caption_of(const Joint& joint, const JointAngles& at, const Pose& X_FM) {
  const std::string line = pose_line(joint, at, X_FM);
  const auto limits = limits_of_poses(joint);
  if (!limits) return line;
  const bool in_contact = contact::JointContact(joint).in_contact(X_FM);
  return line + ", " +
         state_words(
             pose_standing(*limits, at, X_FM.translation(), in_contact, PoseStanding::FindNearest::at_limits),
             joint.anatomy);
}

void draw_annotations(Picture& picture, std::size_t rows_of_scene, const ViewDirection* view,
                      double pixels_per_mm, const std::string& line) {
  const double width = static_cast<double>(picture.width), height = static_cast<double>(rows_of_scene);
  const double border = std::round(0.015 * std::min(width, height)) + 2;
  const double size = std::min(0.024 * height, 0.02 * width), large = 1.4 * size;
  Text text;
  const double room = width - 2 * border, wide = width_of(line);
  const double fitted = std::min(size, room / wide);
  text.add(line, border, border + fitted, fitted, Alignment::left);

  if (view) {
    const Vec3 up = view->up, right = view->up.cross(view->towards_viewer);
    // Under the line; a hair above the middle of the sides, where letters are.
    text.add(orientation_letters(up), width / 2, 2 * border + size + large, large, Alignment::centre);
    text.add(orientation_letters(-up), width / 2, height - border, large, Alignment::centre);
    text.add(orientation_letters(-right), border, (height + large) / 2, large, Alignment::left);
    text.add(orientation_letters(right), width - border, (height + large) / 2, large, Alignment::right);
  }

  const double mm = scale_bar_mm(longest_bar * width / pixels_per_mm), thick = std::max(1.0, 0.1 * size);
  const double left = border, end = border + mm * pixels_per_mm, bottom = height - border;
  text.add_box(left, end, bottom - 2 * thick, bottom);
  for (const double tick : {left, end - 2 * thick})
    text.add_box(tick, tick + 2 * thick, bottom - 0.6 * size, bottom);
  text.add(fmt::format("{:g} mm", mm), left, bottom - size, size, Alignment::left);
  text.draw(picture, {0, rows_of_scene});
}

}  // namespace condyle::io
