#pragma once

#include "c/held.hpp"
#include "condyle/contact.hpp"
#include "condyle/first_contact.hpp"
#include "condyle/pressure.hpp"
#include "condyle/sample/hip.hpp"
#include "support/random_pose.hpp"
#include "support/test.hpp"

/// Two bones, and answers of C against those of C++.

namespace condyle::test {

inline const sample::SampleHip& hip() {
  static const sample::SampleHip made = sample::sample_hip({}, sample::Scenario::two);
  return made;
}

/// The options of C++ as C takes them.
inline HeldOptions c_options(const contact::ElasticContactOptions& given) {
  HeldOptions options = made<HeldOptions>(condyle_elastic_options_create);
  EXPECT_OK(condyle_elastic_options_set_casting(options.get(), static_cast<int>(given.casting)));
  EXPECT_OK(condyle_elastic_options_set_law(options.get(), static_cast<int>(given.law)));
  EXPECT_OK(condyle_elastic_options_set_rays(options.get(), static_cast<int>(given.rays.rule),
                                             given.rays.reach_mm));
  for (const auto& [body, layer] :
       {std::pair{CONDYLE_FIXED, &given.fixed}, std::pair{CONDYLE_MOBILE, &given.mobile}}) {
    if (!*layer) continue;
    const double* const one = std::get_if<double>(&(*layer)->thickness_mm);
    const std::vector<double> each =
        one ? std::vector{*one} : std::get<std::vector<double>>((*layer)->thickness_mm);
    EXPECT_OK(condyle_elastic_options_set_layer(options.get(), body, (*layer)->youngs_modulus_mpa,
                                                (*layer)->poisson_ratio, each.data(), each.size()));
  }
  return options;
}

/// Apart; and flexed, turned and displaced into contact.
inline std::vector<Pose> poses() {
  return {Pose::Identity(), rotated(125, {0, 0, 1}), rotated(140, {0.2, 0.1, 1}),
          rotated(20, {1, 2, 3}, {-3, 5.5, -2}), rotated(95, {0, 0.4, 1}, {1, 4, -1})};
}

template <class T>
std::vector<T> array(const T* first, std::size_t count) {
  return {first, first + count};
}

template <class Enum>
std::vector<std::uint8_t> bytes(const std::vector<Enum>& values) {
  std::vector<std::uint8_t> out;
  for (const Enum value : values) out.push_back(static_cast<std::uint8_t>(value));
  return out;
}

inline Vec3 vector(const double (&xyz)[3]) {
  return {xyz[0], xyz[1], xyz[2]};
}

inline void expect_same(const std::optional<radial::Penetrations>& cpp, const condyle_vertices_inside& c) {
  ASSERT_EQ(c.other_is_closed, cpp ? 1 : 0);
  if (!cpp) return;
  ASSERT_EQ(c.count, cpp->size());
  EXPECT_EQ(array(c.vertex, c.count), cpp->point);
  EXPECT_EQ(array(c.state, c.count), bytes(cpp->state));
  EXPECT_EQ(array(c.depth_mm, c.count), cpp->depth_mm);
  EXPECT_EQ(array(c.triangle, c.count), cpp->triangle);
  EXPECT_EQ(array(c.direction, c.count), bytes(cpp->direction));
}

/// Results of C against those of C++; how many vertices are inside.
inline std::size_t expect_same(const contact::Contact& cpp, const condyle_contact_results* c) {
  condyle_vertices_inside mobile, fixed;
  EXPECT_OK(condyle_contact_results_vertices(c, CONDYLE_MOBILE, &mobile));
  EXPECT_OK(condyle_contact_results_vertices(c, CONDYLE_FIXED, &fixed));
  expect_same(cpp.mobile_in_fixed, mobile);
  expect_same(cpp.fixed_in_mobile, fixed);
  const std::uint32_t* pairs;
  std::size_t count;
  EXPECT_OK(condyle_contact_results_pairs(c, &pairs, &count));
  EXPECT_EQ(count, cpp.pairs.size());
  for (std::size_t i = 0; i < std::min(count, cpp.pairs.size()); ++i)
    EXPECT_EQ((contact::TrianglePair{pairs[2 * i], pairs[2 * i + 1]}), cpp.pairs[i]);
  int in_contact = -1;
  EXPECT_OK(condyle_contact_results_in_contact(c, &in_contact));
  EXPECT_EQ(in_contact, cpp.in_contact ? 1 : 0);
  return mobile.count + fixed.count;
}

inline void expect_same(const contact::SurfaceContact& cpp, const condyle_surface_contact& c) {
  EXPECT_EQ(c.is_cast, 1);
  ASSERT_EQ(c.face_count, cpp.faces.size());
  for (std::size_t i = 0; i < c.face_count; ++i) {
    const contact::FaceContact& a = cpp.faces[i];
    const condyle_face_contact& b = c.faces[i];
    ASSERT_EQ(b.face, a.face);
    ASSERT_EQ((std::array{b.area_mm2, b.max_depth_mm, b.overlap_mm3, b.max_pressure_mpa, b.load_n}),
              (std::array{a.area_mm2, a.max_depth_mm, a.overlap_mm3, a.max_pressure_mpa, a.load_n}));
    ASSERT_EQ(vector(b.overlap_moment_mm4), a.overlap_moment);
    ASSERT_EQ(vector(b.load_moment_nmm), a.load_moment);
  }
  const contact::ContactTotals& totals = cpp.totals;
  EXPECT_EQ((std::array{c.area_mm2, c.mean_depth_mm, c.max_depth_mm, c.mean_pressure_mpa, c.max_pressure_mpa,
                        c.oblique_area_mm2, c.max_strain}),
            (std::array{totals.area_mm2, totals.mean_depth_mm, totals.max_depth_mm, totals.mean_pressure_mpa,
                        totals.max_pressure_mpa, cpp.oblique_area_mm2, cpp.max_strain}));
  EXPECT_EQ(c.has_centre_of_depth, totals.centre_of_depth ? 1 : 0);
  EXPECT_EQ(vector(c.centre_of_depth_mm), totals.centre_of_depth.value_or(Vec3::Zero()));
  EXPECT_EQ(c.has_centre_of_pressure, totals.centre_of_pressure ? 1 : 0);
  EXPECT_EQ(vector(c.centre_of_pressure_mm), totals.centre_of_pressure.value_or(Vec3::Zero()));
  EXPECT_EQ(vector(c.force_n), totals.force_n);
  EXPECT_EQ(vector(c.moment_nmm), totals.moment_nmm);
  EXPECT_EQ(c.met_from_front, cpp.met_from_front);
  EXPECT_EQ(c.rim_faces, cpp.rim_faces);
  EXPECT_EQ(c.peak_is_oblique, cpp.peak_is_oblique ? 1 : 0);
}

inline void expect_same(const motion::Limit& cpp, const condyle_rotation_limit& c) {
  EXPECT_EQ(c.turned_deg, cpp.turned.degrees());
  EXPECT_EQ(c.error_bound_deg, cpp.error_bound.degrees());
  EXPECT_EQ(c.reason, static_cast<int>(cpp.reason));
  ASSERT_EQ(c.has_witness, cpp.contact ? 1 : 0);
  if (!cpp.contact) return;
  for (const auto& [of_c, of_cpp] : {std::pair{c.fixed_feature, cpp.contact->fixed_feature},
                                     std::pair{c.mobile_feature, cpp.contact->mobile_feature}}) {
    EXPECT_EQ(of_c.kind, static_cast<int>(of_cpp.kind));
    EXPECT_EQ(of_c.id, of_cpp.id);
    EXPECT_EQ(of_c.other_end, of_cpp.other_end);
  }
  EXPECT_EQ(vector(c.fixed_point_mm), cpp.contact->fixed_point);
  EXPECT_EQ(vector(c.mobile_point_mm), cpp.contact->mobile_point);
}

}  // namespace condyle::test
