// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/channel_plan.hpp"

#include <fmt/core.h>
#include <fnmatch.h>
#include <lttng/constant.h>
#include <lttng/event.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <set>
#include <string_view>

#include "tracing/record/plan/context_fields.hpp"
#include "tracing/record/plan/ros_events.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {

namespace {

constexpr const char* kUserspaceChannel = "ros2";
constexpr const char* kInitialisationChannel = "ros2_init";
constexpr const char* kAllRosEvents = "ros2:*";
constexpr const char* kLaunchEvents = "launch:*";
constexpr const char* kCutEvent = "launch:cut";
// Tells the processes that another session has the objects which lived before: the snapshot half (docs/tracetools.md).
constexpr const char* kNoStateDump = "ros2_session:no_state_dump";
constexpr const char* kKernelChannel = "kchan";
constexpr std::uint32_t kKernelReadTimer = 200;  // µs: the consumer polls, nobody has to wake it
constexpr std::uint64_t kFewestSubbuffers = 2;
constexpr std::uint64_t kMostSubbuffers = std::uint64_t{1} << 20;
constexpr std::uint64_t kLargestSubbuffer = std::uint64_t{1} << 40;
constexpr std::int64_t kWaitForEver = -1;

std::vector<std::string> without_repetitions(const std::vector<std::string>& names) {
  std::vector<std::string> unique;
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (seen.insert(name).second) {
      unique.push_back(name);
    }
  }
  return unique;
}

std::vector<EventRule> rules(const std::vector<std::string>& texts) {
  std::vector<EventRule> parsed;
  for (const std::string& text : without_repetitions(texts)) {
    for (EventRule& rule : expand_exclusions(parse_event_rule(text))) {
      parsed.push_back(std::move(rule));
    }
  }
  return parsed;
}

// LTTng refuses sizes that are no power of two or less than a page.
std::uint64_t usable_subbuffer_size(std::uint64_t given, lttng_domain_type domain, std::vector<std::string>& warnings) {
  if (given > kLargestSubbuffer) {
    throw TraceError(
        fmt::format("sub-buffer size of {} bytes for the {} domain is too large", given, domain_name(domain)));
  }
  const std::uint64_t usable = std::bit_ceil(std::max<std::uint64_t>(given, static_cast<std::uint64_t>(getpagesize())));
  if (usable != given) {
    warnings.push_back(
        fmt::format("sub-buffer size of {} bytes for the {} domain is rounded up to {}: LTTng needs a "
                    "power of two, at least a page",
                    given, domain_name(domain), usable));
  }
  return usable;
}

// A power of two, and two at least: one is written to while the other is read.
std::uint64_t usable_subbuffer_count(std::uint64_t given, std::vector<std::string>& warnings) {
  if (given > kMostSubbuffers) {
    throw TraceError(fmt::format("{} sub-buffers are too many: {} are possible", given, kMostSubbuffers));
  }
  const std::uint64_t usable = std::bit_ceil(std::max(given, kFewestSubbuffers));
  if (usable != given) {
    warnings.push_back(fmt::format(
        "number of sub-buffers {} is rounded up to {}: LTTng needs a power of two, at least 2", given, usable));
  }
  return usable;
}

// The events of the main userspace channel. Default events that another channel takes by name or pattern are left out.
std::vector<std::string> main_events(const TraceConfig& config) {
  if (config.events_ust != default_ros_events() || config.channels.empty()) {
    return config.events_ust;
  }
  std::vector<std::string> left = config.events_ust;
  for (const ChannelConfig& channel : config.channels) {
    for (const std::string& text : channel.events_ust) {
      const std::string pattern = event_pattern(text);
      std::erase_if(left, [&](const std::string& event) { return fnmatch(pattern.c_str(), event.c_str(), 0) == 0; });
    }
  }
  return left;
}

