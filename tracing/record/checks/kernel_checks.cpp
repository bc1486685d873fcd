// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/checks/kernel_checks.hpp"

#include <fmt/core.h>
#include <fnmatch.h>
#include <lttng/lttng-error.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "base/text/names.hpp"
#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_list.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

std::vector<std::string> names_of(const LttngList<lttng_event>& events) {
  std::vector<std::string> names;
  for (const lttng_event& event : events) {
    names.emplace_back(event.name);
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool is_known(const std::string& pattern, const std::vector<std::string>& names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const std::string& name) { return fnmatch(pattern.c_str(), name.c_str(), 0) == 0; });
}

struct UnknownName {
  std::string what;  // "event 'sched_swich'"
  std::string remedy;
};

UnknownName unknown(const std::string& what, const std::string& pattern, const std::vector<std::string>& names,
                    const std::string& remedy) {
  const std::string nearest = launch::nearest_name(pattern, names);
  return {fmt::format("{} '{}'", what, pattern), nearest.empty() ? remedy : fmt::format("did you mean `{}`?", nearest)};
}

}  // namespace

void check_kernel_tracer() {
  const DomainHandle handle = domain_handle("", LTTNG_DOMAIN_KERNEL);
  lttng_event* tracepoints = nullptr;
  const int count = lttng_list_tracepoints(handle.get(), &tracepoints);
  std::free(tracepoints);
  if (count >= 0) {
    return;
  }
  if (count == -LTTNG_ERR_NEED_ROOT_SESSIOND) {
    throw TraceError(
        "kernel events cannot be recorded: root's session daemon alone records them, and this user has none",
        "run as root; or let root start lttng-sessiond, join the group `tracing` (sudo usermod -aG tracing "
        "USER), and log in again");
  }
  throw TraceError(fmt::format("kernel events cannot be recorded: {}", lttng_strerror(count)),
                   "install the kernel tracer (sudo apt-get install lttng-modules-dkms) and run as root or as a member "
                   "of the group `tracing`; or trace without events-kernel and syscalls");
}

std::string kernel_modules_version() {
  std::string version;
  std::ifstream("/sys/module/lttng_tracer/version") >> version;
  return version;
}

std::vector<std::string> kernel_event_names() {
  const DomainHandle handle = domain_handle("", LTTNG_DOMAIN_KERNEL);
  return names_of(LttngList<lttng_event>("list the kernel events", lttng_list_tracepoints, handle.get()));
}

std::vector<std::string> syscall_names() {
  return names_of(LttngList<lttng_event>("list the system calls", lttng_list_syscalls));
}

std::string drop_unknown_kernel_names(std::vector<ChannelPlan>& channels, const std::vector<std::string>& events,
                                      const std::vector<std::string>& syscalls) {
  std::vector<UnknownName> dropped;
  bool some_left = false;
  for (ChannelPlan& channel : channels) {
    if (channel.domain != LTTNG_DOMAIN_KERNEL) {
      continue;
    }
    std::erase_if(channel.events, [&](const EventRule& rule) {
      // LTTng's own events, such as lttng_statedump_process_state, are not listed.
      if (rule.pattern.starts_with("lttng_") || is_known(rule.pattern, events)) {
        return false;
      }
      dropped.push_back(unknown("event", rule.pattern, events, "`launch trace events` lists them"));
      return true;
    });
    std::erase_if(channel.syscalls, [&](const std::string& name) {
      if (is_known(name, syscalls)) {
        return false;
      }
      dropped.push_back(unknown("system call", name, syscalls, "name it without 'sys_', as in openat"));
      return true;
    });
    some_left = some_left || !channel.events.empty() || !channel.syscalls.empty();
  }
  if (dropped.empty()) {
    return "";
  }
  if (!some_left) {
    throw TraceError("the kernel has no " + dropped.front().what, dropped.front().remedy);
  }
  std::erase_if(channels, [](const ChannelPlan& channel) {
    return channel.domain == LTTNG_DOMAIN_KERNEL && channel.events.empty() && channel.syscalls.empty();
  });
  std::string warning;
  for (const auto& [what, remedy] : dropped) {
    warning +=
        fmt::format("{}{} ({})", warning.empty() ? "not recorded, for the kernel has no " : ", no ", what, remedy);
  }
  return warning;
}

void check_kernel_context_fields(const std::vector<ChannelPlan>& channels, const std::string& modules_version) {
  // Nothing calls their function wrapper_task_prio_init: the first event calls the null pointer that this function
  // should have set, and the kernel panics.
  if (!modules_version.starts_with("2.13.")) {
    return;
  }
  for (const ChannelPlan& channel : channels) {
    const std::vector<std::string>& fields = channel.context_fields;
    if (channel.domain != LTTNG_DOMAIN_KERNEL || std::find(fields.begin(), fields.end(), "prio") == fields.end()) {
      continue;
    }
    throw TraceError(
        fmt::format("context field 'prio' would crash this kernel: LTTng's modules {} call a function that "
                    "they never look up",
                    modules_version),
        "leave it out; sched_switch tells prev_prio and next_prio");
  }
}

}  // namespace tracing
