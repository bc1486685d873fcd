// SPDX-License-Identifier: Apache-2.0
// A trace as one HTML page that needs nothing else: no server, no network.
#pragma once

#include <string>

#include "tracing/model/timeline/traced_system.hpp"

namespace tracing {

std::string html_page(const TracedSystem& system);

}  // namespace tracing