// Without events.
ChannelPlan channel_of_programs(const TraceConfig& config, const char* name) {
  ChannelPlan plan{config.ust};
  plan.buffers = config.buffers_ust;
  plan.channel = name;
  plan.context_fields = config.context_fields_ust;
  plan.switch_timer = config.switch_timer();
  plan.overwrite = config.overwrite_ust.value_or(config.records_snapshots());
  plan.tracefile_size = config.tracefile_size;
  plan.tracefile_count = config.tracefile_count;
  return plan;
}

ChannelPlan userspace_plan(const TraceConfig& config) {
  ChannelPlan plan = channel_of_programs(config, kUserspaceChannel);
  plan.events = rules(main_events(config));
  if (!plan.events.empty()) {
    for (EventRule& rule : rules(config.further_events_ust)) {
      plan.events.push_back(std::move(rule));
    }
  }
  if (records_launch_events(config)) {
    plan.events.push_back({.pattern = kLaunchEvents});
  } else if (config.max_overhead > 0 && !plan.events.empty()) {
    plan.events.push_back({.pattern = kCutEvent});
  }
  if (config.dual_runtime && !plan.events.empty()) {
    plan.events.push_back({.pattern = kNoStateDump});
  }
  return plan;
}

// LTTng's levels of userspace events have other numbers than those of Python.
int python_level(int level) {
  return level <= LTTNG_LOGLEVEL_CRIT      ? LTTNG_LOGLEVEL_PYTHON_CRITICAL
         : level == LTTNG_LOGLEVEL_ERR     ? LTTNG_LOGLEVEL_PYTHON_ERROR
         : level == LTTNG_LOGLEVEL_WARNING ? LTTNG_LOGLEVEL_PYTHON_WARNING
         : level <= LTTNG_LOGLEVEL_INFO    ? LTTNG_LOGLEVEL_PYTHON_INFO
                                           : LTTNG_LOGLEVEL_PYTHON_DEBUG;
}

// "my_logger:*" is the logger and all that are below it, as Python names them.
std::vector<EventRule> python_rules(const std::vector<std::string>& texts) {
  constexpr std::string_view kAllBelow = ":*";
  std::vector<EventRule> found;
  for (const std::string& text : without_repetitions(texts)) {
    EventRule rule = parse_event_rule(text);
    if (!rule.exclusions.empty()) {
      throw TraceError(fmt::format("nothing can be taken out of the loggers '{}'", rule.pattern),
                       "name the loggers one by one, or use a filter such as `if logger_name != \"my_logger\"`");
    }
    if (rule.log_level) {
      rule.log_level = python_level(*rule.log_level);
    }
    if (rule.pattern.ends_with(kAllBelow) && rule.pattern.size() > kAllBelow.size()) {
      rule.pattern.resize(rule.pattern.size() - kAllBelow.size());
      found.push_back(rule);
      rule.pattern += ".*";
    }
    found.push_back(std::move(rule));
  }
  return found;
}

ChannelPlan python_plan(const TraceConfig& config) {
  ChannelPlan plan = channel_of_programs(config, kPythonChannel);
  plan.python = true;
  plan.events = python_rules(config.events_python);
  return plan;
}

ChannelPlan kernel_plan(const TraceConfig& config) {
  ChannelPlan plan;
  plan.domain = LTTNG_DOMAIN_KERNEL;
  plan.channel = kKernelChannel;
  plan.events = rules(config.events_kernel);
  plan.syscalls = without_repetitions(config.syscalls);
  plan.context_fields = config.context_fields_kernel;
  plan.subbuffer_size = config.subbuffer_size_kernel;
  plan.subbuffer_count = config.subbuffer_count_kernel();
  plan.read_timer = kKernelReadTimer;
  plan.overwrite = config.records_snapshots();
  plan.tracefile_size = config.tracefile_size;
  plan.tracefile_count = config.tracefile_count;
  return plan;
}

