/// The module that emscripten makes from viewer/core.
declare module "page-core" {
  export interface PageCore {
    HEAPU8: Uint8Array;
    UTF8ToString(pointer: number): string;
    _malloc(bytes: number): number;
    _free(pointer: number): void;
    _condyle_error(): number;
    _condyle_joint(
      kind: number, anatomy: number, side: number, translationFrame: number, fixedVertices: number, fixedVertexCount: number, fixedTriangles: number,
      fixedTriangleCount: number, mobileVertices: number, mobileVertexCount: number, mobileTriangles: number,
      mobileTriangleCount: number): number;
    _condyle_free(joint: number): void;
    _condyle_pose(joint: number, angles: number, translation: number, pose: number): number;
    _condyle_can_penetrate(joint: number, ofFixed: number): number;
    _condyle_penetrations(joint: number, pose: number, ofFixed: number): number;
    _condyle_penetrating_vertices(joint: number): number;
    _condyle_depths(joint: number): number;
    _condyle_depth(joint: number, pose: number, angles: number, answer: number): number;
    _condyle_nearest(joint: number, pose: number, counted: number, answer: number): number;
    _condyle_shown(joint: number, pose: number, quantity: number, ofFixed: number, values: number, marks: number): number;
    _condyle_in_contact(joint: number, pose: number): number;
    _condyle_pairs(joint: number, pose: number): number;
    _condyle_pair_triangles(joint: number): number;
    _condyle_limit(
      joint: number, vary: number, positive: number, start: number, held: number, range: number, limit: number): number;
    _condyle_free_angles(joint: number, vary: number, start: number, held: number, back: number, forth: number): number;
    _condyle_intervals(joint: number): number;
    _condyle_brush(joint: number, ofFixed: number, before: number): number;
    _condyle_stroke(
      joint: number, ofFixed: number, action: number, along: number, count: number, radius: number, depth: number, outcome: number): number;
    _condyle_undo_stroke(joint: number, ofFixed: number): number;
    _condyle_strokes(joint: number, ofFixed: number): number;
    _condyle_removed(joint: number, ofFixed: number, removed: number): number;
    _condyle_brushed(joint: number, ofFixed: number, vertices: number, depths: number): number;
    _condyle_move_centre(joint: number, centre: number, reference: number): number;
    _condyle_limit_about(
      joint: number, vary: number, positive: number, start: number, range: number, limit: number): number;
    _condyle_body_mesh(joint: number, ofFixed: number, name: number, contact: number, place: number): number;
    _condyle_body_given(
      joint: number, ofFixed: number, vertices: number, head: number, fitted: number, fittedCount: number, margin: number): number;
    _condyle_part(joint: number, name: number, ofFixed: number, definition: number, centre: number): number;
    _condyle_part_mesh(joint: number, name: number): number;
    _condyle_parameter(joint: number, name: number, kind: number, numbers: number): number;
    _condyle_parts(joint: number, margin: number): number;
    _condyle_set_parameters(joint: number, text: number): number;
    _condyle_set_roles(joint: number, countBearing: number, fixed: number, mobile: number): number;
    _condyle_surface(
      joint: number, ofFixed: number, firstVertex: number, vertices: number, firstTriangle: number, triangles: number,
      youngsModulus: number, poissonRatio: number, thickness: number): number;
    _condyle_elastic(joint: number, casting: number, law: number, rule: number, reach: number): number;
    _condyle_pressure(joint: number, pose: number, ofFixed: number, values: number, marks: number): number;
    _condyle_bearing(joint: number, triangles: number): number;
    _condyle_read_mesh(name: number, bytes: number, count: number): number;
    _condyle_free_mesh(mesh: number): void;
    _condyle_propose(fixed: number, mobile: number, side: number): number;
    _condyle_side(joint: number): number;
    _condyle_vertex_count(joint: number, ofFixed: number): number;
    _condyle_triangle_count(joint: number, ofFixed: number): number;
    _condyle_mesh(joint: number, ofFixed: number, vertices: number, triangles: number): void;
    _condyle_description(joint: number): number;
    _condyle_read_labels(name: number, bytes: number, count: number): number;
    _condyle_free_labels(labels: number): void;
    _condyle_labels(labels: number): number;
    _condyle_bone(labels: number, label: number, task: number): number;
    _condyle_free_bone(bone: number): void;
    _condyle_bone_name(bone: number): number;
    _condyle_motion(joint: number, name: number, bytes: number, count: number, columns: number): number;
    _condyle_drop_file(path: number): number;
    _condyle_fill_file(path: number, bytes: number, count: number): number;
    _condyle_joint_meshes(path: number, bytes: number, count: number): number;
    _condyle_joint_block(): number;
    _condyle_joint_block_bytes(): number;
    _condyle_join(fixed: number, mobile: number, side: number): number;
  }
  const pageCore: (options: { wasmBinary: ArrayBuffer; zlib: object }) => Promise<PageCore>;
  export default pageCore;
}
