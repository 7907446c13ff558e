#pragma once

namespace condyle {

/// The unit in which a file gives lengths. Inside the library everything is millimetres.
enum class LengthUnit { millimetres, metres };

}  // namespace condyle
