#pragma once

#include "experiment.hpp"
#include "table.hpp"

namespace bench {

/// All outcomes as one long table, `experiment`, for scripts; and for people, per group of scenes: cost per
/// question (`touch_GROUP`, `pairs_GROUP`, `inside_GROUP`, `deformed_GROUP`), agreement (`accuracy_GROUP`),
/// and what it takes to be ready (`ready_GROUP`, `memory_GROUP`); and of Condyle's fastest way what it looks
/// at
/// (`inside_work`) and how its cost is spread (`inside_spread`). Groups and questions without outcomes have
/// no table.
void add_tables(const ExperimentResult& result, Report& report);

}  // namespace bench
