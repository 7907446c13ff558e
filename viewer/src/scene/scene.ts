import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, DirectionalLight, DoubleSide, Line, LineBasicMaterial, LineLoop, LineSegments,
  Matrix4, Mesh, MeshBasicMaterial, type Object3D, OrthographicCamera, PerspectiveCamera, Plane, Points, PointsMaterial, Quaternion, Raycaster,
  Scene, SphereGeometry, Spherical, Vector2, Vector3, WebGLRenderer, type Intersection,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Surface } from "../core/protocol";
import { SceneBody, type Ghost, type Marked, type Part } from "./body";
import { CameraTurn, type Viewpoint } from "./camera_turn";
import { contactColour, type ColourScale } from "./colour_scale";
import { directionOnto, type Standing } from "./contact_view";
import { heightOfJoint, radiusOfNeighbours } from "./framing";
import type { Marks } from "./measure_marks";
import { SceneOverlay, type Written } from "./overlay";
import { composedPicture } from "./picture";
import { lettersOf, scaleBarLength, viewNamed, type Side, type Three } from "./views";

export { viewDirections, type View } from "./views";

export const bodyNames = ["fixed", "mobile"] as const;
export type BodyName = (typeof bodyNames)[number];
export type ClipAxis = "none" | "x" | "y" | "z";

/// The vertex under the pointer.
export interface Picked {
  body: BodyName;
  vertex: number;
}

/// The point of a surface under the pointer, in the frame of its body; the vertex is the triangle's nearest corner.
export interface PickedPoint extends Picked {
  triangle: number;
  point: [number, number, number];
  normal: [number, number, number];
}

const boneColours = { fixed: "#d9cfb8", mobile: "#b9c7d6" };
/// Darker than the bone that carries it, of the same hue: colours of the scale stay those of values.
const cartilageColours = { fixed: "#c2b186", mobile: "#8fa9c6" };
const brushColour = "#00b050";

/// The joint's sphere of a joint whose bones are apart, as a share of both bones' diagonal.
const shareOfSize = 0.08;
const contactPointShare = 0.05;
/// A scale bar is at most so long.
const longestScaleBar_px = 130, shareOfWidth = 0.3;
/// From exactly above or below a camera whose up is Y has none: it stands a hair aside.
const aside = 1e-3;

function otherThan(body: BodyName): BodyName {
  return body === "fixed" ? "mobile" : "fixed";
}

/// Both bones before a camera. Drawn only when something changed. Points are in F, mm, unless stated otherwise.
export class JointScene {
  readonly bodies: Record<BodyName, SceneBody>;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  /// The camera that is rotated and moved; `parallel` draws instead if projection is parallel.
  private readonly camera = new PerspectiveCamera(30, 1, 1, 5000);
  private readonly parallel = new OrthographicCamera(-1, 1, 1, -1, -3000, 8000);
  private isParallel = false;
  private readonly controls: OrbitControls;
  private readonly overlay = new SceneOverlay();
  private readonly turn: CameraTurn;
  private readonly rays = new Raycaster();
  private readonly contactPoint: Mesh;
  private readonly ring: LineLoop;
  private measure: Line | null = null;
  private marks: Object3D[] = [];
  private readonly removed: Record<BodyName, Mesh | null> = { fixed: null, mobile: null };
  private readonly opacities: Record<BodyName, number> = { fixed: 1, mobile: 1 };
  /// The limit shown.
  private limit: { point: Vector3; label: string; glass: BodyName } | null = null;
  private scale: ColourScale | null = null;
  private pins: readonly Picked[] = [];
  private pickedBody: BodyName = "mobile";
  private frameAsked = false;
  private givenRadius_mm: number | null = null;
  private foundRadius_mm: number | null = null;
  private fitted: "joint" | "all" = "joint";
  /// Whether the camera stands where fitting put it.
  private isFitted = true;
  private hasPose = false;

