#pragma once

/// Safe zones of cups, by the closed form and independently of this code.

namespace condyle::test {

struct Zone {
  double neck_shaft, version, head, neck, area;
  double free[4][2];  ///< anteversions at inclinations of 35, 40, 45, 50
};

inline constexpr Zone zones[] = {
    {135, 15, 16, 6, 658.125, {{11.2369, 32.4068}, {6.3320, 31.9068}, {1.7514, 31.0689}, {-2.4486, 29.8754}}},
    {135, 15, 18, 6, 818.368, {{7.6080, 34.9678}, {2.8258, 34.4907}, {-1.6271, 33.6911}, {-5.7009, 32.5523}}},
    {127, 5, 18, 6, 622.383, {{19.6889, 34.8306}, {12.6346, 36.0835}, {5.8768, 36.1254}, {-0.3976, 35.8579}}},
    {135,
     25,
     14,
     5,
     782.216,
     {{0.2912, 28.2969}, {-3.8534, 27.3609}, {-7.5898, 26.0803}, {-10.9091, 24.4341}}}};

/// What a safe cup lets the hip reach, in degrees.
struct ZoneTarget {
  const char* motion;
  double reach;
};
inline constexpr ZoneTarget zone_targets[] = {
    {"flexion", 110},  {"extension", 30}, {"internal_rotation_at_90_flexion", 30}, {"external_rotation", 40},
    {"abduction", 45}, {"adduction", 20}, {"adduction_at_90_flexion", 10}};

}  // namespace condyle::test
