#include <fmt/format.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <filesystem>
#include <memory>
#include <string>

#include "answer.hpp"
#include "commands.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "io/file/output_file.hpp"

namespace condyle::cli {
namespace {

struct Options {
  ProposalRequest request;
  std::string out;
};

void run(Options options) {
  namespace fs = std::filesystem;
  options.request.joint_file = options.out.empty() ? fs::path("joint.toml") : fs::path(options.out);
  if (!options.out.empty()) {
    std::error_code ignored;
    if (fs::exists(fs::symlink_status(options.out, ignored)))
      throw FileError(options.out +
                      ": is there already; a joint file may have been edited and is not replaced");
    io::check_output_file(options.out);
  }
  const JointProposal proposal = propose_joint(options.request);
  for (const std::string& missing : proposal.to_fill_in) note("to fill in: " + missing);
  if (options.out.empty()) return print(proposal.toml);
  io::write_output_file(options.out, proposal.toml);
  note("wrote " + options.out);
}

}  // namespace

void add_init(CLI::App& app) {
  auto* command =
      app.add_subcommand("init", "Propose a joint file for two meshes, with the evidence for each value");
  command->footer(
      "Example: condyle sample hip --out bones\n"
      "         condyle init bones/hip_bone.ply bones/femur.ply --side right -o proposed.toml\n"
      "What could not be inferred stands in the file as a comment to fill in. Read the file before you use "
      "it.");
  auto options = std::make_shared<Options>();
  command
      ->add_option("FIXED", options->request.fixed, "The mesh of the body that stays, such as the hip bone")
      ->required();
  command->add_option("MOBILE", options->request.mobile, "The mesh of the body that moves, such as the femur")
      ->required();
  command
      ->add_option_function<std::string>(
          "--side",
          [options](const std::string& side) {
            options->request.side = side == "right" ? Side::right : Side::left;
          },
          "The side of the body. Without it inferred from the bones")
      ->check(CLI::IsMember({"right", "left"}))
      ->option_text("right|left");
  command
      ->add_option_function<std::string>(
          "--units",
          [options](const std::string& units) {
            options->request.units = units == "m" ? LengthUnit::metres : LengthUnit::millimetres;
          },
          "The unit of both meshes. Without it inferred from their size")
      ->check(CLI::IsMember({"mm", "m"}))
      ->option_text("mm|m");
  command->add_option("-o,--out", options->out, "Write the joint file here")
      ->option_text("FILE (standard output)");
  command->callback([options] { run(*options); });
}

}  // namespace condyle::cli
