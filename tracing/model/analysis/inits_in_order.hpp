// SPDX-License-Identifier: Apache-2.0
// Initialisation events of CARET, in the order in which they happened.
//
// They are kept until their process does something else: CARET records nothing else of a process before it has recorded
// all that the process has made so far.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tracing/decode/reader/caret_events.hpp"
#include "tracing/model/objects/objects.hpp"

namespace tracing {

class InitsInOrder {
 public:
  struct Kept {
    std::int64_t init_ns = 0;
    Origin origin;
    ros2::KnownCaretEvent event;
  };

  bool empty() const { return kept_.empty(); }
  void keep(const Origin& origin, std::int64_t init_ns, const ros2::KnownCaretEvent& event);
  // Calls tell(kept) for the events of the process, each once.
  template <class Tell>
  void release(ProcessId process, Tell tell) {
    if (const auto found = kept_.find(process); found != kept_.end()) {
      for (const Kept& kept : in_order(found->second)) {
        tell(kept);
      }
      kept_.erase(found);
    }
  }
  template <class Tell>
  void release_all(Tell tell) {
    while (!kept_.empty()) {
      release(kept_.begin()->first, tell);
    }
  }

 private:
  struct OfProcess {
    std::vector<Kept> events;
    std::deque<std::string> texts;  // of the events
  };
  static const std::vector<Kept>& in_order(OfProcess& of);

  std::map<ProcessId, OfProcess> kept_;
};

}  // namespace tracing
