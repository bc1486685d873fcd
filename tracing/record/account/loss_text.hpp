// SPDX-License-Identifier: Apache-2.0
// A loss account for people.
#pragma once

#include <string>
#include <vector>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {

// One line per channel with losses ("12 events lost in ust channel ros2"), or "no events lost".
std::string describe_losses(const LossAccount& losses);

// What the packets of a snapshot say, by processor: "12 events lost, processor 1 (channel ros2)". "" if they have lost
// nothing.
std::string describe_snapshot_losses(const std::vector<Stream>& streams);

// "complete", "incomplete", or "complete but for what was asked to be dropped".
std::string describe_completeness(const LossAccount& losses);

// As one line: the estimated cost of tracing for all processes together, and for the process that it has cost most. ""
// if the cost of an event is unknown or no event was counted.
std::string describe_cost(const LossAccount& losses);

}  // namespace tracing
