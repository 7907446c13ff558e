import type { BoneChoice, SideChoice, LabelMap } from "../core/protocol";
import { button, choice, html, named } from "../dom";
import { words } from "../words";

/// Both bones of a joint.
export interface BonePair {
  fixed: BoneChoice;
  mobile: BoneChoice;
}

interface BoneOption {
  text: string;
  bone: BoneChoice;
}

const isHipBone = /hip|pelvi|innominat|ilium|coxa/i, isFemur = /femur|femor|thigh/i;
/// Text that the core would read as a number.
const isNumber = /^[0-9:]+$/;

/// Bones whose names leave nothing to choose: one pair in the files' own names, on the given side, or two masks of one bone.
export function onlyPair(maps: readonly LabelMap[], side: SideChoice): BonePair | null {
  if (maps.length === 2 && maps.every(({ labels }) => labels.length === 1)) return pairOfMasks(maps);
  const pairs = pairsOf(maps, side).filter(({ fixed }) => fixed.task === null);
  return pairs.length === 1 ? pairs[0]! : null;
}

/// A femur is the mobile body, else the second of the two.
function pairOfMasks(maps: readonly LabelMap[]): BonePair {
  const mask = (map: number): BoneChoice => ({ map, label: "", task: null });
  const isTurned = isFemur.test(maps[0]!.name) && !isFemur.test(maps[1]!.name);
  return isTurned ? { fixed: mask(1), mobile: mask(0) } : { fixed: mask(0), mobile: mask(1) };
}

function pairsOf(maps: readonly LabelMap[], side: SideChoice): BonePair[] {
  return maps.flatMap(({ pairs }, map) => pairs.filter((pair) => side === "automatic" || pair.side === side).map(({ task, fixed, mobile }) => ({
    fixed: { map, label: fixed.label, task }, mobile: { map, label: mobile.label, task },
  })));
}

/// Every label, first those that a table names.
function optionsOf(maps: readonly LabelMap[]): BoneOption[] {
  return maps.flatMap(({ name: file, labels, pairs }, map) => {
    const of = maps.length > 1 ? `${named(file)}: ` : "";
    const voxels = new Map(labels.map((label) => [label.choice, label.voxels]));
    const tabled = pairs.filter(({ task }) => task !== null).flatMap(({ task, fixed, mobile }) => [fixed, mobile].map(({ label, choice }) => ({
      text: of + words.labelOfTable(label, choice, task!, voxels.get(choice) ?? 0), bone: { map, label, task },
    })));
    const counts = new Map<string, number>();
    for (const { name } of labels) counts.set(name, (counts.get(name) ?? 0) + 1);
    const own = labels.map(({ choice, name, voxels: count }) => {
      const isAsked = name !== "" && counts.get(name) === 1 && !isNumber.test(name);
      return { text: of + words.labelOfFile(named(name), choice, count), bone: { map, label: isAsked ? name : choice, task: null } };
    });
    return [...tabled, ...own];
  });
}

/// Which label of label maps is which bone.
export class LabelChoice {
  readonly element: HTMLElement;
  private readonly options: BoneOption[];
  private chosen: { fixed: string; mobile: string };

  constructor(maps: readonly LabelMap[], side: SideChoice, make: (pair: BonePair) => void) {
    this.options = optionsOf(maps);
    this.chosen = this.proposed(maps, side);
    const texts = Object.fromEntries(this.options.map(({ text }, i) => [`bone ${i}`, text]));
    const row = (text: string, body: "fixed" | "mobile") =>
      html("p", {}, choice(text, texts, this.chosen[body], (key) => (this.chosen[body] = key)));
    this.element = html("div", { id: "label-choice" },
      html("p", {}, words.chooseLabels(maps.map(({ name }) => named(name)).join(", "))), row(words.boneThatStays, "fixed"),
      row(words.boneThatMoves, "mobile"), html("p", {}, button(words.makeJoint, () => make(this.pair()))));
  }

  focus(): void {
    this.element.querySelector("select")!.focus();
  }

  setDisabled(disabled: boolean): void {
    for (const control of this.element.querySelectorAll<HTMLSelectElement | HTMLButtonElement>("select, button")) control.disabled = disabled;
  }

  private pair(): BonePair {
    return { fixed: this.boneOf(this.chosen.fixed), mobile: this.boneOf(this.chosen.mobile) };
  }

  private boneOf(key: string): BoneChoice {
    return this.options[Number(key.slice("bone ".length))]!.bone;
  }

  /// The first pair that has names, else labels by words in theirs, else the first two.
  private proposed(maps: readonly LabelMap[], side: SideChoice): { fixed: string; mobile: string } {
    const at = ({ map, label, task }: BoneChoice) =>
      this.options.findIndex(({ bone }) => bone.map === map && bone.label === label && bone.task === task);
    const [pair] = pairsOf(maps, side);
    const place = (of: number, otherwise: number) => `bone ${of >= 0 ? of : Math.min(otherwise, this.options.length - 1)}`;
    const called = (is: RegExp) => this.options.findIndex(({ text }) => is.test(text));
    return { fixed: place(pair ? at(pair.fixed) : called(isHipBone), 0), mobile: place(pair ? at(pair.mobile) : called(isFemur), 1) };
  }
}
