#include "io/result/plot_clock_face.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace condyle::io {
namespace {

constexpr double canvas_width = 800, heading_height = 84, footer_height = 70;
// px; the face is small enough that "Internal rotation at 90 deg flexion" has room beside it.
constexpr double radius = 120, label_size = 12, label_gap = 21, least_height = 320;
constexpr double elbow = 16;            // px, from the rim to the bend of a leader
constexpr double label_distance = 144;  // px, from the centre to the columns of labels
constexpr double margin = 8;            // px, kept free at the edges

ScreenPoint on_face(ScreenPoint centre, double distance, double hour) {
  const double angle = hour * (std::numbers::pi / 6);
  return {centre.x + distance * std::sin(angle), centre.y - distance * std::cos(angle)};
}

void draw_face(SvgCanvas& canvas, ScreenPoint centre) {
  canvas.circle(centre, radius, {.fill = "#f7f7f7", .stroke = palette::axis, .stroke_width = 2});
  for (int hour = 1; hour <= 12; ++hour) {
    canvas.line(on_face(centre, radius - 8, hour), on_face(centre, radius, hour),
                {.stroke = palette::axis, .stroke_width = 1.5});
    const ScreenPoint at = on_face(centre, radius - 22, hour);
    canvas.text({at.x, at.y + 5}, fmt::format("{}", hour), {.size = 14, .anchor = TextAnchor::middle});
  }
  const auto direction = [&](double dx, double dy, std::string_view word, TextAnchor anchor) {
    canvas.text({centre.x + dx, centre.y + dy + 4}, word,
                {.size = 12, .colour = palette::quiet_text, .anchor = anchor});
  };
  direction(0, -radius + 42, "superior", TextAnchor::middle);
  direction(0, radius - 42, "inferior", TextAnchor::middle);
  direction(radius - 40, 0, "anterior", TextAnchor::end);
  direction(-radius + 40, 0, "posterior", TextAnchor::start);
}

void draw_mark(SvgCanvas& canvas, ScreenPoint at, ContactKind kind) {
  const auto [x, y] = at;
  if (kind == ContactKind::bearing)
    canvas.polygon({{x - 7.5, y}, {x, y - 7.5}, {x + 7.5, y}, {x, y + 7.5}},
                   {.fill = palette::orange, .stroke = palette::paper, .stroke_width = 1.2});
  else
    canvas.circle(at, 6.5, {.fill = palette::blue, .stroke = palette::paper, .stroke_width = 1.2});
}

/// Labels of one half of the face, from top to bottom.
struct Half {
  std::vector<const ClockContact*> contacts;
  double side;  ///< +1 right, -1 left
};

std::vector<double> heights(const Half& half, ScreenPoint centre) {
  std::vector<double> heights;
  for (const ClockContact* contact : half.contacts)
    heights.push_back(on_face(centre, radius + elbow, contact->hour).y);
  return heights;
}

void draw_labels(SvgCanvas& canvas, const Half& half, ScreenPoint centre, double low, double high) {
  const std::vector<double> at = spread_apart(heights(half, centre), label_gap, low, high);
  const double label_x = centre.x + half.side * label_distance;
  const double room = canvas_width / 2 - label_distance - 6 - margin;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const ClockContact& contact = *half.contacts[i];
    const std::vector<ScreenPoint> leader{on_face(centre, radius, contact.hour),
                                          on_face(centre, radius + elbow, contact.hour),
                                          {label_x, at[i]}};
    canvas.polyline(leader, {.stroke = palette::grey, .stroke_width = 0.8});
    const std::string hour = clock_text(contact.hour) + " ";
    const std::string name =
        text_within(readable_name(contact.motion), label_size, room - text_width(hour, label_size));
    canvas.text({label_x + half.side * 6, at[i] + label_size / 3}, hour + name,
                {.size = label_size, .anchor = half.side > 0 ? TextAnchor::start : TextAnchor::end});
  }
}

}  // namespace

std::string clock_text(double hour) {
  const long minutes = std::lround(hour * 60) % 720;
  return fmt::format("{}:{:02}", minutes < 60 ? 12 : minutes / 60, minutes % 60);
}

std::vector<double> spread_apart(std::span<const double> wanted, double gap, double low, double high) {
  if (wanted.empty()) return {};
  const auto count = static_cast<double>(wanted.size());
  if (count > 1) gap = std::min(gap, (high - low) / (count - 1));
  // With i gaps taken off the i-th height, "at least a gap apart" becomes "not descending": pooled means.
  struct Pool {
    double sum;
    double size;
    double mean() const noexcept { return sum / size; }
  };
  std::vector<Pool> pools;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    pools.push_back({wanted[i] - gap * static_cast<double>(i), 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean() > pools.back().mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum, pools.back().size += last.size;
    }
  }
  std::vector<double> heights;
  for (const Pool& pool : pools)
    for (double k = 0; k < pool.size; ++k) {
      const double base = std::clamp(pool.mean(), low, std::max(low, high - gap * (count - 1)));
      heights.push_back(base + gap * static_cast<double>(heights.size()));
    }
  return heights;
}

std::string clock_face_plot(const PlotHeading& heading, std::span<const ClockContact> contacts) {
  Half right{{}, 1}, left{{}, -1};
  for (const ClockContact& contact : contacts) (contact.hour < 6 ? right : left).contacts.push_back(&contact);
  // Top to bottom: hours rise on the right and fall on the left.
  std::stable_sort(right.contacts.begin(), right.contacts.end(),
                   [](const auto* a, const auto* b) { return a->hour < b->hour; });
  std::stable_sort(left.contacts.begin(), left.contacts.end(),
                   [](const auto* a, const auto* b) { return a->hour > b->hour; });

  const auto most = static_cast<double>(std::max(right.contacts.size(), left.contacts.size()));
  const double height = std::max(least_height, label_gap * (most + 1));
  SvgCanvas canvas(canvas_width, heading_height + height + footer_height,
                   heading.joint + ": " + heading.subject);
  draw_heading(canvas, heading);
  const ScreenPoint centre{canvas_width / 2, heading_height + height / 2};
  draw_face(canvas, centre);
  for (const Half* half : {&right, &left})
    draw_labels(canvas, *half, centre, heading_height + label_gap / 2,
                heading_height + height - label_gap / 2);
  for (const ClockContact& contact : contacts)
    draw_mark(canvas, on_face(centre, radius, contact.hour), contact.kind);
  if (contacts.empty())
    canvas.text({centre.x, centre.y + 5}, "no contact", {.size = 15, .anchor = TextAnchor::middle});

  const double legend_y = heading_height + height + 22;
  const auto shown = [&](ContactKind kind) {
    return std::any_of(contacts.begin(), contacts.end(),
                       [&](const ClockContact& c) { return c.kind == kind; });
  };
  double legend_x = canvas_width / 2 - 230;
  const auto legend = [&](ContactKind kind, std::string_view words) {
    if (!shown(kind)) return;
    draw_mark(canvas, {legend_x, legend_y}, kind);
    canvas.text({legend_x + 14, legend_y + 4}, words, {.size = 12});
    legend_x += 260;
  };
  legend(ContactKind::impingement, "impingement");
  legend(ContactKind::unknown, "contact");
  legend(ContactKind::bearing, "bearing contact");
  draw_footer(canvas);
  return canvas.document();
}

}  // namespace condyle::io
