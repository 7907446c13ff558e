import { ReportError, type Passed } from "./checks";
import { bytesOf, inflated } from "./packed";
import type { bandRecord, limitRecord, measureRecord } from "./records";
import { checkedText, type Interval, type ReportText as StoredText } from "./report_shape";
import { words } from "./words";

/// Data that `condyle report` puts into the page; docs/report-data.md has every key. Their types are those of their checks.

/// With what was done to the joint by hand, and its limits before: in no report.
export type ReportText = StoredText & { by_hand?: { done: string; before: MotionAnswer[] } };

type Of<Key extends keyof ReportText> = NonNullable<ReportText[Key]>;
type Each<List extends readonly unknown[]> = List[number];

export type { Interval };
export type ArrayPlace = ReportText["arrays"][string];
export type Band = Pick<Passed<typeof bandRecord>, "p5_deg" | "median_deg" | "p95_deg" | "text">;
export type MotionAnswer = Passed<typeof limitRecord>;
export type BoneReference = NonNullable<MotionAnswer["bone_reference"]>;
export type RomAnswer = Of<"rom">;
export type MeshSource = NonNullable<RomAnswer["provenance"]>["joint_file"];
/// A parameter that moves a part of a body.
export type PartParameter = Each<NonNullable<NonNullable<RomAnswer["provenance"]>["parameters"]>>;
export type BandSigma = NonNullable<RomAnswer["band"]>["sigma"];
export type MapAnswer = Of<"map">;
/// Names of arrays of triangles that meet past the end of a motion.
export type StoredZone = Each<ReportText["zones"]>;
export type StoredLayers = Of<"layers">;
export type StoredSurface = StoredLayers["fixed"];
export type StoredPose = Each<ReportText["poses"]>;
export type Recorded = Of<"recorded">;
/// The shape of a hip; docs/measures.md. Points of the femur are in M, those of the hip bone in F.
export type StoredMeasures = Of<"measures">;
export type Measure = Passed<typeof measureRecord>;
/// The bone that must go; docs/planning.md. The joint of the page is the one without it.
export type StoredPlan = Of<"plan">;
export type EndOfMotion = Each<StoredPlan["limits"]>["before"];
/// The joint before, to which the page's joint is compared.
export type StoredBefore = Of<"before">;
/// How far a motion's limit is from that of the joint before: after minus before.
export type LimitDifference = Each<StoredBefore["differences"]>;
/// Parts that turn, and the bodies as they are given.
export type StoredPosed = Of<"posed">;
export type StoredPart = Each<StoredPosed["parts"]>;
/// A number by which a part turns or shifts; docs/parts.md.
export type StoredParameter = Each<StoredPart["parameters"]>;
/// Designs of `condyle sweep`, the last parameter fastest; docs/sweeps.md.
export type StoredSweep = Of<"sweep">;
export type SweptParameter = Each<StoredSweep["parameters"]>;

const headBytes = 16;
const magic = "CONDYLE\0";
const elementTypes = {
  f64: Float64Array, u32: Uint32Array, i16: Int16Array, u8: Uint8Array,
};
type Elements = { [T in keyof typeof elementTypes]: InstanceType<(typeof elementTypes)[T]> };

/// Scope: what the joint's answers cover and what they exclude.
export function scopeOf({ scope, rom }: ReportText): string | null {
  return scope ?? rom?.scope ?? null;
}

/// A data block: its text, and arrays by name.
export class Report {
  private constructor(readonly text: ReportText, private readonly arrays: ArrayBuffer) {}

  /// Throws ReportError for a block that is damaged.
  static async read(base64: string): Promise<Report> {
    let block: ArrayBuffer;
    try {
      block = await inflated(bytesOf(base64), "deflate");
    } catch {
      throw new ReportError(words.damaged + words.notCompressed);
    }
    return Report.of(block);
  }

  /// The same of a block that is not compressed.
  static of(block: ArrayBuffer): Report {
    const bytes = new Uint8Array(block);
    if (bytes.length < headBytes || new TextDecoder().decode(bytes.subarray(0, magic.length)) !== magic)
      throw new ReportError(words.damaged + words.wrongMagic);
    const head = new DataView(block);
    const version = head.getUint32(8, true);
    if (version !== 1) throw new ReportError(words.damaged + words.wrongVersion(version));
    const textEnd = headBytes + head.getUint32(12, true);
    if (textEnd > bytes.length) throw new ReportError(words.damaged + words.truncated);
    const text = checkedText(new TextDecoder().decode(bytes.subarray(headBytes, textEnd)));
    const report = new Report(text, block.slice(textEnd));
    for (const { type, offset, length } of Object.values(text.arrays))
      if (offset + length * elementTypes[type].BYTES_PER_ELEMENT > report.arrays.byteLength)
        throw new ReportError(words.damaged + words.truncated);
    return report;
  }

  /// The array of that name and type, a copy.
  array<T extends keyof Elements>(name: string, type: T): Elements[T] {
    const place = this.text.arrays[name];
    if (place === undefined || place.type !== type) throw new ReportError(words.damaged + name);
    const Type = elementTypes[type];
    return new Type(this.arrays.slice(place.offset, place.offset + place.length * Type.BYTES_PER_ELEMENT)) as Elements[T];
  }
}
