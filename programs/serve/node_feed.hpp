// SPDX-License-Identifier: Apache-2.0
// What the nodes do, as server-sent events: https://html.spec.whatwg.org/multipage/server-sent-events.html
//
//   event: nodes    `lines`: tables of the last seconds, as `launch top` shows them, or why there are none: each second
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "programs/watch/node_watch.hpp"

namespace launch::serve {

// A recording of the nodes. May be used by several threads.
class NodeRecording {
 public:
  NodeRecording();
  std::vector<std::string> lines();

 private:
  std::mutex mutex_;
  NodeWatch watch_;
};

// One recording for all pages that look. It ends with the last of them.
class NodeRecordings {
 public:
  // Throws SpawnError.
  std::shared_ptr<NodeRecording> join();

 private:
  std::mutex mutex_;
  std::weak_ptr<NodeRecording> recording_;
};

// For use by one thread.
class NodeFeed {
 public:
  static constexpr std::chrono::milliseconds kPeriod{1000};

  // `stop` becomes readable when the feed is to end.
  NodeFeed(std::shared_ptr<NodeRecording> recording, int stop) : recording_(std::move(recording)), stop_(stop) {}

  // Waits for the next event, a second at most. Nothing: the feed has ended.
  std::optional<std::string> next();

 private:
  std::shared_ptr<NodeRecording> recording_;
  int stop_;
  bool first_ = true;
};

}  // namespace launch::serve
