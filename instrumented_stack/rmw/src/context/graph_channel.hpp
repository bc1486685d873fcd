// SPDX-License-Identifier: Apache-2.0
// The topic ros_discovery_info: announces the nodes of this participant to others, and receives the nodes of others.
//
// Its publisher and subscription have no rcl counterpart. A thread of its own publishes, and takes the messages that
// arrive. Each wake-up for a message ends with one take that finds nothing. The thread also introduces the participant,
// and announces it again to participants that may have missed it.
//
// It reads the messages of Humble, too (graph/entities_layout.hpp). It writes as Humble does if $ROS_DISTRO says so,
// and as soon as it has heard a participant that does: Humble can't read anything else.
#pragma once

#include <mutex>
#include <optional>

#include "context/introduction.hpp"
#include "graph/entities_layout.hpp"
#include "graph/graph_cache.hpp"
#include "participant/participant.hpp"
#include "process/end_of_process.hpp"
#include "rcutils/joined_thread.hpp"
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

  // The thread publishes the last state that it has got. Late joiners get it, too.
  void announce(GraphCache::EntitiesInfo info);
  // Nothing more is published.
  void end();

 private:
  using Clock = std::chrono::steady_clock;

  void stop();
  void listen();
  // Empty if nothing is to be done at a certain time.
  std::optional<Clock::time_point> next_time() const;
  void introduce_if_due();
  void publish();
  void take();
  void write_as(GidLength length);

  Participant& participant_;
  GraphCache& graph_;
  rmw_publisher_t* publisher_ = nullptr;
  rmw_subscription_t* subscription_ = nullptr;
  rmw_wait_set_t* wait_set_ = nullptr;
  rmw_guard_condition_t* stop_ = nullptr;
  GuardCondition changed_;  // there is something to publish

  // Of the thread.
  std::optional<GraphCache::EntitiesInfo> published_;  // the last state
  GidLength gid_length_;

  mutable std::mutex mutex_;                  // of the rest
  std::optional<Introduction> introduction_;  // while the participant is not introduced
  std::optional<GraphCache::EntitiesInfo> unpublished_;
  bool ended_ = false;
  rcutils::JoinedThread thread_;
  std::optional<EndedWithProcess> ended_with_process_;
};

}  // namespace rmw_fastrtps
