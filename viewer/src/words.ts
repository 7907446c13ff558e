import type { BandSigma } from "./report";

interface BandSource extends BandSigma {
  samples: number;
  seed: number;
}

/// Every text of the page, in one table: another language is another table.
export const words = {
  pageTitle: (title: string) => `${title} – Condyle`,
  subtitle: (side: string, anatomy: string, { fixed, mobile }: { fixed: string; mobile: string }) =>
    `${side} ${anatomy}: ${mobile} in ${fixed}`,
  sides: { right: "right", left: "left" },
  anatomies: { hip: "hip", knee: "knee", ankle: "ankle", elbow: "elbow", shoulder: "shoulder" },
  kinds: { ball: "ball joint", hinge: "hinge", free: "free joint" },
  /// Coverage of the joint's answers, as the core words it; null: the page has no joint.
  scope: (said: string | null) =>
    `${said === null ? "Research software, not a medical device" : said.charAt(0).toUpperCase() + said.slice(1)}. ` +
    "Everything is computed in this page: no data leaves this computer.",
  loading: "Making the joint ready…",
  noWebAssembly:
    "This browser does not run WebAssembly: the page shows poses that were computed when it was made, and none in between.",
  noWebAssemblyToRead: "This browser does not run WebAssembly, by which the page reads meshes and computes.",
  noWebGl: "This browser shows no 3D graphics: the numbers and figures below are complete without.",
  damaged: "The data of this report cannot be read: ",
  wrongMagic: "it does not begin as a block of Condyle does.",
  wrongVersion: (found: number) => `its version is ${found}, this page reads version 1.`,
  truncated: "it ends before the arrays it names.",
  notCompressed: "it is incomplete or was changed after it was made.",
  notJson: "its text is no JSON.",
  wrongKey: (key: string) => `${key.slice(0, 200)} is missing or is not what a report has there.`,
  unfinished: "This file is incomplete, or no scripts run here: it shows a joint only when it is whole and opened in a browser that runs scripts.",
  noScripts: "Scripts are off: this page needs them to show its joint. It asks nothing of any network.",
  noData: "This page holds no joint.",

  scene: "Scene",
  sceneLabel: (fixed: string, mobile: string) =>
    `The joint in three dimensions: ${fixed} and ${mobile}. Drag to turn, wheel or pinch to zoom, drag with two fingers or the ` +
    "right button to move; with the keyboard arrows turn, plus and minus zoom.",
  /// Anterior, superior, right.
  axisLetters: ["A", "S", "R"] as const,
  views: "Look from",
  view: {
    anterior: "front", posterior: "back", superior: "above", inferior: "below", right: "right", left: "left",
  },
  colour: "Colour",
  quantity: {
    gap: "gap along rays", depth: "depth to read", nearest: "nearest distance", pressure: "pressure", removed: "bone that went", none: "none",
  },
  unit: { gap: "mm", depth: "mm", nearest: "mm", pressure: "MPa", removed: "mm" },
  quantityHelp: {
    gap: "Distance along the ray from the joint centre, mm: below zero the vertex is inside the other bone.",
    depth: "How deep a vertex is inside the other bone, mm, where its ray measures that; hatched: a lower bound only.",
    nearest: "Distance to the nearest point of the other bone, mm: below zero inside.",
    pressure: "Load on the triangles around a vertex over their area, MPa, of thin layers on rigid bones.",
    removed: "How far the surface lies below the one before the cut, mm.",
    none: "Plain bones.",
  },
  scaleEnd: "Scale to",
  opacity: (body: string) => `Opacity of ${body}`,
  shown: (body: string) => `Show ${body}`,
  clip: "Cut away",
  clipAxis: { none: "nothing", x: "front of", y: "above", z: "right of" },
  clipAt: "Cut at, mm from the centre",
  bearing: "Mark the bearing surface",
  pairs: "Mark triangles in contact",
  zones: "Mark the impingement zone of",
  noZone: "none",
  zoneHelp: (past: string) => `The triangles that meet ${past}° past the end of the motion.`,
  shading: "Shading",
  measure: "Measure between two points",
  measureFirst: "Choose the first point on a bone, or give the number of a vertex.",
  measureSecond: "Choose the second point.",
  measured: (mm: number) => `Distance ${mm.toFixed(2)} mm`,
  hover: (body: string, vertex: number, value: string) => `${body}, vertex ${vertex}: ${value}`,
  vertexOf: "Vertex of",
  vertexNumber: "Number of a vertex",
  tellVertex: "Tell",
  noVertex: (body: string, last: number) => `${body} has vertices 0 to ${last}`,
  bound: "at least",
  noValue: "no value",

  motion: "Motion",
  reset: "Back to zero",
  coordinate: (name: string) => `${name}, degrees`,
  translation: (axis: string) => `${axis}, mm`,
  free: (name: string, low: string, high: string) => `${name} is free from ${low} to ${high} from here`,
  startsInContact: "in contact here",
  manoeuvres: "Go to the end of",
  inContact: "In contact",
  notInContact: "Not in contact",
  inside: (body: string, { count }: { count: number }) => `${count} vertices of ${body} inside`,
  depthAlong: (depth_mm: number, along: string, vertex: number, body: string, nearest_mm: number) =>
    `depth ${depth_mm.toFixed(2)} mm along ${along}, vertex ${vertex} of ${body}; its nearest surface is ${nearest_mm.toFixed(2)} mm away`,
  theRay: "the ray",
  theArc: (angle: string, deg: number) => `the arc of ${angle}, ${deg.toFixed(1)}°`,
  withoutDepth: (count: number) => `${count} vertices inside have no depth along their ray or an arc`,
  contactArea: (area_mm2: number, body: string) => `${area_mm2.toFixed(1)} mm² of ${body}`,
  contactAreas: (areas: string) => `contact area ${areas}`,
  penetrationVolume: (volume_mm3: number, error_mm3: number) =>
    `penetration volume ${volume_mm3.toFixed(2)} mm³, to within ${error_mm3.toExponential(0)}`,
  coveredAgain: (volume_mm3: number) =>
    `a body covers ${volume_mm3.toPrecision(3)} mm³ about the overlap more than once: the volume may count space there twice`,
  pairsCount: (count: number) => `${count} pairs of triangles meet`,
  stepTook: (ms: number) => `answered in ${ms.toFixed(1)} ms`,
  precomputed: "Poses",

  limits: "Limits",
  limitsCaption:
    "How far each motion goes before bone meets bone. Bar: the limit; whisker: 5 to 95 % of its band; line: normal range.",
  over: (limit: string) => `over ${limit}`,
  bandOf: (low: string, high: string) => `(${low} to ${high})`,
  limit: "limit",
  normal: "normal range",
  bearingContact: "bearing contact",
  reason: "ends by",
  endsBy: (reason: string, kind: string) => `${reason} (${kind})`,
  meshOn: (mobile: string, fixed: string) => `${mobile} on ${fixed}`,
  softFrom: (angle: string, met: string | null) => `soft contact from ${angle}${met ? `: ${met}` : ""}`,
  contactKinds: {
    impingement: "impingement", bearing: "bearing", unknown: "kind unknown", cut: "cut of the image: no limit", soft: "soft contact",
  } as Record<string, string>,
  band: "band",
  bandEnds: (low: string, high: string) => `${low} to ${high}°`,
  errorBound: "error bound",
  goThere: (name: string) => `Go to the end of ${name}`,
  noLimits: "Limits cannot be told: ",
  noBand: "Bands are unknown: the report was made without them.",
  reasons: { contact: "contact", end_of_range: "end of range", contact_at_start: "in contact at the start" },
  translationEnds: "no contact, translation ends",
  notCarried: "unknown: load not carried",

  plan: "Bone that must go",
  withoutBone: "The joint is shown without the bone that must go for its motions to reach their targets; limits are those without it.",
  targets: "Targets",
  before: "before",
  after: "after",
  target: "target",
  gain: "gain",
  unitHead: "unit",
  blocked: (motion: string, planned: string, by: string, body: string) => `${motion} ends at ${planned}°: ${by} of ${body} is in the way`,
  keptBy: {
    bearing: "the bearing surface", depth: "bone deeper than may go", zone: "bone outside the zone that may go", marked: "bone marked to stay",
  },
  cut: ({ name, volume_mm3, least_volume_mm3, area_mm2, deepest_mm, burr_volume_mm3, hour }: {
    name: string; volume_mm3: number; least_volume_mm3: number; area_mm2: number; deepest_mm: number; burr_volume_mm3: number; hour: string | null;
  }) =>
    `${name}: ${volume_mm3.toFixed(1)} mm³ go, ${least_volume_mm3.toFixed(1)} of it in the way, over ${area_mm2.toFixed(0)} mm²; ` +
    `${deepest_mm.toFixed(2)} mm at the deepest${hour === null ? "" : `, at ${hour} of the neck`}` +
    (burr_volume_mm3 > 0 ? `; ${burr_volume_mm3.toFixed(1)} mm³ go for the burr` : ""),
  nothingGoes: "No bone has to go.",
  plannedMargin: (mm: string) => `Planned with a margin of ${mm} mm.`,
  showRemoved: "Show the bone that went",
  curveCaption: (motions: string) => `Volume that has to go for each target by itself, over the angle that it then reaches: ${motions}.`,
  curveVolume: "removed, mm³",
  curveReached: "reached, degrees",
  curvePoint: (reached: string, volume: string, depth: string) => `${reached}°: ${volume} mm³, ${depth} mm deep`,
  measuresThatChange: "Measures that change",
  planNotes: "Notes on the plan",

  shape: "Shape of the hip",
  pelvisFrame: (frame: string) => `Angles of the acetabulum turn with the pelvis: ${frame}.`,
  drawMeasures: "Draw axes, rim and alpha points on the bones",
  measuredPart: { femur: "Femur", acetabulum: "Acetabulum", both: "Both bones" },
  value: "value",
  rangeOf: (low: string, high: string) => `${low} to ${high}`,
  ofMeasure: (name: string, said: string) => `${name}: ${said}`,
  definedBy: (definition: string, source: string) => `${definition} (${source})`,
  notMeasured: "Not measured",
  definitions: "Definitions",
  normalSources: "Whose the normal ranges are",
  alphaAxis: "alpha angle",
  alphaAt: (mm: string) => `to ${mm} mm`,
  alphaCaption: "Alpha angle by the hour around the neck, at two tolerances of the head's circle: 12 is superior, 3 anterior.",
  centreEdgeAxis: "centre-edge angle",
  centreEdgeCaption: "Centre-edge angle by the hour around the opening of the socket: 12 is superior, 3 anterior.",

  map: "Range-of-motion map",
  computeMap: "Compute a map",
  mapProgress: (done: number, total: number) => `Computing the map: ${done} of ${total} points`,
  mapCaption: (vary: string, column: string, row: string) =>
    `How far ${vary} goes at every ${column} and ${row}, from its start. Hatched: not free at the start.`,
  mapPlace: (column: string, column_deg: number, row: string, row_deg: number) => `${column} ${column_deg}°, ${row} ${row_deg}°`,
  mapPoint: (place: string, vary: string, intervals: string) => `${place}: ${vary} ${intervals}`,
  severalFree: "more than one free interval: press to see all",
  freeFrom: (low: string, high: string) => `free from ${low}° to ${high}°`,
  orMore: (degrees: number) => `${degrees}° or more`,
  notFree: "nowhere free",

  clock: "Contacts on the clock face",
  clockCaption: {
    sagittal: "Sagittal clock position of the contact that ends each motion, seen from the side: 12 is superior, 3 anterior.",
    rim: "Where on the socket's rim each motion ends, in the plane fitted to the rim: 6 is the acetabular notch, 3 anterior.",
  },

  recorded: "Recorded motion",
  play: "Play",
  pause: "Pause",
  frame: "Frame",
  recordedAxis: { time_s: "time, s", frame: "frame" },
  recordedFrames: (count: number) => `${count} frames`,
  recordedOver: (count: number, first: string, last: string) => `${count} frames from ${first} to ${last} s`,
  zeroCurves: (names: string) => `Zero throughout: ${names}`,
  emptyCurves: (names: string) => `Without values: ${names}`,

  drop: "Drop your own",
  dropHere:
    "Drop the meshes of a hip here, or choose them: the hip bone first, or a file named femur (STL, OBJ, PLY, VTP, VTK). They stay " +
    "on this computer.",
  dropSide: "Side",
  dropSides: { told: "as the bones tell", right: "right", left: "left" },
  dropSecond: (name: string) => `${name} is the bone that stays; now the one that moves.`,
  dropHint: "Drop the meshes of a hip on this page",
  dropTwo: "A joint has two meshes: drop these two, or one after the other.",
  dropBusy: "The page is still reading the meshes that were dropped before.",
  dropDone: "This page shows the joint of the meshes that were dropped first: reload it, then drop others.",
  dropped: (fixed: string, mobile: string) => `${mobile} in ${fixed}`,
  saveSvg: "Save as SVG",
  saveData: "Save data",

  numbers: "Numbers",
  ofBodies: (side: string, kind: string) => `Bodies of the joint: ${side}, ${kind}`,
  how: "How limits were found",
  guarantee: "A limit is the first contact of the surfaces as the angle turns: free before it, in contact at it or past it by at most " +
    "its error bound.",
  bounded: "Limits are bounded, not exact, for the centre is not held: the joint is free up to each, and past it by its error bound in " +
    "contact, or nearer to contact than some micrometres.",
  bandsFrom: ({ samples, seed, centre_mm, axes_deg, surface_mm, surface_voxels, parameters }: BandSource) =>
    `Bands: 5 to 95 % of ${samples} displaced joints, seed ${seed}; standard deviations: centre ${centre_mm} mm, axes ${axes_deg}°, ` +
    `surfaces ${surface_voxels ? `${surface_voxels} voxels` : `${surface_mm} mm`}` +
    Object.entries(parameters ?? {}).map(([name, sigma]) => `, ${name} ${sigma}`).join("") + ".",
  notAsInFile: (changed: string) => `Not as in the joint file: ${changed}.`,
  changedTo: (name: string, value: string, inFile: string) => `${name} ${value} instead of ${inFile}`,
  bearingRules: {
    leave_out: "Contact of the bearing surface does not end a motion.", count: "Every contact ends a motion.",
  },
  bearingWhy: (why: string) => `No bearing surface: ${why}.`,
  bearingHead: (mm: string) => `Sphere fitted to the head: radius ${mm} mm.`,
  bearingSocket: (mm: string) => `Sphere fitted to the socket: radius ${mm} mm.`,
  bearingMargin: (mm: string) => `The bearing surface reaches ${mm} mm outside the head's sphere.`,
  normalFrom: (source: string) => `Normal ranges: ${source}.`,
  vertices: "vertices",
  triangles: "triangles",
  notes: "Notes of the checks",
  noNotes: "The checks found nothing unusual.",
  readWith: "Read with",
  caveats: "What usually ends these motions",
  caveat: (motions: string, text: string, source: string | null) => `${motions}: ${text}${source === null ? "" : ` (${source})`}`,
  file: "file",
  sha256: "SHA-256",
  bytes: "bytes",
  made: "Made of",
  files: "Files",
  madeHere: (version: string) => `By condyle ${version} in this page, from files dropped on it`,
  madeBy: (version: string, command: string) => `By condyle ${version}, command: ${command}`,
  licences: "Licences of the software in this page",
};
