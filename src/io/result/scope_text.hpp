#pragma once

#include <string>

#include "condyle/io/joint_file.hpp"
#include "condyle/joint.hpp"

/// The scope of the numbers: which tissues an answer covers. Written once, for every text, file, figure and page.

namespace condyle::io {

/// The tissues whose contact an answer covers, and those it does not: one line. A mesh is a cartilage, labrum, meniscus,
/// ligament, capsule, tendon, muscle or implant where its name says so, else a bone; contact is called osseous only where all are bones.
std::string scope_text(const Joint& joint);

/// The same of the surfaces of an entry; one that carries a layer and is not called a cartilage is an elastic layer.
std::string scope_text(const ContactEntry& entry, const ContactSurfaces& surfaces);

/// The same of an answer about many joints, which may differ.
std::string scope_text();

}  // namespace condyle::io
