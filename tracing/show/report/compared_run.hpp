// SPDX-License-Identifier: Apache-2.0
// Reads a trace for a comparison, and for a page that shows it beside another one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/model/compare/run_summary.hpp"
#include "tracing/show/page/comparison_page.hpp"

namespace tracing {

// Reads traces as one run. Throws TraceReadError if they can't be read at all, and std::runtime_error if there is
// nothing to compare. `all`: also what is of processes that do not belong to the launch (launch_filter.hpp).
compare::RunSummary read_run(const std::vector<std::filesystem::path>& directories, bool all = false);

// Likewise, of one trace, with what the page holds of it. The page holds as much of two runs as of one.
struct PagedRun {
  compare::RunSummary summary;
  PageRun page;
};
PagedRun read_run_for_page(const std::filesystem::path& directory, const std::vector<ChainDefinition>& chains,
                           bool all = false);

}  // namespace tracing
