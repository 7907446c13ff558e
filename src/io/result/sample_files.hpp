#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/control.hpp"
#include "condyle/implant.hpp"
#include "condyle/io/joint_file.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/sample/cartilages.hpp"
#include "condyle/sample/hip.hpp"
#include "io/file/output_folder.hpp"

namespace condyle::io {

/// A file that is to be written.
struct FileBytes {
  std::string name, bytes;
};

/// A sample hip as a joint that everything else reads: hip_bone.ply, femur.ply and hip.toml. The meshes are those of the side
/// given, already mirrored for a left hip.
std::vector<FileBytes> sample_hip_files(const sample::SampleHip& hip, Side side);
/// Puts them into a folder.
void write_sample_hip(OutputFolder& out, const sample::SampleHip& hip, Side side);

/// Puts a label map of a sample hip into a folder, labels.nii.gz: cubes of this width, in mm, with the labels that
/// TotalSegmentator gives femur and hip bone of that side. Throws UsageError for voxels below 0.2 or above 5 mm.
void write_sample_labels(OutputFolder& out, const sample::SampleHip& hip, Side side, double voxel_mm);

/// The same for the cartilages: acetabular_cartilage.ply, which is fixed, femoral_cartilage.ply and
/// cartilages.toml.
void write_sample_cartilages(OutputFolder& out, const sample::SampleCartilages& cartilages, Side side);

/// Puts an implant into a folder as a joint: hip.toml or shoulder.toml, with the sizes of the implant in it, and a mesh for each part, named
/// after it. Bands move its axes only: a centre displaced by as much as the clearance would bring head and liner into contact. The meshes are those of the side given.
void write_sample_implant(OutputFolder& out, const plan::ImplantMeshes& meshes, const plan::Implant& implant,
                          Side side);

/// The joint that reading these files makes.
LoadedJoint sample_implant_joint(const plan::ImplantMeshes& meshes, const plan::Implant& implant, Side side);

/// Where a study gets the hips of a cohort from.
enum class CohortMeshes {
  of_measures,  ///< it makes them of the measures in the table: no mesh is stored
  in_files,     ///< a folder with meshes and joint file for each
};

/// A cohort that is to be written: hips 1 to n of a seed.
struct SampleCohort {
  std::size_t n = 0;
  std::uint64_t seed = 1;
  sample::Scenario scenario = sample::Scenario::one;
  CohortMeshes meshes = CohortMeshes::of_measures;
};

/// Writes cohort.csv, a table for a study, and cohort.json, what it was drawn from; with meshes hips/000001/ and so on before,
/// on all threads. A hip whose measures cannot be made has no folder then, and is a failure of the study. Some microseconds a
/// hip, with meshes a second or more. Throws UsageError for no hip or more than 10 million, FileError. Empty if it was
/// stopped: then there is no table.
std::optional<std::vector<std::filesystem::path>> write_sample_cohort(const std::filesystem::path& folder,
                                                                      const SampleCohort& cohort,
                                                                      const Control& control = {});

}  // namespace condyle::io
