import { CoreClient } from "./core/client";
import { lineOf } from "./core/error_line";
import type { JointArrays, Proposal } from "./core/protocol";
import { button, found, html, named, textOf } from "./dom";
import { readJoint, reasonOf, sampleFiles, textOfProposal } from "./dropped_joint";
import { jointArraysOf } from "./joint_arrays";
import { clearMessages, post, warn } from "./messages";
import { copiedOf, type Copied } from "./notes_block";
import { Page, type Added } from "./page";
import { keepPage, notesBlock } from "./page_copy";
import { DropPanel } from "./panels/drop";
import { takeDrops } from "./panels/report_drop";
import { Report } from "./report";
import { canCompute, isCoreDamage, wasmBytes } from "./stored_core";
import { words } from "./words";

/// The page without a joint takes one from files; `shown` is called once it shows one. Returns what takes files.
function openEmpty(shown: () => void = () => undefined): DropPanel | undefined {
  if (!canCompute) return void warn(words.noWebAssemblyToRead);
  found("title").textContent = words.noData;
  const sample = sampleFiles(), trySample = () => void sample!().then((files) => panel.add(files)).catch(refuse);
  found("scene").append(html("p", { class: "drop-hint" }, words.dropHint, ...(sample ? [button(words.trySample, trySample)] : [])));
  const drops = new AbortController();
  const warnOnly = (message: string) => {
    clearMessages();
    warn(message);
  };
  const refuse = (error: unknown) => warnOnly(reasonOf(error));
  const leave = () => {
    clearMessages();
    panel.element.remove();
    found("scene").replaceChildren();
  };
  const show = (core: CoreClient, proposal: Proposal) => {
    leave();
    new Page(textOfProposal(proposal), proposal.joint, null, true).compute(core);
    shown();
  };
  const attempt = (work: () => Promise<void>) => work().then(() => true, (error: unknown) => {
    refuse(error);
    return false;
  });
  const panel = new DropPanel({
    signal: drops.signal, labels: { wasm: wasmBytes, take: show, refuse }, refuse: warnOnly,
    meshes: (fixedFile, mobileFile, side) => attempt(async () => {
      const wasm = await wasmBytes(), { core, answer } = await CoreClient.begin("propose", { wasm, fixed: fixedFile, mobile: mobileFile, side }, [wasm]);
      show(core, answer);
    }),
    jointFile: (files) => attempt(async () => {
      const report = await readJoint(files);
      drops.abort();
      leave();
      await showDropped(report);
      shown();
    }),
  });
  found("side").append(panel.element);
  return panel;
}

/// The joint of dropped files, with what the page leaves to the command.
async function showDropped(report: Report): Promise<void> {
  await show(report, true);
  const { only_in_reports = [], taken_by_name = [] } = report.text;
  const lines = [
    ...(hasReport() ? [words.notTheReport] : []), ...taken_by_name.map(({ mesh, taken }) => words.takenByName(named(mesh), named(taken))),
    ...only_in_reports.map((table) => words.onlyInReports[table]),
  ];
  if (lines.length) post("status", lines.join(" "));
}

/// The notes of a saved copy; null for a page that is not a copy. It opens with the view it was saved with, unless the address gives another.
function copiedWith({ fixed, mobile }: JointArrays): Copied | null {
  const block = notesBlock();
  if (block === null) return null;
  try {
    const copied = copiedOf(block, { fixed: fixed.vertices.length / 3, mobile: mobile.vertices.length / 3 });
    if (!location.hash && copied.view) history.replaceState(null, "", copied.view);
    return copied;
  } catch (error) {
    warn(words.notesDamaged(lineOf(error)));
    return null;
  }
}

/// Whether the file of this page is a report; else it is the page without a joint.
function hasReport(): boolean {
  return textOf("condyle-data") !== null;
}

async function open(): Promise<void> {
  keepPage();
  found("unfinished").remove();
  found("skip").textContent = words.skip;
  found("scope").textContent = words.footer;
  const data = textOf("condyle-data");
  if (data === null) return void openEmpty();
  await show(await Report.read(data), false);
}

/// The joint of a report, which takes the place of another page that was closed.
async function show(report: Report, isDropped: boolean): Promise<void> {
  const arrays = jointArraysOf(report), copied = isDropped ? null : copiedWith(arrays);
  const newPage = (computes: boolean, added: Added) => new Page(report.text, arrays, report, computes, { ...added, isDropped });
  let page = newPage(canCompute, { notes: copied ?? undefined });
  if (copied) page.sayIsCopy(copied);
  const compute = async () => {
    const wasm = await wasmBytes();
    page.compute((await CoreClient.begin("open", { wasm, arrays }, [wasm])).core);
  };
  const drops = new AbortController();
  const leave = () => {
    drops.abort();
    page.close();
    leaveReport();
  };
  takeDrops({
    signal: drops.signal, computes: canCompute, read: (file) => page.readMotion(file), isReport: !isDropped,
    play: async (motion) => {
      page = newPage(true, { notes: page.handOver(), motion });
      await compute();
      page.playFromStart();
    },
    replace: (files) => {
      leave();
      void openEmpty(hasReport() ? () => post("status", words.notTheReport) : undefined)?.add(files);
    },
    readJoint: async (files) => {
      const dropped = await readJoint(files).catch((error: unknown) => {
        throw new Error(reasonOf(error));
      });
      return () => {
        leave();
        return showDropped(dropped);
      };
    },
  });
  if (!canCompute) return page.useStoredPoses(words.noWebAssembly);
  try {
    await compute();
  } catch (error) {
    page = newPage(false, { notes: page.handOver() });
    page.useStoredPoses(isCoreDamage(error) ? words.coreDamaged : lineOf(error));
  }
}

/// Another joint has another view. The line in the foot stays.
function leaveReport(): void {
  history.replaceState(null, "", "#");
  clearMessages();
  if (hasReport()) found("scope").textContent = `${words.footer} ${words.notTheReport}`;
}

open().catch((error: unknown) => {
  warn(lineOf(error));
});
