#pragma once

#include "page_core.hpp"

extern "C" {

/// Takes the ligaments of a text of [[ligament]] tables in mm, as the data block of a report has it: those that end motions end what is asked
/// from then on.
int condyle_set_ligaments(CondyleJoint* joint, const char* toml);

/// A JSON list of the ligaments at a pose: name; `is`, one of slack, taut, at_end and unknown; length_mm, strain and tension_n, null where the
/// length is not known; and a thin tube along its path in F, vertices (mm) and triangles.
const char* condyle_ligaments(CondyleJoint* joint, const double* pose);
}