ChannelPlan further_plan(const ChannelConfig& channel, const TraceConfig& config) {
  const bool kernel = !channel.events_kernel.empty() || !channel.syscalls.empty();
  if (kernel == !channel.events_ust.empty()) {
    throw TraceError(kernel ? fmt::format("channel '{}' has userspace and kernel events", channel.name)
                            : fmt::format("channel '{}' has no events", channel.name),
                     kernel ? "make it two channels: each belongs to one domain"
                            : "name some in events-ust, events-kernel or syscalls");
  }
  ChannelPlan plan = kernel ? kernel_plan(config) : userspace_plan(config);
  plan.channel = channel.name;
  plan.events = rules(kernel ? channel.events_kernel : channel.events_ust);
  plan.syscalls = without_repetitions(channel.syscalls);
  if (channel.context_fields) {
    plan.context_fields = *channel.context_fields;
  }
  plan.subbuffer_size = channel.subbuffer_size.value_or(plan.subbuffer_size);
  plan.subbuffer_count = channel.subbuffer_count.value_or(plan.subbuffer_count);
  plan.read_timer = channel.read_timer.value_or(plan.read_timer);
  plan.switch_timer = channel.switch_timer.value_or(plan.switch_timer);
  plan.overwrite = channel.overwrite.value_or(plan.overwrite);
  plan.blocking_timeout = channel.blocking_timeout;
  return plan;
}

// Moves the initialisation events of the main userspace channel to a channel of their own. A pattern other than
// "ros2:*", or a rule with conditions, stays where it is: an event that two rules match would be recorded twice.
void split_initialisation_events(std::vector<ChannelPlan>& plans, std::size_t main) {
  const std::vector<std::string>& all = initialisation_ros_events();
  std::set<std::string> initialisation(all.begin(), all.end());
  initialisation.insert(kCutEvent);
  initialisation.insert(kLaunchEvents);  // few, and as worth keeping
  ChannelPlan first = plans[main];
  first.channel = kInitialisationChannel;
  std::vector<std::string> moved;
  std::vector<std::string> staying;
  std::vector<EventRule> rest;
  for (const EventRule& rule : plans[main].events) {
    if (!rule.plain()) {
      rest.push_back(rule);
      continue;
    }
    const std::vector<std::string> names =
        rule.pattern == kAllRosEvents ? default_ros_events() : std::vector{rule.pattern};
    for (const std::string& event : names) {
      (initialisation.contains(event) ? moved : staying).push_back(event);
    }
  }
  first.events = rules(moved);
  plans[main].events = rules(staying);
  plans[main].events.insert(plans[main].events.end(), rest.begin(), rest.end());
  if (plans[main].events.empty()) {
    plans.erase(plans.begin() + static_cast<std::ptrdiff_t>(main));
  }
  if (!first.events.empty()) {
    plans.insert(plans.begin(), std::move(first));
  }
}

// Replaces each pattern of provider ros2 by the names of the events that it matches. LTTng can switch an event off only
// by the rule that it was given.
void name_ros_events(std::vector<ChannelPlan>& channels) {
  for (ChannelPlan& channel : channels) {
    std::set<std::string> named;  // without a condition: an event of two such rules is recorded once
    std::vector<EventRule> named_rules;
    for (const EventRule& rule : channel.events) {
      if (!rule.pattern.starts_with("ros2:") || rule.pattern.find('*') == std::string::npos) {
        if (!rule.plain() || named.insert(rule.pattern).second) {
          named_rules.push_back(rule);
        }
        continue;
      }
      for (const std::string& event : default_ros_events()) {
        if (fnmatch(rule.pattern.c_str(), event.c_str(), 0) != 0 || (rule.plain() && !named.insert(event).second)) {
          continue;
        }
        named_rules.push_back(rule);
        named_rules.back().pattern = event;
      }
    }
    channel.events = std::move(named_rules);
  }
}

