import {
  Color, DataTexture, DoubleSide, LinearFilter, MeshDepthMaterial, MeshLambertMaterial, RGBAFormat, SRGBColorSpace, UnsignedByteType,
  type WebGLProgramParametersWithUniforms,
} from "three";
import { colourTable, contactColour, plainFrom, stripeColour, zoneColour, type ColourScale } from "./colour_scale";
import { ghostShader } from "./ghost";

const steps = 512;

/// What is not shown is put beyond every camera.
const hideVertices = ({ vertexShader }: WebGLProgramParametersWithUniforms) => vertexShader
  .replace("#include <common>", "#include <common>\nattribute float hidden;")
  .replace("#include <project_vertex>", "#include <project_vertex>\nif (hidden > 0.5) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);");

/// Shadows of what is shown.
export function shadowMaterial(): MeshDepthMaterial {
  const material = new MeshDepthMaterial();
  material.onBeforeCompile = (shader) => (shader.vertexShader = hideVertices(shader));
  return material;
}

/// A surface coloured by a value per vertex: values are interpolated, not colours, so that a pixel has the colour of its value on the scale. Bounds
/// are hatched in grey, values beyond the scale striped, and marked triangles tinted. Light is the scene's, less where the surface is less open;
/// a cut shows the inside as one flat colour, as if the bone were solid.
export class BodyMaterial extends MeshLambertMaterial {
  private readonly shared = {
    scaleColours: { value: null as DataTexture | null },
    scaleLow: { value: 0 },
    scaleHigh: { value: 1 },
    plainAbove: { value: false },
    isFlat: { value: false },
    isGlass: { value: false },
    ghostRadius: { value: 0 },
    pixel: { value: 1 },
    cartilageColour: { value: new Color() },
    contactColour: { value: new Color(contactColour) },
    zoneColour: { value: new Color(zoneColour) },
    stripeColour: { value: new Color(stripeColour) },
  };

