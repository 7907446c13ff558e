import { lineOf } from "../core/error_line";
import type { NamedFile } from "../core/protocol";
import { button, named } from "../dom";
import { clearMessages, post, warn } from "../messages";
import type { RecordedMotion } from "../recorded_motion";
import { words } from "../words";
import { isJointFile, isMesh, isMotionFile, unknownAmong } from "./drop";
import { isLabelMap } from "./label_drop";
import { catchDrops } from "./page_drop";

export interface DropsOnReport {
  signal: AbortSignal;
  computes: boolean;
  /// Whether the joint is that of the page's own file.
  isReport: boolean;
  read: (file: File) => Promise<{ motion: RecordedMotion; remarks: string[] }>;
  play: (motion: RecordedMotion) => Promise<void>;
  /// Two meshes or label maps.
  replace: (files: NamedFile[]) => void;
  /// A joint file and its meshes: what shows it, once it is read. Rejects with the line of a file that is not taken.
  readJoint: (files: NamedFile[]) => Promise<() => Promise<void>>;
}

/// Motion files that are dropped on a report are played on its joint, one at a time. A file that misses its mark does not replace the report:
/// another joint takes its place once that is confirmed and its files are read, and others are refused in a line.
export function takeDrops({ signal, computes, isReport, read, play, replace, readJoint }: DropsOnReport): void {
  let isBusy = false;
  catchDrops((files) => {
    if (isBusy) return warn(words.dropBusy);
    const file = files[0]?.file, joints = files.filter(({ path }) => isJointFile(path));
    const confirm = (those: NamedFile[], open: () => void) =>
      post("status", words.replaceJoint(those.map(({ path }) => named(path)).join(", ")), button(words.replaceReportButton, open));
    if (computes && joints.length > 0)
      return confirm(joints, () => {
        if (isBusy) return warn(words.dropBusy);
        isBusy = true;
        clearMessages();
        post("status", words.loading);
        readJoint(files).then((show) => show()).catch((error: unknown) => {
          clearMessages();
          warn(lineOf(error));
        }).finally(() => (isBusy = false));
      });
    if (computes && files.length <= 2 && files.every(({ path }) => isMesh(path) || isLabelMap(path))) return confirm(files, () => replace(files));
    if (files.length !== 1 || !isMotionFile(file!.name)) return warn(unknownAmong(files) ?? words.dropOnReport);
    isBusy = true;
    read(file!).then(async ({ motion, remarks }) => {
      await play(motion);
      clearMessages();
      post("status", [words.motionPlays(named(file!.name), motion.times.length, isReport), ...remarks].join(" "));
    }).catch((error: unknown) => warn(lineOf(error))).finally(() => (isBusy = false));
  }, signal);
}
