#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "io/result/plot_axes.hpp"
#include "io/result/svg_canvas.hpp"
#include "plot_svg_elements.hpp"

namespace condyle::test {
namespace {

using namespace io;

TEST(SvgNumber, Has_at_most_two_decimals_and_no_negative_zero) {
  EXPECT_EQ(svg_number(3), "3");
  EXPECT_EQ(svg_number(-0.004), "0");
  EXPECT_EQ(svg_number(-0.0), "0");
  EXPECT_EQ(svg_number(12.5), "12.5");
  EXPECT_EQ(svg_number(100), "100");
  EXPECT_EQ(svg_number(-1.005e3), "-1005");
  EXPECT_EQ(svg_number(0.126), "0.13");
}

TEST(XmlEscaped, Keeps_text_and_replaces_what_no_document_may_hold) {
  EXPECT_EQ(xml_escaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
  EXPECT_EQ(xml_escaped("Hüftgelenk 90°"), "Hüftgelenk 90°");
  const std::string unknown = "\xEF\xBF\xBD";
  EXPECT_EQ(xml_escaped(std::string_view("a\0b", 3)), "a" + unknown + "b");
  EXPECT_EQ(xml_escaped("\x1b[0m"), unknown + "[0m");
  EXPECT_EQ(xml_escaped("\xff"), unknown);
  EXPECT_EQ(xml_escaped("\xc3"), unknown);                              // ends in the middle
  EXPECT_EQ(xml_escaped("\xc0\xaf"), unknown + unknown);                // overlong
  EXPECT_EQ(xml_escaped("\xed\xa0\x80"), unknown + unknown + unknown);  // surrogate
  EXPECT_EQ(xml_escaped("\xef\xbf\xbf"), unknown);                      // U+FFFF
}

RC_GTEST_PROP(SvgCanvas, Is_well_formed_whatever_bytes_the_words_hold, (const std::string& words)) {
  SvgCanvas canvas(100, 50, words);
  canvas.text({1, 2}, words);
  canvas.line({0, 0}, {1, 1}, {.stroke = "#000000"});
  const auto elements = svg_elements(canvas.document());
  RC_ASSERT(!elements.empty());
  RC_ASSERT(elements.front().name == "svg");
  RC_ASSERT(elements.back().name == "line");
}

TEST(SvgCanvas, Says_its_size_as_a_view_box_and_paints_in_order) {
  SvgCanvas canvas(800, 600.5, "A & B");
  canvas.circle({1, 2}, 3, {.fill = "#0072b2"});
  const std::string hatch = canvas.hatch("#ffffff");
  canvas.rectangle({4, 5}, 6, 7, {.fill = hatch});
  const auto elements = svg_elements(canvas.document());
  ASSERT_FALSE(elements.empty());
  EXPECT_EQ(elements[0].attributes.at("viewBox"), "0 0 800 600.5");
  EXPECT_EQ(elements_named(canvas.document(), "title").at(0).text, "A & B");
  EXPECT_EQ(elements.back().name, "rect");
  const auto pattern = elements_named(canvas.document(), "pattern");
  ASSERT_EQ(pattern.size(), 1u);
  EXPECT_EQ(hatch, "url(#" + pattern[0].attributes.at("id") + ")");
}

TEST(SvgCanvas, Draws_nothing_for_no_points) {
  SvgCanvas canvas(10, 10, "");
  const std::string before = canvas.document();
  canvas.polyline({}, {});
  canvas.polygon({}, {});
  canvas.region({}, {});
  EXPECT_EQ(canvas.document(), before);
}

TEST(TextWithin, Cuts_to_the_width_between_characters) {
  const std::string name = "Äußere Drehung über 90° hinaus";
  for (double width = 20; width < 400; width += 7) {
    const std::string cut = text_within(name, 13, width);
    EXPECT_LE(text_width(cut, 13), width);
    EXPECT_EQ(xml_escaped(cut), cut) << "cut inside a character";
  }
  EXPECT_EQ(text_within(name, 13, 1000), name);
}

TEST(Ticks, Are_the_multiples_of_the_step_with_both_ends) {
  EXPECT_EQ(ticks(-20, 120, 20), (std::vector<double>{-20, 0, 20, 40, 60, 80, 100, 120}));
  EXPECT_EQ(ticks(-17, 17, 15), (std::vector<double>{-15, 0, 15}));
  EXPECT_EQ(ticks(0.1, 0.3, 0.1).size(), 3u);  // 3 * 0.1 is just above 0.3
  EXPECT_EQ(tick_text(-20, 20),
            "\xE2\x88\x92"
            "20");
  EXPECT_EQ(tick_text(-0.0, 20), "0");
  EXPECT_EQ(tick_text(0.5, 0.1), "0.5");
}

RC_GTEST_PROP(Ticks, Never_make_more_steps_than_asked_nor_fewer_than_a_third, ()) {
  const double span = *rc::gen::inRange(1, 4000) / 10.0;
  const int steps = *rc::gen::inRange(4, 13);
  const double step = tick_step(span, steps);
  RC_ASSERT(span / step <= steps + 1e-9);
  RC_ASSERT(span / step >= steps / 3.0);
}

TEST(ReadableName, Is_what_a_clinician_says) {
  EXPECT_EQ(readable_name("fadir"), "FADIR");
  EXPECT_EQ(readable_name("internal_rotation"), "Internal rotation");
  EXPECT_EQ(readable_name("abduction_at_90_flexion"), "Abduction at 90° flexion");
  EXPECT_EQ(readable_name(""), "");
}

TEST(SequentialColour, Runs_between_its_ends_and_stays_there) {
  EXPECT_EQ(sequential_colour(0), "#440154");
  EXPECT_EQ(sequential_colour(1), "#fde725");
  EXPECT_EQ(sequential_colour(-1), sequential_colour(0));
  EXPECT_EQ(sequential_colour(2), sequential_colour(1));
  EXPECT_EQ(sequential_colour(0.5), "#21908d");
}

}  // namespace
}  // namespace condyle::test
