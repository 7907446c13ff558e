#pragma once

#include <cstdint>

/// Parts of a page's joint that turn (condyle/joint.hpp, PosedPart): they are described once, after condyle_set_roles(), then values of their
/// parameters are set by the functions of the command's `--set`.

extern "C" {

struct CondyleJoint;

/// A body as it is given: `text` is the JSON of `posed.fixed` or `posed.mobile` of a report with the body's `meshes` (docs/report-data.md);
/// x, y and z of each vertex, null if the drawn ones are these; the vertices of a head that the joint's centre was fitted to, none if
/// `fitted` is null.
int condyle_body_given(CondyleJoint* joint, int of_fixed, const char* text, const double* vertices,
                       const std::uint32_t* fitted, int fitted_count);
/// Then the parts: `text` is the JSON of `posed`.
int condyle_parts(CondyleJoint* joint, const char* text);

/// The joint at these values, as `--set` takes them; parameters that are not named have those of the description, and with an empty
/// text the joint is as it was described, with the roles that were set. Else its bearing surface is found anew. Every query of
/// page_core.hpp then answers for the joint as it is. Fails for a value outside of its range; the joint then stays.
int condyle_set_parameters(CondyleJoint* joint, const char* text);
}
