// SPDX-License-Identifier: Apache-2.0
// Names from a trace may hold anything. On a terminal a line break would break a table, and an escape could do more.
#pragma once

#include <string>
#include <string_view>

#include "tracing/model/analysis/results.hpp"

namespace tracing {

// The text with "?" for each control character and each byte that is no UTF-8.
std::string printable(std::string_view text);

// The results with all names printable.
TraceResults printable(TraceResults results);

}  // namespace tracing
