import {
  AmbientLight, Box3, BufferAttribute, BufferGeometry, DirectionalLight, DoubleSide, Line, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  MeshBasicMaterial, type Object3D, PerspectiveCamera, Plane, Points, PointsMaterial, Raycaster, Scene, SphereGeometry, Spherical, Vector2, Vector3, WebGLRenderer, type Intersection,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { ViewHelper } from "three/addons/helpers/ViewHelper.js";
import type { Surface } from "../core/protocol";
import { SceneBody, type Marked, type Part } from "./body";
import type { ColourScale } from "./colour_scale";
import type { Marks } from "./measure_marks";
import { words } from "../words";

/// From where the joint is looked at, in the joint frame: X anterior, Y superior, Z right.
export const viewDirections = {
  anterior: [1, 0, 0], posterior: [-1, 0, 0], superior: [0, 1, 0], inferior: [0, -1, 0], right: [0, 0, 1], left: [0, 0, -1],
} as const;
export type View = keyof typeof viewDirections;

export const bodyNames = ["fixed", "mobile"] as const;
export type BodyName = (typeof bodyNames)[number];
export type ClipAxis = "none" | "x" | "y" | "z";

/// A vertex that was pointed at.
export interface Picked {
  body: BodyName;
  vertex: number;
}

const boneColours = { fixed: "#d9cfb8", mobile: "#b9c7d6" };
/// Darker than the bone that carries it, of the same hue: colours of the scale stay those of values.
const cartilageColours = { fixed: "#c2b186", mobile: "#8fa9c6" };

/// Both bones before a camera. Drawn only when something changed.
export class JointScene {
  readonly bodies: Record<BodyName, SceneBody>;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(30, 1, 1, 5000);
  private readonly controls: OrbitControls;
  private readonly gizmo: ViewHelper;
  private readonly rays = new Raycaster();
  private readonly contactPoint: Mesh;
  private measure: Line | null = null;
  private marks: Object3D[] = [];
  private readonly removed: Record<BodyName, Mesh | null> = { fixed: null, mobile: null };
  private frameAsked = false;
  private size = 100;
  private middle = new Vector3();

  /// Throws where the browser has no WebGL.
  constructor(private readonly place: HTMLElement, fixed: Surface, mobile: Surface, parts: Record<BodyName, readonly Part[]>, label: string) {
    this.renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.renderer.autoClear = false;
    this.renderer.setClearColor(0, 0);
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    place.append(canvas);

    const body = (name: BodyName, surface: Surface) => new SceneBody(surface, boneColours[name], cartilageColours[name], parts[name]);
    this.bodies = { fixed: body("fixed", fixed), mobile: body("mobile", mobile) };
    this.bodies.mobile.mesh.matrixAutoUpdate = false;
    this.contactPoint = new Mesh(new SphereGeometry(1, 24, 16), new MeshBasicMaterial({ color: "#ff7f0e", depthTest: false }));
    this.contactPoint.visible = false;
    const light = new DirectionalLight("white", 2.2);
    light.position.set(0.4, 0.7, 1);
    this.camera.add(light);
    this.scene.add(this.bodies.fixed.mesh, this.bodies.mobile.mesh, this.contactPoint, this.camera, new AmbientLight("white", 1.1));

    this.controls = new OrbitControls(this.camera, canvas);
    canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    this.controls.addEventListener("change", () => this.draw());
    this.gizmo = new ViewHelper(this.camera, canvas);
    this.gizmo.setLabels(...words.axisLetters);
    new ResizeObserver(() => this.fit()).observe(place);

    const box = new Box3().setFromObject(this.bodies.mobile.mesh).union(new Box3().setFromObject(this.bodies.fixed.mesh));
    this.size = box.getSize(new Vector3()).length();
    box.getCenter(this.middle);
    this.look("anterior");
    this.fit();
  }

  look(view: View): void {
    const [x, y, z] = viewDirections[view];
    const distance = (0.55 * this.size) / Math.tan((this.camera.fov / 2) * (Math.PI / 180));
    this.camera.up.set(0, 1, 0);
    // Straight above or below "up" would be along the view: a hair aside keeps the front at the bottom.
    this.camera.position.set(x, y, z).multiplyScalar(distance).add(this.middle);
    if (x === 0 && z === 0) this.camera.position.x += y * 1e-3 * distance;
    this.controls.target.copy(this.middle);
    this.controls.update();
    this.draw();
  }

  /// Camera and what it looks at, six numbers.
  get viewpoint(): number[] {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }
  set viewpoint(numbers: number[]) {
    this.camera.position.fromArray(numbers, 0);
    this.controls.target.fromArray(numbers, 3);
    this.controls.update();
    this.draw();
  }

  onViewChange(changed: () => void): void {
    this.controls.addEventListener("end", changed);
  }

  /// X_FM, 16 numbers row by row.
  setPose(rows: ArrayLike<number>): void {
    const mesh = this.bodies.mobile.mesh;
    mesh.matrix = new Matrix4().fromArray(Array.from(rows)).transpose();
    mesh.matrixWorldNeedsUpdate = true;
    this.draw();
  }

  setScale(scale: ColourScale): void {
    for (const body of Object.values(this.bodies)) body.mesh.material.setScale(scale);
    this.draw();
  }

  setShading(on: boolean): void {
    for (const body of Object.values(this.bodies)) body.mesh.material.setShading(on);
    this.draw();
  }

  setOpacity(name: BodyName, opacity: number): void {
    const { mesh } = this.bodies[name];
    mesh.material.setOpacity(opacity);
    mesh.renderOrder = opacity < 1 ? 1 : 0;
    this.draw();
  }

  setVisible(name: BodyName, visible: boolean): void {
    this.bodies[name].mesh.visible = visible;
    this.draw();
  }

  /// Cuts away what lies beyond `at` mm along an axis.
  clip(axis: ClipAxis, at: number): void {
    const normal = { x: [-1, 0, 0], y: [0, -1, 0], z: [0, 0, -1] } as const;
    const planes = axis === "none" ? [] : [new Plane(new Vector3(...normal[axis]), at)];
    for (const body of Object.values(this.bodies)) body.setClipping(planes);
    this.draw();
  }

  showContactPoint(point: readonly [number, number, number] | null): void {
    this.contactPoint.visible = point !== null;
    if (point) this.contactPoint.position.set(...point);
    this.contactPoint.scale.setScalar(this.size / 120);
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
      // Axes lie inside the bones that they are of.
      const drawn = [
        new LineSegments(geometry(lines), new LineBasicMaterial({ color: colour, depthTest: false })),
        new Points(geometry(points), new PointsMaterial({ color: colour, size: 3 })),
      ];
      for (const each of drawn) each.renderOrder = 2;
      this.bodies[body].mesh.add(...drawn);
      return drawn;
    });
    this.draw();
  }

  /// The surface that a body had before some of its vertices were lowered, over them, in a colour that no scale has; null: none.
  showRemoved(body: BodyName, removed: { vertices: Uint32Array; before: Float64Array } | null): void {
    this.removed[body]?.removeFromParent();
    const mesh = removed && this.bodies[body].surfaceBefore(removed.vertices, removed.before);
    this.removed[body] = mesh && new Mesh(mesh, new MeshBasicMaterial({ color: "#1b9e77", transparent: true, opacity: 0.6, side: DoubleSide }));
    if (this.removed[body]) this.bodies[body].mesh.add(this.removed[body]);
    this.draw();
  }

  /// The vertex next to what is under a point of the page; null where no bone is.
  pick(event: { clientX: number; clientY: number }): Picked | null {
    const box = this.renderer.domElement.getBoundingClientRect();
    this.rays.setFromCamera(new Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2), this.camera);
    for (const hit of this.rays.intersectObjects([this.bodies.fixed.mesh, this.bodies.mobile.mesh].filter((m) => m.visible), false)) {
      const body: BodyName = hit.object === this.bodies.fixed.mesh ? "fixed" : "mobile";
      const planes = this.bodies[body].mesh.material.clippingPlanes ?? [];
      const vertex = nearestCorner(hit);
      if (planes.every((plane) => plane.distanceToPoint(hit.point) >= 0) && !this.bodies[body].isHidden(vertex))
        return { body, vertex };
    }
    return null;
  }

  /// Position of a vertex, in F.
  vertexPoint({ body, vertex }: Picked): Vector3 {
    const { mesh, surface } = this.bodies[body];
    return new Vector3().fromArray(surface.vertices, 3 * vertex).applyMatrix4(mesh.matrixWorld);
  }

  get canvas(): HTMLCanvasElement {
    return this.renderer.domElement;
  }

  draw(): void {
    if (this.frameAsked) return;
    this.frameAsked = true;
    requestAnimationFrame(() => {
      this.frameAsked = false;
      this.renderer.clear();
      this.renderer.render(this.scene, this.camera);
      this.gizmo.render(this.renderer);
      document.documentElement.dataset["drawn"] ??= performance.now().toFixed(0);
    });
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
    const from = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    from.theta += azimuth;
    from.phi += elevation;
    from.radius *= zoom;
    this.camera.position.setFromSpherical(from.makeSafe()).add(this.controls.target);
    this.controls.update();
    this.controls.dispatchEvent({ type: "end" });
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}

function nearestCorner({ face, barycoord }: Intersection): number {
  const corners = [face!.a, face!.b, face!.c], weights = barycoord!.toArray();
  return corners[weights.indexOf(Math.max(...weights))]!;
}
