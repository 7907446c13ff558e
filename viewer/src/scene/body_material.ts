import { Color, DataTexture, DoubleSide, LinearFilter, MeshLambertMaterial, RGBAFormat, SRGBColorSpace, UnsignedByteType } from "three";
import { colourTable, contactColour, stripeColour, zoneColour, type ColourScale } from "./colour_scale";

const steps = 512;

/// A surface coloured by a value per vertex: values are interpolated, not colours, so that a pixel has the colour of its value on the scale. Bounds
/// are hatched in grey, values beyond the scale striped, and marked triangles tinted.
export class BodyMaterial extends MeshLambertMaterial {
  private readonly shared = {
    scaleColours: { value: null as DataTexture | null },
    scaleLow: { value: 0 },
    scaleHigh: { value: 1 },
    plainAbove: { value: false },
    isFlat: { value: false },
    isGlass: { value: false },
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
      shader.vertexShader = shader.vertexShader
        .replace("#include <common>", `#include <common>
          attribute float shown; attribute float mark; attribute vec3 tints; attribute float hidden; attribute float isCartilage;
          varying float vShown; varying float vHasValue; varying float vIsBound; varying vec3 vTints; varying float vHidden; varying float vCartilage;`)
        .replace("#include <begin_vertex>", `#include <begin_vertex>
          vShown = shown; vHasValue = min(mark, 1.0); vIsBound = max(mark - 1.0, 0.0); vTints = tints; vHidden = hidden; vCartilage = isCartilage;`);
      shader.fragmentShader = shader.fragmentShader
        .replace("#include <common>", `#include <common>
          uniform sampler2D scaleColours; uniform float scaleLow; uniform float scaleHigh; uniform bool plainAbove;
          uniform bool isFlat; uniform bool isGlass; uniform vec3 cartilageColour; uniform vec3 contactColour; uniform vec3 zoneColour;
          uniform vec3 stripeColour;
          varying float vShown; varying float vHasValue; varying float vIsBound; varying vec3 vTints; varying float vHidden; varying float vCartilage;`)
        .replace("#include <color_fragment>", `#include <color_fragment>
          if (vHidden > 0.5) discard;
          if (vCartilage > 0.5) diffuseColor.rgb = cartilageColour;
          if (vHasValue > 0.5 && !(plainAbove && vShown > scaleHigh)) {
            float along = clamp((vShown - scaleLow) / (scaleHigh - scaleLow), 0.0, 1.0);
            diffuseColor.rgb = texture2D(scaleColours, vec2(along, 0.5)).rgb;
            bool isBeyond = vShown > scaleHigh || (scaleLow < 0.0 && vShown < scaleLow);
            if (isBeyond && mod(gl_FragCoord.x - gl_FragCoord.y, 8.0) < 2.0) diffuseColor.rgb = stripeColour;
            // A triangle with one bound among its corners has no value between them.
            if (vIsBound > 1e-3)
              diffuseColor.rgb = mod(gl_FragCoord.x + gl_FragCoord.y, 8.0) < 3.0 ? vec3(0.2) : vec3(0.55);
          }
          if (vTints.x > 0.5) diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.1, 0.55, 0.35), 0.35);
          if (vTints.z > 0.5) diffuseColor.rgb = mix(diffuseColor.rgb, zoneColour, 0.6);
          if (vTints.y > 0.5) diffuseColor.rgb = mix(diffuseColor.rgb, contactColour, 0.85);`)
        .replace("#include <opaque_fragment>", `if (isFlat) outgoingLight = diffuseColor.rgb;
          if (isGlass) {
            // As in condyle picture: least opaque where it faces the viewer.
            vec3 towardsViewer = isOrthographic ? vec3(0.0, 0.0, 1.0) : normalize(vViewPosition);
            float aside = 1.0 - abs(dot(normal, towardsViewer));
            diffuseColor.a = 0.2 + 0.6 * aside * aside;
          }
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
