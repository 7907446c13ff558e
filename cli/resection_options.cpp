#include "resection_options.hpp"

#include <CLI/App.hpp>
#include <CLI/CLI.hpp>

#include "choice.hpp"
#include "condyle/error.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
namespace {

double fixed_share(const ResectionArguments& given) {
  if (given.share && given.from != "both") throw UsageError("--share: only with --from both");
  if (given.from == "both") return given.share.value_or(0.5);
  return given.from == "fixed" ? 1 : 0;
}

}  // namespace

void add_cut(CLI::App& command, ResectionArguments& given, CLI::Option* targets) {
  const auto add = [&](CLI::Option* option, const char* value) {
    option->option_text(value)->needs(targets);
  };
  add(command
          .add_option("--from", given.from,
                      "Cut this body: the moving one, the one that stays, as at a socket's rim, or both")
          ->check(CLI::IsMember({"mobile", "fixed", "both"})),
      "mobile|fixed|both (mobile)");
  add(command.add_option("--share", given.share,
                         "With --from both: cut the fixed body for this share of the depth, 0 to 1"),
      "SHARE (0.5)");
  add(command.add_option(
          "--margin", given.margin_mm,
          "Keep the remaining bone clear of the other bone's surface moved outwards by this, 0 to 10"),
      "MM");
  add(command.add_option("--burr", given.burr_mm,
                         "Leave a surface that a ball of this diameter can make, 0.5 to 30: no groove is "
                         "narrower, and the answer reports the bone that goes only for that"),
      "MM");
  add(command.add_option("--deepest", given.deepest_mm, "Remove no more than this anywhere"), "MM");
  add(command.add_option("--within", given.within_mm,
                         "Keep bone farther than this outside the ball of the bearing surface, the head's "
                         "radius and margin: the head-neck junction is its border"),
      "MM");
  add(command.add_option("--edge", given.edge_mm, "Make triangles around the cut this small, 0.05 to 10"),
      "MM (0.5)");
}

CLI::Option* add_confidence(CLI::App& command, ResectionArguments& given) {
  return add_value(command, "--confidence", given.confidence, "SHARE (0.5)",
                   "Plan with the margin with which each target is reached in this share of the varied "
                   "joints of the band, above 0 and below 1");
}

std::optional<double> confidence_of(const ResectionArguments& given,
                                    const std::optional<BandRequest>& bands) {
  if (given.confidence && !bands)
    throw UsageError("--confidence: is a share of varied joints, and there are none");
  return given.margin_mm ? std::nullopt
                         : std::optional(given.confidence.value_or(*ResectionRequest{}.confidence));
}

CLI::Option* add_curve(CLI::App& command, std::size_t& points) {
  return add_value(command, "--curve", points, "N (10)",
                   "Points on the curve of degrees against mm3 for each target; 0 for none, each costs a cut")
      ->check(whole_number(0, 1000));
}

HelpGroup resection_group() {
  return {"Bone that must go",
          {"--from", "--share", "--margin", "--burr", "--deepest", "--within", "--edge"}};
}

plan::ResectionOptions resection_request_of(const ResectionArguments& given) {
  const plan::KeptBone kept{given.deepest_mm, given.within_mm, {}};
  plan::ResectionOptions request;
  request.fixed_share = fixed_share(given);
  request.mobile = kept;
  request.fixed = kept;
  request.margin_mm = given.margin_mm.value_or(0);
  request.burr_mm = given.burr_mm;
  request.edge_mm = given.edge_mm;
  return request;
}

}  // namespace condyle::cli
