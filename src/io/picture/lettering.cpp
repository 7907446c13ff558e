#include "io/picture/lettering.hpp"

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkVectorText.h>

namespace condyle::io {

TriMesh lettering(const std::string& text) {
  vtkNew<vtkVectorText> letters;
  letters->SetText(text.c_str());
  letters->Update();
  vtkPolyData& outline = *letters->GetOutput();
  TriMesh mesh;
  for (vtkIdType i = 0; i < outline.GetNumberOfPoints(); ++i) {
    double point[3];
    outline.GetPoint(i, point);
    mesh.vertices.push_back({point[0], point[1], 0});
  }
  vtkCellArray& cells = *outline.GetPolys();
  vtkIdType corners = 0;
  const vtkIdType* corner = nullptr;
  for (cells.InitTraversal(); cells.GetNextCell(corners, corner);)
    for (vtkIdType k = 2; k < corners; ++k)
      mesh.triangles.push_back(
          {static_cast<Index>(corner[0]), static_cast<Index>(corner[k - 1]), static_cast<Index>(corner[k])});
  return mesh;
}

}  // namespace condyle::io
