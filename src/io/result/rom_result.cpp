#include "io/result/rom_result.hpp"

namespace condyle::io {

RomResult rom_result_of(const RangeAnswer& answer, std::span<const JointNote> notes, Provenance* from) {
  if (from && answer.held_translation_mm) from->frame = from->frame.of_held(*answer.held_translation_mm);
  return {{answer.joint, answer, notes, from}, nullptr};
}

AnswerFrame frame_of(const RomResult& result) {
  if (result.provenance) return result.provenance->frame;
  return AnswerFrame{}.of_held(result.answer.held_translation_mm.value_or(Vec3::Zero()));
}

}  // namespace condyle::io
