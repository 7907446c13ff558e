import type { PageCore } from "page-core";
import { openModule } from "./module";
import {
  quantityNumber, type BothPenetrations, type BothValues, type Brushed, type Coordinates, type Depth, type Details, type DroppedFile, type Edit,
  type JointArrays, type Layers, type LigamentShown, type LimitQuestion, type LiveLimit, type MapQuestion, type MotionFrames, type Nearest, type Penetrations, type PosedArrays,
  type Proposal, type Quantity, type Screw, type Shown, type SideChoice, type Standing, type Stroke, type Surface, type Turned, type Values,
} from "./protocol";

const poseBytes = 16 * 8;
const atRest = [0, 0, 0] as const;
const reasons = ["contact", "end_of_range", "contact_at_start", "ligament", "strained_at_start"] as const;
const states = ["free", "at_limit", "bearing", "impinging", "strained", "contact"] as const;
const kinds = ["unknown", "bearing", "impingement", "cut"] as const;

/// A joint in the module's memory. Everything it answers is copied out of there.
export class CoreJoint {
  private readonly pose: number;
  private readonly answer: number;
  private readonly shownPlace: number;
  private readonly marksPlace: number;
  private readonly vertices: { fixed: number; mobile: number };
  private readonly mobileTriangles: number;
  private readonly protectedVertices = { fixed: 0, mobile: 0 };
  private ligamentNames: string[] = [];

  static async open(wasm: ArrayBuffer, arrays: JointArrays): Promise<CoreJoint> {
    const memory = new Memory(await openModule(wasm)), { core } = memory, { bearing } = arrays;
    const given = ({ vertices, triangles }: Surface) => [vertices, vertices.length / 3, triangles, triangles.length / 3] as const;
    const joint = memory.made(
      core._condyle_joint, arrays.kind, arrays.anatomy, arrays.side, arrays.translationFrame, ...given(arrays.fixed), ...given(arrays.mobile));
    const opened = new CoreJoint(memory, joint);
    if (bearing !== "found") opened.on(core._condyle_set_roles, bearing.counts ? 1 : 0, bearing.fixed, bearing.mobile);
    if (arrays.layers) opened.setLayers(arrays.layers);
    if (arrays.posed) opened.describeParts(arrays.posed);
    if (arrays.ligaments) opened.setLigaments(arrays.ligaments);
    return opened;
  }

  /// The joint that is proposed for two mesh files; throws the command line's own line if there is none.
  static async propose(
    wasm: ArrayBuffer, fixed: DroppedFile, mobile: DroppedFile, side: SideChoice): Promise<{ joint: CoreJoint; proposal: Proposal }> {
    const memory = new Memory(await openModule(wasm));
    const { core } = memory;
    const meshes = [fixed, mobile].map((file) => memory.read(file, core._condyle_read_mesh));
    const joint = core._condyle_propose(meshes[0]!, meshes[1]!, sideNumber[side]);
    meshes.forEach((mesh) => core._condyle_free_mesh(mesh));
    return CoreJoint.proposed(memory, joint, { fixed: fixed.name, mobile: mobile.name });
  }

  /// A joint that the core has proposed, or its error line if that is null.
  static proposed(memory: Memory, made: number, bodies: Proposal["bodies"]): { joint: CoreJoint; proposal: Proposal } {
    const { core } = memory, joint = new CoreJoint(memory, made), description = core._condyle_description(made);
    if (!description) throw memory.error();
    return {
      joint,
      proposal: {
        joint: {
          kind: 0, anatomy: 0, side: core._condyle_side(made), translationFrame: 0, fixed: joint.surface(1),
          mobile: joint.surface(0), bearing: "found", layers: null, posed: null, ligaments: null,
        },
        rom: JSON.parse(memory.text(description)) as Proposal["rom"], bodies,
      },
    };
  }

