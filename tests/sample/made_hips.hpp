#pragma once

#include "condyle/sample/hip.hpp"

namespace condyle::test {

/// The sample hip of these parameters, made once per process and shared by its tests.
const sample::SampleHip& made_hip(sample::Scenario scenario, const sample::HipParameters& parameters = {});

}  // namespace condyle::test
