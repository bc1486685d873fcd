// SPDX-License-Identifier: Apache-2.0
// A loss account for people.
#pragma once

#include <string>

#include "tracing/account/loss_account.hpp"

namespace tracing {

// One line per channel with losses ("12 events lost in ust channel ros2"), or "no events lost".
std::string describe_losses(const LossAccount& losses);

// What tracing has cost the processes, estimated, as one line: all of them and the one that it has cost most. "" where
// the cost of an event isn't known, or no event was counted.
std::string describe_cost(const LossAccount& losses);

}  // namespace tracing
