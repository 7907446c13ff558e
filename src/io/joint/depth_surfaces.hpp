#pragma once

#include "condyle/answer/depth.hpp"
#include "condyle/io/joint_file.hpp"

/// What a contact entry says of depths along normals.

namespace condyle::io {

/// The joint with the parts that cast and are cast at in the place of bodies of several. UsageError as surfaces_of().
Joint joint_of_surfaces(const ContactEntry& entry, Joint joint);

/// The request with the entry's casting surface and rays.
DepthRequest cast_as(const ContactEntry& entry, DepthRequest request);

}  // namespace condyle::io
