#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <utility>

#include "condyle/error.hpp"
#include "condyle/io/study.hpp"
#include "condyle/version.hpp"
#include "core/parallel_tasks.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/replaced_files.hpp"
#include "io/mesh/parse.hpp"
#include "io/result/crate.hpp"
#include "io/study/answered_rows.hpp"
#include "io/study/json_digest.hpp"
#include "io/study/study_answer.hpp"
#include "io/study/study_files.hpp"
#include "io/study/study_inputs.hpp"
#include "io/study/study_joint.hpp"
#include "io/study/study_options.hpp"

namespace condyle::io {
namespace {

using io::StudyAnswer;
using io::StudyRow;
using io::StudyTable;
using Rows = std::span<const StudyRow>;

Rows rows_of(const StudyTable& table, const Shard& shard) {
  const std::size_t rows = table.rows.size();
  const auto before = [&](std::size_t number) { return number * rows / shard.of; };
  return Rows(table.rows).subspan(before(shard.number - 1), before(shard.number) - before(shard.number - 1));
}

/// Contents of study.json before the tables are known.
StudyRecord record_of(const Study& study, const StudyTable& table) {
  StudyRecord record;
  record.version = version;
  record.options = io::options_json(study.options);
  record.table = table.path.string();
  record.table_digest = table.digest;
  record.table_rows = table.rows.size();
  record.shard = study.shard.value_or(Shard{});
  record.family = io::sha256_of({record.version, record.options, table.digest.sha256, record.shard.of});
  return record;
}

/// Where rows stand counts too: results have their numbers, messages their lines.
std::string key_of(const StudyRecord& record, const std::string& columns, Rows rows,
                   const StudyInputs& inputs) {
  nlohmann::json of_rows = nlohmann::json::array();
  for (std::size_t i = 0; i < rows.size(); ++i)
    of_rows.push_back({rows[i].number, rows[i].line, rows[i].fields, inputs.of_rows[i]});
  std::vector<std::string> read;
  for (const Input& input : inputs.all) read.push_back(text_of(input));
  return io::sha256_of({record.version, record.options, columns, of_rows, read});
}

/// The answers of all rows, as they come about.
class Answers {
 public:
  Answers(const Study& study, const StudyTable& table, Rows rows, const Control& control, AnsweredRows& kept)
      : study_(study),
        table_(table),
        rows_(rows),
        control_(control),
        kept_(kept),
        answers_(rows.size()),
        errors_(rows.size()) {}

  /// Empty if it was stopped. Throws what ends the run, of the lowest row.
  std::optional<std::vector<StudyAnswer>> all() {
    core::parallel_tasks(rows_.size(), [&](std::size_t i) { answer(i); });
    for (const std::exception_ptr& error : errors_)
      if (error) std::rethrow_exception(error);
    if (was_stopped_) return std::nullopt;
    return std::move(answers_);
  }

 private:
  void answer(std::size_t i) {
    if (i > last_) return;
    if (control_.stop.stop_requested()) {
      was_stopped_ = true;
      return;
    }
    if (const auto& earlier = kept_.earlier()[i]) {
      answers_[i] = *earlier;
      return report();
    }
    const InputRecorder read;
    try {
      auto answer = io::answer_of(table_, rows_[i], study_, read, control_.stop);
      if (answer)
        answers_[i] = std::move(*answer);
      else
        was_stopped_ = true;
    } catch (...) {
      fail(i, read);
    }
    // Even if an answer came about: it may be that of a file which seemed not to be there.
    if (const auto why = read.passing_failure()) end_with(i, std::make_exception_ptr(FileError(*why)));
    if (errors_[i] || (answers_[i].hip + answers_[i].failure).empty()) return;
    kept_.add(rows_[i], answers_[i]);
    report();
  }

  void report() {
    const std::lock_guard lock(mutex_);
    if (control_.progress) control_.progress("joints", ++done_, rows_.size());
  }

