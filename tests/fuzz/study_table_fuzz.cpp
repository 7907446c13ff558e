#include <filesystem>
#include <string>
#include <vector>

#include "condyle/error.hpp"
#include "condyle/io/mesh_file.hpp"
#include "condyle/io/study.hpp"
#include "fuzz/one_line.hpp"
#include "fuzz/targets.hpp"
#include "io/file/csv_fields.hpp"
#include "io/file/whole_file.hpp"
#include "io/study/study_table.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

/// Beside the table: post.ply, arm.ply, and arm.toml, a joint of both.
const TemporaryFolder& folder_with_joints() {
  static const TemporaryFolder folder;
  static const bool written = [] {
    io::write_mesh(folder / "post.ply", box({30, -120, -50}, {50, -80, 50}));
    io::write_mesh(folder / "arm.ply", box({-1, -100, -2}, {1, -10, 2}));
    folder.file(
        "arm.toml",
        "condyle = 1\nkind = \"ball\"\nside = \"right\"\nunits = \"mm\"\n[fixed]\nmesh = \"post.ply\"\n"
        "[mobile]\nmesh = \"arm.ply\"\n[frame]\ncentre = [0, 0, 0]\nanterior = [1, 0, 0]\n"
        "superior = [0, 1, 0]\n");
    return true;
  }();
  static_cast<void>(written);
  return folder;
}

/// Flexion of each joint, and what the first byte asks for besides.
io::StudyOptions options_of(unsigned char byte) {
  io::StudyOptions options;
  options.motions = {"flexion"};
  if (byte & 1) options.depth_at = io::PoseDegrees{.flexion = 20};
  if (byte & 4) options.measures = true;
  if (byte & 2)
    options.load = io::StudyLoad{.at = {}, .contact = {}, .force_n = Vec3(80, 0, 0), .free_directions = {}};
  return options;
}

/// Reads a table of results; a row of another length than the header is a fault.
struct Ids {
  std::vector<std::string> ids;
  std::string fault;
};

Ids ids_in(const fs::path& path) {
  const std::string bytes = io::read_whole_file(path), name = path.string();
  const io::Source source{bytes, name};
  io::TextCursor cursor(source);
  Ids found;
  std::size_t columns = 0;
  while (!cursor.at_end()) {
    const std::size_t line = cursor.line();
    const std::string_view text = cursor.rest_of_line();
    if (columns == 0 && text.starts_with("#")) continue;
    const auto fields = io::csv_fields(text, line, source);
    if (columns == 0)
      columns = fields.size();
    else
      found.ids.push_back(fields[0]);
    if (fields.size() != columns) found.fault = "a row of another length than the header";
  }
  return found;
}

/// Every row of the table, in its order, is among the joints or among the failures.
std::string fault_of_results(const io::StudyTable& table, const fs::path& out) {
  const Ids hips = ids_in(out / "hips.csv"), failures = ids_in(out / "failures.csv");
  const Ids limits = ids_in(out / "limits.csv");
  for (const Ids* of : {&hips, &failures, &limits})
    if (!of->fault.empty()) return of->fault;
  if (limits.ids != hips.ids) return "a joint without its limit";
  std::size_t hip = 0, failure = 0;
  for (const io::StudyRow& row : table.rows) {
    if (hip < hips.ids.size() && hips.ids[hip] == table.id(row))
      ++hip;
    else if (failure < failures.ids.size() && failures.ids[failure] == table.id(row))
      ++failure;
    else
      return "a row that is lost";
  }
  return hip == hips.ids.size() && failure == failures.ids.size() ? "" : "a result of no row";
}

std::string fault_of_parts(const io::Study& whole, const fs::path& parted) {
  io::Study part = whole;
  part.folder = parted;
  for (const std::size_t number : {2u, 1u}) {
    part.shard = {number, 2};
    io::run_study(part);
  }
  io::merge_study(parted);
  for (const char* name : {"limits.csv", "hips.csv", "failures.csv", "columns.csv", "study.h5"}) {
    if (io::read_whole_file(whole.folder / name) != io::read_whole_file(parted / name))
      return std::string("shards that are merged to another ") + name;
  }
  return {};
}

}  // namespace

std::string fuzz_study_table(std::string_view bytes) {
  // A sample hip takes a second to make.
  if (bytes.empty() || bytes.find("sample") != bytes.npos) return {};
  const TemporaryFolder& folder = folder_with_joints();
  const fs::path path = folder.file("x.csv", bytes.substr(1));
  try {
    const io::StudyTable table = io::read_study_table(path);
    const io::Study study{path, folder / "out", options_of(static_cast<unsigned char>(bytes[0]))};
    io::run_study(study);
    const std::string fault = fault_of_results(table, study.folder);
    return fault.empty() && bytes[0] & 4 ? fault_of_parts(study, folder / "parted") : fault;
  } catch (const FileError& error) {
    return fault_of_message(error.what(), path.string());
  } catch (const UsageError& error) {
    return fault_of_message(error.what());
  }
}

}  // namespace condyle::test
