#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <new>
#include <variant>

#include "condyle/io/picture.hpp"
#include "io/file/output_file.hpp"
#include "io/mesh/vtk_silence.hpp"
#include "io/result/provenance_forms.hpp"

namespace condyle {
namespace {

std::string png_bytes(const Picture& picture, const Provenance* from) {
  const io::VtkSilence silence;
  vtkNew<vtkImageData> image;
  image->SetDimensions(static_cast<int>(picture.width), static_cast<int>(picture.height), 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  // VTK's rows begin at the bottom.
  const std::size_t row = 3 * picture.width;
  auto* bytes = static_cast<std::uint8_t*>(image->GetScalarPointer());
  for (std::size_t y = 0; y < picture.height; ++y)
    std::copy_n(picture.rgb.data() + (picture.height - 1 - y) * row, row, bytes + y * row);
  vtkNew<vtkPNGWriter> writer;
  for (const VtpField& field : io::provenance_fields(from))
    if (const auto* text = std::get_if<std::string>(&field.value))
      writer->AddText(field.name.c_str(), text->c_str());
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  if (writer->GetErrorCode() != 0 || writer->GetResult() == nullptr) throw std::bad_alloc();
  const vtkUnsignedCharArray& result = *writer->GetResult();
  return {reinterpret_cast<const char*>(const_cast<vtkUnsignedCharArray&>(result).GetPointer(0)),
          static_cast<std::size_t>(result.GetNumberOfValues())};
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture, const Provenance* from) {
  io::check_output_file(path, io::files_read(from));
  io::write_output_file(path, png_bytes(picture, from));
}

}  // namespace condyle
