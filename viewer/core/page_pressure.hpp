#pragma once

#include <cstdint>

/// Pressure of thin layers on the bones, at any pose of the page: condyle/pressure.hpp.

extern "C" {

struct CondyleJoint;

/// The surface of the fixed body (`of_fixed` 1) or of the mobile one (0) that carries a load: a run of its mesh's vertices and the
/// run of triangles between them. `youngs_modulus_mpa` 0: rigid, and the thicknesses are not read; else a layer, with a thickness
/// in mm for each of these vertices.
int condyle_surface(CondyleJoint* joint, int of_fixed, int first_vertex, int vertex_count, int first_triangle,
                    int triangle_count, double youngs_modulus_mpa, double poisson_ratio,
                    const double* thickness_mm);
/// After both surfaces. `casting`: 0 fixed, 1 mobile, 2 both; `law`: 0 linear, 1 logarithmic; `rule`: 0 face_centre, 1 cut_faces.
int condyle_elastic(CondyleJoint* joint, int casting, int law, int rule, double reach_mm);

/// As condyle_shown(): at each vertex the load on the triangles around it over their area, in MPa. Marks are 1 on loaded triangles,
/// 0 elsewhere, and everywhere on a body whose surface is not cast.
int condyle_pressure(CondyleJoint* joint, const double* pose, int of_fixed, float* values,
                     std::uint8_t* marks);
}
