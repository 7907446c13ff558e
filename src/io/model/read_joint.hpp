#pragma once

#include <string>

#include "condyle/io/model_file.hpp"
#include "io/model/model_frames.hpp"

namespace condyle::io {

/// Whether an element is a joint, of a type that is read or not.
bool is_joint(std::string_view element) noexcept;

/// A joint as its element says, in every version of the format; `enclosing_body` is the body that it stands in up to version
/// 30500. What is wrong with it stands in its `why_not`.
ModelJoint joint_of(const Source& source, const XmlElement& element, const std::string& enclosing_body,
                    const ModelFrames& frames, int version);

/// Later versions have no `reverse`, and OpenSim passes over one that they have.
inline constexpr int last_version_with_reverse = 30513;

}  // namespace condyle::io
