#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/error.hpp"
#include "support/complaint.hpp"
#include "support/shared_data.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_meshes.hpp"

/// What every test may use, beside what it is about: the standard library, meshes, refusals, real joints and folders of its own.

/// Names what was found of the real joints, or ends the test.
#define FOUND_OR_SKIP(name, found) \
  const auto name = found;         \
  if (!name) GTEST_SKIP() << "no shared data: set CONDYLE_DATA"
