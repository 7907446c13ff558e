#pragma once

#include <vtkObject.h>

namespace condyle::io {

/// VTK prints its warnings unless they are switched off. Declared before VTK's objects, it outlives them.
class VtkSilence {
 public:
  VtkSilence() : before_(vtkObject::GetGlobalWarningDisplay()) { vtkObject::SetGlobalWarningDisplay(0); }
  ~VtkSilence() { vtkObject::SetGlobalWarningDisplay(before_); }
  VtkSilence(const VtkSilence&) = delete;
  VtkSilence& operator=(const VtkSilence&) = delete;

 private:
  int before_;
};

}  // namespace condyle::io
