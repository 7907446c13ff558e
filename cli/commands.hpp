#pragma once

#include <CLI/App.hpp>

/// One command per file: its options, then read, one library call, one writer. A command runs as the
/// callback of its subcommand and ends by throwing where it cannot answer; main() turns errors into a line and
/// an exit code.

namespace condyle::cli {

void add_init(CLI::App& app);
void add_hip(CLI::App& app);
void add_surface(CLI::App& app);
void add_inspect(CLI::App& app);
void add_frame(CLI::App& app);
void add_depth(CLI::App& app);
void add_rom(CLI::App& app);
void add_load(CLI::App& app);
void add_motion(CLI::App& app);
void add_picture(CLI::App& app);
void add_report(CLI::App& app);
void add_sample(CLI::App& app);
void add_study(CLI::App& app);
void add_measure(CLI::App& app);
void add_resect(CLI::App& app);
void add_implant(CLI::App& app);
void add_sweep(CLI::App& app);
void add_merge(CLI::App& app);
void add_touch(CLI::App& app);
void add_turn(CLI::App& app);
void add_slide(CLI::App& app);

}  // namespace condyle::cli
