#include "sample/hip_bone_shape.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "core/trigonometry.hpp"
#include "sample/skeleton.hpp"

namespace condyle::sample {
namespace {

/// Thickness of the socket's wall, mm at the nominal size: medial walls of 5 to 8 mm are usual.
constexpr double socket_wall = 8;

/// Width over which the edge between socket and rim is rounded, mm at the nominal size.
constexpr double rim_seam = 4;

/// Margin around the skeleton's sheet and ring for tips, seams and the socket's rim, mm at the nominal size.
constexpr double margin_around_hip_bone = 20;

/// Control balls {x, y, z}, radius of the ilium, drawn after the proportions of adult hip bones.
constexpr std::size_t ilium_balls = 22;
const std::array<Ball, ilium_balls> ilium = {{
    {{53, 64, 35}, 6},       //  0 anterior superior spine
    {{43, 88, 38}, 7},       //  1 crest, from front to back
    {{26, 110, 42}, 7},      //  2 its tubercle
    {{0, 128, 37}, 6},       //  3
    {{-28, 140, 12}, 6},     //  4 top
    {{-56, 134, -21}, 6.5},  //  5
    {{-82, 116, -36}, 7},    //  6
    {{-102, 94, -43}, 6},    //  7 posterior superior spine
    {{-82, 64, -43}, 6},     //  8 posterior inferior spine
    {{-54, 92, -30}, 10},    //  9 sacral surface, upper
    {{-46, 64, -27}, 10},    // 10 sacral surface, lower
    {{-28, 98, -6}, 4.5},    // 11 wing, back
    {{-4, 90, 12}, 3.2},     // 12 wing, middle
    {{22, 84, 25}, 4.5},     // 13 wing, front
    {{-38, 46, -20}, 7},     // 14 sciatic notch
    {{-18, 50, -10}, 11},    // 15
    {{4, 50, 1}, 12},        // 16
    {{31, 52, 15}, 6},       // 17 between the anterior spines
    {{-38, 26, -18}, 9},     // 18 body, back
    {{-12, 30, -8}, 13},     // 19
    {{12, 30, -3}, 11},      // 20
    {{36, 40, 10}, 7},       // 21 anterior inferior spine
}};
constexpr std::array<std::array<Index, 3>, 26> ilium_plates = {
    {{0, 1, 13},   {1, 2, 13},   {2, 3, 13},   {3, 12, 13},  {3, 4, 12},   {4, 11, 12}, {4, 5, 11},
     {5, 9, 11},   {5, 6, 9},    {6, 7, 9},    {7, 8, 9},    {8, 10, 9},   {11, 9, 10}, {11, 10, 15},
     {10, 14, 15}, {12, 11, 15}, {12, 15, 16}, {13, 12, 16}, {13, 16, 17}, {0, 13, 17}, {14, 18, 15},
     {18, 19, 15}, {15, 19, 16}, {19, 20, 16}, {16, 20, 17}, {20, 21, 17}}};

/// From the body down the pubis, round below the obturator hole, and up the ischium to the body again.
const std::array<Ball, 13> pubis_and_ischium = {{
    {{6, 22, -14}, 11},
    {{14, 8, -33}, 11},    // iliopubic eminence
    {{22, -3, -50}, 9.5},  // superior ramus
    {{30, -12, -68}, 9},
    {{35, -20, -88}, 12},  // body of the pubis
    {{25, -39, -90}, 11},
    {{6, -43, -75}, 8.5},  // inferior ramus
    {{-10, -53, -58}, 9},
    {{-29, -62, -42}, 14},  // ischial tuberosity
    {{-44, -44, -27}, 14},
    {{-41, -20, -23}, 12.5},
    {{-32, 2, -18}, 14},
    {{-22, 24, -12}, 13},
}};
const std::array<Ball, 3> ischial_spine = {{{{-34, 12, -22}, 11}, {{-45, 4, -30}, 8}, {{-55, 0, -37}, 5.5}}};
/// Tips that the sheet's border would round off.
const std::array<Ball, 2> anterior_tip = {{{{40, 72, 31}, 6.5}, {{51, 63, 36}, 5.5}}};
const std::array<Ball, 2> posterior_tip = {{{{-86, 97, -39}, 7}, {{-99, 92, -44}, 5.5}}};
const std::array<Ball, 2> posterior_inferior_tip = {{{{-70, 74, -38}, 7}, {{-83, 66, -43}, 5.5}}};

struct HipBonePieces {
  Skeleton ilium_sheet = Skeleton::sheet(ilium, ilium_plates);
  Skeleton ring = Skeleton::chain(pubis_and_ischium);
  std::array<Skeleton, 4> tips = {Skeleton::chain(ischial_spine), Skeleton::chain(anterior_tip),
                                  Skeleton::chain(posterior_tip), Skeleton::chain(posterior_inferior_tip)};
  Socket socket;
  Ball notch_start, notch_end;
  double scale = 1;

