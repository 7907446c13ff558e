import { lineOf } from "../core/error_line";
import { button, named } from "../dom";
import { clearMessages, post, warn } from "../messages";
import type { RecordedMotion } from "../recorded_motion";
import { words } from "../words";
import { isMesh } from "./drop";
import { isLabelMap } from "./label_drop";
import { catchDrops } from "./page_drop";

export interface DropsOnReport {
  signal: AbortSignal;
  computes: boolean;
  read: (file: File) => Promise<{ motion: RecordedMotion; remarks: string[] }>;
  play: (motion: RecordedMotion) => Promise<void>;
  replace: (files: File[]) => void;
}

/// Motion files that are dropped on a report are played on its joint, one at a time. A file that misses its mark does not replace the report:
/// bones take its place once that is confirmed, and others are refused in a line.
export function takeDrops({ signal, computes, read, play, replace }: DropsOnReport): void {
  let isBusy = false;
  catchDrops((files) => {
    if (isBusy) return warn(words.dropBusy);
    const [file] = files;
    if (computes && files.length <= 2 && files.every(({ name }) => isMesh(name) || isLabelMap(name)))
      return post("status", words.replaceReport(files.map(({ name }) => named(name)).join(", ")), button(words.replaceReportButton, () => replace(files)));
    if (files.length !== 1 || !/\.(mot|sto|csv|tsv)$/i.test(file!.name)) return warn(words.dropOnReport);
    isBusy = true;
    read(file!).then(async ({ motion, remarks }) => {
      await play(motion);
      clearMessages();
      post("status", [words.motionPlays(named(file!.name), motion.times.length), ...remarks].join(" "));
    }).catch((error: unknown) => warn(lineOf(error))).finally(() => (isBusy = false));
  }, signal);
}
