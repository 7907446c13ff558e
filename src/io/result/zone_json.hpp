#pragma once

#include <optional>

#include "condyle/impingement_zone.hpp"
#include "condyle/io/provenance.hpp"
#include "io/result/json.hpp"

namespace condyle::io {

/// An impingement zone under the keys of docs/formats-rom.md, its points in the frame of the answer; null if there is none.
Json zone_json(const std::optional<motion::ImpingementZone>& zone, const AnswerFrame& frame);

}  // namespace condyle::io
