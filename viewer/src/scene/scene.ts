import { Box3, Matrix4, Plane, Quaternion, Scene, Vector3, WebGLRenderer } from "three";
import type { Surface } from "../core/protocol";
import { Annotations } from "./annotations";
import { SceneBody, type Marked, type Part } from "./body";
import { bodyNames, otherThan, type BodyName } from "./body_names";
import { prefersStill } from "./camera_turn";
import { plainBone, type ColourScale } from "./colour_scale";
import { directionOnto, directionPast, type Standing } from "./contact_view";
import { heightOfJoint, radiusOfNeighbours } from "./framing";
import { aside, JointCamera } from "./joint_camera";
import { Lights } from "./lights";
import { enlarged, SceneOverlay, type Written } from "./overlay";
import { Picker, type Picked, type PickedPoint } from "./picking";
import { composedPicture } from "./picture";
import { lettersOf, scaleBarLength, viewDirections, type Three, type View } from "./views";

export type ClipAxis = "none" | "x" | "y" | "z";

const boneColours = { fixed: plainBone, mobile: "#c0cddb" };
/// Darker than the bone that carries it, of the same hue: colours of the scale stay those of values.
const cartilageColours = { fixed: "#c2b186", mobile: "#8fa9c6" };

/// The joint's sphere of a joint whose bones are apart, as a share of both bones' diagonal.
const shareOfSize = 0.08;
const contactPointShare = 0.05;
/// The joint rests once it has stood so long.
const rest_ms = 500;
/// A motion of less has no plane.
const leastMotion_rad = 0.02;
/// No side of a picture has more pixels: every browser draws so many.
const mostPixels = 4096;
/// A scale bar is at most so long.
const longestScaleBar_px = 130, shareOfWidth = 0.3;

/// Both bones before a camera. Drawn only when something changed. Points are in F, mm, unless stated otherwise.
export class JointScene {
  readonly bodies: Record<BodyName, SceneBody>;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly lights: Lights;
  private readonly overlay = new SceneOverlay();
  readonly camera: JointCamera;
  readonly annotations: Annotations;
  private readonly picker: Picker;
  private readonly opacities: Record<BodyName, number> = { fixed: 1, mobile: 1 };
  /// The limit shown.
  private limit: { point: Vector3; label: string; glass: BodyName } | null = null;
  private scale: ColourScale | null = null;
  private pins: readonly Picked[] = [];
  private frameAsked = false;
  private givenRadius_mm: number | null = null;
  private foundRadius_mm: number | null = null;
  private fitted: "joint" | "all" = "joint";
  private hasPose = false;
  /// Whether the page may turn the camera that it has placed.
  private mayTurn = true;
  private rest = 0;
  private shade = 0;
  private rested = new Quaternion();
  /// A processor that draws in place of a graphics card draws shadows only of what rests.
  private readonly isSlow: boolean;

  /// Throws if the browser has no WebGL.
  constructor(
    private readonly place: HTMLElement, fixed: Surface, mobile: Surface, parts: Record<BodyName, readonly Part[]>, label: string) {
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.renderer.setClearColor(0, 0);
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    place.append(canvas, this.overlay.element);
    this.overlay.setScale(null);

    const body = (name: BodyName, surface: Surface) => new SceneBody(surface, boneColours[name], cartilageColours[name], parts[name], () => this.draw());
    this.bodies = { fixed: body("fixed", fixed), mobile: body("mobile", mobile) };
    this.bodies.mobile.mesh.matrixAutoUpdate = false;
    this.scene.add(this.bodies.fixed.mesh, this.bodies.mobile.mesh);
    this.annotations = new Annotations(this.scene, this.bodies, () => this.draw());
    this.picker = new Picker(canvas, this.bodies, () => this.jointRadius_mm);
    this.camera = new JointCamera(canvas, () => this.draw());
    this.lights = new Lights(this.scene);
    this.renderer.shadowMap.enabled = true;
    const context = this.renderer.getContext(), names = context.getExtension("WEBGL_debug_renderer_info");
    this.isSlow = /swiftshader|llvmpipe|software/i.test(String(context.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER)));
    canvas.addEventListener("webglcontextlost", () => this.overlay.setLost(true));
    canvas.addEventListener("webglcontextrestored", () => {
      this.overlay.setLost(false);
      this.draw();
    });

    new ResizeObserver(() => this.fit()).observe(place);

