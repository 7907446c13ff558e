import { CoreJoint, Memory, sideNumber } from "./joint";
import { openModule } from "./module";
import type { BoneChoice, DroppedFile, SideChoice, LabelMap, Proposal } from "./protocol";

/// Label maps in the module's memory, until a joint is made of two of their labels.
export class CoreLabels {
  private readonly maps: number[] = [];

  static async open(wasm: ArrayBuffer): Promise<CoreLabels> {
    return new CoreLabels(new Memory(await openModule(wasm)));
  }

  private constructor(private readonly memory: Memory) {}

  /// Throws the command line's own line for a bad file.
  read(file: DroppedFile): LabelMap {
    const { core } = this.memory, map = this.memory.read(file, core._condyle_read_labels), described = core._condyle_labels(map);
    if (!described) throw this.memory.error();
    this.maps.push(map);
    return { name: file.name, ...(JSON.parse(this.memory.text(described)) as Omit<LabelMap, "name">) };
  }

  /// `step` is called before each surface with its label, then with null. The label maps stay if this throws.
  join(
    fixed: BoneChoice, mobile: BoneChoice, side: SideChoice, step: (label: string | null) => void): { joint: CoreJoint; proposal: Proposal } {
    const { core } = this.memory, bones: number[] = [];
    try {
      for (const choice of [fixed, mobile]) {
        step(choice.label);
        bones.push(this.memory.made(core._condyle_bone, this.maps[choice.map]!, choice.label, choice.task ?? ""));
      }
      step(null);
      const joint = core._condyle_join(bones[0]!, bones[1]!, sideNumber[side]);
      const names = bones.map((bone) => this.memory.text(core._condyle_bone_name(bone)));
      if (joint) this.maps.splice(0).forEach((map) => core._condyle_free_labels(map));
      return CoreJoint.proposed(this.memory, joint, { fixed: names[0]!, mobile: names[1]! });
    } finally {
      bones.forEach((bone) => core._condyle_free_bone(bone));
    }
  }
}
