#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include "mesh/label_surface/contour.hpp"
#include "mesh/surface_distance.hpp"
#include "support/test.hpp"

/// VTK's flying edges on the same samples: another table of cases, without the decider for ambiguous faces.

namespace condyle::mesh {
namespace {

TriMesh flying_edges(const SampledField& field) {
  const vtkNew<vtkImageData> image;
  std::array<int, 3> n;
  for (std::size_t a = 0; a < 3; ++a) n[a] = static_cast<int>(field.axis[a].size());
  image->SetDimensions(n.data());
  image->SetOrigin(field.axis[0].coordinate[0], field.axis[1].coordinate[0], field.axis[2].coordinate[0]);
  image->AllocateScalars(VTK_FLOAT, 1);
  std::copy(field.value.begin(), field.value.end(), static_cast<float*>(image->GetScalarPointer()));
  const vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, 0.0);
  contour->ComputeNormalsOff();
  contour->Update();
  vtkPolyData* const surface = contour->GetOutput();
  TriMesh mesh;
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v)
    mesh.vertices.push_back(Vec3(surface->GetPoint(v)));
  const vtkNew<vtkIdList> corners;
  vtkCellArray* const triangles = surface->GetPolys();
  for (triangles->InitTraversal(); triangles->GetNextCell(corners) != 0;)
    mesh.triangles.push_back({static_cast<Index>(corners->GetId(0)), static_cast<Index>(corners->GetId(1)),
                              static_cast<Index>(corners->GetId(2))});
  return mesh;
}

double largest_distance(const TriMesh& from, const TriMesh& to) {
  const SurfaceDistance distance(to);
  double largest = 0;
  for (std::size_t t = 0; t < from.triangles.size(); ++t) {
    const Vec3 middle = (from.corner(t, 0) + from.corner(t, 1) + from.corner(t, 2)) / 3;
    largest = std::max(largest, distance(middle));
    for (int k = 0; k < 3; ++k) largest = std::max(largest, distance(from.corner(t, k)));
  }
  return largest;
}

TEST(Contour, IsWhereFlyingEdgesAre) {
  VoxelBox box{{60, 60, 50}, {}};
  for (int k = 0; k < 50; ++k) {
    for (int j = 0; j < 60; ++j) {
      for (int i = 0; i < 60; ++i) {
        const Vec3 p = Vec3(i - 29.7, j - 29.2, k - 25.1) / 20;
        const double bumps = 0.15 * std::sin(7 * p.x()) * std::cos(6 * p.y() + 5 * p.z());
        box.inside.push_back(p.norm() < 0.9 + bumps && p.head<2>().norm() > 0.3 ? 1 : 0);
      }
    }
  }
  const SampledField field = smoothed_field(box, {{1, 1, 1}, {62, 62, 52}}, 0.65);
  const TriMesh ours = contour_of(field)->mesh, theirs = flying_edges(field);
  ASSERT_GT(theirs.triangles.size(), 10'000u);
  // The same vertices, but for those that we add within cells.
  EXPECT_GE(ours.vertices.size(), theirs.vertices.size());
  EXPECT_LT(ours.vertices.size(), theirs.vertices.size() + theirs.vertices.size() / 1000);
  // A vertex of ours is moved by less than the margin, theirs are in single precision; within a cell diagonals differ.
  const SurfaceDistance distance(ours);
  double at_vertices = 0;
  for (std::size_t v = 0; v < theirs.vertices.size(); ++v)
    at_vertices = std::max(at_vertices, distance(theirs.vertices[v]));
  EXPECT_LT(at_vertices, contour_margin + 1e-5);
  const double largest = std::max(largest_distance(ours, theirs), largest_distance(theirs, ours));
  // The middles of a quadrilateral's two diagonals are at most so far apart.
  EXPECT_LT(largest, 0.5);
}

}  // namespace
}  // namespace condyle::mesh