    this.fit();
    this.look("anterior");
    this.mayTurn = true;
  }

  // -- where the camera stands ------------------------------------------------------------------------------------------------------

  /// Views the last fitted part from a side, superior up. In a view along that anterior is up: to that side the camera stands a hair aside.
  look(view: View): void {
    this.mayTurn = false;
    const towards = new Vector3(...viewDirections[view]);
    if (towards.y !== 0) towards.setX(-towards.y * aside).normalize();
    this.camera.standFitted({ towards, ...this.fitting() });
  }

  /// Frames the joint, a sphere of 2.5 radii about its centre, or both bones.
  fitTo(what: "joint" | "all"): void {
    this.fitted = what;
    this.camera.standFitted({ towards: this.camera.towards, ...this.fitting() });
  }

  /// Radius of the joint's sphere, that of the head; without one it is where the bones lie next to each other.
  setJointRadius(mm: number | null): void {
    this.givenRadius_mm = mm;
    if (this.camera.isFitted) this.fitTo(this.fitted);
  }

  get jointRadius_mm(): number {
    return this.givenRadius_mm ?? (this.foundRadius_mm ??= this.radiusOfMeshes());
  }

  /// Parallel projection: lengths across the view compare everywhere.
  setOrthographic(on: boolean): void {
    this.camera.isParallel = on;
    this.draw();
  }

  /// Where a point is, in pixels of the page from the scene's top left corner.
  project(point: Three): [number, number] {
    const { x, y } = new Vector3(...point).project(this.camera.drawing());
    return [((x + 1) / 2) * this.place.clientWidth, ((1 - y) / 2) * this.place.clientHeight];
  }

  // -- a limit ----------------------------------------------------------------------------------------------------------------------

  /// Turns the camera to look along a contact from the side on which the joint is open, at the surface of `from`; the other bone becomes
  /// glass, and a pin with a text stands at the point. Null: the motion's end has no contact point, and the camera stays. With `turns`
  /// the camera moves there, is there, or stays.
  arriveAt(point: readonly [number, number, number] | null, label: string, from: BodyName, turns: "slowly" | "at once" | "not" = "slowly"): void {
    this.leaveLimit();
    if (!point) return;
    this.limit = { point: new Vector3(...point), label, glass: otherThan(from) };
    this.annotations.showContactPoint(point, contactPointShare * this.jointRadius_mm);
    this.applyOpacities();
    if (turns !== "not") this.turnToLimit(turns === "at once");
    this.draw();
  }

  /// The limit's pin and glass go; the camera stays.
  leaveLimit(): void {
    if (!this.limit) return;
    this.limit = null;
    this.camera.stop();
    this.annotations.showContactPoint(null);
    this.applyOpacities();
    this.draw();
  }

  // -- what is shown ----------------------------------------------------------------------------------------------------------------

  /// X_FM, 16 numbers row by row.
  setPose(rows: ArrayLike<number>): void {
    const mesh = this.bodies.mobile.mesh, before = mesh.matrix;
    mesh.matrix = new Matrix4().fromArray(Array.from(rows)).transpose();
    mesh.matrixWorldNeedsUpdate = true;
    if (!this.hasPose) this.standAtFirst();
    // The pose of a limit may come after its pin.
    if (this.limit && !mesh.matrix.equals(before)) this.turnToLimit();
    clearTimeout(this.rest);
    this.rest = window.setTimeout(() => this.turnPast(), rest_ms);
    this.draw();
  }

  /// Values with their legend; null: nothing is coloured.
  setScale(scale: ColourScale | null): void {
    this.scale = scale;
    if (scale) for (const body of Object.values(this.bodies)) body.mesh.material.setScale(scale);
    this.overlay.setScale(scale);
    this.applyOpacities();
  }

  setShading(on: boolean): void {
    for (const body of Object.values(this.bodies)) body.mesh.material.setShading(on);
    this.draw();
  }

  setOpacity(name: BodyName, opacity: number): void {
    this.opacities[name] = opacity;
    this.applyOpacities();
  }

  setVisible(name: BodyName, visible: boolean): void {
    this.bodies[name].mesh.visible = visible;
    this.applyOpacities();
  }

  /// Cuts away everything beyond `at` mm along an axis.
  clip(axis: ClipAxis, at: number): void {
    const normal = { x: [-1, 0, 0], y: [0, -1, 0], z: [0, 0, -1] } as const;
    const planes = axis === "none" ? [] : [new Plane(new Vector3(...normal[axis]), at)];
    for (const body of Object.values(this.bodies)) body.setClipping(planes);
    this.draw();
  }

  /// Triangles of either body, as one kind of mark.
  setMarked(as: Marked, fixed: Iterable<number>, mobile: Iterable<number>): void {
    this.bodies.fixed.setMarked(as, fixed);
    this.bodies.mobile.setMarked(as, mobile);
    this.draw();
  }

  showMarked(as: Marked, on: boolean): void {
    for (const body of Object.values(this.bodies)) body.showMarked(as, on);
    this.draw();
  }

  /// Vertices with numbers from 1, over everything; those of a hidden bone are not drawn.
  setPins(pins: readonly Picked[]): void {
    this.pins = pins;
    this.draw();
  }

  // -- under the pointer ------------------------------------------------------------------------------------------------------------

  /// The point of a bone under a point of the page, in that body's frame; null if no bone is there.
  pick(event: { clientX: number; clientY: number }): PickedPoint | null {
    return this.picker.pick(event, this.camera.drawing());
  }

  /// Position of a vertex, in F.
  vertexPoint({ body, vertex }: Picked): Vector3 {
    const { mesh, surface } = this.bodies[body];
    return new Vector3().fromArray(surface.vertices, 3 * vertex).applyMatrix4(mesh.matrixWorld);
  }

  // -- what is taken away -----------------------------------------------------------------------------------------------------------

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  /// The scene with a title, ribbon, letters, scale bar, legend and pin, on white; at least so many pixels wide. Letters have their size
  /// where it is shown in `within`, in pixels of the page.
  pictureCanvas(title: string, ribbon: string | null = null, width_px = 0, within: { width: number; height: number } | null = null): HTMLCanvasElement {
    const { renderer } = this, ratio = renderer.getPixelRatio(), { clientWidth: width, clientHeight: height } = this.place;
    const fine = width_px ? Math.max(ratio, Math.min(width_px / width, mostPixels / Math.max(width, height))) : ratio;
    renderer.setPixelRatio(fine);
    this.drawNow(true);
    const times = within ? Math.min(within.width / width, within.height / height) : 1;
    const picture = composedPicture(this.canvas, fine / times, title, ribbon, enlarged(this.written(), times), this.scale);
    renderer.setPixelRatio(ratio);
    if (fine !== ratio) this.drawNow(true);
    return picture;
  }

  /// The same as a PNG.
  picture(title: string, ribbon: string | null = null, width_px = 0): Promise<Blob> {
    const canvas = this.pictureCanvas(title, ribbon, width_px);
    return new Promise((resolve, reject) =>
      canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture"))), "image/png"));
  }

  /// Both bones as they stand, with their colours: binary glTF.
  async exportGlb(): Promise<Blob> {
    const { glbOf } = await import("./glb");
    return glbOf(bodyNames.map((name) => ({ name, body: this.bodies[name] })), this.scale);
  }

  draw(): void {
    if (this.frameAsked) return;
    this.frameAsked = true;
    requestAnimationFrame(() => {
      this.frameAsked = false;
      this.drawNow(!this.isSlow);
      if (this.isSlow) {
        clearTimeout(this.shade);
        this.shade = window.setTimeout(() => this.drawNow(true), rest_ms / 2);
      }
      document.documentElement.dataset["drawn"] ??= performance.now().toFixed(0);
    });
  }

  // -- inside -----------------------------------------------------------------------------------------------------------------------

  private drawNow(castsShadow: boolean): void {
    const camera = this.camera.drawing(), radius_mm = this.jointRadius_mm;
    this.lights.castsShadow = castsShadow;
    this.lights.follow(this.camera.perspective, radius_mm);
    for (const body of Object.values(this.bodies)) body.setMeasures(radius_mm, this.renderer.getPixelRatio());
    this.renderer.render(this.scene, camera);
    this.overlay.update(this.written());
  }

  private written(): Written {
    const { clientWidth: width, clientHeight: height } = this.place;
    const x = new Vector3(), y = new Vector3();
    this.camera.perspective.matrixWorld.extractBasis(x, y, new Vector3());
    const letters = (direction: Vector3, sign: number) => lettersOf(direction.clone().multiplyScalar(sign).toArray());
    const mmPerPixel = (2 * this.camera.distance * this.camera.halfHeight) / Math.max(1, height);
    const mm = scaleBarLength(mmPerPixel * Math.min(longestScaleBar_px, shareOfWidth * width));
    const [pinX, pinY] = this.limit ? this.project(this.limit.point.toArray()) : [0, 0];
    return {
      width, height, edges: { top: letters(y, 1), bottom: letters(y, -1), left: letters(x, -1), right: letters(x, 1) },
      scaleBar: { length: mm / mmPerPixel, mm, isTrueEverywhere: this.camera.isParallel },
      pin: this.limit && { x: pinX, y: pinY, label: this.limit.label },
      numbered: this.pins.flatMap((pin, i) => {
        if (!this.bodies[pin.body].mesh.visible) return [];
        const [at, below] = this.project(this.vertexPoint(pin).toArray());
        return [{ x: at, y: below, number: i + 1 }];
      }),
    };
  }

  /// Target and distance of the camera that fit the joint or both bones. Bones that end near the joint are framed with it.
  private fitting(): { target: Vector3; distance: number } {
    const box = this.boxOfAll();
    const all = { target: box.getCenter(new Vector3()), distance: (0.55 * box.getSize(new Vector3()).length()) / this.camera.halfHeight };
    if (this.fitted === "all") return all;
    const high = heightOfJoint(this.jointRadius_mm, this.camera.perspective.aspect);
    const joint = { target: new Vector3(), distance: high / 2 / this.camera.halfHeight };
    return joint.distance < all.distance ? joint : all;
  }

  private boxOfAll(): Box3 {
    this.bodies.mobile.mesh.updateMatrixWorld();
    return bodyNames.reduce((box, name) => {
      const { geometry, matrixWorld } = this.bodies[name].mesh;
      if (!geometry.boundingBox) geometry.computeBoundingBox();
      return box.union(geometry.boundingBox!.clone().applyMatrix4(matrixWorld));
    }, new Box3());
  }

  private radiusOfMeshes(): number {
    const { fixed, mobile } = this.bodies;
    return radiusOfNeighbours(fixed.surface.vertices, mobile.surface.vertices, mobile.mesh.matrix)
      ?? shareOfSize * this.boxOfAll().getSize(new Vector3()).length();
  }

  /// Bones of a free joint are where they belong only in a pose of it.
  private standAtFirst(): void {
    this.hasPose = true;
    this.foundRadius_mm = null;
    if (this.camera.isFitted) this.fitTo(this.fitted);
  }

  private turnToLimit(atOnce = false): void {
    const { point, glass } = this.limit!;
    const towards = directionOnto(point, this.standing(otherThan(glass)), this.standing(glass));
    this.fitted = "joint";
    const to = { towards, ...this.fitting() };
    if (atOnce) this.camera.standFitted(to);
    else this.camera.turnFitted(to);
  }

  /// The joint rests: if what moved hides it, the camera turns along the motion to where it is seen, unless the user has placed it.
  private turnPast(): void {
    const now = new Quaternion().setFromRotationMatrix(this.bodies.mobile.mesh.matrix), { x, y, z, w } = now.clone().multiply(this.rested.invert());
    this.rested = now;
    const axis = new Vector3(x, y, z), { camera } = this;
    if (2 * Math.atan2(axis.length(), Math.abs(w)) < leastMotion_rad) return;
    if (!this.mayTurn || !camera.isFitted || camera.isTurning || this.limit || prefersStill()) return;
    const shown = bodyNames.filter((name) => this.bodies[name].mesh.visible).map((name) => this.standing(name));
    const towards = directionPast(camera.towards, axis.normalize(), this.jointRadius_mm, shown);
    if (towards) camera.turnFitted({ towards, ...this.fitting() });
  }

  private standing(name: BodyName): Standing {
    const { mesh, surface } = this.bodies[name];
    mesh.updateMatrixWorld();
    return { vertices: surface.vertices, normals: mesh.geometry.getAttribute("normal").array, pose: mesh.matrixWorld };
  }

  /// If both bones are transparent, every surface is drawn; if one is, only its nearest surface. A bone shown by itself hides no other.
  private applyOpacities(): void {
    // Depths and pressure lie inside the other body.
    const glass = this.limit?.glass ?? (["depth", "pressure"].includes(this.scale?.quantity ?? "") ? "fixed" : null);
    const isGlass = (name: BodyName) => glass === name && this.opacities[name] === 1 && this.bodies[otherThan(name)].mesh.visible;
    const isSeenThrough = (name: BodyName) => isGlass(name) || this.opacities[name] < 1;
    const both = bodyNames.every(isSeenThrough);
    for (const name of bodyNames) this.bodies[name].setOpacity(this.opacities[name], isGlass(name), isSeenThrough(name) && !both);
    this.draw();
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.setAspect(width / height);
    if (this.camera.isFitted && !this.camera.isTurning) this.fitTo(this.fitted);
    else this.draw();
  }
}
