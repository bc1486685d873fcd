// SPDX-License-Identifier: Apache-2.0
// A session in the listing of the session daemon, read with liblttng-ctl and without our code.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace trace_test {

struct ListedEvent {
  std::string name;
  std::string filter;
  std::string level;  // "", ">= N" or "== N"
};

struct ListedChannel {
  std::string name;
  bool overwrite = false;
  std::uint64_t subbuffer_size = 0;
  std::uint64_t subbuffer_count = 0;
  std::uint32_t switch_timer = 0;
  std::uint32_t read_timer = 0;
  std::int64_t blocking_timeout = 0;
  std::uint64_t tracefile_size = 0;
  std::uint64_t tracefile_count = 0;
  bool mmap = false;
  std::vector<ListedEvent> events;  // by name

  std::vector<std::string> event_names() const;
};

struct ListedSession {
  bool exists = false;
  std::string path;
  bool active = false;
  bool snapshot = false;
  std::uint32_t live_timer = 0;
  bool buffers_per_process = false;     // of userspace
  std::vector<ListedChannel> channels;  // of userspace, by name

  const ListedChannel& channel(const std::string& name) const;
};

// Throws std::runtime_error when the daemon refuses.
ListedSession list_session(const std::string& name);

}  // namespace trace_test
