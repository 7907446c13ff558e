import { OrthographicCamera, PerspectiveCamera, Spherical, Vector3 } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { CameraTurn, type Viewpoint } from "./camera_turn";

/// From exactly above or below a camera whose up is Y has none: it stands a hair aside.
export const aside = 1e-3;

/// The camera before the joint, which is rotated and moved by pointer and keys. Points are in F, mm.
export class JointCamera {
  readonly perspective = new PerspectiveCamera(30, 1, 1, 5000);
  /// Draws instead of it if projection is parallel.
  private readonly parallel = new OrthographicCamera(-1, 1, 1, -1, -3000, 8000);
  private readonly controls: OrbitControls;
  private readonly turn: CameraTurn;
  /// Whether projection is parallel.
  isParallel = false;
  /// Whether the camera stands where fitting put it.
  isFitted = true;

  /// `changed` is called whenever the view has changed.
  constructor(canvas: HTMLCanvasElement, private readonly changed: () => void) {
    this.controls = new OrbitControls(this.perspective, canvas);
    canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    this.turn = new CameraTurn((at) => this.stand(at), () => this.controls.dispatchEvent({ type: "end" }));
    this.controls.addEventListener("start", () => this.takenByHand());
    canvas.addEventListener("wheel", () => this.takenByHand(), { passive: true });
    this.controls.addEventListener("change", () => this.changed());
  }

  /// Camera and its target, six numbers.
  get viewpoint(): number[] {
    return [...this.perspective.position.toArray(), ...this.controls.target.toArray()];
  }
  set viewpoint(numbers: number[]) {
    this.turn.stop();
    this.isFitted = false;
    this.perspective.position.fromArray(numbers, 0);
    this.controls.target.fromArray(numbers, 3);
    const { x, y, z } = this.perspective.position.clone().sub(this.controls.target);
    if (x === 0 && z === 0) this.perspective.position.x -= y * aside;
    this.controls.update();
    this.changed();
  }

  /// Calls `moved` at the end of each movement.
  onEnd(moved: () => void): void {
    this.controls.addEventListener("end", moved);
  }

  /// Direction from the target to the camera.
  get towards(): Vector3 {
    return this.perspective.position.clone().sub(this.controls.target).normalize();
  }

  /// Distance from the camera to its target.
  get distance(): number {
    return this.perspective.position.distanceTo(this.controls.target);
  }

  /// Half the visible height of the plane through the camera's target, for each mm of distance.
  get halfHeight(): number {
    return Math.tan((this.perspective.fov / 2) * (Math.PI / 180));
  }

  /// Whether the camera is moving by itself.
  get isTurning(): boolean {
    return this.turn.isUnderWay;
  }

  /// Stops such a movement where it is.
  stop(): void {
    this.turn.stop();
  }

  /// Stands at once where fitting puts it.
  standFitted(to: Viewpoint): void {
    this.turn.stop();
    this.stand(to);
    this.isFitted = true;
  }

  /// Moves there.
  turnFitted(to: Viewpoint): void {
    this.isFitted = true;
    this.turn.go({ towards: this.towards, target: this.controls.target.clone(), distance: this.distance }, to);
  }

  /// The camera that draws and picks, where it stands now.
  drawing(): PerspectiveCamera | OrthographicCamera {
    this.perspective.updateMatrixWorld();
    if (!this.isParallel) return this.perspective;
    const { parallel, perspective } = this, high = this.distance * this.halfHeight;
    [parallel.top, parallel.bottom, parallel.right, parallel.left] = [high, -high, high * perspective.aspect, -high * perspective.aspect];
    parallel.position.copy(perspective.position);
    parallel.quaternion.copy(perspective.quaternion);
    parallel.updateProjectionMatrix();
    parallel.updateMatrixWorld();
    return parallel;
  }

  setAspect(aspect: number): void {
    this.perspective.aspect = aspect;
    this.perspective.updateProjectionMatrix();
  }

  private stand({ towards, target, distance }: Viewpoint): void {
    this.controls.target.copy(target);
    this.perspective.position.copy(towards).setLength(distance).add(target);
    this.controls.update();
    this.changed();
  }

  private takenByHand(): void {
    this.turn.stop();
    this.isFitted = false;
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
    const from = new Spherical().setFromVector3(this.perspective.position.clone().sub(this.controls.target));
    from.theta += azimuth;
    from.phi += elevation;
    from.radius *= zoom;
    this.perspective.position.setFromSpherical(from.makeSafe()).add(this.controls.target);
    this.controls.update();
    this.controls.dispatchEvent({ type: "end" });
  }
}
