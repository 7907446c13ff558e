#include "label_options.hpp"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include "answer.hpp"
#include "condyle/error.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
namespace {

constexpr io::AffineChoice affines[] = {io::AffineChoice::sform, io::AffineChoice::qform};
constexpr io::StatedAxes stated_axes[] = {io::StatedAxes::lps, io::StatedAxes::ras, io::StatedAxes::las};

}  // namespace

void add_label_file(CLI::App& command, const std::shared_ptr<LabelOptions>& options) {
  command
      .add_option_function<std::string>(
          "--affine", [options](const std::string& word) { options->file.affine = affines[word == "qform"]; },
          "Which of the two places that a NIfTI file gives its voxels")
      ->check(CLI::IsMember({"sform", "qform"}))
      ->option_text("sform|qform (sform, else qform)");
  command
      .add_option_function<std::int64_t>(
          "--volume", [options](std::int64_t volume) { options->file.volume = volume; },
          "Which volume of a NIfTI file with several, from 0")
      ->check(whole_number(0))
      ->option_text("N");
  command
      .add_option_function<std::string>(
          "--axes",
          [options](const std::string& word) {
            options->file.axes = stated_axes[word == "LPS" ? 0 : word == "RAS" ? 1 : 2];
          },
          "The directions of an image that gives none")
      ->check(CLI::IsMember({"LPS", "RAS", "LAS"}))
      ->option_text("LPS|RAS|LAS");
  command.add_flag("--elsewhere", options->file.outside_folder,
                   "A header may name data outside its own folder");
}

void add_label_surface(CLI::App& command, const std::shared_ptr<LabelOptions>& options) {
  command
      .add_option_function<std::string>(
          "--task", [options](const std::string& word) { options->task = io::label_task_of(word); },
          "The table of TotalSegmentator that names the labels")
      ->check(CLI::IsMember({"total", "total_v1", "total_mr"}))
      ->option_text("total|total_v1|total_mr");
  command
      .add_option_function<std::string>(
          "--pieces", [options](const std::string& word) { options->surface.all_pieces = word == "all"; },
          "The pieces of a label to keep")
      ->check(CLI::IsMember({"largest", "all"}))
      ->option_text("largest|all (largest)");
  command
      .add_option_function<std::string>(
          "--cavities",
          [options](const std::string& word) { options->surface.keep_cavities = word == "keep"; },
          "Whether closed cavities, such as marrow, are filled")
      ->check(CLI::IsMember({"fill", "keep"}))
      ->option_text("fill|keep (fill)");
  command
      .add_option_function<std::size_t>(
          "--triangles", [options](std::size_t count) { options->surface.triangles = count; },
          "Simplify each surface to about this many triangles")
      ->check(whole_number(1))
      ->option_text("N (as extracted)");
}

std::vector<std::string> label_file_names() {
  return {"--affine", "--volume", "--axes", "--elsewhere"};
}

std::vector<std::string> label_surface_names() {
  return {"--task", "--pieces", "--cavities", "--triangles"};
}

void refuse_label_options(const CLI::App& command, const std::string& file) {
  for (const auto& names : {label_file_names(), label_surface_names()})
    for (const std::string& name : names)
      if (const CLI::Option* option = command.get_option_no_throw(name); option && option->count() > 0)
        throw UsageError(name + ": is for label maps, and " + file + " is none");
}

}  // namespace condyle::cli
