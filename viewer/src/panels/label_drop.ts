import { CoreClient } from "../core/client";
import type { SideChoice, LabelMap, Proposal } from "../core/protocol";
import { html, named } from "../dom";
import { words } from "../words";
import { LabelChoice, onlyPair, type BonePair } from "./label_choice";

/// Whether a file of this name is one; a header whose data lie in another file as well, which the core refuses with its line.
export function isLabelMap(name: string): boolean {
  return /\.(nii|nii\.gz|hdr|img|nrrd|nhdr|mha|mhd)$/i.test(name);
}

export interface LabelDropHooks {
  wasm: () => Promise<ArrayBuffer>;
  /// Shows the joint.
  take: (core: CoreClient, proposal: Proposal) => void;
  /// Gets the error.
  refuse: (error: unknown) => void;
  /// Values from and for the enclosing panel: progress is one line, empty if nothing is being computed.
  side: () => SideChoice;
  progress: (said: string) => void;
  busy: (state: "open" | "busy" | "done") => void;
}

/// Label maps that were dropped, one with both bones or two, and the joint that is made from them. The worker keeps them until then,
/// so that other labels can be chosen.
export class LabelDrop {
  /// The place of the choice of labels.
  readonly place = html("div");
  private core: CoreClient | null = null;
  private maps: LabelMap[] = [];
  private asked: LabelChoice | null = null;

  constructor(private readonly hooks: LabelDropHooks) {}

  /// Whether a mask of one bone waits for that of the other.
  get isWaiting(): boolean {
    return this.maps.length > 0 && !this.asked;
  }

  reset(): void {
    this.core?.close();
    this.core = null;
    this.maps = [];
    this.place.replaceChildren();
    this.asked = null;
    this.hooks.progress("");
  }

  async add(files: readonly File[]): Promise<void> {
    // A file dropped instead of a choice of labels asks for another joint.
    if (this.asked) this.reset();
    if (this.maps.length + files.length > 2) {
      this.reset();
      return this.hooks.progress(words.dropTwo);
    }
    this.hooks.busy("busy");
    try {
      for (const file of files) await this.read(file);
    } catch (error) {
      this.reset();
      this.hooks.busy("open");
      return this.hooks.refuse(error);
    }
    await this.next();
  }

  private async read(file: File): Promise<void> {
    this.hooks.progress(words.reading(named(file.name)));
    const dropped = { name: file.name, bytes: await file.arrayBuffer() };
    if (this.core) return void this.maps.push(await this.core.call("labels", { wasm: null, file: dropped }, undefined, [dropped.bytes]));
    const wasm = await this.hooks.wasm(), { core, answer } = await CoreClient.begin("labels", { wasm, file: dropped }, [wasm, dropped.bytes]);
    this.core = core;
    this.maps.push(answer);
  }

  /// A mask of one bone waits for the other; if names do not settle it, the user chooses.
  private async next(): Promise<void> {
    const [first] = this.maps;
    this.hooks.busy("open");
    if (this.maps.length === 1 && first!.labels.length === 1) return this.hooks.progress(words.otherMask(named(first!.name)));
    this.hooks.progress("");
    const pair = onlyPair(this.maps, this.hooks.side());
    if (pair) return this.make(pair);
    this.ask();
  }

  private ask(): void {
    if (!this.asked) {
      this.asked = new LabelChoice(this.maps, this.hooks.side(), (pair) => void this.make(pair));
      this.place.replaceChildren(this.asked.element);
    }
    this.asked.setDisabled(false);
    this.asked.focus();
  }

  private async make({ fixed, mobile }: BonePair): Promise<void> {
    const core = this.core!;
    this.hooks.busy("busy");
    this.asked?.setDisabled(true);
    try {
      const proposal = await core.call("join", { fixed, mobile, side: this.hooks.side() }, { step: (label) => this.hooks.progress(this.stepOf(label)) });
      this.hooks.busy("done");
      this.hooks.take(core, proposal);
    } catch (error) {
      this.hooks.busy("open");
      this.hooks.progress("");
      this.hooks.refuse(error);
      this.ask();
    }
  }

  private stepOf(label: string | null): string {
    if (label === null) return words.limitsNext;
    return words.surfaceOf(label === "" ? words.theMask : named(label));
  }
}
