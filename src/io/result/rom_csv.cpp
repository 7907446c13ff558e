#include "io/result/limit_fields.hpp"
#include "io/result/provenance_forms.hpp"
#include "io/result/rom_result.hpp"

namespace condyle::io {
namespace {

bool has_columns(const LimitField& field, const Joint& joint) {
  switch (field.joints) {
    case LimitJoints::all:
      return true;
    case LimitJoints::hips:
      return joint.is_hip();
    case LimitJoints::shoulders:
      return joint.anatomy == Anatomy::shoulder;
  }
  return false;
}

}  // namespace

std::string rom_csv(const RomResult& result) {
  std::vector<const LimitField*> fields;
  for (const LimitField& field : io::limit_fields())
    if (has_columns(field, result.joint)) fields.push_back(&field);

  std::vector<std::string> line;
  for (const auto* field : fields)
    for (ResultColumn& column : io::columns_of(*field, result.joint.anatomy))
      line.push_back(std::move(column.name));
  std::string text = io::provenance_comments(result.provenance) + io::csv_line(line);
  for (std::size_t i = 0; i < result.answer.limits.size(); ++i) {
    line.clear();
    for (const auto* field : fields) io::append_texts(line, *field, {result, i});
    text += io::csv_line(line);
  }
  return text;
}

}  // namespace condyle::io
