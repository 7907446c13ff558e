#include "io/file/input_recorder.hpp"

#include <algorithm>
#include <array>

namespace condyle::io {
namespace {

thread_local InputRecorder* current_recorder = nullptr;

constexpr std::array<std::string_view, 4> kind_words = {"file", "entry", "names", "variable"};

/// The first word, taken off with the blank behind it.
std::string_view word_off(std::string_view& text) noexcept {
  const std::size_t end = std::min(text.find(' '), text.size());
  const std::string_view word = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

}  // namespace

std::string text_of(const Input& input) {
  return std::string(kind_words[static_cast<std::size_t>(input.kind)]) + " " + input.state + " " +
         input.path.string();
}

std::optional<Input> input_in(std::string_view text) {
  const std::string_view kind = word_off(text), state = word_off(text);
  const auto word = std::find(kind_words.begin(), kind_words.end(), kind);
  if (word == kind_words.end() || state.empty() || text.empty()) return std::nullopt;
  return Input{static_cast<Input::Kind>(word - kind_words.begin()), std::filesystem::path(text),
               std::string(state)};
}

InputRecorder::InputRecorder(Digests digests) : digests_(digests), outer_(current_recorder) {
  current_recorder = this;
}

InputRecorder::~InputRecorder() {
  current_recorder = outer_;
}

std::vector<Input> InputRecorder::inputs() const {
  const std::lock_guard lock(mutex_);
  std::vector<Input> all = recorded_.inputs;
  // That a file is there goes without saying if it was read.
  std::erase_if(all, [&](const Input& input) {
    return input.kind == Input::Kind::entry && place_of_.contains({Input::Kind::file, input.path});
  });
  return all;
}

std::optional<std::string> InputRecorder::passing_failure() const {
  const std::lock_guard lock(mutex_);
  return recorded_.passing_failure;
}

Recorded InputRecorder::recorded() const {
  const std::lock_guard lock(mutex_);
  return recorded_;
}

InputRecorder* InputRecorder::current() noexcept {
  return current_recorder;
}

bool InputRecorder::takes_digests() {
  for (const InputRecorder* each = current_recorder; each != nullptr; each = each->outer_)
    if (each->digests_ == Digests::taken) return true;
  return false;
}

void InputRecorder::add(Input input) {
  for (InputRecorder* each = current_recorder; each != nullptr; each = each->outer_) {
    if (each->digests_ == Digests::left_out) continue;
    const std::lock_guard lock(each->mutex_);
    const auto [place, is_new] =
        each->place_of_.emplace(std::pair(input.kind, input.path), each->recorded_.inputs.size());
    if (is_new)
      each->recorded_.inputs.push_back(input);
    else if (Input& before = each->recorded_.inputs[place->second]; before.state != input.state)
      before.state = changing_state;
  }
}

void InputRecorder::add_read(FileId file) {
  for (InputRecorder* each = current_recorder; each != nullptr; each = each->outer_) {
    const std::lock_guard lock(each->mutex_);
    each->recorded_.read.insert(file);
  }
}

void InputRecorder::add_passing_failure(const std::string& message) {
  for (InputRecorder* each = current_recorder; each != nullptr; each = each->outer_) {
    const std::lock_guard lock(each->mutex_);
    if (auto& failure = each->recorded_.passing_failure; !failure) failure = message;
  }
}

void InputRecorder::add(const Recorded& elsewhere) {
  for (const Input& input : elsewhere.inputs) add(input);
  for (const FileId& file : elsewhere.read) add_read(file);
  if (elsewhere.passing_failure) add_passing_failure(*elsewhere.passing_failure);
}

bool InputRecorder::has_read(FileId file) {
  for (const InputRecorder* each = current_recorder; each != nullptr; each = each->outer_) {
    const std::lock_guard lock(each->mutex_);
    if (each->recorded_.read.contains(file)) return true;
  }
  return false;
}

Recording::Recording(InputRecorder* in) noexcept : before_(current_recorder) {
  current_recorder = in;
}

Recording::~Recording() {
  current_recorder = before_;
}

}  // namespace condyle::io