  private constructor(private readonly memory: Memory, private readonly joint: number) {
    const { core } = memory;
    if (!joint) throw memory.error();
    this.vertices = { fixed: core._condyle_vertex_count(joint, 1), mobile: core._condyle_vertex_count(joint, 0) };
    this.mobileTriangles = core._condyle_triangle_count(joint, 0);
    const most = Math.max(this.vertices.fixed, this.vertices.mobile);
    this.pose = core._malloc(poseBytes);
    this.answer = core._malloc(16 * 8);
    this.shownPlace = core._malloc(4 * most);
    this.marksPlace = core._malloc(Math.max(most, this.mobileTriangles));
  }

  shown(at: Coordinates): Shown {
    this.place(at);
    const inside = { mobile: this.inside(0), fixed: this.inside(1) }, inContact = this.inContact();
    return { pose: this.f64(this.pose, 16), inContact, inside, pairs: inContact ? this.pairs() : new Uint32Array(), ligaments: this.ligaments() };
  }

  /// Throws the command line's own line for a bad file.
  motion({ name, bytes }: DroppedFile, columns: string): MotionFrames {
    const { memory, core } = this, said = memory.made(core._condyle_motion, this.joint, name, new Uint8Array(bytes), bytes.byteLength, columns);
    return JSON.parse(memory.text(said)) as MotionFrames;
  }

  values(at: Coordinates, quantity: Exclude<Quantity, "none">): BothValues {
    this.place(at);
    return { mobile: this.valuesOf(quantity, 0, this.vertices.mobile), fixed: this.valuesOf(quantity, 1, this.vertices.fixed) };
  }

  nearest(at: Coordinates, counted: boolean): Nearest {
    this.place(at);
    this.on(this.core._condyle_nearest, this.pose, counted ? 1 : 0, this.answer);
    const [distance_mm, fixed, mobile, isBearing, x, y, z] = this.f64(this.answer, 7) as unknown as [number, number, number, number, number, number, number];
    return { distance_mm, triangle: { fixed, mobile }, isBearing: isBearing === 1, point: [x, y, z] };
  }

  /// `held` in F, mm.
  standing(angles: readonly number[], held: readonly number[]): Standing {
    this.on(this.core._condyle_standing, angles, held, this.answer);
    const [state, vary, isHigh, byLigament] = this.f64(this.answer, 4) as unknown as [number, number, number, number];
    return { is: states[state]!, vary, isHigh: isHigh === 1, byLigament: byLigament === 1 };
  }

  limit({ start, held, vary, positive, range_deg }: LimitQuestion): LiveLimit {
    this.on(this.core._condyle_limit, vary, positive ? 1 : 0, start, held ?? atRest, range_deg, this.answer);
    return this.limitThere(vary, positive);
  }

  /// Rotations are about the centre's latest place.
  limitAbout({ start, vary, positive, range_deg }: LimitQuestion): LiveLimit {
    this.on(this.core._condyle_limit_about, vary, positive ? 1 : 0, start, range_deg, this.answer);
    return this.limitThere(vary, positive);
  }

  private limitThere(vary: number, positive: boolean): LiveLimit {
    const [turned_deg, reason, kind, bearing, x, y, z, ligament] = this.f64(this.answer, 8) as unknown as number[];
    return {
      vary, positive, turned_deg: turned_deg!, reason: reasons[reason!]!, kind: kinds[kind!]!,
      bearing_deg: bearing! < 0 ? null : bearing!, point: Number.isNaN(x!) ? null : [x!, y!, z!],
      ligament: this.ligamentNames[ligament!] ?? null,
    };
  }

  /// Null if no bone changes.
  edit(edit: Edit): Brushed | Turned | null {
    if (edit.of === "parts") {
      this.on(this.core._condyle_set_parameters, edit.values);
      return { fixed: this.surface(1).vertices, mobile: this.surface(0).vertices };
    }
    if (edit.of === "centre") {
      this.on(this.core._condyle_move_centre, edit.offset_mm, edit.reference_deg);
      return null;
    }
    const { body } = edit, ofFixed = body === "fixed" ? 1 : 0;
    if (edit.of === "brush") this.protectedVertices[body] = this.on(this.core._condyle_brush, ofFixed, edit.before);
    if (edit.of === "undo" || (edit.of === "stroke" && edit.replaces)) this.on(this.core._condyle_undo_stroke, ofFixed);
    return this.brushed(body, edit.of === "stroke" ? this.stroke(ofFixed, edit.stroke) : null);
  }

