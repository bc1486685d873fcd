// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/recorded_events.hpp"

#include <fmt/core.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_list.hpp"
#include "tracing/record/plan/channel_plan.hpp"

namespace tracing {
namespace {

std::vector<std::string> exclusions_of(lttng_event& rule) {
  std::vector<std::string> names;
  const int count = lttng_event_get_exclusion_name_count(&rule);
  for (int i = 0; i < count; ++i) {
    const char* name = nullptr;
    if (lttng_event_get_exclusion_name(&rule, static_cast<std::size_t>(i), &name) == 0) {
      names.emplace_back(name);
    }
  }
  return names;
}

}  // namespace

bool RecordedEvents::Rule::takes(const std::string& event) const {
  const auto matches = [&event](const std::string& name) { return fnmatch(name.c_str(), event.c_str(), 0) == 0; };
  // Exclusions are given without a provider. LTTng applies them to the provider of the pattern.
  const std::string provider = event.substr(0, event.find(':') + 1);
  return matches(pattern) && std::none_of(exclusions.begin(), exclusions.end(), [&](const std::string& name) {
           return matches(name) || matches(provider + name);
         });
}

std::size_t RecordedEvents::times(const std::string& event) const {
  std::set<std::string> channels;
  for (const Rule& rule : rules) {
    if (rule.takes(event)) {
      channels.insert(rule.channel);
    }
  }
  return channels.size();
}

bool RecordedEvents::countable(const std::string& event) const {
  bool taken = false;
  for (const Rule& rule : rules) {
    if (!rule.takes(event)) {
      continue;
    }
    if (rule.conditional) {
      return false;
    }
    taken = true;
  }
  return taken;
}

bool is_our_own(const std::string& event) {
  constexpr std::array kProviders = {"launch:", "launch_probe:", "ros2_deadline:", "ros2_session:"};
  return std::any_of(kProviders.begin(), kProviders.end(),
                     [&event](const char* provider) { return event.starts_with(provider); });
}

bool is_counted(const std::string& event) {
  return event.starts_with("ros2:") || event.starts_with("ros2_ext:");
}

RecordedEvents read_recorded_events(const std::string& lttng_session_name) {
  RecordedEvents recorded;
  const DomainHandle handle = domain_handle(lttng_session_name, LTTNG_DOMAIN_UST);
  const std::string doing = fmt::format("list the events of session '{}'", lttng_session_name);
  for (const lttng_channel& channel : LttngList<lttng_channel>(doing, lttng_list_channels, handle.get())) {
    if (std::string_view(channel.name) == kPythonChannel) {
      recorded.python = true;
      continue;
    }
    for (lttng_event& rule : LttngList<lttng_event>(doing, lttng_list_events, handle.get(), channel.name)) {
      recorded.rules.push_back({.channel = channel.name,
                                .pattern = rule.name,
                                .exclusions = exclusions_of(rule),
                                .conditional = rule.filter != 0 || rule.loglevel_type != LTTNG_EVENT_LOGLEVEL_ALL});
    }
  }
  return recorded;
}

}  // namespace tracing
