#pragma once

#include <optional>
#include <string>

#include "condyle/answer/case.hpp"
#include "io/result/json.hpp"

/// How a pose stands to the limits, in the words of every command and of the page.

namespace condyle::io {

/// "bearing contact, ends no motion", "at the limit of internal rotation".
std::string state_words(const PoseStanding& standing, Anatomy joint);
/// And, of contact that nothing distinguishes, why.
std::string state_text(const PoseStanding& standing, Anatomy joint);
/// "7.6 degrees of internal rotation to the nearest limit"; empty beyond one and if there is none.
std::string to_limit_text(const PoseStanding& standing, Anatomy joint);
/// Adds `state`, `state_unknown_why`, `nearest_limit` and `clearance_mm`; null where they are not known.
void add_standing(Json& json, const std::optional<PoseStanding>& standing, Anatomy joint);

}  // namespace condyle::io
