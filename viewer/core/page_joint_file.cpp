#include "page_joint_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "answer/exact_limits.hpp"
#include "condyle/error.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/joint_checks.hpp"
#include "core/one_line.hpp"
#include "io/file/environment.hpp"
#include "io/file/input_file.hpp"
#include "io/joint/load_joint.hpp"
#include "io/report/joint_object.hpp"
#include "io/result/rom_result.hpp"
#include "page_joint.hpp"

using namespace condyle;

namespace {

/// What was dropped together, bytes by paths, and the joint that is read of it.
struct Drop {
  std::map<std::string, std::string, std::less<>> files = {};
  std::optional<io::JointFile> joint = {};
  io::Json by_name =
      io::Json::array();  ///< meshes that do not lie where the joint file says: there, and what was taken
  std::string answer = {};
};

Drop& drop() {
  static Drop files;
  return files;
}

/// The dropped files that a joint file may mean: the one at its path, else all of its name.
std::vector<std::string> dropped_at(const std::filesystem::path& path) {
  const std::string there = path.lexically_normal().string();
  if (drop().files.contains(there)) return {there};
  std::vector<std::string> of_name;
  for (const auto& [each, bytes] : drop().files)
    if (std::filesystem::path(each).filename() == path.filename()) of_name.push_back(each);
  return of_name;
}

/// Meshes by the names under which they were dropped, which messages then have.
io::Json name_meshes(io::JointFile& file) {
  io::Json paths = io::Json::array();
  drop().by_name = io::Json::array();
  for (io::BodyEntry* body : {&file.fixed, &file.mobile})
    for (io::MeshEntry& entry : body->meshes)
      if (const std::vector<std::string> dropped = dropped_at(entry.mesh); dropped.size() == 1) {
        const std::string there = entry.mesh.lexically_normal().string();
        if (dropped.front() != there) drop().by_name.push_back({{"mesh", there}, {"taken", dropped.front()}});
        entry.mesh = dropped.front();
        paths.push_back(dropped.front());
      }
  return paths;
}

/// Tables of the joint file whose answers take the command.
io::Json only_in_reports(const io::JointFile& file) {
  io::Json tables = io::Json::array();
  if (file.contact && (file.contact->fixed || file.contact->mobile)) tables.push_back("contact");
  return tables;
}

/// As `condyle report` without options asks for them; a joint without limits has the reason.
std::string block_of_joint(const io::LoadedJoint& loaded) {
  const Case joint = loaded;
  const std::vector<JointNote> notes = check_joint(joint.joint, joint.placement);
  io::Provenance from = io::provenance_of(loaded, {});
  std::optional<RangeAnswer> answer;
  std::string error;
  try {
    answer = answer::exact_limits(joint, {.motions = joint.motions()});
  } catch (const MeshError& why) {
    error = why.what();
  }
  std::optional<io::RomResult> rom;
  if (answer) rom.emplace(io::rom_result_of(*answer, notes, &from));
  const io::Report report = io::report_of(loaded, rom ? &*rom : nullptr, error);
  io::BlockArrays arrays;
  io::Json json = io::joint_object(report, arrays);
  json["only_in_reports"] = only_in_reports(loaded.report.file);
  json["taken_by_name"] = drop().by_name;
  return io::block_of(std::move(json), arrays);
}

}  // namespace

// What was dropped, in place of a file system.
namespace condyle::io {

/// As the joint file has it: what counts is the name behind it.
std::optional<std::string> environment_variable(const std::string& name) {
  return "${" + name + "}";
}

std::string why_no_file(const std::filesystem::path& path) {
  const std::vector<std::string> dropped = dropped_at(path);
  if (dropped.size() == 1) return {};
  const std::string name = path.filename().string();
  return core::one_line(dropped.empty() ? name + " was not dropped beside it"
                                        : fmt::format("{} may be {} or {}, which were dropped both", name,
                                                      dropped[0], dropped[1]),
                        300);
}

void check_is_file(const std::filesystem::path& path) {
  if (!drop().files.contains(path.string())) throw FileError(path.string() + ": no such file");
}

std::string read_whole_file(const std::filesystem::path& path, FileDigest* digest) {
  check_is_file(path);
  const std::string& bytes = drop().files.find(path.string())->second;
  if (digest != nullptr) *digest = digest_of(bytes);
  return bytes;
}

// Label maps come as bytes.
EntryKind entry_at(const std::filesystem::path&) {
  return EntryKind::none;
}

InputFile::InputFile(const std::filesystem::path& path) {
  throw FileError(path.string() + ": no such file");
}
InputFile::~InputFile() = default;
InputFile::InputFile(InputFile&&) noexcept = default;
InputFile& InputFile::operator=(InputFile&&) noexcept = default;
std::size_t InputFile::read(std::uint64_t, std::span<char>) const {
  return 0;
}

}  // namespace condyle::io

int condyle_drop_file(const char* path) {
  return guarded(-1, [&] {
    drop().files.emplace(path, "");
    return 0;
  });
}

int condyle_fill_file(const char* path, const std::uint8_t* bytes, int count) {
  return guarded(-1, [&] {
    drop().files[path].assign(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return 0;
  });
}

const char* condyle_joint_meshes(const char* path, const std::uint8_t* bytes, int count) {
  return guarded(static_cast<const char*>(nullptr), [&] {
    const std::string_view text(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    drop().joint = io::joint_file_of(text, path);
    drop().answer = name_meshes(*drop().joint).dump(-1, ' ', false, io::Json::error_handler_t::replace);
    return drop().answer.c_str();
  });
}

const std::uint8_t* condyle_joint_block() {
  return guarded(static_cast<const std::uint8_t*>(nullptr), [&] {
    if (!drop().joint) throw UsageError("joint: no joint file was read");
    drop().answer = block_of_joint(io::load_joint(*drop().joint));
    return reinterpret_cast<const std::uint8_t*>(drop().answer.data());
  });
}

int condyle_joint_block_bytes() {
  return static_cast<int>(drop().answer.size());
}
