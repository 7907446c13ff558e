import type { CoreClient } from "../core/client";
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

/// An edit of the joint and the limits after it. One is computed at a time; of those requested meanwhile only the latest.
export class LiveEdit {
  private isBusy = false;
  private waits = false;

  constructor(private readonly core: CoreClient, private readonly questions: LimitQuestion[], private readonly hooks: LiveEditHooks) {}

  ask(): void {
    this.waits = true;
    if (!this.isBusy) this.send();
  }

  private send(): void {
    const { questions, hooks } = this, begun = performance.now(), limits: LiveLimit[] = [];
    this.waits = false;
    this.isBusy = true;
    for (const table of hooks.tables()) table.wait();
    this.core.edit(hooks.edit(), questions, {
      edited: (changed) => hooks.edited(changed, !this.waits),
      limit: (i, limit) => {
        limits[i] = limit;
        for (const table of hooks.tables()) table.showLimit(i, limit);
        if (i < questions.length - 1) return;
        hooks.shown(performance.now() - begun, !this.waits, limits);
        this.done();
      },
      failed: (message) => {
        hooks.failed(message);
        this.done();
      },
    });
  }

  private done(): void {
    this.isBusy = false;
    if (this.waits) this.send();
  }
}