  /// Throws if the browser has no WebGL.
  constructor(
    private readonly place: HTMLElement, fixed: Surface, mobile: Surface, parts: Record<BodyName, readonly Part[]>, label: string,
    private readonly side: Side = "right") {
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.renderer.setClearColor(0, 0);
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    place.append(canvas, this.overlay.element);
    this.overlay.setScale(null);

    const body = (name: BodyName, surface: Surface) => new SceneBody(surface, boneColours[name], cartilageColours[name], parts[name]);
    this.bodies = { fixed: body("fixed", fixed), mobile: body("mobile", mobile) };
    this.bodies.mobile.mesh.matrixAutoUpdate = false;
    this.contactPoint = new Mesh(new SphereGeometry(1, 24, 16), new MeshBasicMaterial({ color: contactColour, depthTest: false, transparent: true }));
    this.contactPoint.renderOrder = 9;
    this.contactPoint.visible = false;
    this.ring = brushRing();
    const light = new DirectionalLight("white", 2.2);
    light.position.set(0.4, 0.7, 1);
    this.camera.add(light);
    this.scene.add(this.bodies.fixed.mesh, this.bodies.mobile.mesh, this.contactPoint, this.camera, new AmbientLight("white", 1.1));

    this.controls = new OrbitControls(this.camera, canvas);
    canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    this.turn = new CameraTurn((at) => this.stand(at), () => this.controls.dispatchEvent({ type: "end" }));
    this.controls.addEventListener("start", () => this.takenByHand());
    canvas.addEventListener("wheel", () => this.takenByHand(), { passive: true });
    this.controls.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.fit()).observe(place);
    this.drawWhenPrinted();

