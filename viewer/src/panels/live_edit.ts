import type { CoreClient } from "../core/client";
import { lineOf } from "../core/error_line";
import { latestOnly } from "../core/latest";
import type { Brushed, Edit, LimitQuestion, LiveLimit, Turned } from "../core/protocol";
import type { LiveLimits } from "./live_limits";

export interface LiveEditHooks {
  /// The edit for the present values.
  edit: () => Edit;
  /// Every table that shows the limits.
  tables: () => readonly LiveLimits[];
  /// The core has made the edit; `rests` if no other one waits.
  edited: (changed: Brushed | Turned | null, rests: boolean) => void;
  /// All limits are known and shown, so many milliseconds after the edit was sent.
  shown: (took_ms: number, rests: boolean, limits: readonly LiveLimit[]) => void;
  failed: (message: string) => void;
}

/// Edits of the joint and the limits after each.
export function liveEdit(core: CoreClient, questions: LimitQuestion[], hooks: LiveEditHooks): () => void {
  const ask = latestOnly<true>(async (_, rests) => {
    const begun = performance.now(), limits: LiveLimit[] = [];
    for (const table of hooks.tables()) table.wait();
    try {
      await core.edit(hooks.edit(), questions, {
        edited: (changed) => hooks.edited(changed, rests()),
        limit: (i, limit) => {
          limits[i] = limit;
          for (const table of hooks.tables()) table.showLimit(i, limit);
        },
      });
      hooks.shown(performance.now() - begun, rests(), limits);
    } catch (error) {
      hooks.failed(lineOf(error));
    }
  });
  return () => ask(true);
}
