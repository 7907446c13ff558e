#include "condyle/motion_contact.hpp"

#include "support/cup.hpp"
#include "support/test.hpp"

/// Checks of layers, loads and motions.

namespace condyle::motion {
namespace {

using Codes = std::vector<ContactNoteCode>;

Codes codes_of(const std::vector<ContactNote>& notes) {
  Codes codes;
  for (const ContactNote& note : notes) {
    EXPECT_FALSE(note.text.empty());
    codes.push_back(note.code);
  }
  return codes;
}

/// A cartilage of 2.5 mm, as the shell of a ball.
Mesh cartilage() {
  return test::socket(Vec3::Zero(), 25, 27.5, 3);
}
Codes of_layer(const contact::ElasticLayer& layer, const Mesh& mesh = cartilage()) {
  return codes_of(
      check_layers(contact::ElasticContact(mesh, test::sphere(Vec3::Zero(), 24, 2), {.fixed = layer})));
}

TEST(ContactChecks, SayNothingOfTissueAndImplants) {
  for (const contact::ElasticLayer& layer : {contact::ElasticLayer{10, 0.45, 3.0},
                                             {0.5, 0, 0.5},
                                             {1000, 0.46, 8.0},
                                             {230000, 0.3, 4.0},
                                             {380000, 0.23, 5.0}})
    EXPECT_EQ(of_layer(layer), Codes{}) << layer.youngs_modulus_mpa;
}

TEST(ContactChecks, NameWhatNoTissueOrImplantHas) {
  EXPECT_EQ(of_layer({1e9, 0.45, 3.0}), Codes{ContactNoteCode::unlikely_modulus});
  EXPECT_EQ(of_layer({0.012, 0.45, 3.0}), Codes{ContactNoteCode::unlikely_modulus});
  EXPECT_EQ(of_layer({10, 0.4999, 3.0}), Codes{ContactNoteCode::unlikely_poisson_ratio});
  EXPECT_EQ(of_layer({10, -0.2, 3.0}), Codes{ContactNoteCode::unlikely_poisson_ratio});
  EXPECT_EQ(of_layer({10, 0.45, 1500.0}), Codes{ContactNoteCode::unlikely_thickness});
  EXPECT_EQ(of_layer({10, 0.45, 0.0015}), Codes{ContactNoteCode::unlikely_thickness});
  const Mesh mesh = cartilage();
  std::vector<double> thickness(mesh.vertices().size(), 2.0);
  thickness[7] = 0.05;
  EXPECT_EQ(of_layer({10, 0.45, thickness}), Codes{ContactNoteCode::unlikely_thickness});
  const auto notes =
      check_layers(contact::ElasticContact(cartilage(), test::sphere(Vec3::Zero(), 24, 2),
                                           {.fixed = contact::ElasticLayer{1e7, 0.45, 1500.0}}),
                   {"acetabular cartilage", "head"});
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].text.find("acetabular cartilage"), std::string::npos);
  EXPECT_NE(notes[0].text.find("is it in Pa?"), std::string::npos);
  EXPECT_NE(notes[1].text.find("is it in micrometres?"), std::string::npos);
}

TEST(ContactChecks, NameThicknessesBeyondTheBoundsOfTheirFile) {
  const Mesh mesh = cartilage();
  std::vector<double> thickness(mesh.vertices().size(), 2.0);
  thickness[3] = 0.5, thickness[7] = 0.8, thickness[9] = 4.5;
  const auto of_bounds = [&](std::array<double, 2> bounds) {
    return check_layers(
        contact::ElasticContact(mesh, test::sphere(Vec3::Zero(), 24, 2),
                                {.fixed = contact::ElasticLayer{10, 0.45, thickness, bounds}}),
        {"tibial cartilage", "head"});
  };
  EXPECT_EQ(codes_of(of_bounds({0.5, 4.5})), Codes{}) << "the bounds themselves are within";
  const auto notes = of_bounds({1, 4});
  ASSERT_EQ(codes_of(notes), Codes{ContactNoteCode::thickness_beyond_bounds});
  EXPECT_EQ(notes[0].text, "the layer on tibial cartilage is 1 to 4 mm thick by its file, and measured at " +
                               std::to_string(thickness.size()) +
                               " vertices: 2 thinner, down to 0.5 mm, and 1 thicker, up to 4.5 mm");
  EXPECT_EQ(codes_of(of_bounds({0, 4})), Codes{ContactNoteCode::thickness_beyond_bounds});
  EXPECT_EQ(of_layer({10, 0.45, 3.0, std::array{1.0, 2.0}}), Codes{})
      << "a layer of one thickness is not measured";
}

