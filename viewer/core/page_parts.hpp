#pragma once

#include <cstdint>

/// Parts of a page's joint that turn (condyle/joint.hpp, PosedPart): they are described once, after condyle_set_roles(), then values of their
/// parameters are set by the functions of the command's `--set`.

extern "C" {

struct CondyleJoint;

/// One of several meshes of a body, in their order: `place` its first vertex, vertices, first triangle, triangles and how many of these,
/// the last ones, are faces of a cut; `contact` as in files.
int condyle_body_mesh(CondyleJoint* joint, int of_fixed, const char* name, const char* contact,
                      const std::uint32_t place[5]);
/// A body as it is given: x, y and z of each vertex, null if the drawn ones are these; centre and radius of its head or socket where that
/// is known, else null; the vertices of a head that the joint's centre was fitted to, none if `fitted` is null; how far its bearing
/// surface reaches outside the head, NaN by default.
int condyle_body_given(CondyleJoint* joint, int of_fixed, const double* vertices, const double* head,
                       const std::uint32_t* fitted, int fitted_count, double margin_mm);

/// A part, then its meshes and its parameters. `definition` and `kind` as in files; `numbers`: low, high, value, value of the
/// description, value as given, standard deviation, and the three of a direction.
int condyle_part(CondyleJoint* joint, const char* name, int of_fixed, const char* definition,
                 const double centre_mm[3]);
int condyle_part_mesh(CondyleJoint* joint, const char* name);
int condyle_parameter(CondyleJoint* joint, const char* name, const char* kind, const double numbers[9]);
/// All are described. `margin_mm`: BearingOptions::margin_mm, NaN by default.
int condyle_parts(CondyleJoint* joint, double margin_mm);

/// The joint at these values, as `--set` takes them; parameters that are not named have those of the description, and with an empty
/// text the joint is as it was described, with the roles that were set. Else its bearing surface is found anew. Every query of
/// page_core.hpp then answers for the joint as it is. Fails for a value outside of its range; the joint then stays.
int condyle_set_parameters(CondyleJoint* joint, const char* text);
}
