#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNIFTIImageReader.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include "condyle/io/label_file.hpp"
#include "io/image/label_files.hpp"
#include "support/test.hpp"

namespace condyle {
namespace {

/// Holds that VTK, which puts slices of left-handed files the other way round, sees each label in the same place.
void expect_same_as_vtk(const test::LabelImage& image, const test::NiftiWriting& how) {
  const test::TemporaryFolder folder;
  const auto path = folder.file("bones.nii", test::nifti(image, how));
  const auto map = io::read_labels(path);
  const auto inverse = map.grid.X_WI.inverse();

  vtkNew<vtkNIFTIImageReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkImageData* seen = reader->GetOutput();
  vtkMatrix4x4* matrix = how.sform ? reader->GetSFormMatrix() : reader->GetQFormMatrix();
  ASSERT_NE(matrix, nullptr);
  vtkDataArray* values = seen->GetPointData()->GetScalars();
  ASSERT_EQ(values->GetNumberOfTuples(), static_cast<vtkIdType>(map.layers[0].size()));
  for (vtkIdType point = 0; point < values->GetNumberOfTuples(); ++point) {
    const double* p = seen->GetPoint(point);
    Eigen::Vector3d p_W;
    for (int row = 0; row < 3; ++row) {
      p_W[row] = matrix->GetElement(row, 3);
      for (int column = 0; column < 3; ++column) p_W[row] += matrix->GetElement(row, column) * p[column];
    }
    p_W.head<2>() *= -1;  // from RAS
    const Eigen::Vector3d voxel = inverse * p_W;
    // NIfTI-1 keeps floats, and so does this reader on the way: 2^-24 of 800 mm, a few times.
    const Eigen::Vector3d whole = voxel.array().round();
    ASSERT_LE((voxel - whole).norm(), 1e-3) << "point " << point;
    ASSERT_TRUE((whole.array() >= 0).all()) << "point " << point;
    const auto at = static_cast<std::size_t>(
        whole.x() +
        static_cast<double>(image.size[0]) * (whole.y() + static_cast<double>(image.size[1]) * whole.z()));
    ASSERT_LT(at, map.layers[0].size());
    EXPECT_EQ(static_cast<double>(map.labels[map.layers[0][at]]), values->GetTuple1(point))
        << "point " << point;
  }
}

TEST(NiftiBesideVtk, PlacesEachLabelWhereVtkDoes) {
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.35, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const double third : {2.5, -2.5})
    for (const bool by_sform : {true, false})
      for (const int version : {1, 2}) {
        SCOPED_TRACE(testing::Message()
                     << "sform " << by_sform << ", third axis " << third << ", version " << version);
        Eigen::Affine3d X = Eigen::Affine3d::Identity();
        X.linear() = turned * Eigen::Vector3d(0.75, 0.8125, third).asDiagonal();
        X.translation() << -120.5, 33.25, -800.125;
        expect_same_as_vtk(test::label_image(X), {.version = version, .sform = by_sform, .qform = !by_sform});
      }
}

}  // namespace
}  // namespace condyle
