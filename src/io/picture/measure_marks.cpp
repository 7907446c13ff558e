#include <array>
#include <numbers>

#include "condyle/hip_measures.hpp"
#include "condyle/io/picture.hpp"
#include "core/trigonometry.hpp"
#include "io/picture/marks.hpp"
#include "io/result/line_mesh.hpp"

namespace condyle::io {
namespace {

constexpr std::array<std::uint8_t, 3> grey = {110, 110, 110}, green = {0, 158, 115}, orange = {230, 159, 0},
                                      purple = {204, 121, 167};

/// Thickness of lines and size of dots, mm; the neck's axis in radii of the head on either side of its centre.
constexpr double line_mm = 0.5, dot_mm = 0.9, small_dot_mm = 0.5;
constexpr double axis_behind = 1.3, axis_ahead = 2.0, twelve_ahead = 1.3, up_ahead = 1.5;
constexpr double normal_mm = 25;
constexpr int ring_steps = 144;

/// The mark's mesh grows by a line.
void add_line(TriMesh& mesh, const Vec3& from, const Vec3& to) {
  io::add_line(mesh, from, to, line_mm);
}

void add_ring(TriMesh& mesh, const measure::RimGeometry& rim) {
  const Vec3 x = rim.clock.twelve, y = rim.normal.cross(x);
  const auto at = [&](int step) {
    const double turn = 2 * std::numbers::pi * step / ring_steps;
    return Vec3(rim.centre + rim.radius_mm * (core::cosine(turn) * x + core::sine(turn) * y));
  };
  for (int step = 0; step < ring_steps; ++step) add_line(mesh, at(step), at(step + 1));
}

void add_mark(std::vector<PictureMark>& marks, TriMesh mesh, const std::array<std::uint8_t, 3>& rgb,
              const char* meaning) {
  if (!mesh.triangles.empty()) marks.push_back({std::move(mesh), rgb, meaning});
}

/// Shaft, condylar line, the line that version is seen along, 12 o'clock and the top of the trochanter, with the femur.
TriMesh femur_axes(const measure::FemurMeasures& femur, const Pose& X_FM) {
  TriMesh mesh;
  const auto line = [&](const Vec3& from, const Vec3& to) { add_line(mesh, X_FM * from, X_FM * to); };
  if (femur.neck) {
    const auto& [head, direction, outline, clock, source] = *femur.neck;
    line(head.centre, head.centre + twelve_ahead * head.radius * clock.twelve);
  }
  if (femur.shaft) line(femur.shaft->first, femur.shaft->last);
  if (femur.condyles) {
    line(femur.condyles->medial, femur.condyles->lateral);
    if (femur.head) line(femur.head->centre, femur.condyles->middle);
  }
  if (femur.trochanter_top) add_ball(mesh, X_FM * *femur.trochanter_top, dot_mm);
  return mesh;
}

/// From the head's centre up and to the edges of the roof, and the chords of the rim.
TriMesh roof_lines(const measure::HipMeasures& measures) {
  TriMesh mesh;
  const measure::AcetabulumMeasures& socket = measures.acetabulum;
  bool has_edge = false;
  if (measures.femur.head)
    for (const auto* edge : {&socket.lateral_edge, &socket.anterior_edge, &socket.posterior_edge})
      if (*edge) add_line(mesh, measures.femur.head->centre, **edge), has_edge = true;
  if (has_edge) {
    const Sphere& head = *measures.femur.head;
    add_line(mesh, head.centre, head.centre + up_ahead * head.radius * socket.superior);
  }
  for (const measure::RimChord& chord : socket.chords) add_line(mesh, chord.back, chord.front);
  return mesh;
}

/// Where the bones are nearest, at the poses that this is measured in.
TriMesh nearest_places(const measure::BothMeasures& both) {
  TriMesh mesh;
  for (const auto* at : {&both.joint_space_at, &both.ischiofemoral_at})
    if (*at) {
      add_line(mesh, (*at)->fixed_point, (*at)->mobile_point);
      add_ball(mesh, (*at)->fixed_point, dot_mm), add_ball(mesh, (*at)->mobile_point, dot_mm);
    }
  return mesh;
}

}  // namespace

/// An octahedron whose edges are halved twice, pushed out.
void add_ball(TriMesh& mesh, const Vec3& at, double radius) {
  static constexpr int halves = 4;
  for (const double sx : {1.0, -1.0})
    for (const double sy : {1.0, -1.0})
      for (const double sz : {1.0, -1.0}) {
        const auto corner = [&](int i, int j) {
          const Vec3 p = Vec3(sx * i, sy * j, sz * (halves - i - j)).normalized();
          mesh.vertices.push_back(at + radius * p);
          return static_cast<Index>(mesh.vertices.size() - 1);
        };
        const auto add = [&](std::array<int, 2> a, std::array<int, 2> b, std::array<int, 2> c) {
          mesh.triangles.push_back({corner(a[0], a[1]), corner(b[0], b[1]), corner(c[0], c[1])});
        };
        for (int i = 0; i < halves; ++i)
          for (int j = 0; i + j < halves; ++j) {
            add({i, j}, {i + 1, j}, {i, j + 1});
            if (i + j + 1 < halves) add({i + 1, j}, {i + 1, j + 1}, {i, j + 1});
          }
      }
}

std::vector<PictureMark> measure_marks(const measure::HipMeasures& measures, const Pose& X_FM) {
  std::vector<PictureMark> marks;
  const measure::FemurMeasures& femur = measures.femur;
  const measure::AcetabulumMeasures& socket = measures.acetabulum;
  TriMesh in_plane, off_plane, plane, axis, alpha;
  for (const measure::RimHour& hour : socket.rim)
    if (hour.point) add_ball(hour.is_in_plane ? in_plane : off_plane, *hour.point, dot_mm);
  if (socket.plane) {
    add_ring(plane, *socket.plane);
    add_line(plane, socket.plane->centre, socket.plane->centre + normal_mm * socket.plane->normal);
  }
  if (femur.neck) {
    const auto& [head, direction, outline, clock, source] = *femur.neck;
    add_line(axis, X_FM * Vec3(head.centre - axis_behind * head.radius * direction),
             X_FM * Vec3(head.centre + axis_ahead * head.radius * direction));
  }
  for (const measure::NeckHour& hour : femur.around_neck)
    if (hour.alpha_point) add_ball(alpha, X_FM * *hour.alpha_point, small_dot_mm);
  add_mark(marks, std::move(plane), vermilion, "rim and its plane");
  add_mark(marks, std::move(in_plane), vermilion, "rim and its plane");
  add_mark(marks, std::move(off_plane), grey, "rim off its plane");
  add_mark(marks, std::move(axis), blue, "axes of the femur");
  add_mark(marks, std::move(alpha), green, "end of the head");
  add_mark(marks, femur_axes(femur, X_FM), blue, "axes of the femur");
  add_mark(marks, roof_lines(measures), orange, "roof");
  add_mark(marks, nearest_places(measures.both), purple, "nearest bone");
  return marks;
}

}  // namespace condyle::io