    this.fit();
    this.look("anterior");
  }

  // -- where the camera stands ------------------------------------------------------------------------------------------------------

  /// Views the last fitted part from a side, by the name that `condyle picture --view` takes.
  look(view: string): void {
    const { towardsViewer, up } = viewNamed(view, this.side);
    const towards = new Vector3(...towardsViewer);
    // Superior is up unless the view is along it: then the up vector decides to which side the camera is offset.
    if (Math.abs(towardsViewer[1]) === 1) towards.addScaledVector(new Vector3(...up), -Math.sign(towardsViewer[1]) * aside).normalize();
    this.turn.stop();
    this.stand({ towards, ...this.fitting() });
    this.isFitted = true;
  }

  /// Frames the joint: a sphere of 2.5 radii about its centre.
  fitJoint(): void {
    this.fitTo("joint");
  }

  /// Frames both bones.
  fitAll(): void {
    this.fitTo("all");
  }

  /// Radius of the joint's sphere, that of the head; without one it is where the bones lie next to each other.
  setJointRadius(mm: number | null): void {
    this.givenRadius_mm = mm;
    if (this.isFitted) this.fitTo(this.fitted);
  }

  get jointRadius_mm(): number {
    return this.givenRadius_mm ?? (this.foundRadius_mm ??= this.radiusOfMeshes());
  }

  /// Parallel projection: lengths across the view compare everywhere.
  setOrthographic(on: boolean): void {
    this.isParallel = on;
    this.draw();
  }

  /// Camera and its target, six numbers.
  get viewpoint(): number[] {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }
  set viewpoint(numbers: number[]) {
    this.turn.stop();
    this.isFitted = false;
    this.camera.position.fromArray(numbers, 0);
    this.controls.target.fromArray(numbers, 3);
    const { x, y, z } = this.camera.position.clone().sub(this.controls.target);
    if (x === 0 && z === 0) this.camera.position.x -= y * aside;
    this.controls.update();
    this.draw();
  }

  onViewChange(changed: () => void): void {
    this.controls.addEventListener("end", changed);
  }

  /// Where a point is, in pixels of the page from the scene's top left corner.
  project(point: Three): [number, number] {
    const { x, y } = new Vector3(...point).project(this.seenBy());
    return [((x + 1) / 2) * this.place.clientWidth, ((1 - y) / 2) * this.place.clientHeight];
  }

  // -- a limit ----------------------------------------------------------------------------------------------------------------------

  /// Turns the camera to look along a contact from the side on which the joint is open, at the surface of `from`; the other bone becomes
  /// glass, and a pin with a text stands at the point. Null: the motion's end has no contact point, and the camera stays.
  arriveAt(point: readonly [number, number, number] | null, label: string, from: BodyName): void {
    this.leaveLimit();
    if (!point) return;
    this.limit = { point: new Vector3(...point), label, glass: otherThan(from) };
    this.showContactPoint(point);
    this.applyOpacities();
    this.turnToLimit();
  }

  /// The limit's pin and glass go; the camera stays.
  leaveLimit(): void {
    if (!this.limit) return;
    this.limit = null;
    this.turn.stop();
    this.showContactPoint(null);
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
    this.draw();
  }

  /// Values with their legend; null: nothing is coloured.
  setScale(scale: ColourScale | null): void {
    this.scale = scale;
    if (scale) for (const body of Object.values(this.bodies)) body.mesh.material.setScale(scale);
    this.overlay.setScale(scale);
    this.draw();
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

  showContactPoint(point: readonly [number, number, number] | null): void {
    this.contactPoint.visible = point !== null;
    if (point) this.contactPoint.position.set(...point);
    this.contactPoint.scale.setScalar(contactPointShare * this.jointRadius_mm);
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

  setPartVisible(name: BodyName, part: Part, visible: boolean): void {
    this.bodies[name].setPartVisible(part, visible);
    this.draw();
  }

  /// Another state of a body, such as before a change, transparent; in the body's frame. Null: none. Ghosts of other names stay.
  setGhost(body: BodyName, ghost: Ghost | null, name = "before"): void {
    this.bodies[body].setGhost(name, ghost);
    this.draw();
  }

  /// Other positions of a body's vertices, x, y and z in turn, in its frame.
  replaceBody(body: BodyName, vertices: ArrayLike<number>): void {
    this.bodies[body].replaceVertices(vertices);
    this.draw();
  }

  showDistance(ends: [Vector3, Vector3] | null): void {
    if (this.measure) this.scene.remove(this.measure);
    this.measure = ends
      ? new Line(new BufferGeometry().setFromPoints(ends), new LineBasicMaterial({ color: "#c2185b", depthTest: false })) : null;
    if (this.measure) this.scene.add(this.measure);
    this.draw();
  }

  /// Lines and points that move with their bodies; null: none.
  showMarks(marks: readonly Marks[] | null): void {
    for (const mark of this.marks) mark.removeFromParent();
    const geometry = (xyz: readonly number[]) => new BufferGeometry().setAttribute("position", new BufferAttribute(new Float32Array(xyz), 3));
    this.marks = (marks ?? []).flatMap(({ body, colour, lines, points }) => {
      // Axes lie inside their bones.
      const drawn = [
        new LineSegments(geometry(lines), new LineBasicMaterial({ color: colour, depthTest: false })),
        new Points(geometry(points), new PointsMaterial({ color: colour, size: 3 })),
      ];
      for (const each of drawn) each.renderOrder = 6;
      this.bodies[body].mesh.add(...drawn);
      return drawn;
    });
    this.draw();
  }

  /// Vertices with numbers from 1, over everything; those of a hidden bone are not drawn.
  setPins(pins: readonly Picked[]): void {
    this.pins = pins;
    this.draw();
  }

  /// The surface that a body had before some of its vertices were lowered, over them, in a colour that no scale has; null: none.
  showRemoved(body: BodyName, removed: { vertices: Uint32Array; before: Float64Array } | null): void {
    this.removed[body]?.removeFromParent();
    const mesh = removed && this.bodies[body].surfaceBefore(removed.vertices, removed.before);
    this.removed[body] = mesh && new Mesh(mesh, new MeshBasicMaterial({ color: "#1b9e77", transparent: true, opacity: 0.6, side: DoubleSide }));
    if (this.removed[body]) this.removed[body].renderOrder = 5;
    if (this.removed[body]) this.bodies[body].mesh.add(this.removed[body]);
    this.draw();
  }

  // -- under the pointer ------------------------------------------------------------------------------------------------------------

  /// The vertex nearest to the surface point under a point of the page; null if no bone is there.
  pick(event: { clientX: number; clientY: number }): Picked | null {
    const found = this.hitUnder(event);
    return found && { body: found.body, vertex: nearestCorner(found.hit) };
  }

  /// The point of a bone under a point of the page, in that body's frame; null if no bone is there.
  pickPoint(event: { clientX: number; clientY: number }): PickedPoint | null {
    const found = this.hitUnder(event);
    if (!found) return null;
    const { body, hit } = found;
    this.pickedBody = body;
    const point = hit.point.clone().applyMatrix4(this.bodies[body].mesh.matrixWorld.clone().invert());
    return { body, vertex: nearestCorner(hit), triangle: hit.faceIndex!, point: point.toArray(), normal: hit.face!.normal.toArray() };
  }

  /// A ring about a point of a surface, in the frame of `body`: the last one of pickPoint(), if none is named. Null: no ring.
  brush(
    point: readonly [number, number, number], normal: readonly [number, number, number], radius_mm: number | null,
    body: BodyName = this.pickedBody): void {
    this.ring.removeFromParent();
    if (radius_mm !== null) {
      this.bodies[body].mesh.add(this.ring);
      this.ring.position.set(...point);
      this.ring.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), new Vector3(...normal).normalize()));
      this.ring.scale.setScalar(radius_mm);
    }
    this.draw();
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

  /// The scene with a title, letters, scale bar, legend and pin, on white.
  pictureCanvas(title: string): HTMLCanvasElement {
    this.drawNow();
    return composedPicture(this.canvas, this.renderer.getPixelRatio(), title, this.written(), this.scale);
  }

  /// The same as a PNG.
  picture(title: string): Promise<Blob> {
    const canvas = this.pictureCanvas(title);
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
      this.drawNow();
      document.documentElement.dataset["drawn"] ??= performance.now().toFixed(0);
    });
  }

  // -- inside -----------------------------------------------------------------------------------------------------------------------

  private drawNow(): void {
    this.renderer.render(this.scene, this.seenBy());
    this.overlay.update(this.written());
  }

  /// Distance from the camera to its target.
  private get distance(): number {
    return this.camera.position.distanceTo(this.controls.target);
  }

  /// Half the visible height of the plane through the camera's target, for each mm of distance.
  private get halfHeight(): number {
    return Math.tan((this.camera.fov / 2) * (Math.PI / 180));
  }

  /// The camera that draws and picks, where it stands now.
  private seenBy(): PerspectiveCamera | OrthographicCamera {
    this.camera.updateMatrixWorld();
    if (!this.isParallel) return this.camera;
    const { parallel, camera } = this, high = this.distance * this.halfHeight;
    [parallel.top, parallel.bottom, parallel.right, parallel.left] = [high, -high, high * camera.aspect, -high * camera.aspect];
    parallel.position.copy(camera.position);
    parallel.quaternion.copy(camera.quaternion);
    parallel.updateProjectionMatrix();
    parallel.updateMatrixWorld();
    return parallel;
  }

  private written(): Written {
    const { clientWidth: width, clientHeight: height } = this.place;
    const x = new Vector3(), y = new Vector3();
    this.camera.matrixWorld.extractBasis(x, y, new Vector3());
    const letters = (direction: Vector3, sign: number) => lettersOf(direction.clone().multiplyScalar(sign).toArray());
    const mmPerPixel = (2 * this.distance * this.halfHeight) / Math.max(1, height);
    const mm = scaleBarLength(mmPerPixel * Math.min(longestScaleBar_px, shareOfWidth * width));
    const [pinX, pinY] = this.limit ? this.project(this.limit.point.toArray()) : [0, 0];
    return {
      width, height, edges: { top: letters(y, 1), bottom: letters(y, -1), left: letters(x, -1), right: letters(x, 1) },
      scaleBar: { length: mm / mmPerPixel, mm, isTrueEverywhere: this.isParallel },
      pin: this.limit && { x: pinX, y: pinY, label: this.limit.label },
      numbered: this.pins.flatMap((pin, i) => {
        if (!this.bodies[pin.body].mesh.visible) return [];
        const [at, below] = this.project(this.vertexPoint(pin).toArray());
        return [{ x: at, y: below, number: i + 1 }];
      }),
    };
  }

  private stand({ towards, target, distance }: Viewpoint): void {
    this.controls.target.copy(target);
    this.camera.position.copy(towards).setLength(distance).add(target);
    this.controls.update();
    this.draw();
  }

  private fitTo(what: "joint" | "all"): void {
    this.fitted = what;
    this.turn.stop();
    this.stand({ towards: this.camera.position.clone().sub(this.controls.target).normalize(), ...this.fitting() });
    this.isFitted = true;
  }

  /// Target and distance of the camera that fit the joint or both bones. Bones that end near the joint are framed with it.
  private fitting(): { target: Vector3; distance: number } {
    const box = this.boxOfAll();
    const all = { target: box.getCenter(new Vector3()), distance: (0.55 * box.getSize(new Vector3()).length()) / this.halfHeight };
    if (this.fitted === "all") return all;
    const joint = { target: new Vector3(), distance: heightOfJoint(this.jointRadius_mm, this.camera.aspect) / 2 / this.halfHeight };
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
    if (this.isFitted) this.fitTo(this.fitted);
  }

  private takenByHand(): void {
    this.turn.stop();
    this.isFitted = false;
  }

  private turnToLimit(): void {
    const { point, glass } = this.limit!;
    const towards = directionOnto(point, this.standing(otherThan(glass)), this.standing(glass));
    this.fitted = "joint";
    this.isFitted = true;
    const now: Viewpoint = {
      towards: this.camera.position.clone().sub(this.controls.target).normalize(), target: this.controls.target.clone(), distance: this.distance,
    };
    this.turn.go(now, { towards, ...this.fitting() });
  }

  private standing(name: BodyName): Standing {
    const { mesh, surface } = this.bodies[name];
    mesh.updateMatrixWorld();
    return { vertices: surface.vertices, normals: mesh.geometry.getAttribute("normal").array, pose: mesh.matrixWorld };
  }

  /// If both bones are transparent, every surface is drawn; if one is, only its nearest surface. A bone shown by itself hides no other.
  private applyOpacities(): void {
    const isGlass = (name: BodyName) => this.limit?.glass === name && this.opacities[name] === 1 && this.bodies[otherThan(name)].mesh.visible;
    const isSeenThrough = (name: BodyName) => isGlass(name) || this.opacities[name] < 1;
    const both = bodyNames.every(isSeenThrough);
    for (const name of bodyNames) this.bodies[name].setOpacity(this.opacities[name], isGlass(name), isSeenThrough(name) && !both);
    this.draw();
  }

  private hitUnder(event: { clientX: number; clientY: number }): { body: BodyName; hit: Intersection } | null {
    const box = this.renderer.domElement.getBoundingClientRect();
    this.rays.setFromCamera(new Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2), this.seenBy());
    for (const hit of this.rays.intersectObjects([this.bodies.fixed.mesh, this.bodies.mobile.mesh].filter((m) => m.visible), false)) {
      const body: BodyName = hit.object === this.bodies.fixed.mesh ? "fixed" : "mobile";
      const planes = this.bodies[body].mesh.material.clippingPlanes ?? [];
      if (planes.every((plane) => plane.distanceToPoint(hit.point) >= 0) && !this.bodies[body].isHidden(nearestCorner(hit))) return { body, hit };
    }
    return null;
  }

  /// Arrows turn, plus and minus zoom.
  private turnByKey(event: KeyboardEvent): void {
    const step = Math.PI / 36, closer = 0.9;
    const [azimuth, elevation, zoom] = ({
      ArrowLeft: [-step, 0, 1], ArrowRight: [step, 0, 1], ArrowUp: [0, -step, 1], ArrowDown: [0, step, 1], "+": [0, 0, closer],
      "-": [0, 0, 1 / closer],
    } as Record<string, [number, number, number]>)[event.key] ?? [0, 0, 0];
    if (zoom === 0) return;
    event.preventDefault();
    this.takenByHand();
    const from = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    from.theta += azimuth;
    from.phi += elevation;
    from.radius *= zoom;
    this.camera.position.setFromSpherical(from.makeSafe()).add(this.controls.target);
    this.controls.update();
    this.controls.dispatchEvent({ type: "end" });
  }

  /// Paper has the picture with all text over the scene.
  private drawWhenPrinted(): void {
    let printed: HTMLCanvasElement | null = null;
    window.addEventListener("beforeprint", () => {
      printed?.remove();
      printed = this.pictureCanvas("");
      printed.className = "scene-print";
      this.place.prepend(printed);
      this.place.classList.add("has-print-picture");
    });
    window.addEventListener("afterprint", () => {
      printed?.remove();
      this.place.classList.remove("has-print-picture");
    });
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.isFitted && !this.turn.isUnderWay) this.fitTo(this.fitted);
    else this.draw();
  }
}

/// A circle of radius 1 about Z.
function brushRing(): LineLoop {
  const steps = 64;
  const circle = Array.from({ length: steps }, (_, k) => {
    const turn = (2 * Math.PI * k) / steps;
    return new Vector3(Math.cos(turn), Math.sin(turn), 0);
  });
  const ring = new LineLoop(new BufferGeometry().setFromPoints(circle), new LineBasicMaterial({ color: brushColour, depthTest: false, transparent: true }));
  ring.renderOrder = 10;
  return ring;
}

function nearestCorner({ face, barycoord }: Intersection): number {
  const corners = [face!.a, face!.b, face!.c], weights = barycoord!.toArray();
  return corners[weights.indexOf(Math.max(...weights))]!;
}