void check_channel_name(const std::string& name, const std::set<std::string>& taken) {
  if (name.empty() || name.size() >= LTTNG_SYMBOL_NAME_LEN || name.front() == '.' ||
      name.find('/') != std::string::npos) {
    throw TraceError(fmt::format("'{}' is no name for a channel", name),
                     fmt::format("a name has 1 to {} characters, none of them '/', and begins with no '.'",
                                 LTTNG_SYMBOL_NAME_LEN - 1));
  }
  if (taken.contains(name)) {
    throw TraceError(fmt::format("there are two channels '{}'", name), "give one another name");
  }
}

// Rounds values that LTTng would refuse, and refuses values that LTTng would misunderstand.
void make_usable(ChannelPlan& plan, const TraceConfig& config, std::vector<std::string>& warnings) {
  plan.subbuffer_size = usable_subbuffer_size(plan.subbuffer_size, plan.domain, warnings);
  plan.subbuffer_count = usable_subbuffer_count(plan.subbuffer_count, warnings);
  plan.context_fields = without_repetitions(plan.context_fields);
  for (const std::string& name : plan.context_fields) {
    ContextField{name, plan.domain};
  }
  if (config.records_snapshots() && !plan.overwrite) {
    throw TraceError(fmt::format("channel '{}' of a snapshot session must overwrite", plan.channel),
                     "leave the overwrite attribute out: a snapshot is of the newest events");
  }
  if (plan.blocking_timeout < kWaitForEver) {
    throw TraceError(
        fmt::format("blocking timeout of {} microseconds for channel '{}'", plan.blocking_timeout, plan.channel),
        "-1 waits for ever, 0 never");
  }
  if (plan.blocking_timeout != 0 && plan.overwrite) {
    throw TraceError(fmt::format("channel '{}' both overwrites and blocks", plan.channel),
                     "a channel that overwrites always has room: leave one of them out");
  }
  if (plan.tracefile_count != 0 && plan.tracefile_size == 0) {
    throw TraceError("a number of trace files is given without their size", "add tracefile-size");
  }
  if (plan.tracefile_size != 0 && plan.tracefile_size < plan.subbuffer_size) {
    warnings.push_back(fmt::format("trace files of {} bytes are rounded up to {}, a sub-buffer of channel '{}'",
                                   plan.tracefile_size, plan.subbuffer_size, plan.channel));
    plan.tracefile_size = plan.subbuffer_size;
  }
  for (const EventRule& rule : plan.events) {
    if (plan.domain == LTTNG_DOMAIN_KERNEL && rule.log_level) {
      throw TraceError(fmt::format("kernel event '{}' has a log level", rule.pattern),
                       "only userspace events can have one");
    }
  }
}

}  // namespace

std::string domain_name(lttng_domain_type domain) {
  return domain == LTTNG_DOMAIN_KERNEL ? "kernel" : "ust";
}

bool records_launch_events(const TraceConfig& config) {
  return config.launch_events && !main_events(config).empty();
}

std::vector<ChannelPlan> plan_channels(const TraceConfig& config, std::vector<std::string>& warnings) {
  std::vector<ChannelPlan> plans;
  if (ChannelPlan plan = userspace_plan(config); !plan.events.empty()) {
    plans.push_back(std::move(plan));
  }
  const bool has_main = !plans.empty();
  if (ChannelPlan plan = kernel_plan(config); !plan.events.empty() || !plan.syscalls.empty()) {
    plans.push_back(std::move(plan));
  }
  if (config.init_channel && has_main) {
    split_initialisation_events(plans, 0);
  }
  if (!config.events_python.empty()) {
    plans.push_back(python_plan(config));
  }
  for (const ChannelConfig& channel : config.channels) {
    plans.push_back(further_plan(channel, config));
  }
  if (config.max_overhead > 0) {
    name_ros_events(plans);
  }
  std::set<std::string> names;
  for (ChannelPlan& plan : plans) {
    check_channel_name(plan.channel, names);
    names.insert(plan.channel);
    make_usable(plan, config, warnings);
  }
  return plans;
}

}  // namespace tracing
