// SPDX-License-Identifier: Apache-2.0
// Checks the requests of on_shutdown handlers: only some of them can still be carried out.
#pragma once

#include "launcher/visit/requests.hpp"

namespace launch {

// Throws LaunchError for a trace, which could not begin any more, for requests to the services of nodes, and for
// processes that wait for others. `may_ask_nodes`: requests to the services of nodes are no error, they are left out.
void check_farewell(const Requests& requests, bool may_ask_nodes);

}  // namespace launch