TEST(ContactChecks, NameABoneThatIsGivenALayer) {
  // A ball of radius 24: 2 V / A = 2 r / 3.
  EXPECT_EQ(of_layer({10, 0.45, 3.0}, test::sphere(Vec3::Zero(), 24, 3)),
            Codes{ContactNoteCode::layer_on_bone});
  EXPECT_EQ(of_layer({10, 0.45, 3.0}, test::cup(24, 3)), Codes{}) << "an open sheet has no thickness";
}

TEST(ContactChecks, NameForcesBeyondTenBodyWeights) {
  EXPECT_EQ(codes_of(check_load({.on_mobile = {.force_n = {0, 7300, 0}}})), Codes{});
  const auto notes = check_load({.on_mobile = {.force_n = {0, 7400, 0}}});
  ASSERT_EQ(codes_of(notes), Codes{ContactNoteCode::unlikely_load});
  EXPECT_NE(notes[0].text.find("75 kg assumed"), std::string::npos);
}

Codes at_depth(double depth, contact::FaceRule rule = contact::FaceRule::cut_faces) {
  const contact::ElasticContact contact(test::plane(3, 4), test::box({-9, 0, -9}, {9, 40, 9}),
                                        {.casting = contact::Casting::fixed,
                                         .rays = {.rule = rule, .reach_mm = 50},
                                         .fixed = contact::ElasticLayer{1, 0.4, 3.0}});
  return codes_of(check_contact(contact.at(test::translated({0, -depth, 0}))));
}

TEST(ContactChecks, NameLayersThatAreCompressedFarOrWholly) {
  EXPECT_EQ(at_depth(0.89), Codes{});
  EXPECT_EQ(at_depth(0.91), Codes{ContactNoteCode::large_strain});
  EXPECT_EQ(at_depth(2.99), Codes{ContactNoteCode::large_strain});
  EXPECT_EQ(at_depth(3.01), Codes{ContactNoteCode::deeper_than_layers});
}

/// Frames apart by a gap, or within each other by a depth.
std::vector<std::optional<FrameContact>> frames(std::size_t apart, double gap, std::size_t deep, double depth,
                                                std::size_t others) {
  std::vector<std::optional<FrameContact>> all;
  for (std::size_t i = 0; i < apart; ++i)
    all.push_back(FrameContact{.X_FM = Pose::Identity(), .smallest_gap_mm = gap});
  for (std::size_t i = 0; i < deep; ++i) {
    all.push_back(FrameContact{.X_FM = Pose::Identity(), .in_contact = true});
    all.back()->surface.totals.max_depth_mm = depth;
  }
  for (std::size_t i = 0; i < others; ++i)
    all.push_back(FrameContact{.X_FM = Pose::Identity(), .smallest_gap_mm = 2});
  all.emplace_back();  // a gap of the recording
  return all;
}

