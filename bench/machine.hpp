#pragma once

#include <string>
#include <utility>
#include <vector>

namespace bench {

/// Context of a run, as names and texts: processor, compiler, commit, date. Without the load.
std::vector<std::pair<std::string, std::string>> describe_machine();

/// Runnable threads of the whole machine, averaged over the last minute; this program's count too.
double load_average();

}  // namespace bench
