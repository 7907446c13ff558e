#pragma once

/// The whole core, in reading order. Files (condyle/io) and the parametric hip (condyle/sample) are libraries of their
/// own and are included one by one. Joints, meshes, requests and answers are directly in `condyle`; what else a layer has is in
/// its own namespace: condyle::radial, tangential, contact, motion, measure, plan; and condyle::sample, condyle::io.

// In reading order, not in the alphabet's.
// clang-format off

// Types that everything else is made of.
#include "condyle/angle.hpp"
#include "condyle/pose.hpp"
#include "condyle/error.hpp"
#include "condyle/control.hpp"

// Surfaces.
#include "condyle/mesh.hpp"
#include "condyle/inspect.hpp"
#include "condyle/label_surface.hpp"

// Joints.
#include "condyle/joint_coordinates.hpp"
#include "condyle/joint.hpp"
#include "condyle/fit.hpp"
#include "condyle/make_joint.hpp"
#include "condyle/joint_checks.hpp"

// One pose.
#include "condyle/radial.hpp"
#include "condyle/tangential.hpp"
#include "condyle/contact.hpp"
#include "condyle/contact_measures.hpp"
#include "condyle/normal_depth.hpp"
#include "condyle/pressure.hpp"

// Motions.
#include "condyle/first_contact.hpp"
#include "condyle/bearing.hpp"
#include "condyle/range_of_motion.hpp"
#include "condyle/limit_band.hpp"
#include "condyle/motion_map.hpp"
#include "condyle/motion_contact.hpp"
#include "condyle/impingement_zone.hpp"
#include "condyle/resection.hpp"
#include "condyle/brush.hpp"
#include "condyle/sweep.hpp"
#include "condyle/implant.hpp"
#include "condyle/hip_measures.hpp"
#include "condyle/answer.hpp"

#include "condyle/version.hpp"
