#pragma once

#include "condyle/io/output_folder.hpp"
#include "condyle/joint_coordinates.hpp"
#include "condyle/sample/cartilages.hpp"
#include "condyle/sample/hip.hpp"

namespace condyle {

/// Puts a sample hip into a folder as a joint that everything else reads: hip_bone.ply, femur.ply and
/// hip.toml. The meshes are those of the side given, already mirrored for a left hip.
void write_sample_hip(OutputFolder& out, const SampleHip& hip, Side side);

/// The same for the cartilages: acetabular_cartilage.ply, which is fixed, femoral_cartilage.ply and
/// cartilages.toml.
void write_sample_cartilages(OutputFolder& out, const SampleCartilages& cartilages, Side side);

}  // namespace condyle