  /// The row is a failure, unless what is wrong is not its joint.
  void fail(std::size_t i, const InputRecorder& read) {
    try {
      throw;
    } catch (const UsageError&) {  // the options do not fit this joint
      end_with(i, std::current_exception());
    } catch (const std::bad_alloc&) {  // another machine may answer
      end_with(i, std::current_exception());
    } catch (const std::system_error&) {  // likewise
      end_with(i, std::current_exception());
    } catch (...) {
      if (study_.bad_joint == BadJoint::ends_run)
        end_with(i, std::current_exception());
      else
        answers_[i] = io::failure_of(table_, rows_[i], read);
    }
  }

  /// Rows before this one are answered all the same, so that the lowest such row is the same on any number of threads.
  void end_with(std::size_t i, std::exception_ptr error) {
    errors_[i] = std::move(error);
    std::size_t last = last_;
    while (i < last && !last_.compare_exchange_weak(last, i)) {
    }
  }

  const Study& study_;
  const StudyTable& table_;
  Rows rows_;
  const Control& control_;
  AnsweredRows& kept_;
  std::vector<StudyAnswer> answers_;
  std::vector<std::exception_ptr> errors_;
  std::atomic<bool> was_stopped_ = false;
  std::atomic<std::size_t> last_ = static_cast<std::size_t>(-1);  ///< the lowest row that ends the run
  std::mutex mutex_;
  std::size_t done_ = 0;
};

StudyTexts texts_of(const std::vector<StudyAnswer>& answers, const StudyColumns& columns) {
  StudyTexts texts{io::header_of(columns.limits), io::header_of(columns.hips),
                   io::header_of(columns.failures)};
  for (const StudyAnswer& answer : answers) {
    texts.limits += answer.limits;
    texts.hips += answer.hip;
    texts.failures += answer.failure;
  }
  return texts;
}

/// Files that were read are never overwritten: a shard does not overwrite those that merge_study() will write either.
class ResultsThere {
 public:
  ResultsThere(const Study& study, const std::filesystem::path& folder)
      : files_(io::study_result_files(study.folder)) {
    if (folder != study.folder)
      for (std::filesystem::path& file : io::study_result_files(folder)) files_.push_back(std::move(file));
    std::erase_if(files_, [](const auto& file) {
      std::error_code ignored;
      return !std::filesystem::exists(file, ignored);
    });
  }

  /// What rows name, before they are answered. Throws FileError.
  void check_before(const StudyTable& table) const {
    if (files_.empty()) return;
    std::vector<std::filesystem::path> read = {table.path};
    for (const StudyRow& row : table.rows)
      for (std::filesystem::path& file : io::files_of(table, row)) read.push_back(std::move(file));
    io::check_replaces_none(files_, read);
  }

  /// What was read: headers and joint files may name more. Throws FileError.
  void check_after(const std::vector<std::vector<Input>>& inputs) const {
    if (files_.empty()) return;
    std::vector<std::filesystem::path> read;
    for (const std::vector<Input>& of_row : inputs)
      for (const Input& input : of_row)
        if (input.kind == Input::Kind::file) read.push_back(input.path);
    io::check_replaces_none(files_, read);
  }

