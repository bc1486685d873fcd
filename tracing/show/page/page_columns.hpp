// SPDX-License-Identifier: Apache-2.0
// Instances, messages and states of threads as columns of numbers. script/data.js reads them in the same order.
#pragma once

#include <string>

#include "tracing/model/timeline/timeline.hpp"

namespace tracing {

// Compressed, as text.
std::string page_columns(const timeline::Timeline& timeline);

}  // namespace tracing
