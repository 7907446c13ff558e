#include "io/study/study_inputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <utility>

#include "condyle/error.hpp"
#include "core/parallel_tasks.hpp"
#include "io/file/words.hpp"
#include "io/mesh/parse.hpp"
#include "io/study/json_digest.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

/// The path from the folder where it begins with that, else from the root; an environment variable's name as it is.
fs::path path_below(const fs::path& folder, const Input& input) {
  if (input.kind == Input::Kind::variable) return input.path;
  auto [of_folder, of_path] =
      std::mismatch(folder.begin(), folder.end(), input.path.begin(), input.path.end());
  if (of_folder != folder.end() || of_path == input.path.end()) return fs::absolute(input.path);
  fs::path rest;
  for (; of_path != input.path.end(); ++of_path) rest /= *of_path;
  return rest;
}

fs::path path_in(const fs::path& folder, const Input& input) {
  return input.kind == Input::Kind::variable ? input.path : folder / input.path;
}

/// Each input once, in the order in which rows read them.
struct GatheredInputs {
  StudyInputs inputs;
  std::map<std::pair<Input::Kind, fs::path>, std::size_t> places;

  std::size_t place_of(Input input) {
    const auto [place, is_new] = places.emplace(std::pair(input.kind, input.path), inputs.all.size());
    if (is_new)
      inputs.all.push_back(std::move(input));
    else if (Input& before = inputs.all[place->second]; before.state != input.state)
      before.state = changing_state;
    return place->second;
  }
};

}  // namespace

StudyInputs StudyInputs::now(const fs::path& folder) const {
  StudyInputs inputs = *this;
  core::parallel_tasks(inputs.all.size(), [&](std::size_t i) {
    Input& input = inputs.all[i];
    input.state = state_now(input.kind, path_in(folder, input));
  });
  return inputs;
}

StudyInputs study_inputs(const fs::path& folder, std::span<const std::vector<Input>> of_rows) {
  GatheredInputs gathered;
  for (const std::vector<Input>& of_row : of_rows) {
    std::vector<std::size_t>& places = gathered.inputs.of_rows.emplace_back();
    for (const Input& input : of_row)
      places.push_back(gathered.place_of({input.kind, path_below(folder, input), input.state}));
  }
  return std::move(gathered.inputs);
}

StudyInputs joined(std::span<const StudyInputs> shards) {
  GatheredInputs gathered;
  for (const StudyInputs& shard : shards) {
    std::vector<std::size_t> moved;
    for (const Input& input : shard.all) moved.push_back(gathered.place_of(input));
    for (const std::vector<std::size_t>& of_row : shard.of_rows) {
      std::vector<std::size_t>& places = gathered.inputs.of_rows.emplace_back();
      for (const std::size_t place : of_row) places.push_back(moved[place]);
    }
  }
  return std::move(gathered.inputs);
}

std::string inputs_sha256(const StudyRow& row, std::span<const Input> inputs) {
  std::vector<std::string> files;
  for (const Input& input : inputs)
    if (input.kind == Input::Kind::file) files.push_back(input.state);
  return sha256_of(nlohmann::json{row.fields, files});
}

Json inputs_json(const StudyInputs& inputs) {
  Json json{{"read", Json::array()}, {"of_rows", Json::array()}};
  for (const Input& input : inputs.all) json["read"].push_back(text_of(input));
  for (const std::vector<std::size_t>& places : inputs.of_rows)
    json["of_rows"].push_back(fmt::format("{}", fmt::join(places, " ")));
  return json;
}

StudyInputs inputs_in(const Json& json) {
  const auto require = [](bool is_well) {
    if (!is_well) throw FileError("inputs: not as they are written");
  };
  StudyInputs inputs;
  for (const Json& text : json.at("read")) {
    auto input = input_in(text.get_ref<const std::string&>());
    require(input.has_value());
    inputs.all.push_back(*std::move(input));
  }
  for (const Json& text : json.at("of_rows")) {
    std::vector<std::size_t>& places = inputs.of_rows.emplace_back();
    for (const std::string_view word : words_of(text.get_ref<const std::string&>())) {
      std::size_t place = 0;
      require(parse_number(word, place) && place < inputs.all.size());
      places.push_back(place);
    }
  }
  return inputs;
}

void check_unchanged(std::span<const Input> inputs, const fs::path& folder, const std::string& shard) {
  std::vector<char> is_other(inputs.size());
  core::parallel_tasks(inputs.size(), [&](std::size_t i) {
    if (inputs[i].kind != Input::Kind::file) return;
    const std::string now = state_now(Input::Kind::file, path_in(folder, inputs[i]));
    is_other[i] = is_digest(now) && now != inputs[i].state;
  });
  const auto other = std::find(is_other.begin(), is_other.end(), true);
  if (other == is_other.end()) return;
  const Input& input = inputs[static_cast<std::size_t>(other - is_other.begin())];
  throw FileError(fmt::format("{}: is another since {} was computed: run that shard again",
                              path_in(folder, input).string(), shard));
}

}  // namespace condyle::io
