#pragma once

#include <string>
#include <string_view>

/// Fuzz targets. Each target takes any bytes at all, does with them what a user could, and compares the outcome with
/// the guarantee: an answer that is right if a plain oracle knows it and finite if it must be, or an error of one
/// line. It returns the fault in words; the empty text if there was none. Other exceptions go through.
///
/// libFuzzer runs a target by entry.cpp; the ordinary tests run it on the inputs kept in corpus/.

namespace condyle::test {

/// The first byte chooses the format of a mesh file, the rest is the file.
std::string fuzz_mesh_reader(std::string_view bytes);
/// The first byte chooses the format of a label map and what a user may choose, the rest is the file.
std::string fuzz_label_file(std::string_view bytes);
/// A model of OpenSim: its joints have poses, and what is proposed for them is a joint file.
std::string fuzz_model_file(std::string_view bytes);
/// The first byte chooses the force, the rest is a model of OpenSim into which limits are written.
std::string fuzz_model_limits(std::string_view bytes);
/// A joint file, beside a mesh for both its bodies.
std::string fuzz_joint_file(std::string_view bytes);
/// The first byte chooses .mot, .sto or .csv, the rest is the file: columns, times, coordinates and poses.
std::string fuzz_motion_file(std::string_view bytes);
/// The first byte chooses what is asked, the rest is the table of a study.
std::string fuzz_study_table(std::string_view bytes);
/// The first two bytes choose a joint and what is read, the rest is the text: a pose, an axis of a map, a name.
std::string fuzz_text(std::string_view bytes);

// Those that follow draw meshes and points by FuzzInput.

/// A triangle soup inspected.
std::string fuzz_inspect(std::string_view bytes);
/// A direction table and its two queries, against winding numbers by brute force.
std::string fuzz_radial(std::string_view bytes);
/// A ring table, its query and its arcs, against winding numbers by brute force.
std::string fuzz_tangential(std::string_view bytes);
/// Pairs of triangles of two bodies at a pose, against every pair by brute force.
std::string fuzz_pairs(std::string_view bytes);
/// Both ends of a free rotation, against poses on the way by brute force.
std::string fuzz_first_contact(std::string_view bytes);
/// All free angles of a turn about the z axis, against poses by brute force.
std::string fuzz_turns(std::string_view bytes);
/// All free positions of a slide along it, against poses by brute force.
std::string fuzz_slides(std::string_view bytes);
/// Two meshes at a pose: contact and pairs against brute force, measures by what they must keep.
std::string fuzz_touch(std::string_view bytes);
/// Meshes and curves written and read back, and the JSON of an inspection.
std::string fuzz_results(std::string_view bytes);

}  // namespace condyle::test
