#include "kinds.hpp"
#include "spherical_shell.hpp"

namespace bench {

/// Trees of spherical shells. Taken from Krishnan et al. (1998): the volume, and a tree of it on each body.
/// Theirs are fitted to smooth patches and compared cone by cone; ours hold triangles, are fitted by least
/// squares, and are compared by tests of which each is enough to separate two of them, without deciding
/// every case. The triangles themselves decide at the leaves, exactly.
std::vector<MethodKind> spherical_shell_kinds() {
  return {{"spherical_shells",
           "bounding volume hierarchies",
           "spherical shells (Krishnan 1998), plain",
           {.touch = true, .pairs = true, .deforms = true},
           DepthKind::none,
           true,
           [](const Bodies& bodies) { return std::make_unique<TwoTrees<SphericalShell>>(bodies); }}};
}

}  // namespace bench
