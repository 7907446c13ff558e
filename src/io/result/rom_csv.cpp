#include "answer/records/limit_record.hpp"
#include "io/record/table_of.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_result.hpp"

namespace condyle::io {

std::string rom_csv(const RomResult& result) {
  const Joint& joint = result.joint;
  const auto shown = [&](const FieldColumn& column) {
    return column.joints == TablesOf::all || (column.joints == TablesOf::hips && joint.is_hip()) ||
           (column.joints == TablesOf::shoulders && joint.anatomy == Anatomy::shoulder);
  };
  std::vector<std::string> cells;
  for (ResultColumn& column : columns_of<LimitRecord>(joint.anatomy, shown))
    cells.push_back(std::move(column.name));
  std::string text = provenance_comments(result.provenance, result.notes) + csv_line(cells);
  const AnswerFrame frame = frame_of(result);
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    cells.clear();
    append_cells(cells, limit_record(result.answer, i), {frame, joint.anatomy}, shown);
    text += csv_line(cells);
  }
  return text;
}

}  // namespace condyle::io