TEST(ContactChecks, NameMotionsThatLeaveTheBodiesApartOrDeep) {
  EXPECT_EQ(codes_of(check_motion(frames(5, 100, 0, 0, 5))), Codes{}) << "half of them";
  EXPECT_EQ(codes_of(check_motion(frames(6, 100, 0, 0, 5))), Codes{ContactNoteCode::mostly_apart});
  EXPECT_EQ(codes_of(check_motion(frames(6, 19, 0, 0, 5))), Codes{});
  EXPECT_EQ(codes_of(check_motion(frames(0, 0, 6, 20, 5))), Codes{ContactNoteCode::mostly_deep});
  EXPECT_EQ(codes_of(check_motion(frames(0, 0, 6, 9, 5))), Codes{});
  EXPECT_EQ(codes_of(check_motion({})), Codes{});
}

TEST(ContactChecks, NameRecordedNumbersInAnotherUnit) {
  EXPECT_FALSE(check_recorded("flexion", RecordedKind::angle_deg, 720));
  EXPECT_EQ(check_recorded("flexion", RecordedKind::angle_deg, 5156)->code, ContactNoteCode::unlikely_angle);
  EXPECT_FALSE(check_recorded("x", RecordedKind::length_mm, 999));
  EXPECT_EQ(check_recorded("x", RecordedKind::length_mm, 40000)->code, ContactNoteCode::unlikely_translation);
}

TEST(ContactChecks, NameAnglesInRadiansThatAreReadAsDegrees) {
  const auto code = [](const std::vector<std::vector<double>>& columns) {
    const auto note = check_degrees(columns);
    return note ? std::optional(note->code) : std::nullopt;
  };
  // A hip from -20 to 40 degrees, its other angles smaller.
  EXPECT_EQ(code({{-0.35, 0.2, 0.7}, {0.02, 0.05, std::nan("")}}), ContactNoteCode::unlikely_angle);
  EXPECT_FALSE(code({{-20, 11, 40}, {1, 3, 1}})) << "degrees";
  EXPECT_FALSE(code({{0, 0.2, 0.7}, {3.15, 3.1, 3.1}})) << "one of them beyond half a turn";
  EXPECT_EQ(code({{0, 0.2, 0.7}, {3.14, 3.1, 3.1}}), ContactNoteCode::unlikely_angle);
  EXPECT_FALSE(code({{1.0, 1.1, 1.29}, {2, 2, 2}})) << "at rest";
  EXPECT_EQ(code({{1.0, 1.1, 1.31}, {2, 2, 2}}), ContactNoteCode::unlikely_angle);
  EXPECT_FALSE(code({}));
  EXPECT_FALSE(code({{std::nan("")}}));
}

TEST(ContactChecks, NameTimesInMilliseconds) {
  const auto is_noted = [](double step, int frames) {
    std::vector<double> times;
    for (int i = 0; i < frames; ++i) times.push_back(500 + step * i);
    return check_times(times).has_value();
  };
  EXPECT_FALSE(is_noted(0.01, 1000));
  EXPECT_TRUE(is_noted(10, 3)) << "100 frames in a second";
  EXPECT_TRUE(is_noted(2, 2));
  EXPECT_FALSE(is_noted(1.99, 60));
  EXPECT_FALSE(is_noted(1, 101)) << "per cent";
  EXPECT_TRUE(is_noted(1, 122)) << "1000 frames in a second";
  EXPECT_FALSE(is_noted(0.1, 100000)) << "a day of walking";
  EXPECT_FALSE(check_times({}));
  EXPECT_EQ(check_times(std::vector<double>{0, 10})->code, ContactNoteCode::unlikely_times);
}

TEST(ContactChecks, AddOnlyNewCodes) {
  std::vector<ContactNote> notes = check_load({.on_mobile = {.force_n = {0, 8000, 0}}});
  add_new(notes, {{ContactNoteCode::unlikely_load, "again"},
                  {ContactNoteCode::large_strain, "one"},
                  {ContactNoteCode::large_strain, "two"}});
  EXPECT_EQ(codes_of(notes), (Codes{ContactNoteCode::unlikely_load, ContactNoteCode::large_strain,
                                    ContactNoteCode::large_strain}));
}

}  // namespace
}  // namespace condyle::motion