  private stroke(ofFixed: number, { action, along, radius_mm, depth_mm }: Stroke): Brushed["outcome"] {
    this.on(
      this.core._condyle_stroke, ofFixed, action === "lower" ? 0 : 1, Uint32Array.from(along), along.length, radius_mm, depth_mm, this.answer);
    const [moved, kept, limited] = this.u32(this.answer, 3) as unknown as [number, number, number];
    return { moved, kept, limited };
  }

  private brushed(body: "fixed" | "mobile", outcome: Brushed["outcome"]): Brushed {
    const { core } = this, ofFixed = body === "fixed" ? 1 : 0, count = this.vertices[body];
    this.on(core._condyle_removed, ofFixed, this.answer);
    const [volume_mm3, deepest_mm, , edge_mm] = this.f64(this.answer, 4) as unknown as [number, number, number, number];
    const vertices = core._malloc(24 * count), depths = core._malloc(8 * count);
    this.on(core._condyle_brushed, ofFixed, vertices, depths);
    const bone = { vertices: this.f64(vertices, 3 * count), depths_mm: this.f64(depths, count) };
    this.memory.free(vertices, depths);
    const steps = this.on(core._condyle_strokes, ofFixed);
    return { body, ...bone, volume_mm3, deepest_mm, edge_mm, steps, protectedVertices: this.protectedVertices[body], outcome };
  }

  /// The answer of `condyle depth`.
  depth(at: Coordinates): Depth {
    this.place(at);
    this.on(this.core._condyle_depth, this.pose, at.angles, this.answer);
    const answer = this.f64(this.answer, 16);
    const [inContact, kind, depth_mm, body, vertex, x, y, z, nearest_mm] = answer as unknown as [
      number, number, number, number, number, number, number, number, number];
    const orNull = (place: number): number | null => (Number.isNaN(answer[place]!) ? null : answer[place]!);
    return {
      inContact: inContact === 1,
      deepest: kind === 0 ? null : {
        depth_mm, about: kind === 1 ? null : kind - 2, depth_deg: orNull(9), body: body === 0 ? "mobile" : "fixed", vertex,
        point: [x, y, z], nearest_mm,
      },
      withoutDepth: answer[10]!, area_mm2: { mobile: orNull(11), fixed: orNull(12) }, volume_mm3: orNull(13),
      volumeError_mm3: orNull(14), coveredAgain_mm3: orNull(15),
    };
  }

  screw(before: Coordinates, at: Coordinates): Screw {
    this.place(before);
    const from = this.f64(this.pose, 16);
    this.place(at);
    this.on(this.core._condyle_screw, from, this.pose, this.answer);
    const [slides, ...rest] = Array.from(this.f64(this.answer, 9), (value) => (Number.isNaN(value) ? null : value));
    const axis = rest.slice(0, 6) as number[], [depth_deg, depth_mm] = rest.slice(6) as [number | null, number | null];
    return { slides: slides === 1, axis: axis[0] === null ? null : { direction: axis.slice(0, 3), point: axis.slice(3) }, depth_deg, depth_mm };
  }

  /// At coordinates, or at X_FM, 16 numbers row by row.
  details(at: Coordinates | readonly number[]): Details {
    const inside = this.penetrationsAt(at);
    return { pose: this.f64(this.pose, 16), inContact: this.inContact(), ...inside, pairs: this.pairs() };
  }

  penetrationsAt(at: Coordinates | readonly number[]): BothPenetrations {
    this.place(at);
    return { mobileInFixed: this.penetrations(0), fixedInMobile: this.penetrations(1) };
  }

