#include "io/mesh/uncompress.hpp"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkZLibDataCompressor.h>

namespace condyle::io {

/// VTK's compressors check their output's size, and they print unless somebody listens.
bool uncompress(Compressor compressor, const std::string& block, std::span<char> out) {
  vtkSmartPointer<vtkDataCompressor> codec;
  if (compressor == Compressor::zlib) {
    codec = vtkSmartPointer<vtkZLibDataCompressor>::New();
  } else {
    codec = vtkSmartPointer<vtkLZ4DataCompressor>::New();
  }
  vtkNew<vtkCallbackCommand> silence;
  silence->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  codec->AddObserver(vtkCommand::ErrorEvent, silence);
  codec->AddObserver(vtkCommand::WarningEvent, silence);
  return codec->Uncompress(reinterpret_cast<const unsigned char*>(block.data()), block.size(),
                           reinterpret_cast<unsigned char*>(out.data()), out.size()) == out.size();
}

}  // namespace condyle::io
