// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "actions/trace/event_rules.hpp"
#include "actions/trace/trace_settings.hpp"

namespace launch {

namespace {

using Channel = tracing::ChannelConfig;
using Type = AttributeType;

std::vector<Setting<Channel>> make_channel_settings() {
  const auto own = [](const char* name, Type type, const char* help) {
    return AttributeSpec{name, type, false, "as the domain's own channel", help};
  };
  return {
      {.attribute = {"name", Type::kText, true, "", "its name"}, .place = place_of(&Channel::name)},
      {.attribute = {"events-ust", Type::kWords, false, "none", "userspace events"},
       .perform = event_rules<Channel>("events-ust", Tracepoints::kUserspace, place_of(&Channel::events_ust))},
      {.attribute = {"events-kernel", Type::kWords, false, "none", "kernel tracepoints"},
       .perform = event_rules<Channel>("events-kernel", Tracepoints::kKernel, place_of(&Channel::events_kernel))},
      {.attribute = {"syscalls", Type::kWords, false, "none", "system calls"}, .place = place_of(&Channel::syscalls)},
      {.attribute = {"context-fields", Type::kWords, false, "those of the trace", ""},
       .perform = [](const Fields& fields, Scope& scope,
                     Channel& channel) { channel.context_fields = perform_names(fields, "context-fields", scope); }},
      {.attribute = own("subbuffer-size", Type::kInteger, "bytes"), .place = place_of(&Channel::subbuffer_size)},
      {.attribute = own("subbuffer-count", Type::kInteger, "sub-buffers for each processor"),
       .place = place_of(&Channel::subbuffer_count)},
      {.attribute = own("read-timer", Type::kInteger, "microseconds between two reads of the buffers"),
       .place = place_of(&Channel::read_timer)},
      {.attribute =
           own("switch-timer", Type::kInteger, "microseconds until a part-full sub-buffer is written; 0: never"),
       .place = place_of(&Channel::switch_timer)},
      {.attribute = own("overwrite", Type::kBoolean, "lose the oldest events, not the newest"),
       .place = place_of(&Channel::overwrite)},
      {.attribute = {"blocking-timeout", Type::kInteger, false, "0",
                     "microseconds that a traced thread waits for room; -1: for ever"},
       .place = place_of(&Channel::blocking_timeout)},
  };
}

}  // namespace

const std::vector<Setting<Channel>>& channel_settings() {
  static const std::vector<Setting<Channel>> settings = make_channel_settings();
  return settings;
}

}  // namespace launch
