// SPDX-License-Identifier: Apache-2.0
// Rows of durations, as the sections of details have them.
#pragma once

#include <string>
#include <vector>

#include "tracing/model/analysis/results.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

// The columns of durations after a label: first their titles, then the cells of one row.
TextTable duration_table();
const std::vector<std::string>& duration_titles();
std::vector<std::string> duration_cells(const DurationSummary& took);

// "/ping, ping [71]"
std::string node_label(const std::string& node, ProcessIndex process, const TraceOverview& overview);

}  // namespace tracing
