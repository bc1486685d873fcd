// SPDX-License-Identifier: Apache-2.0
// The state behind rmw_context_t.
#pragma once

#include <memory>
#include <mutex>

#include "context/graph_channel.hpp"
#include "graph/graph_cache.hpp"
#include "graph/graph_changes.hpp"
#include "participant/participant.hpp"
#include "rmw/init.h"
#include "rmw/rmw.h"
#include "types/identifier.hpp"
#include "wait/waitable.hpp"

struct rmw_context_impl_s {
  explicit rmw_context_impl_s(rmw_context_t* context)
      : graph_guard_condition{rmw_fastrtps::kIdentifier, static_cast<rmw_fastrtps::Waitable*>(&graph_changed), context},
        graph([this] {
          graph_changed.trigger();
          graph_changes.add();
        }) {}

  // Serializes creation and destruction of nodes and endpoints, with their announcements.
  std::mutex mutex;
  rmw_fastrtps::GuardCondition graph_changed;
  rmw_guard_condition_t graph_guard_condition;
  rmw_fastrtps::GraphChanges graph_changes;
  rmw_fastrtps::GraphCache graph;
  // These exist while there are nodes.
  std::unique_ptr<rmw_fastrtps::Participant> participant;
  std::unique_ptr<rmw_fastrtps::GraphChannel> channel;
  std::size_t nodes = 0;
  bool shut_down = false;
};