  FieldValue operator()(const Vec3& p) const noexcept {
    const Vec3 nominal = p / scale;
    // A part larger than the rest by the width of the seam has no influence on it.
    constexpr double ring_seam = 10, tip_seam = 8;
    FieldValue bone = ring(nominal);
    bone = joined(ilium_sheet.up_to(bone.value + ring_seam, nominal), bone, ring_seam);
    for (const Skeleton& tip : tips) bone = joined(bone, tip.up_to(bone.value + tip_seam, nominal), tip_seam);
    bone.value *= scale;

    const Ball shell = {Vec3::Zero(), socket.radius + socket_wall * scale};
    bone = joined(bone, ball(shell, p), 10 * scale);
    // The rim: what stands beyond its plane goes, out to somewhat more than the shell.
    const Ball around_rim = {Vec3::Zero(), shell.radius + 4 * scale};
    const FieldValue beyond_rim = half_space(-socket.opening, -socket.rim_offset, p);
    bone = without(bone, common(ball(around_rim, p), beyond_rim, 4 * scale), 6 * scale);
    // The head's cavity, open outwards: a bar from the centre along the opening keeps the neck's place free.
    const Ball cavity = {Vec3::Zero(), socket.radius};
    const Ball outside = {3 * socket.radius * socket.opening, socket.radius};
    bone = without(bone, bar(cavity, outside, p), rim_seam * scale);
    return without(bone, bar(notch_start, notch_end, p), 7 * scale);
  }
};

}  // namespace

Socket socket_of(const HipParameters& hip) noexcept {
  const double inclination = hip.acetabular_inclination.radians(), version = hip.acetabular_version.radians();
  const double edge = hip.lateral_centre_edge_angle.radians();
  Socket socket;
  socket.radius = hip.head_radius_mm + hip.joint_space_mm;
  socket.opening = Vec3(core::sine(inclination) * core::sine(version), -core::cosine(inclination),
                        core::sine(inclination) * core::cosine(version));
  const Vec3 down(0.15, -1, 0);
  socket.notch = (down - down.dot(socket.opening) * socket.opening).normalized();
  // The edge is where a radiograph shows it: in the middle of the rounded seam between socket and rim. There
  // the rim is sunk by x below its plane: with seam s and depth s / 2 into it,
  //     x = s h^2 / 4 where h = 1 - (s / 2 - x) / s, hence x^2 - 3 s x + s^2 / 4 = 0.
  const double seam = rim_seam * socket.radius / nominal_socket_radius;
  const double sunk = (1.5 - std::numbers::sqrt2) * seam;
  const Vec3 roof = (socket.radius + seam / 2) * Vec3(0, core::cosine(edge), core::sine(edge));
  socket.rim_offset = roof.dot(socket.opening) + sunk;
  return socket;
}

Solid hip_bone_shape(const HipParameters& hip) {
  HipBonePieces bone;
  bone.socket = socket_of(hip);
  bone.scale = bone.socket.radius / nominal_socket_radius;
  const Vec3& notch = bone.socket.notch;
  const Vec3 level = bone.socket.rim_offset * bone.socket.opening;
  bone.notch_start = {level + 0.7 * bone.socket.radius * notch, 8 * bone.scale};
  bone.notch_end = {level + 1.6 * bone.socket.radius * notch, 10 * bone.scale};

  const Box sheet = box_around(bone.ilium_sheet.balls()), ring = box_around(bone.ring.balls());
  const Vec3 margin = Vec3::Constant(margin_around_hip_bone);
  const Vec3 low = sheet.low.cwiseMin(ring.low) - margin, high = sheet.high.cwiseMax(ring.high) + margin;
  const Ball& tip = ischial_spine.back();
  const Ball lips = {level + 1.2 * bone.socket.radius * notch, 12 * bone.scale};
  return {bone,
          {bone.scale * low, bone.scale * high},
          {{bone.scale * tip.centre, 2 * bone.scale * tip.radius}, lips}};
}

}  // namespace condyle::sample
