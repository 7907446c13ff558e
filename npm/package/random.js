// Emscripten's glue looks at `crypto` when it starts, for which node would load all of that.
import { randomFillSync } from "node:crypto";

export const crypto = { getRandomValues: randomFillSync };
