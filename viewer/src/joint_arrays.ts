import type { GivenBody, JointArrays, Layers, LoadedSurface, PosedArrays } from "./core/protocol";
import type { Report, StoredLayers, StoredPosed, StoredSurface } from "./report";

const kinds = ["ball", "hinge", "free"], anatomies = ["hip", "knee", "ankle", "elbow", "shoulder"];
const castings = ["fixed", "mobile", "both"], laws = ["linear", "logarithmic"], rules = ["face_centre", "cut_faces"];

/// The joint of a report as the core takes it.
export function jointArraysOf(report: Report): JointArrays {
  const { joint, layers, posed } = report.text;
  const surface = (body: string) => ({
    vertices: report.array(`${body}_vertices`, "f64"), triangles: report.array(`${body}_triangles`, "u32"),
  });
  return {
    kind: kinds.indexOf(joint.kind), anatomy: anatomies.indexOf(joint.anatomy), side: joint.side === "right" ? 0 : 1,
    translationFrame: joint.translation_frame === "fixed" ? 0 : 1, fixed: surface("fixed"), mobile: surface("mobile"),
    bearing: bearingOf(report), layers: layers && layersOf(report, layers), posed: posed ? posedOf(report, posed) : null,
    ligaments: joint.ligaments ?? null,
  };
}

/// The rules by which the report's own limits were computed.
function bearingOf(report: Report): JointArrays["bearing"] {
  const { rom, arrays } = report.text;
  if (!rom) return "found";
  const roles = (name: string) => (name in arrays ? report.array(name, "u8") : null);
  return { counts: rom.bearing?.rule === "count", fixed: roles("fixed_roles"), mobile: roles("mobile_roles") };
}

function layersOf(report: Report, layers: StoredLayers): Layers {
  const surface = (stored: StoredSurface): LoadedSurface => ({
    firstVertex: stored.first_vertex, vertices: stored.vertices, firstTriangle: stored.first_triangle, triangles: stored.triangles,
    layer: stored.thickness_mm === undefined ? null : {
      youngsModulus_mpa: stored.youngs_modulus_mpa!, poissonRatio: stored.poisson_ratio!,
      thickness_mm: report.array(stored.thickness_mm, "f64"),
    },
  });
  return {
    casting: castings.indexOf(layers.casting), law: laws.indexOf(layers.law), rule: rules.indexOf(layers.rule),
    reach_mm: layers.reach_mm, fixed: surface(layers.fixed), mobile: surface(layers.mobile),
  };
}

function posedOf(report: Report, posed: StoredPosed): PosedArrays {
  const given = (body: "fixed" | "mobile"): GivenBody => {
    const { as_given, fitted_head } = posed[body];
    return {
      text: JSON.stringify({ ...posed[body], meshes: report.text.parts[body] }), vertices: as_given === null ? null : report.array(as_given, "f64"),
      fittedHead: fitted_head === null ? null : report.array(fitted_head, "u32"),
    };
  };
  return { text: JSON.stringify(posed), fixed: given("fixed"), mobile: given("mobile") };
}
