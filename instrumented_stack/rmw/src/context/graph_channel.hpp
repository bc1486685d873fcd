// SPDX-License-Identifier: Apache-2.0
// The topic ros_discovery_info: tells other participants of the nodes of this one, and listens to theirs.
//
// Its publisher and subscription have no rcl counterpart. A thread of its own takes what arrives; it ends each wake-up
// for a message with one take that finds nothing. It also announces the participant again to those who may have missed
// it.
#pragma once

#include <thread>

#include "graph/graph_cache.hpp"
#include "participant/participant.hpp"
#include "rmw/rmw.h"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

class GraphChannel {
 public:
  // `graph` is updated from the thread. Throws std::runtime_error.
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
