/// The module that emscripten makes from viewer/core. Its functions take numbers and places in its memory: the headers there say which, here is how many.
declare module "page-core" {
  type Numbers<Count extends number, Made extends number[] = []> = Made["length"] extends Count ? Made : Numbers<Count, [...Made, number]>;
  type Taking<Count extends number, Names extends string> = Record<`_condyle_${Names}`, (...args: Numbers<Count>) => number>;

  type Functions =
    & Taking<0, "error" | "joint_block" | "joint_block_bytes">
    & Taking<1, "free" | "penetrating_vertices" | "depths" | "pair_triangles" | "intervals" | "free_mesh" | "side" | "description" |
      "free_labels" | "labels" | "free_bone" | "bone_name" | "drop_file">
    & Taking<2, "can_penetrate" | "in_contact" | "pairs" | "undo_stroke" | "strokes" | "parts" | "set_parameters" | "bearing" |
      "vertex_count" | "triangle_count" | "set_ligaments" | "ligaments">
    & Taking<3, "penetrations" | "brush" | "removed" | "move_centre" | "read_mesh" | "propose" | "read_labels" | "bone" | "fill_file" |
      "joint_meshes" | "join">
    & Taking<4, "pose" | "standing" | "depth" | "screw" | "nearest" | "brushed" | "set_roles" | "mesh">
    & Taking<5, "elastic" | "pressure" | "motion">
    & Taking<6, "shown" | "free_angles" | "limit_about" | "body_given">
    & Taking<7, "limit">
    & Taking<8, "stroke">
    & Taking<9, "surface">
    & Taking<12, "joint">;
  export interface PageCore extends Functions {
    HEAPU8: Uint8Array;
    UTF8ToString(pointer: number): string;
    _malloc(bytes: number): number;
    _free(pointer: number): void;
  }
  const pageCore: (options: { wasmBinary: ArrayBuffer; zlib: object }) => Promise<PageCore>;
  export default pageCore;
}
