// SPDX-License-Identifier: Apache-2.0
// The topic ros_discovery_info: announces the nodes of this participant to others, and receives the nodes of others.
//
// Its publisher and subscription have no rcl counterpart. A thread of its own takes the messages that arrive. Each
// wake-up for a message ends with one take that finds nothing. The thread also announces the participant again to
// participants that may have missed it.
#pragma once

#include <thread>

#include "graph/graph_cache.hpp"
#include "participant/participant.hpp"
#include "rmw/rmw.h"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

class GraphChannel {
 public:
  // The thread updates `graph`. Throws std::runtime_error.
  GraphChannel(rmw_context_t& context, Participant& participant, GraphCache& graph);
  ~GraphChannel();
  GraphChannel(const GraphChannel&) = delete;
  GraphChannel& operator=(const GraphChannel&) = delete;

  // Late joiners get the last announcement. Throws std::runtime_error.
  void announce(const GraphCache::EntitiesInfo& info);

 private:
  void listen();

  Participant& participant_;
  GraphCache& graph_;
  rmw_publisher_t* publisher_ = nullptr;
  rmw_subscription_t* subscription_ = nullptr;
  rmw_wait_set_t* wait_set_ = nullptr;
  rmw_guard_condition_t* stop_ = nullptr;
  std::thread thread_;
};

}  // namespace rmw_fastrtps
