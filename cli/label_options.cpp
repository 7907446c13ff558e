#include "label_options.hpp"

#include <CLI/CLI.hpp>

#include "answer.hpp"
#include "choice.hpp"
#include "condyle/error.hpp"
#include "whole_number.hpp"

namespace condyle::cli {
void add_label_file(CLI::App& command, LabelOptions& options) {
  add_choice(command, "--affine", options.file.affine,
             {{"sform", io::AffineChoice::sform}, {"qform", io::AffineChoice::qform}},
             "Which of the two places that a NIfTI file gives its voxels", "sform, else qform");
  command
      .add_option_function<std::int64_t>(
          "--volume", [&options](std::int64_t volume) { options.file.volume = volume; },
          "Which volume of a NIfTI file with several, from 0")
      ->check(whole_number(0))
      ->option_text("N");
  add_choice(command, "--axes", options.file.axes,
             {{"LPS", io::StatedAxes::lps}, {"RAS", io::StatedAxes::ras}, {"LAS", io::StatedAxes::las}},
             "The directions of an image that gives none");
  command.add_flag("--elsewhere", options.file.outside_folder,
                   "A header may name data outside its own folder");
}

void add_label_surface(CLI::App& command, LabelOptions& options) {
  command
      .add_option_function<std::string>(
          "--task", [&options](const std::string& word) { options.task = io::label_task_of(word); },
          "The table of TotalSegmentator that names the labels")
      ->check(CLI::IsMember({"total", "total_v1", "total_mr"}))
      ->option_text("total|total_v1|total_mr");
  add_choice(command, "--pieces", options.surface.all_pieces, {{"largest", false}, {"all", true}},
             "The pieces of a label to keep", "largest");
  add_choice(command, "--cavities", options.surface.keep_cavities, {{"fill", false}, {"keep", true}},
             "Whether closed cavities, such as marrow, are filled", "fill");
  command
      .add_option_function<std::size_t>(
          "--triangles", [&options](std::size_t count) { options.surface.triangles = count; },
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
