#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "condyle/inspect.hpp"
#include "io/joint/proposal.hpp"

/// The lines of a proposed joint file that are the same for every joint.

namespace condyle::io {

/// As TOML writes it, whatever it holds.
std::string toml_text(std::string_view text);

std::string toml_vector(const Vec3& v);

/// Writes lines of a joint file: keys that were inferred, and the other keys as comments.
class ProposalLines {
 public:
  void add(const std::string& line) { text_ += line + "\n"; }
  void key(std::string_view key, const std::string& value, const std::string& evidence) {
    add(fmt::format("{} = {}  # {}", key, value, evidence));
  }
  void missing(std::string_view key, std::string_view choices, const std::string& why) {
    add(fmt::format("# {} = {}  # to fill in: {}", key, choices, why));
    to_fill_in_.push_back(fmt::format("{}: {}", key, why));
  }

  void evidence(const std::string& line) {
    add("# " + line);
    evidence_.push_back(line);
  }

  std::string units_note;

  JointProposal proposal(std::optional<Side> side) && {
    return {std::move(text_), std::move(to_fill_in_), side, std::move(evidence_), std::move(units_note)};
  }

 private:
  std::string text_;
  std::vector<std::string> to_fill_in_, evidence_;
};

/// The comment above the file, its version and the joint's name.
void add_head(ProposalLines& lines, const ProposedBody& fixed, const ProposedBody& mobile,
              const ProposalFacts& facts);

/// `units` is empty if nothing speaks for one unit. A unit that was inferred and is not millimetres is noted.
void add_units(ProposalLines& lines, const std::optional<Stated<LengthUnit>>& units,
               const ProposedBody& fixed, const ProposedBody& mobile);

/// [fixed.image]: every bit, as the planes of the cuts must hold the vertices on them.
void add_image(ProposalLines& lines, std::string_view role, const std::optional<BodyImage>& image);

/// [fixed] or [mobile], and its image.
void add_body(ProposalLines& lines, std::string_view role, const ProposedBody& body,
              const std::filesystem::path& joint_file);

}  // namespace condyle::io
