// SPDX-License-Identifier: Apache-2.0
// What on_shutdown handlers may ask for: no more than can still be carried out.
#pragma once

#include "launcher/visit/requests.hpp"

namespace launch {

// Throws LaunchError for a trace, which could not begin any more, for what needs services of nodes, and for processes
// that wait for others.
void check_farewell(const Requests& requests);

}  // namespace launch