  private inContact(): boolean {
    return this.on(this.core._condyle_in_contact, this.pose) === 1;
  }

  private pairs(): Uint32Array {
    const count = this.on(this.core._condyle_pairs, this.pose);
    return this.u32(this.core._condyle_pair_triangles(this.joint), 2 * count);
  }

  /// Free intervals of a point of a map, as angles of the joint.
  mapPoint(question: MapQuestion, point: number): [number, number, number, number][] {
    const start: [number, number, number] = [0, 0, 0];
    start[question.columnAngle] = question.columns[point % question.columns.length]!;
    start[question.rowAngle] = question.rows[Math.floor(point / question.columns.length)]!;
    const count = this.on(this.core._condyle_free_angles, question.vary, start, question.held ?? atRest, 180, 180);
    const flat = this.f64(this.core._condyle_intervals(this.joint), 4 * count);
    return Array.from({ length: count }, (_, i) => Array.from(flat.subarray(4 * i, 4 * i + 4)) as [number, number, number, number]);
  }

  /// Per triangle of the mobile body 1 where it is bearing; all 0 if no bearing surface was found.
  bearing(): Uint8Array {
    const found = this.on(this.core._condyle_bearing, this.marksPlace);
    return found ? this.core.HEAPU8.slice(this.marksPlace, this.marksPlace + this.mobileTriangles) : new Uint8Array(this.mobileTriangles);
  }

  get memory_bytes(): number {
    return this.core.HEAPU8.length;
  }

  private penetrations(ofFixed: number): Penetrations {
    if (!this.core._condyle_can_penetrate(this.joint, ofFixed)) return { vertices: new Uint32Array(), depths_mm: new Float64Array() };
    const count = this.on(this.core._condyle_penetrations, this.pose, ofFixed);
    return {
      vertices: this.u32(this.core._condyle_penetrating_vertices(this.joint), count),
      depths_mm: this.f64(this.core._condyle_depths(this.joint), count),
    };
  }

  private inside(ofFixed: number): number {
    return this.core._condyle_can_penetrate(this.joint, ofFixed) ? this.on(this.core._condyle_penetrations, this.pose, ofFixed) : 0;
  }

  private setLayers(layers: Layers): void {
    for (const [ofFixed, { layer, ...surface }] of [layers.mobile, layers.fixed].entries())
      this.on(
        this.core._condyle_surface, ofFixed, surface.firstVertex, surface.vertices, surface.firstTriangle, surface.triangles,
        layer?.youngsModulus_mpa ?? 0, layer?.poissonRatio ?? 0, layer?.thickness_mm ?? null);
    this.on(this.core._condyle_elastic, layers.casting, layers.law, layers.rule, layers.reach_mm);
  }

  private describeParts({ text, fixed, mobile }: PosedArrays): void {
    for (const [ofFixed, given] of [mobile, fixed].entries())
      this.on(this.core._condyle_body_given, ofFixed, given.text, given.vertices, given.fittedHead, given.fittedHead?.length ?? 0);
    this.on(this.core._condyle_parts, text);
  }

  private setLigaments(toml: string): void {
    this.on(this.core._condyle_set_ligaments, toml);
    this.ligamentNames = this.ligamentsAt({ angles: [0, 0, 0], translation: [0, 0, 0] }).map(({ name }) => name);
  }

  ligamentsAt(at: Coordinates): LigamentShown[] {
    this.place(at);
    return this.ligaments();
  }

  /// At the pose that was placed.
  private ligaments(): LigamentShown[] {
    const { memory, core } = this;
    return JSON.parse(memory.text(memory.made(core._condyle_ligaments, this.joint, this.pose))) as LigamentShown[];
  }

  private valuesOf(quantity: Exclude<Quantity, "none">, ofFixed: number, count: number): Values {
    const { core, pose, shownPlace, marksPlace } = this;
    if (quantity === "pressure") this.on(core._condyle_pressure, pose, ofFixed, shownPlace, marksPlace);
    else this.on(core._condyle_shown, pose, quantityNumber[quantity], ofFixed, shownPlace, marksPlace);
    return {
      shown: new Float32Array(this.bytes(shownPlace, 4 * count)), marks: new Uint8Array(this.bytes(marksPlace, count)),
    };
  }

