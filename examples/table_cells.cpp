// What the tables of a closed mesh hold, cell by cell, for the drawings of docs/mathematics: table_cells MESH CELLS_PER_SIDE CELLS.
// Rings are about Z; both maps of directions have CELLS_PER_SIDE, the profile about CELLS.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include "condyle/io/mesh_file.hpp"
#include "radial/build/cartesian_rows.hpp"
#include "radial/build/cube_table.hpp"
#include "tangential/build/rings.hpp"

namespace {

void print_list(const char* table, std::size_t cell, const auto& entries, auto triangle_of) {
  for (const auto& entry : entries) std::printf("%s,%zu,%u\n", table, cell, triangle_of(entry));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fputs("usage: example_table_cells MESH CELLS_PER_SIDE CELLS\n", stderr);
    return 2;
  }
  try {
    using namespace condyle::radial;
    const condyle::TriMesh mesh = condyle::io::read_mesh(std::filesystem::path(argv[1])).mesh;
    const auto itself = [](condyle::Index triangle) { return triangle; };
    std::puts("table,cell,triangle");
    const CartesianMap cartesian(std::atoi(argv[2]));
    CartesianRows of_cartesian;
    build(mesh, cartesian, of_cartesian);
    for (condyle::Index cell = 0; cell < cartesian.cell_count(); ++cell)
      print_list("cartesian", cell, of_cartesian.entries.of(cell), itself);
    const CubeMap cube(std::atoi(argv[2]));
    CubeTable of_cube;
    build(mesh, cube, of_cube);
    for (condyle::Index cell = 0; cell < cube.cell_count(); ++cell)
      print_list("cube", cell, of_cube.entries.of(cell), itself);
    const auto cells = static_cast<std::size_t>(std::atoi(argv[3]));
    const auto rings = condyle::tangential::build_rings(mesh, {{0, 0, 0}, {0, 0, 1}}, cells);
    const auto& grid = rings.grid();
    std::printf("grid,%.17g,%.17g,%.17g,%.17g,%u,%u\n", grid.rho_min, grid.z_min, grid.rho_cell, grid.z_cell,
                grid.columns, grid.rows);
    for (std::size_t cell = 0; cell < grid.cells(); ++cell)
      print_list("ring", cell, rings.lists.of(cell), [](const auto& entry) { return entry.triangle; });
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
