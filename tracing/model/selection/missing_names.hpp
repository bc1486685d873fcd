// SPDX-License-Identifier: Apache-2.0
// What is said of a name or pattern that fits nothing in a trace.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tracing {

// "no node is called '/pnig'; what was read has /ping, /pong; did you mean '/ping'?" `kind` is the word for one of the
// names, which are sorted. Of many names, the first are told.
std::string nothing_is_called(std::string_view kind, const std::vector<std::string>& patterns,
                              const std::vector<std::string>& names);

}  // namespace tracing
