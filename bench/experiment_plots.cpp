#include "experiment_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/file/whole_file.hpp"
#include "log_plot.hpp"

namespace bench {
namespace {

constexpr std::string_view growth_family = "sample bones", accuracy_scene = "libhip_2";

bool is_of_family(std::string_view scene, std::string_view family) {
  return std::any_of(scene_names().begin(), scene_names().end(),
                     [&](const SceneName& name) { return name.name == scene && name.family == family; });
}

/// One per method with outcomes that `point` makes something of, in the order of the methods.
template <class Point>
std::vector<Series> series_of(const ExperimentResult& result, const Point& point) {
  std::vector<Series> all;
  for (const MethodGroup& group : method_groups()) {
    for (const MethodKind& kind : group.kinds) {
      Series series{kind.title, kind.family, {}};
      for (const Outcome& outcome : result.outcomes)
        if (outcome.method == kind.name)
          if (const auto made = point(outcome)) series.points.push_back(*made);
      if (!series.points.empty()) all.push_back(std::move(series));
    }
  }
  return all;
}

std::string asked(Question question) {
  switch (question) {
    case Question::touch:
      return "Do the bodies touch?";
    case Question::pairs:
      return "Which triangles intersect?";
    case Question::inside:
      return "Which vertices are inside, where, how deep?";
  }
  return "";
}

LogPlot cost_plot(const ExperimentResult& result, Question question) {
  LogPlot plot{.title = asked(question),
               .subtitle = "Cost against size: sample hip, scenarios 1 to 4; one thread",
               .x_label = "triangles of the fixed body",
               .y_label = "ms per pose",
               .series = {},
               .zero_label = ""};
  plot.series = series_of(result, [&](const Outcome& o) -> std::optional<SizeAndCost> {
    if (o.question != question || o.is_deformed || !is_of_family(o.scene, growth_family)) return std::nullopt;
    return SizeAndCost{static_cast<double>(o.fixed_triangles), o.query.mean * 1e3};
  });
  for (Series& series : plot.series)
    if (const auto exponent = fitted_exponent(series.points))
      series.label += fmt::format("  ({:.2f})", *exponent);
  return plot;
}

/// Wrong answers over those that a method could get wrong.
double share_wrong(const Outcome& o) {
  const auto share = [](std::int64_t wrong, std::int64_t all) {
    return static_cast<double>(wrong) / static_cast<double>(std::max<std::int64_t>(all, 1));
  };
  if (o.inside) return share(o.inside->false_inside + o.inside->false_outside, o.inside->inside);
  if (o.pairs) return share(o.pairs->missed + o.pairs->invented, o.pairs->pairs);
  return o.touch ? share(o.touch->missed + o.touch->invented, o.touch->poses) : 0;
}

std::string wrong_label(Question question) {
  switch (question) {
    case Question::touch:
      return "wrong answers per pose";
    case Question::pairs:
      return "missed and invented pairs per true pair";
    case Question::inside:
      return "wrong vertices per vertex truly inside";
  }
  return "";
}

LogPlot accuracy_plot(const ExperimentResult& result, Question question) {
  LogPlot plot{.title = asked(question),
               .subtitle = "Wrong answers against cost: real bones 2; one thread",
               .x_label = "ms per pose",
               .y_label = wrong_label(question),
               .series = {},
               .zero_label = "none"};
  plot.series = series_of(result, [&](const Outcome& o) -> std::optional<SizeAndCost> {
    if (o.question != question || o.is_deformed || o.scene != accuracy_scene) return std::nullopt;
    return SizeAndCost{o.query.mean * 1e3, share_wrong(o)};
  });
  return plot;
}

/// A plot on which nobody is wrong shows nothing.
bool has_any_cost(const LogPlot& plot) {
  return std::any_of(plot.series.begin(), plot.series.end(), [](const Series& series) {
    return std::any_of(series.points.begin(), series.points.end(),
                       [](const SizeAndCost& point) { return point.cost > 0; });
  });
}

}  // namespace

void write_plots(const ExperimentResult& result, const std::filesystem::path& folder) {
  for (const Question question : {Question::touch, Question::pairs, Question::inside}) {
    const std::pair<std::string_view, LogPlot> plots[] = {{"cost", cost_plot(result, question)},
                                                          {"accuracy", accuracy_plot(result, question)}};
    for (const auto& [name, plot] : plots)
      if (has_any_cost(plot))
        condyle::io::write_whole_file(folder / fmt::format("{}_{}.svg", name, name_of(question)),
                                      svg_text(plot));
  }
}

}  // namespace bench
