#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "condyle/pose.hpp"

/// Contact along a motion as OpenSim-JAM's JointMechanicsTool writes it (HDF5), for scripts that read its files. SI units;
/// points, forces and moments in the frame of the body whose surface it is.

namespace condyle::io {

/// Known values of a surface, or of a region of it, in one frame of a motion; NaN if there is no answer, 0 if there
/// is no contact.
struct JamTotals {
  double contact_area_m2 = 0;
  double mean_proximity_m = 0, max_proximity_m = 0;  ///< depth of overlap, over the triangles in contact
  Vec3 centre_of_proximity_m = Vec3::Zero();
  double mean_pressure_pa = 0, max_pressure_pa = 0;
  Vec3 centre_of_pressure_m = Vec3::Zero();
  Vec3 contact_force_n = Vec3::Zero();
  Vec3 contact_moment_nm = Vec3::Zero();
};

/// JAM's six regions of a surface: the triangles whose centres have x < 0, x >= 0, y < 0, y >= 0, z < 0 and z >= 0 in the frame
/// of its body. Of a right knee with Z to the right, the fifth is the medial half and the sixth the lateral one.
inline constexpr std::size_t jam_regions = 6;

struct JamFrame {
  JamTotals total;
  /// One per region, in every frame; none in any frame: not written.
  std::vector<JamTotals> regional;
  /// One number per triangle of the mesh, as many in every frame; none in any frame: not written.
  std::vector<double> triangle_proximity_m, triangle_pressure_pa;
};

/// A surface of a contact. Without frames it is named in the file and nothing more.
struct JamSurface {
  std::string mesh;
  std::vector<JamFrame> frames;  ///< one per time, or none
};

/// A pair of surfaces: rays are cast from the triangles of one along its normals to the other.
struct JamContact {
  std::string name;
  JamSurface casting, target;
};

/// A coordinate of the joint along the motion: degrees or m, one per time.
struct JamCoordinate {
  std::string name;
  std::vector<double> values;
};

/// Writes `/time`, the value of each coordinate and, for each contact and each of its two meshes, the datasets of
/// `/model/forceset/Smith2018ArticularContactForce/CONTACT/MESH`; which: docs/motion-files.md. The same input gives the same
/// bytes. The file appears whole or not at all.
/// Raises FileError if it cannot be written, and for names that the scripts could not read: each is a letter and then
/// up to 62 letters, digits and _, contacts and coordinates have different names and so have the two meshes of a contact.
void write_jam_file(const std::filesystem::path& path, std::span<const double> times_s,
                    std::span<const JamContact> contacts, std::span<const JamCoordinate> coordinates = {});

}  // namespace condyle::io
