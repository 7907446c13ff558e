#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/result/plot_clock_face.hpp"
#include "io/result/plot_limits.hpp"
#include "io/result/plot_map.hpp"
#include "plot_svg_elements.hpp"

namespace condyle::test {
namespace {

using namespace io;

constexpr const char* footer = "osseous contact; research software, not a medical device";

const PlotHeading heading{"Left hip <7> & co", "what is shown"};

MotionLimit limit_of(std::string name, double degrees, LimitReason reason) {
  MotionLimit limit;
  limit.motion.name = std::move(name);
  limit.end.turned = Angle::degrees(degrees);
  limit.end.reason = reason;
  return limit;
}

bool has_text(const std::string& document, const std::string& words) {
  const auto texts = elements_named(document, "text");
  return std::any_of(texts.begin(), texts.end(),
                     [&](const auto& t) { return t.text.find(words) != t.text.npos; });
}

std::vector<SvgElement> filled(const std::string& document, const std::string& name, std::string_view fill) {
  std::vector<SvgElement> out = elements_named(document, name);
  std::erase_if(out, [&](const SvgElement& e) {
    const auto at = e.attributes.find("fill");
    return at == e.attributes.end() || at->second != fill;
  });
  return out;
}

/// Every drawing names the joint, says what it is not, and keeps its words inside.
void expect_sober(const std::string& document) {
  const auto elements = svg_elements(document);
  ASSERT_FALSE(elements.empty()) << "not well-formed XML";
  EXPECT_EQ(elements[0].attributes.at("viewBox").substr(0, 8), "0 0 800 ");
  EXPECT_TRUE(has_text(document, "Left hip <7> & co"));
  EXPECT_TRUE(has_text(document, footer));
  int inside = 0;
  for (const SvgElement& text : elements_named(document, "text")) {
    if (text.attributes.contains("transform")) continue;
    const double width = text_width(text.text, text.number("font-size"));
    const std::string anchor = text.attributes.at("text-anchor");
    const double left = text.number("x") - (anchor == "end" ? width : anchor == "middle" ? width / 2 : 0);
    EXPECT_GE(left, 0) << text.text;
    EXPECT_LE(left + width, 800) << text.text;
    EXPECT_LE(text.number("y"), elements[0].number("height")) << text.text;
    ++inside;
  }
  EXPECT_GE(inside, 3);
}

TEST(NormalHipRange, Is_given_where_the_source_has_a_value) {
  EXPECT_EQ(normal_hip_range("flexion"), Angle::degrees(120));
  EXPECT_EQ(normal_hip_range("extension"), Angle::degrees(30));
  EXPECT_EQ(normal_hip_range("abduction"), Angle::degrees(45));
  EXPECT_EQ(normal_hip_range("adduction"), Angle::degrees(30));
  EXPECT_EQ(normal_hip_range("internal_rotation"), Angle::degrees(45));
  EXPECT_EQ(normal_hip_range("external_rotation"), Angle::degrees(45));
  for (const char* none : {"fadir", "faber", "internal_rotation_at_90_flexion", "my_motion", ""})
    EXPECT_FALSE(normal_hip_range(none)) << none;
}

TEST(LimitsPlot, Draws_bars_to_scale_with_the_normal_range_behind) {
  const std::vector limits{limit_of("flexion", 90, LimitReason::contact),
                           limit_of("abduction", 60, LimitReason::end_of_range)};
  const std::string plot = limits_plot(heading, limits);
  expect_sober(plot);
  const auto contact = filled(plot, "rect", palette::blue), ended = filled(plot, "rect", palette::grey);
  auto normal = filled(plot, "rect", palette::light_grey);
  ASSERT_EQ(contact.size(), 1u);
  ASSERT_EQ(ended.size(), 1u);
  ASSERT_EQ(normal.size(), 3u);  // one of them in the legend
  // All widths are written to a hundredth of a pixel, so a ratio of two of some 200 px is right to 1e-4.
  const double per_degree = contact[0].number("width") / 90;
  EXPECT_NEAR(ended[0].number("width") / per_degree, 60, 0.01);
  EXPECT_NEAR(normal[0].number("width") / per_degree, 120, 0.02);
  EXPECT_NEAR(normal[1].number("width") / per_degree, 45, 0.01);
  EXPECT_EQ(normal[0].number("x"), contact[0].number("x"));
  EXPECT_TRUE(has_text(plot, "AAOS, Joint Motion: Method of Measuring and Recording, 1965"));
  EXPECT_TRUE(has_text(plot, "90.00°"));
  EXPECT_TRUE(has_text(plot, "degrees"));
}

TEST(LimitsPlot, Names_no_source_where_no_motion_has_one) {
  const std::string plot = limits_plot(heading, std::vector{limit_of("fadir", 8, LimitReason::contact)});
  expect_sober(plot);
  EXPECT_TRUE(filled(plot, "rect", palette::light_grey).empty());
  EXPECT_FALSE(has_text(plot, "AAOS"));
}

TEST(LimitsPlot, Shows_no_normal_range_of_a_hip_for_another_joint) {
  const std::vector limits{limit_of("flexion", 140, LimitReason::contact)};
  EXPECT_TRUE(has_text(limits_plot(heading, limits), "normal range of the living hip"));
  EXPECT_FALSE(has_text(limits_plot(heading, limits, {}, NormalRanges::none), "living hip"));
}

TEST(LimitsPlot, Draws_a_whisker_and_quotes_the_band) {
  const std::vector limits{limit_of("flexion", 131.94, LimitReason::contact)};
  const std::vector bands{
      LimitBand{Angle::degrees(126.2), Angle::degrees(131), Angle::degrees(134.8), {}, 0, 0}};
  const std::string plot = limits_plot(heading, limits, bands);
  EXPECT_TRUE(has_text(plot,
                       "131.9\xC2\xB0 (126\xE2\x80\x93"
                       "135)"));
  EXPECT_TRUE(has_text(plot, "band, 5 to 95 %"));
  EXPECT_GT(elements_named(plot, "line").size(),
            elements_named(limits_plot(heading, limits), "line").size() + 4);
}

TEST(LimitsPlot, Stays_inside_its_canvas_for_many_motions_with_long_names) {
  std::vector<MotionLimit> limits;
  for (int i = 0; i < 40; ++i)
    limits.push_back(limit_of(std::string(200, 'W') + std::to_string(i), 360, LimitReason::end_of_range));
  expect_sober(limits_plot(heading, limits));
  expect_sober(limits_plot(heading, {}));
  expect_sober(limits_plot(heading, std::vector{limit_of("flexion", 0, LimitReason::contact_at_start)}));
}

MapPlot map_of(int columns, int rows, LimitReason kind) {
  MapPlot map{
      heading, "limit of internal rotation", "flexion, degrees", "adduction, degrees", {}, {}, {}, {}, {},
      {}};
  for (int i = 0; i < columns; ++i) map.x.push_back(10 * i - 20);
  for (int j = 0; j < rows; ++j) map.y.push_back(5 * j - 40);
  for (int k = 0; k < columns * rows; ++k) map.values.push_back(k), map.reasons.push_back(kind);
  return map;
}

TEST(MapPlot, Is_well_formed_for_every_shape_and_kind) {
  for (const LimitReason kind :
       {LimitReason::contact, LimitReason::end_of_range, LimitReason::contact_at_start})
    for (const int columns : {1, 2, 9})
      for (const int rows : {1, 2, 7}) {
        const std::string plot = map_plot(map_of(columns, rows, kind));
        expect_sober(plot);
        EXPECT_TRUE(has_text(plot, "limit of internal rotation, degrees") ||
                    kind == LimitReason::contact_at_start);
      }
}

TEST(MapPlot, Fills_the_whole_plane_with_its_lowest_band) {
  const std::string plot = map_plot(map_of(5, 4, LimitReason::contact));
  const auto bands = elements_named(plot, "path");
  ASSERT_GT(bands.size(), 3u);
  // The frame is 548 x 432 px from (92, 84); only its corners are left of the lowest band's outline.
  EXPECT_EQ(bands[0].attributes.at("d"), "M92,516 640,516 640,84 92,84Z");
  EXPECT_EQ(bands[0].attributes.at("fill"), "#440154");
}

TEST(MapPlot, Leaves_out_points_in_contact_at_the_start_and_says_so) {
  MapPlot map = map_of(5, 4, LimitReason::contact);
  EXPECT_FALSE(has_text(map_plot(map), "free nowhere"));
  map.reasons[0] = LimitReason::contact_at_start;
  map.values[0] = 1e9;  // not read
  const std::string plot = map_plot(map);
  EXPECT_TRUE(has_text(plot, "free nowhere"));
  EXPECT_EQ(elements_named(plot, "path")[0].attributes.at("d"), "M92,372 229,516 640,516 640,84 92,84Z");
}

TEST(MapPlot, Marks_points_not_free_at_the_start_and_islands_cell_by_cell) {
  MapPlot map = map_of(5, 4, LimitReason::contact);
  map.starts_in_contact.assign(20, false), map.has_islands.assign(20, false);
  EXPECT_EQ(map_plot(map), map_plot(map_of(5, 4, LimitReason::contact)));
  map.starts_in_contact[6] = map.starts_in_contact[7] = true;
  map.has_islands[19] = true;
  map.reasons[0] = LimitReason::end_of_range;
  const std::string plot = map_plot(map);
  EXPECT_TRUE(has_text(plot, "not free at the start"));
  EXPECT_TRUE(has_text(plot, "free again beyond contact"));
  const auto cells_of = [&](std::string_view paint) {
    auto cells = filled(plot, "rectangle", paint);
    return cells.empty() ? filled(plot, "rect", paint) : cells;
  };
  // Patterns in the order in which the plot makes them; one more rectangle each in the legend, where there is one.
  const auto end = cells_of("url(#hatch2)"), start = cells_of("url(#hatch3)"),
             islands = cells_of("url(#hatch4)");
  ASSERT_EQ(end.size(), 2u);
  ASSERT_EQ(start.size(), 2u);
  ASSERT_EQ(islands.size(), 2u);
  // Columns are 137 px apart from 92 on, rows 144 px from 516 upwards: half a cell at the corner, two cells inside.
  EXPECT_EQ(end[0].number("width"), 68.5);
  EXPECT_EQ(end[0].number("height"), 72);
  EXPECT_EQ(start[0].number("x"), 92 + 68.5);
  EXPECT_EQ(start[0].number("width"), 2 * 137);
  EXPECT_EQ(start[0].number("height"), 144);
  EXPECT_EQ(islands[0].number("y"), 84);
}

TEST(MapPlot, Has_no_colour_beyond_the_highest_value) {
  MapPlot map = map_of(9, 7, LimitReason::end_of_range);
  for (std::size_t i = 0; i < map.values.size(); ++i) map.values[i] = i % 9 == 0 ? 20 : 180;
  EXPECT_FALSE(has_text(map_plot(map), "200"));
  EXPECT_TRUE(has_text(map_plot(map), "180"));
}

TEST(ClockFace, Puts_twelve_on_top_and_three_to_the_right) {
  const std::vector<ClockContact> contacts{{"flexion", 0}, {"abduction", 3}, {"adduction", 7.5}};
  const std::string plot = clock_face_plot(heading, contacts);
  expect_sober(plot);
  const auto face = filled(plot, "circle", "#f7f7f7");
  auto marks = filled(plot, "circle", palette::blue);
  ASSERT_EQ(face.size(), 1u);
  ASSERT_EQ(marks.size(), 4u);  // one of them in the legend
  const double x = face[0].number("cx"), y = face[0].number("cy"), r = face[0].number("r");
  constexpr double written = 0.005 + 1e-9;  // px: two decimals
  EXPECT_NEAR(marks[0].number("cx"), x, written);
  EXPECT_NEAR(marks[0].number("cy"), y - r, written);
  EXPECT_NEAR(marks[1].number("cx"), x + r, written);
  EXPECT_NEAR(marks[1].number("cy"), y, written);
  EXPECT_NEAR(marks[2].number("cx"), x - r * std::numbers::sqrt2 / 2, written);
  EXPECT_NEAR(marks[2].number("cy"), y + r * std::numbers::sqrt2 / 2, written);
}

TEST(ClockFace, Names_hours_as_a_clock_does) {
  EXPECT_EQ(clock_text(0), "12:00");
  EXPECT_EQ(clock_text(1.5), "1:30");
  EXPECT_EQ(clock_text(11.999), "12:00");
  EXPECT_EQ(clock_text(9.1), "9:06");
}

RC_GTEST_PROP(ClockFace, Never_lets_two_labels_overlap, ()) {
  std::vector<ClockContact> contacts;
  const int count = *rc::gen::inRange(0, 30);
  for (int i = 0; i < count; ++i)
    contacts.push_back({"motion_number_" + std::to_string(i), *rc::gen::inRange(0, 120) / 10.0});
  struct Label {
    double y;
    std::string anchor;
  };
  std::vector<Label> labels;
  for (const SvgElement& text : elements_named(clock_face_plot(heading, contacts), "text"))
    if (text.text.find("Motion number") != text.text.npos)
      labels.push_back({text.number("y"), text.attributes.at("text-anchor")});
  RC_ASSERT(labels.size() == contacts.size());
  // Type of 12 px is no higher than 15 px with its descenders.
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (labels[i].anchor == labels[j].anchor) RC_ASSERT(std::abs(labels[i].y - labels[j].y) >= 15);
}

RC_GTEST_PROP(SpreadApart, Keeps_order_gap_and_bounds_and_no_other_heights_are_nearer, ()) {
  std::vector<double> wanted;
  const int count = *rc::gen::inRange(1, 8);
  for (int i = 0; i < count; ++i) wanted.push_back(*rc::gen::inRange(0, 100));
  std::sort(wanted.begin(), wanted.end());
  constexpr double gap = 10, low = 0, high = 100, rounding = 1e-9;
  const std::vector<double> heights = spread_apart(wanted, gap, low, high);
  RC_ASSERT(heights.size() == wanted.size());
  const auto allowed = [&](const std::vector<double>& h) {
    for (std::size_t i = 0; i < h.size(); ++i) {
      if (h[i] < low - rounding || h[i] > high + rounding) return false;
      if (i > 0 && h[i] - h[i - 1] < gap - rounding) return false;
    }
    return true;
  };
  const auto cost = [&](const std::vector<double>& h) {
    double sum = 0;
    for (std::size_t i = 0; i < h.size(); ++i) sum += (h[i] - wanted[i]) * (h[i] - wanted[i]);
    return sum;
  };
  RC_ASSERT(allowed(heights));
  // The problem is convex: what no shift of any run of neighbours betters is best of all.
  for (std::size_t first = 0; first < heights.size(); ++first)
    for (std::size_t last = first; last < heights.size(); ++last)
      for (const double shift : {-1.0, -0.01, 0.01, 1.0}) {
        std::vector<double> other = heights;
        for (std::size_t i = first; i <= last; ++i) other[i] += shift;
        RC_ASSERT(!allowed(other) || cost(other) >= cost(heights) - rounding);
      }
}

TEST(SpreadApart, Makes_the_gap_smaller_where_there_is_no_room) {
  const std::vector<double> wanted(11, 50.0);
  const std::vector<double> heights = spread_apart(wanted, 20, 0, 100);
  for (std::size_t i = 0; i < heights.size(); ++i)
    EXPECT_NEAR(heights[i], 10.0 * static_cast<double>(i), 1e-9);
  EXPECT_TRUE(spread_apart({}, 20, 0, 100).empty());
}

}  // namespace
}  // namespace condyle::test
