// SPDX-License-Identifier: Apache-2.0
// Messages on a topic that a test expects.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "launcher/process/event_loop.hpp"

namespace launch {

// What has been seen so far.
struct SeenMessages {
  std::uint64_t all = 0;
  std::uint64_t matching = 0;  // of which the condition holds
  std::int64_t first_ns = 0;   // when the first and the last matching one have come, since the epoch
  std::int64_t last_ns = 0;
  std::vector<std::string> last = {};   // the newest ones, on a line each
  std::uint64_t publishers = 0;         // that there are now, or were at last
  std::vector<std::string> types = {};  // of their messages
};

class MessageWatch {
 public:
  // `failure` is the reason why no more is seen. Otherwise `seen` is all that there was so far.
  using Report = std::function<void(const std::optional<std::string>& failure, const SeenMessages& seen)>;

  // Ends the watch: `report` is not called after this.
  virtual ~MessageWatch() = default;

  // Begins to watch. Called once, on the loop's thread; must not block. `report` is called whenever something has
  // changed, on the loop's thread, later than this call.
  virtual void watch(EventLoop& loop, Report report) = 0;

  virtual const std::string& topic() const = 0;
  virtual const std::string& type() const = 0;
  virtual const std::string& condition() const = 0;  // empty: none
};

}  // namespace launch
