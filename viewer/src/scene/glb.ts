import { BufferAttribute, BufferGeometry, Color, DoubleSide, Group, Mesh, MeshStandardMaterial, SRGBColorSpace } from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import type { SceneBody } from "./body";
import { beyond, contactColour, rgb, zoneColour, type ColourScale } from "./colour_scale";

const metresPerMm = 1e-3;

/// Both bones as they stand, with the colours of their vertices: binary glTF, whose lengths are metres.
export async function glbOf(bodies: readonly { name: string; body: SceneBody }[], scale: ColourScale | null): Promise<Blob> {
  const all = new Group();
  all.name = "joint";
  all.scale.setScalar(metresPerMm);
  for (const { name, body } of bodies) {
    if (!body.mesh.visible) continue;
    const mesh = new Mesh(colouredGeometry(body, scale), new MeshStandardMaterial({ vertexColors: true, side: DoubleSide, roughness: 0.9, metalness: 0 }));
    mesh.name = name;
    mesh.matrixAutoUpdate = false;
    mesh.matrix.copy(body.mesh.matrix);
    all.add(mesh);
  }
  const bytes = await new GLTFExporter().parseAsync(all, { binary: true, trs: false });
  return new Blob([bytes as ArrayBuffer], { type: "model/gltf-binary" });
}

function colouredGeometry(body: SceneBody, scale: ColourScale | null): BufferGeometry {
  const shown = body.mesh.geometry, count = shown.getAttribute("position").count;
  const colours = new Float32Array(3 * count), colour = new Color();
  for (let v = 0; v < count; ++v) {
    const [r, g, b] = colourOf(body, v, scale);
    colour.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace).toArray(colours, 3 * v);
  }
  return new BufferGeometry().setAttribute("position", shown.getAttribute("position")).setAttribute("normal", shown.getAttribute("normal"))
    .setAttribute("color", new BufferAttribute(colours, 3)).setIndex(shown.getIndex());
}

const bound = [140, 140, 140] as const;

/// sRGB, 0 to 255. Only a surface has stripes: here a value beyond the scale has its end's colour.
function colourOf(body: SceneBody, vertex: number, scale: ColourScale | null): readonly [number, number, number] {
  if (body.isMarked("contact", vertex)) return rgb(contactColour);
  if (body.isMarked("zone", vertex)) return rgb(zoneColour);
  const value = scale && body.valueOf(vertex);
  if (!value || beyond(scale, value.amount) === "plain") return rgb(body.plainColour(vertex));
  return value.isBound ? bound : rgb(scale.colour(value.amount));
}