  surface(ofFixed: number): Surface {
    const { core } = this.memory;
    const vertexCount = core._condyle_vertex_count(this.joint, ofFixed), count = core._condyle_triangle_count(this.joint, ofFixed);
    const vertices = core._malloc(24 * vertexCount), triangles = core._malloc(12 * count);
    core._condyle_mesh(this.joint, ofFixed, vertices, triangles);
    const surface = { vertices: this.f64(vertices, 3 * vertexCount), triangles: this.u32(triangles, 3 * count) };
    this.memory.free(vertices, triangles);
    return surface;
  }

  private place(at: Coordinates | readonly number[]): void {
    if ("angles" in at) this.on(this.core._condyle_pose, at.angles, at.translation, this.pose);
    else new Float64Array(this.core.HEAPU8.buffer, this.pose, 16).set(at);
  }

  /// Asks the core about this joint.
  private on<Args extends number[]>(of: (joint: number, ...args: Args) => number, ...given: Given<Args>): number {
    return this.memory.call(of, ...([this.joint, ...given] as Given<[number, ...Args]>));
  }

  private get core(): PageCore {
    return this.memory.core;
  }
  private bytes(pointer: number, count: number): ArrayBuffer {
    return this.core.HEAPU8.slice(pointer, pointer + count).buffer as ArrayBuffer;
  }
  private f64(pointer: number, count: number): Float64Array {
    return new Float64Array(this.bytes(pointer, 8 * count));
  }
  private u32(pointer: number, count: number): Uint32Array {
    return new Uint32Array(this.bytes(pointer, 4 * count));
  }
}

/// The side as condyle_propose() and condyle_join() take it.
export const sideNumber = { automatic: -1, right: 0, left: 1 } as const;

/// What the core's functions take: numbers as they are, and copies of all else, null as no place. A list of numbers is doubles.
type Given<Args extends number[]> = { [Place in keyof Args]: number | string | readonly number[] | Float64Array | Uint32Array | Uint8Array | null };

/// The module's memory.
export class Memory {
  constructor(readonly core: PageCore) {}

  /// A number that the core answers; throws its line if that is below zero.
  call<Args extends number[]>(of: (...args: Args) => number, ...given: Given<Args>): number {
    const answer = this.within(of, given);
    if (answer < 0) throw this.error();
    return answer;
  }
  /// Something that the core makes, by its place; throws its line if it makes none.
  made<Args extends number[]>(of: (...args: Args) => number, ...given: Given<Args>): number {
    const place = this.within(of, given);
    if (!place) throw this.error();
    return place;
  }
  /// What a reader of the core makes of a file.
  read({ name, bytes }: DroppedFile, reader: (name: number, bytes: number, count: number) => number): number {
    return this.made(reader, name, new Uint8Array(bytes), bytes.byteLength);
  }
  /// A text of the core.
  text(place: number): string {
    return this.core.UTF8ToString(place);
  }
  free(...places: number[]): void {
    for (const place of places) this.core._free(place);
  }
  error(): Error {
    return new Error(this.text(this.core._condyle_error()));
  }

  private within<Args extends number[]>(of: (...args: Args) => number, given: Given<Args>): number {
    const copies: number[] = [];
    const args = (given as Given<number[]>).map((each) => {
      if (typeof each === "number" || each === null) return each ?? 0;
      const bytes = typeof each === "string" ? new TextEncoder().encode(`${each}\0`) : ArrayBuffer.isView(each) ? each : Float64Array.from(each);
      const place = this.core._malloc(bytes.byteLength);
      this.core.HEAPU8.set(new Uint8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength), place);
      copies.push(place);
      return place;
    });
    const answer = of(...(args as Args));
    this.free(...copies);
    return answer;
  }
}
