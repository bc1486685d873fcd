// SPDX-License-Identifier: Apache-2.0
// Watches conditions: for each of them it tells once whether it holds, or that it can't hold any more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/visit/dependency.hpp"
#include "launcher/visit/process_table.hpp"

namespace launch {

class DependencyWatches {
 public:
  // Called once. Nullopt: the condition holds; else the reason why it can't hold any more, or that its time is over.
  // Must not end a watch.
  using Decided = std::function<void(const std::optional<std::string>& failure)>;
  // A watch of one condition. It ends with the last pointer to it.
  class Watch;
  using WatchPtr = std::shared_ptr<Watch>;

  // The loop must outlive this object.
  explicit DependencyWatches(EventLoop& loop) : loop_(loop) {}

  // `decided` may be called before this returns. The dependency must be resolved, and outlive the watch, as this object
  // must.
  WatchPtr begin(const Dependency& dependency, Decided decided);

  // To be called when the table has noted an event of the process.
  void on_process_event(const TrackedProcess& process);
  void on_line(const TrackedProcess& process, OutputStream stream, std::string_view line);

  // Whether some condition is about lines.
  bool watch_output() const { return lines_watched_ > 0; }

 private:
  EventLoop& loop_;
  std::unordered_map<const TrackedProcess*, std::vector<Watch*>> by_target_;
  std::size_t lines_watched_ = 0;
};

}  // namespace launch
