// SPDX-License-Identifier: Apache-2.0
// The graph of nodes and topics in the language of Graphviz.
#pragma once

#include <string>

#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

std::string dot_text(const TracedSystem& system);

}  // namespace tracing
