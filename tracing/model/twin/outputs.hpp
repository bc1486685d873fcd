// SPDX-License-Identifier: Apache-2.0
// What each callback sends in which of its runs, from the publications and requests in a recording.
#pragma once

#include <map>
#include <vector>

#include "tracing/model/twin/description/twin_system.hpp"
#include "tracing/model/twin/recording.hpp"

namespace tracing::twin {

// Something that was sent, and from where.
struct Sending {
  std::int64_t called_ns = 0;
  std::int64_t sent_ns = 0;
  timeline::Index instance = timeline::kNone;  // kNone: outside of callbacks
};

// The sendings of each publisher (an index of the timeline), without those that stand there again for another
// subscription.
std::map<timeline::Index, std::vector<Sending>> publications_of(const Recording& recording);
// The requests of each client.
std::map<timeline::Index, std::vector<Sending>> requests_of(const Recording& recording);

// The output of each callback that has sent some of these (callbacks and inputs as in the timeline). Publisher and
// client are not set.
std::map<timeline::Index, Output> outputs_of(const Recording& recording, const std::vector<Sending>& sendings);

}  // namespace tracing::twin
