#pragma once

#include "condyle/sample/hip.hpp"

namespace condyle::test {

/// The sample hip of these parameters, made once per process and shared by its tests.
const SampleHip& made_hip(Scenario scenario, const HipParameters& parameters = {});

}  // namespace condyle::test
