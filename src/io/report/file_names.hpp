#pragma once

#include "io/result/json.hpp"

namespace condyle::io {

/// Leaves of every path in a provenance, and of the words of its command that are paths, the name of the file: who hands a page on
/// does not hand on how folders are called. Texts that were given as such stay as they are.
void name_files_only(Json& provenance);

}  // namespace condyle::io
