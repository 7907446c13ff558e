#pragma once

#include <span>
#include <string>

#include "answer/records/limit_box_record.hpp"
#include "condyle/answer/range.hpp"
#include "io/result/result_of.hpp"

/// Results of `condyle rom`, as text for people and for programs. Every key, column, unit and sign is in
/// docs/formats-rom.md.

namespace condyle::io {

/// The limits of a joint and what they must be read with. Its joint is that of the answer, which may be held at a translation.
struct RomResult : ResultOf<RangeAnswer> {
  const LimitBoxRecord* box = nullptr;  ///< of limits for other programs
};

/// Shows an answer, with what looks wrong with its joint. `from`, which may be null, gets the frame of a joint that is held at a translation.
RomResult rom_result_of(const RangeAnswer& answer, std::span<const JointNote> notes, Provenance* from);

/// The frame in which it gives points and meshes.
AnswerFrame frame_of(const RomResult& result);

/// The summary as JSON text, with a newline at its end.
std::string rom_json(const RomResult& result);

/// The answer, within 24 lines of a hip (26 with bands), or with all that stands in the files too.
enum class TextForm { brief, whole };

/// A table for people, one line per motion, then what the map comes to.
std::string rom_text(const RomResult& result, TextForm form = TextForm::brief);

/// One line per motion, with a header line; numbers to the last bit.
std::string rom_csv(const RomResult& result);

}  // namespace condyle::io
