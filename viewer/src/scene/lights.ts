import { DirectionalLight, HemisphereLight, type PerspectiveCamera, type Scene, Vector3 } from "three";

/// Where the key light stands: left, above and before the joint as the viewer sees it.
const keyAside = [-0.55, 0.75, 0.8] as const;
/// Bone within so many radii of the joint casts a shadow: the shadow of a shaft that comes at the viewer would only hide the joint.
const radiiOfShadow = 3;
const shadowMap_px = 1024;

/// Light from the sky, a little from the viewer, and a key light with a soft shadow that follows the viewer's upper left.
export class Lights {
  private readonly key = new DirectionalLight("#ffffff", 2.3);

  constructor(scene: Scene) {
    const { key } = this, { shadow } = key;
    key.castShadow = true;
    shadow.mapSize.set(shadowMap_px, shadowMap_px);
    shadow.radius = 3;
    shadow.intensity = 0.7;
    scene.add(key, key.target, new HemisphereLight("#ffffff", "#b8aa9c", 1.45));
  }

  set castsShadow(on: boolean) {
    this.key.castShadow = on;
  }

  /// About a joint of this radius, before this camera.
  follow(camera: PerspectiveCamera, radius_mm: number): void {
    const reach = radiiOfShadow * radius_mm, { key } = this, { camera: view } = key.shadow;
    key.position.copy(new Vector3(...keyAside).setLength(2 * reach).applyQuaternion(camera.quaternion));
    key.shadow.normalBias = 0.02 * radius_mm;
    if (view.right === reach) return;
    [view.left, view.right, view.bottom, view.top, view.near, view.far] = [-reach, reach, -reach, reach, reach, 3 * reach];
    view.updateProjectionMatrix();
  }
}