  constructor(bone: string, cartilage: string) {
    super({ color: bone, side: DoubleSide });
    this.shared.cartilageColour.value.set(cartilage);
    this.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, this.shared);
      shader.vertexShader = hideVertices(shader)
        .replace("#include <common>", `#include <common>
          attribute float shown; attribute float mark; attribute float cover; attribute vec3 tints; attribute float isCartilage; attribute float openness;
          varying float vShown; varying float vHasValue; varying float vCover; varying float vIsBound; varying vec3 vTints; varying float vCartilage;
          varying float vOpen;`)
        .replace("#include <begin_vertex>", `#include <begin_vertex>
          vShown = shown; vHasValue = min(mark, 1.0); vIsBound = max(mark - 1.0, 0.0); vCover = cover; vTints = tints; vCartilage = isCartilage;
          vOpen = openness * openness;`);
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>
          uniform sampler2D scaleColours; uniform float scaleLow; uniform float scaleHigh; uniform bool plainAbove; uniform float pixel;
          uniform bool isFlat; uniform bool isGlass; uniform vec3 cartilageColour; uniform vec3 contactColour; uniform vec3 zoneColour;
          uniform vec3 stripeColour;
          varying float vShown; varying float vHasValue; varying float vCover; varying float vIsBound; varying vec3 vTints; varying float vCartilage;
          varying float vOpen;`)
        .replace("void main() {", `${ghostShader}
          void main() {`)
        .replace("#include <color_fragment>", `#include <color_fragment>
          if (vCartilage > 0.5) diffuseColor.rgb = cartilageColour;
          vec3 plain = diffuseColor.rgb;
          vec2 at = floor(gl_FragCoord.xy / pixel);
          if (vHasValue > 0.01 && (plainAbove || vHasValue > 0.5)) {
            // A scale that ends in plain bone fades into it, and along the edge of what has values. A corner without one does not count.
            float value = plainAbove ? vShown / vHasValue : vShown;
            float along = clamp((value - scaleLow) / (scaleHigh - scaleLow), 0.0, 1.0);
            float share = 1.0;
            if (plainAbove) {
              share = smoothstep(0.0, 0.4, vHasValue) * smoothstep(0.35, 0.9, vCover);
              share *= 1.0 - smoothstep(${plainFrom.toFixed(2)}, 1.0, value / scaleHigh);
            }
            diffuseColor.rgb = texture2D(scaleColours, vec2(along, 0.5)).rgb;
            bool isBeyond = value > scaleHigh || (scaleLow < 0.0 && value < scaleLow);
            if (isBeyond && mod(at.x - at.y, 8.0) < 2.0) diffuseColor.rgb = stripeColour;
            diffuseColor.rgb = mix(plain, diffuseColor.rgb, share);
            // A triangle with one bound among its corners has no value between them.
            if (vIsBound > 1e-3) diffuseColor.rgb = mod(at.x + at.y, 8.0) < 3.0 ? vec3(0.2) : vec3(0.55);
          }
          if (vTints.x > 0.5) diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.1, 0.55, 0.35), 0.35);
          if (vTints.z > 0.5) diffuseColor.rgb = mix(diffuseColor.rgb, zoneColour, 0.6);
          if (vTints.y > 0.5) diffuseColor.rgb = mix(diffuseColor.rgb, contactColour, 0.85);`)
        .replace("#include <aomap_fragment>", `
          vec3 towardsViewer = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(vViewPosition);
          float facing = abs(dot(normal, towardsViewer));
          // Light that bone throws into its own hollows has the bone's colour.
          reflectedLight.indirectDiffuse *= mix(0.7 * diffuseColor.rgb, vec3(1.0), vOpen);
          reflectedLight.directDiffuse *= mix(0.5, 1.0, vOpen);
          // A rim of light from above and behind, and before what lies farther a thin dark line.
          float slant = 1.0 - facing;
          reflectedLight.indirectDiffuse += 0.3 * slant * slant * slant * vOpen * (0.6 + 0.4 * normal.y) * diffuseColor.rgb;
          float line = min(facing / max(2.5 * pixel * fwidth(facing), 1e-4), 1.0);`)
        .replace("#include <opaque_fragment>", `outgoingLight *= 0.3 + 0.7 * line;
          // A mark has its own colour in the shade too.
          outgoingLight = mix(outgoingLight, diffuseColor.rgb, 0.5 * step(0.5, vTints.y));
          if (isFlat) outgoingLight = diffuseColor.rgb;
          #if NUM_CLIPPING_PLANES > 0
            if (!gl_FrontFacing && opacity == 1.0 && !isGlass) outgoingLight = 0.62 * plain;
          #endif
          // As in condyle picture: least opaque where it faces the viewer.
          if (isGlass) diffuseColor.a = 0.2 + 0.6 * slant * slant;
          if (isGhost(-vViewPosition, at, facing)) discard;
          #include <opaque_fragment>`);
    };
  }

  setScale(scale: ColourScale): void {
    const texture = new DataTexture(colourTable(scale, steps), steps, 1, RGBAFormat, UnsignedByteType);
    texture.colorSpace = SRGBColorSpace;
    texture.minFilter = texture.magFilter = LinearFilter;
    texture.needsUpdate = true;
    this.shared.scaleColours.value?.dispose();
    this.shared.scaleColours.value = texture;
    this.shared.scaleLow.value = scale.low;
    this.shared.scaleHigh.value = scale.high;
    this.shared.plainAbove.value = scale.plainAbove;
  }

  setShading(on: boolean): void {
    this.shared.isFlat.value = !on;
  }

  /// Radius of the joint's sphere, and pixels of the canvas to one of the page.
  setMeasures(radius_mm: number, pixel: number): void {
    this.shared.ghostRadius.value = radius_mm;
    this.shared.pixel.value = pixel;
  }

  /// Transparent below 1; like glass, more so where it faces the viewer.
  setOpacity(opacity: number, isGlass: boolean): void {
    const transparent = opacity < 1 || isGlass;
    if (transparent !== this.transparent) this.needsUpdate = true;
    this.transparent = transparent;
    this.depthWrite = !transparent;
    this.opacity = opacity;
    this.shared.isGlass.value = isGlass;
  }
}
