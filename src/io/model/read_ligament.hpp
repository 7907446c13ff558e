#pragma once

#include "condyle/io/model_file.hpp"
#include "io/model/model_frames.hpp"

namespace condyle::io {

/// A Blankevoort1991Ligament with its points in the frames of bodies. Throws FileError, one line, for what it cannot have.
ModelLigament ligament_of(const Source& source, const XmlElement& element, const ModelFrames& frames);

/// A surface of a body's WrapObjectSet; `why_not` if it cannot be read.
ModelWrap wrap_of(const Source& source, const XmlElement& element, const std::string& body);

}  // namespace condyle::io
