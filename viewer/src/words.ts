/// Every text of the page, in one table: another language is another table.
export const words = {
  appName: "Condyle",
  scope:
    "Osseous contact of the meshes given; soft tissue is not modelled. Research software, not a medical device. " +
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
  noData: "This page holds no joint.",

  scene: "Scene",
  sceneLabel: (fixed: string, mobile: string) =>
    `The joint in three dimensions: ${fixed} and ${mobile}. Drag to turn, wheel or pinch to zoom, drag with two fingers or the ` +
    "right button to move; with the keyboard arrows turn, plus and minus zoom.",
  views: "Look from",
  view: {
    anterior: "front", posterior: "back", superior: "above", inferior: "below", right: "right", left: "left",
  },
  colour: "Colour",
  quantity: {
    gap: "gap along rays", depth: "depth to read", nearest: "nearest distance", pressure: "pressure", none: "none",
  },
  unit: { gap: "mm", depth: "mm", nearest: "mm", pressure: "MPa" },
  quantityHelp: {
    gap: "Distance along the ray from the joint centre, mm: below zero the vertex is inside the other bone.",
    depth: "How deep a vertex is inside the other bone, mm, where its ray measures that; hatched: a lower bound only.",
    nearest: "Distance to the nearest point of the other bone, mm: below zero inside.",
    pressure: "Load on the triangles around a vertex over their area, MPa, of thin layers on rigid bones.",
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
  measureFirst: "Choose the first point on a bone.",
  measureSecond: "Choose the second point.",
  measured: (mm: number) => `Distance ${mm.toFixed(2)} mm`,
  hover: (body: string, vertex: number, value: string) => `${body}, vertex ${vertex}: ${value}`,
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
  inside: (body: string, { count, deepest_mm, without }: { count: number; deepest_mm: number; without: number }) =>
    `${count} vertices of ${body} inside` + (deepest_mm > 0 ? `, deepest ${deepest_mm.toFixed(2)} mm` : "") +
    (without > 0 ? `, ${without} of them where the ray tells no depth` : ""),
  pairsCount: (count: number) => `${count} pairs of triangles meet`,
  stepTook: (ms: number) => `computed in ${ms.toFixed(1)} ms`,
  precomputed: "Poses",

  limits: "Limits",
  limitsCaption:
    "How far each motion goes before bone meets bone. Bar: the limit; whisker: 5 to 95 % of its band; line: normal range.",
  limit: "limit",
  normal: "normal range",
  bearingContact: "bearing contact",
  reason: "ends by",
  contactKind: "kind of contact",
  goThere: (name: string) => `Go to the end of ${name}`,
  noLimits: "Limits cannot be told: ",
  noBand: "Bands are unknown: the report was made without them.",
  reasons: { contact: "contact", end_of_range: "end of range", contact_at_start: "in contact at the start" },

  map: "Range-of-motion map",
  computeMap: "Compute a map",
  mapProgress: (done: number, total: number) => `Computing the map: ${done} of ${total} points`,
  mapCaption: (vary: string, column: string, row: string) =>
    `How far ${vary} goes at every ${column} and ${row}, from its start. Hatched: not free at the start.`,
  mapPoint: (column: string, row: string, intervals: string) => `${column}, ${row}: ${intervals}`,
  freeFrom: (low: string, high: string) => `free from ${low}° to ${high}°`,
  orMore: (degrees: number) => `${degrees}° or more`,
  notFree: "nowhere free",

  clock: "Contacts on the clock face",
  clockCaption: "Where on the socket's rim each motion ends, as a clock seen from the side: 12 is superior, 3 anterior.",

  recorded: "Recorded motion",
  play: "Play",
  pause: "Pause",
  frame: "Frame",

  drop: "Drop your own",
  dropHere:
    "Drop the meshes of a hip here, or choose them: the hip bone first, or a file named femur (STL, OBJ, PLY, VTP, VTK). They stay " +
    "on this computer.",
  dropSecond: (name: string) => `${name} is the bone that stays; now the one that moves.`,
  dropped: (fixed: string, mobile: string) => `${mobile} in ${fixed}`,
  saveSvg: "Save as SVG",
  saveData: "Save data",

  numbers: "Numbers",
  side: "side",
  kind: "kind",
  vertices: "vertices",
  triangles: "triangles",
  notes: "Notes of the checks",
  noNotes: "The checks found nothing unusual.",
  terms: "Read with",
  file: "file",
  sha256: "SHA-256",
  bytes: "bytes",
  made: "made by",
  command: "command",
  licences: "Licences of the software in this page",
};
