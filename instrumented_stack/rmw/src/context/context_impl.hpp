// SPDX-License-Identifier: Apache-2.0
// The state behind rmw_context_t.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>

#include "context/graph_channel.hpp"
#include "graph/graph_cache.hpp"
#include "participant/participant.hpp"
#include "rmw/init.h"
#include "rmw/rmw.h"
#include "types/identifier.hpp"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

// Counts the changes of the graph. Any number of threads can wait for a change.
class GraphChanges {
 public:
  void add() {
    {
      const std::lock_guard lock(mutex_);
      ++number_;
    }
    changed_.notify_all();
  }

  // Ends all waits, current and later ones.
  void end() {
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    changed_.notify_all();
  }

  // Waits until the number differs from `seen`, which then gets it, or until end(). Returns false when the time is
  // over; a negative timeout never ends.
  bool wait(std::uint64_t& seen, std::chrono::nanoseconds timeout) {
    std::unique_lock lock(mutex_);
    const auto is_over = [&] { return ended_ || number_ != seen; };
    bool over = true;
    if (timeout < std::chrono::nanoseconds::zero()) {
      changed_.wait(lock, is_over);
    } else {
      over = changed_.wait_for(lock, timeout, is_over);
    }
    seen = number_;
    return over;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t number_ = 0;
  bool ended_ = false;
};

}  // namespace rmw_fastrtps

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
