#include "io/study/answered_rows.hpp"

#include <fstream>
#include <map>
#include <utility>

#include "io/file/file_calls.hpp"
#include "io/result/json.hpp"
#include "io/study/json_digest.hpp"
#include "io/study/study_inputs.hpp"

namespace condyle::io {

namespace fs = std::filesystem;

AnsweredRows::AnsweredRows(const fs::path& folder, const fs::path& table, std::span<const StudyRow> rows,
                           std::string common)
    : file_(folder / ".condyle-rows"),
      table_folder_(table.parent_path()),
      common_(std::move(common)),
      earlier_(rows.size()) {
  read(rows);
}

std::string AnsweredRows::key_of(const StudyRow& row) const {
  return sha256_of({common_, row.number, row.line, row.fields});
}

void AnsweredRows::read(std::span<const StudyRow> rows) {
  std::ifstream lines(file_, std::ios::binary);
  if (!lines) return;
  std::map<std::string, std::size_t> place_of;
  for (std::size_t i = 0; i < rows.size(); ++i) place_of[key_of(rows[i])] = i;
  std::vector<std::vector<Input>> inputs(rows.size());
  for (std::string line; std::getline(lines, line);) {
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded()) continue;
    const auto text_of = [&](const char* key) { return json.at(key).get<std::string>(); };
    const auto place = place_of.find(text_of("row"));
    if (place == place_of.end()) continue;
    StudyAnswer answer{text_of("limits"), text_of("hip"), text_of("failure"), {}};
    for (const Json& read : json.at("read")) {
      Input input = input_in(read.get_ref<const std::string&>()).value();
      if (input.kind != Input::Kind::variable) input.path = table_folder_ / input.path;
      answer.inputs.push_back(std::move(input));
    }
    inputs[place->second] = answer.inputs;
    earlier_[place->second] = std::move(answer);
  }
  // Each file is read once, however many rows have it.
  const StudyInputs before = study_inputs(table_folder_, inputs), now = before.now(table_folder_);
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const std::size_t place : before.of_rows[i])
      if (now.all[place] != before.all[place]) earlier_[i].reset();
}

void AnsweredRows::add(const StudyRow& row, const StudyAnswer& answer) {
  Json json{
      {"row", key_of(row)}, {"limits", answer.limits}, {"hip", answer.hip}, {"failure", answer.failure}};
  json["read"] = Json::array();
  for (const Input& input : study_inputs(table_folder_, {&answer.inputs, 1}).all)
    json["read"].push_back(text_of(input));
  std::string line;
  try {
    line = json.dump();
  } catch (const Json::exception&) {
    return;  // a path that is no UTF-8
  }
  line = "\n" + line + "\n";  // the line before may have been broken off
  const std::lock_guard lock(mutex_);
  std::ofstream(file_, std::ios::binary | std::ios::app)
      .write(line.data(), static_cast<std::streamsize>(line.size()));
}

void AnsweredRows::remove() const noexcept {
  remove_file(file_);
}

}  // namespace condyle::io