 private:
  std::vector<std::filesystem::path> files_;  ///< those that are there now
};

/// The study in the folder, if it is the one that this run would write.
std::optional<StudyDone> done_before(const std::filesystem::path& folder, const StudyRecord& asked,
                                     const std::string& columns, const StudyTable& table, Rows rows,
                                     const std::optional<std::string>& crate_date) {
  auto there = io::read_study_record(folder);
  if (!there || there->inputs.of_rows.size() != rows.size()) return std::nullopt;
  // Shards are merged where the table need not be: of merged tables the key is found here, if the table is the same.
  if (there->is_merged && there->table_digest.sha256 == asked.table_digest.sha256)
    there->key = key_of(*there, columns, rows, there->inputs);
  if (there->key != key_of(asked, columns, rows, there->inputs.now(table.path.parent_path())))
    return std::nullopt;
  StudyResults results = io::read_study(folder);
  // Other rows of the table may have changed: then the shard belongs to the new table as it is.
  if (there->family != asked.family) {
    results.record = asked;
    results.record.key = there->key;
    results.record.joints = there->joints;
    results.record.failures = there->failures;
    results.record.inputs = there->inputs;
  }
  if (there->family != asked.family || crate_date) io::write_study(folder, results, crate_date);
  StudyDone done{
      there->joints, there->failures, io::first_failure(results), true, {}, io::noted_joints(results)};
  if (crate_date) done.written = {folder / crate_name};
  return done;
}

}  // namespace

PoseDegrees study_pose(std::string_view text, Anatomy joint) {
  if (is_matrix(text))
    throw UsageError(fmt::format("pose: a study takes angles by their names, such as {}=90, and no matrix",
                                 name_of(JointAngle::flexion, joint)));
  return parse_pose(text, JointKind::ball, joint);
}

Shard Shard::parse(std::string_view text) {
  const std::size_t slash = text.find('/');
  Shard shard;
  if (slash == text.npos || !io::parse_number(text.substr(0, slash), shard.number) ||
      !io::parse_number(text.substr(slash + 1), shard.of) || shard.number < 1 || shard.number > shard.of ||
      shard.of > 1'000'000)
    throw UsageError(fmt::format(
        "shard: {} is not a number and how many there are, up to 1000000, such as 3/7", io::in_quotes(text)));
  return shard;
}

std::optional<StudyDone> run_study(const Study& study, const Control& control) {
  if (study.options.measures && study.options.anatomy != Anatomy::hip)
    throw UsageError(
        fmt::format("measures: are of hips, and this study is of the {}", name_of(study.options.anatomy)));
  if (study.crate_date) check_crate_date(*study.crate_date);
  if (study.crate_date && study.shard)
    throw UsageError("crate: is of a whole study, as condyle merge puts it together, and not of a shard");
  const StudyTable table = io::read_study_table(study.table);
  const Rows rows = rows_of(table, study.shard.value_or(Shard{}));
  const auto folder = study.shard ? io::shard_folder(study.folder, *study.shard) : study.folder;
  const StudyColumns columns = io::study_columns(table, study.options);
  StudyResults results{record_of(study, table), io::columns_csv(columns), {}};
  const ResultsThere before(study, folder);
  before.check_before(table);
  // A folder that cannot be written to is reported before the work, not after it.
  io::prepare_study_folder(folder);
  const auto done = done_before(folder, results.record, results.columns, table, rows, study.crate_date);
  // For a failure that ends the run, the tables have only the message, not the error.
  const bool all_well = done && done->failures == 0 && done->noted.empty();
  if (all_well || (done && study.bad_joint == BadJoint::is_a_row)) return done;

  // Messages name the table, and what ends one run is a row of another.
  AnsweredRows kept(folder, table.path, rows,
                    io::sha256_of({results.record.version, results.record.options, results.columns,
                                   table.path.string(), study.bad_joint == BadJoint::is_a_row}));
  auto answers = Answers(study, table, rows, control, kept).all();
  if (!answers) return std::nullopt;
  std::vector<std::vector<Input>> inputs;
  for (StudyAnswer& answer : *answers) {
    inputs.push_back(std::move(answer.inputs));
    results.record.failures += !answer.failure.empty();
  }
  before.check_after(inputs);
  results.record.inputs = study_inputs(table.path.parent_path(), inputs);
  results.record.joints = rows.size() - results.record.failures;
  results.record.key = key_of(results.record, results.columns, rows, results.record.inputs);
  results.texts = texts_of(*answers, columns);
  StudyDone written{
      results.record.joints,
      results.record.failures,
      io::first_failure(results),
      false,
      io::write_study(folder, results, study.crate_date),
      io::noted_joints(results),
      static_cast<std::size_t>(std::count_if(kept.earlier().begin(), kept.earlier().end(),
                                             [](const auto& earlier) { return earlier.has_value(); }))};
  kept.remove();
  return written;
}

}  // namespace condyle::io
