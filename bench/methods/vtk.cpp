#include <vtkCellArray.h>
#include <vtkCollisionDetectionFilter.h>
#include <vtkIdTypeArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include "kinds.hpp"

namespace bench {
namespace {

using condyle::Index;
using condyle::Pose;
using condyle::TriMesh;
using condyle::Vec3;

void set_points(vtkPolyData& surface, condyle::PointsView vertices) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i)
    points->SetPoint(static_cast<vtkIdType>(i), vertices.x[i], vertices.y[i], vertices.z[i]);
  surface.SetPoints(points);
}

vtkSmartPointer<vtkPolyData> surface_of(const TriMesh& mesh) {
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : mesh.triangles) triangles->InsertNextCell({t[0], t[1], t[2]});
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  set_points(*surface, mesh.vertices);
  surface->SetPolys(triangles);
  return surface;
}

/// vtkImplicitPolyDataDistance of VTK 9.1: distance to the nearest point of the surface, its sign from the
/// angle-weighted normal there (Baerentzen and Aanaes 2005), found through a grid of cells.
///
/// Queried for each vertex that lies in the surface's bounding box: all others are outside. It does not report
/// which triangle, and cannot be asked by two threads at once.
class VtkDistance final : public Method {
 public:
  explicit VtkDistance(const Bodies& bodies) : mobile_(&bodies.mobile), surface_(surface_of(bodies.fixed)) {
    distance_->SetInput(surface_);
    const double* bounds = surface_->GetBounds();
    box_ = {Vec3(bounds[0], bounds[2], bounds[4]), Vec3(bounds[1], bounds[3], bounds[5])};
  }

  void find_inside(const Pose& X_FM, std::vector<InsideVertex>& out) override {
    out.clear();
    for (std::size_t v = 0; v < mobile_->vertices.size(); ++v) {
      Vec3 p = condyle::posed(X_FM, mobile_->vertices[v]);
      if (!box_.contains(p)) continue;
      ++asked_;
      const double gap = distance_->EvaluateFunction(p.data());
      if (gap <= 0) out.push_back({static_cast<Index>(v), condyle::no_index, -gap});
    }
  }

  Work work() const override { return {{"vertices in the box", asked_}}; }

 private:
  const TriMesh* mobile_;
  vtkSmartPointer<vtkPolyData> surface_;
  vtkNew<vtkImplicitPolyDataDistance> distance_;
  Eigen::AlignedBox3d box_;
  std::int64_t asked_ = 0;
};

/// vtkCollisionDetectionFilter of VTK 9.1: two trees of oriented boxes, two triangles in a leaf, its default.
/// Triangles meet by where the edges of one pierce the other, in floating point; coplanar ones do not.
///
/// One point for each pair is asked for (half contacts), the fewest that report all pairs.
class VtkFilter final : public Method {
 public:
  explicit VtkFilter(const Bodies& bodies) {
    filter_->SetInputData(0, surface_of(bodies.fixed));
    filter_->SetInputData(1, surface_of(bodies.mobile));
    filter_->SetMatrix(0, vtkNew<vtkMatrix4x4>());
    filter_->SetMatrix(1, X_FM_);
    // The first detection builds the trees; it then sets their tolerance, upon which the second builds them
    // again.
    detect(Pose::Identity());
    filter_->Modified();
    detect(Pose::Identity());
    box_tests_ = 0;
  }

  bool touch(const Pose& X_FM) override {
    filter_->SetCollisionModeToFirstContact();
    detect(X_FM);
    return filter_->GetNumberOfContacts() > 0;
  }

  void find_pairs(const Pose& X_FM, std::vector<condyle::contact::TrianglePair>& out) override {
    filter_->SetCollisionModeToHalfContacts();
    detect(X_FM);
    out.clear();
    const auto &fixed = *filter_->GetContactCells(0), &mobile = *filter_->GetContactCells(1);
    for (vtkIdType i = 0; i < fixed.GetNumberOfValues(); ++i)
      out.push_back({static_cast<Index>(fixed.GetValue(i)), static_cast<Index>(mobile.GetValue(i))});
  }

  Work work() const override { return {{"box tests", box_tests_}}; }

 private:
  void detect(const Pose& X_FM) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) X_FM_->SetElement(i, j, X_FM.matrix()(i, j));
    X_FM_->Modified();
    filter_->Update();
    box_tests_ += filter_->GetNumberOfBoxTests();
  }

  vtkNew<vtkMatrix4x4> X_FM_;
  vtkNew<vtkCollisionDetectionFilter> filter_;
  std::int64_t box_tests_ = 0;
};

}  // namespace

std::vector<MethodKind> vtk_kinds() {
  return {{"vtk_distance",
           "what people use today",
           "VTK, implicit distance",
           {.inside = true},
           DepthKind::nearest_surface,
           false,
           [](const Bodies& bodies) { return std::make_unique<VtkDistance>(bodies); }},
          {"vtk_collision",
           "what people use today",
           "VTK, collision detection filter",
           {.touch = true, .pairs = true},
           DepthKind::none,
           false,
           [](const Bodies& bodies) { return std::make_unique<VtkFilter>(bodies); }}};
}

}  // namespace bench
