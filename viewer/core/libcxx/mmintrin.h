#pragma once

/// MMX, which Eigen includes before SSE2 and does not use: emscripten has none.
