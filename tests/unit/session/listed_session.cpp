// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/session/listed_session.hpp"

#include <lttng/lttng.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace trace_test {

namespace {

template <typename T>
using Listed = std::unique_ptr<T, decltype(&std::free)>;

int check(int result) {
  if (result < 0) {
    throw std::runtime_error(lttng_strerror(result));
  }
  return result;
}

ListedEvent describe(lttng_event& event) {
  ListedEvent described{.name = event.name, .filter = {}, .level = {}};
  const char* filter = nullptr;
  check(lttng_event_get_filter_expression(&event, &filter));
  if (filter != nullptr) {
    described.filter = filter;
  }
  if (event.loglevel_type == LTTNG_EVENT_LOGLEVEL_RANGE) {
    described.level = ">= " + std::to_string(event.loglevel);
  }
  if (event.loglevel_type == LTTNG_EVENT_LOGLEVEL_SINGLE) {
    described.level = "== " + std::to_string(event.loglevel);
  }
  return described;
}

ListedChannel describe(lttng_handle* handle, lttng_channel& channel) {
  ListedChannel described{.name = channel.name,
                          .overwrite = channel.attr.overwrite == 1,
                          .subbuffer_size = channel.attr.subbuf_size,
                          .subbuffer_count = channel.attr.num_subbuf,
                          .switch_timer = channel.attr.switch_timer_interval,
                          .read_timer = channel.attr.read_timer_interval,
                          .tracefile_size = channel.attr.tracefile_size,
                          .tracefile_count = channel.attr.tracefile_count,
                          .mmap = channel.attr.output == LTTNG_EVENT_MMAP,
                          .events = {}};
  check(lttng_channel_get_blocking_timeout(&channel, &described.blocking_timeout));
  lttng_event* events = nullptr;
  const int count = check(lttng_list_events(handle, channel.name, &events));
  const Listed<lttng_event> owner(events, &std::free);
  for (int i = 0; i < count; ++i) {
    described.events.push_back(describe(events[i]));
  }
  std::sort(described.events.begin(), described.events.end(),
            [](const ListedEvent& a, const ListedEvent& b) { return a.name < b.name; });
  return described;
}

}  // namespace

std::vector<std::string> ListedChannel::event_names() const {
  std::vector<std::string> names;
  for (const ListedEvent& event : events) {
    names.push_back(event.name);
  }
  return names;
}

const ListedChannel& ListedSession::channel(const std::string& name) const {
  const auto found = std::find_if(channels.begin(), channels.end(),
                                  [&](const ListedChannel& channel) { return channel.name == name; });
  if (found == channels.end()) {
    throw std::runtime_error("no channel " + name);
  }
  return *found;
}

ListedSession list_session(const std::string& name) {
  ListedSession session;
  lttng_session* sessions = nullptr;
  const int session_count = check(lttng_list_sessions(&sessions));
  const Listed<lttng_session> session_owner(sessions, &std::free);
  for (int i = 0; i < session_count; ++i) {
    if (sessions[i].name != name) {
      continue;
    }
    session.exists = true;
    session.path = sessions[i].path;
    session.active = sessions[i].enabled != 0;
    session.snapshot = sessions[i].snapshot_mode != 0;
    session.live_timer = sessions[i].live_timer_interval;
  }
  if (!session.exists) {
    return session;
  }

  lttng_domain* domains = nullptr;
  const int domain_count = check(lttng_list_domains(name.c_str(), &domains));
  const Listed<lttng_domain> domain_owner(domains, &std::free);
  for (int i = 0; i < domain_count; ++i) {
    if (domains[i].type != LTTNG_DOMAIN_UST) {
      continue;
    }
    session.buffers_per_process = domains[i].buf_type == LTTNG_BUFFER_PER_PID;
    const std::unique_ptr<lttng_handle, decltype(&lttng_destroy_handle)> handle(
        lttng_create_handle(name.c_str(), &domains[i]), &lttng_destroy_handle);
    lttng_channel* channels = nullptr;
    const int count = check(lttng_list_channels(handle.get(), &channels));
    const Listed<lttng_channel> owner(channels, &std::free);
    for (int c = 0; c < count; ++c) {
      session.channels.push_back(describe(handle.get(), channels[c]));
    }
  }
  std::sort(session.channels.begin(), session.channels.end(),
            [](const ListedChannel& a, const ListedChannel& b) { return a.name < b.name; });
  return session;
}

}  // namespace trace_test
