// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/session_listing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string_view>

#include "tracing/record/account/loss_counters.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/checks/kernel_checks.hpp"
#include "tracing/record/lttng/channels.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_list.hpp"
#include "tracing/record/lttng/session_daemon.hpp"
#include "tracing/record/plan/channel_plan.hpp"
#include "tracing/record/plan/context_fields.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

// The events of a channel that are enabled.
std::vector<std::string> enabled_events(lttng_handle* handle, const char* channel) {
  std::vector<std::string> names;
  for (const lttng_event& event :
       LttngList<lttng_event>("list the events of a channel", lttng_list_events, handle, channel)) {
    if (event.enabled != 0) {
      names.emplace_back(event.name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<ChannelDetails> channels_of(const std::string& session, const lttng_domain& domain) {
  const DomainHandle handle = domain_handle(session, domain);
  const LttngList<lttng_channel> channels(fmt::format("list the channels of session '{}'", session),
                                          lttng_list_channels, handle.get());
  lttng_domain of_python = domain;
  of_python.type = LTTNG_DOMAIN_PYTHON;
  const DomainHandle loggers = domain_handle(session, of_python);
  std::vector<ChannelDetails> details;
  for (const lttng_channel& channel : channels) {
    const lttng_channel_attr& attributes = channel.attr;
    const bool python = std::string_view(channel.name) == kPythonChannel;
    details.push_back({.domain = domain_name(domain.type),
                       .name = channel.name,
                       .subbuffer_size = attributes.subbuf_size,
                       .subbuffer_count = attributes.num_subbuf,
                       .overwrite = attributes.overwrite == 1,
                       .events = enabled_events((python ? loggers : handle).get(), channel.name)});
  }
  return details;
}

std::string process_name(int pid) {
  std::string name = "?";
  if (const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(fmt::format("/proc/{}/comm", pid).c_str(), "r"),
                                                       &std::fclose);
      file) {
    std::array<char, 64> line{};
    if (std::fgets(line.data(), line.size(), file.get()) != nullptr) {
      name = line.data();
    }
    if (name.ends_with('\n')) {
      name.pop_back();
    }
  }
  return fmt::format("{} {}", name, pid);
}

std::vector<TraceableEvent> userspace_events() {
  const DomainHandle handle = domain_handle("", LTTNG_DOMAIN_UST);
  const LttngList<lttng_event> events("list the userspace events", lttng_list_tracepoints, handle.get());
  std::map<std::string, std::set<int>> processes;
  for (const lttng_event& event : events) {
    processes[event.name].insert(event.pid);
  }
  std::vector<TraceableEvent> traceable;
  for (const auto& [name, pids] : processes) {
    TraceableEvent event{.name = name, .processes = {}};
    for (const int pid : pids) {
      event.processes.push_back(process_name(pid));
    }
    traceable.push_back(std::move(event));
  }
  return traceable;
}

}  // namespace

std::vector<SessionSummary> list_sessions() {
  check_daemon_not_stopped();
  if (lttng_session_daemon_alive() != 1) {
    return {};
  }
  std::vector<SessionSummary> summaries;
  for (lttng_session& session : LttngList<lttng_session>("list the trace sessions", lttng_list_sessions)) {
    std::uint64_t created = 0;
    lttng_session_get_creation_time(&session, &created);
    summaries.push_back({.name = session.name,
                         .path = session.path,
                         .active = session.enabled != 0,
                         .snapshot = session.snapshot_mode != 0,
                         .created = static_cast<std::int64_t>(created)});
  }
  return summaries;
}

std::optional<SessionSummary> find_session(const std::string& name) {
  for (SessionSummary& session : list_sessions()) {
    if (session.name == name) {
      return std::move(session);
    }
  }
  return std::nullopt;
}

SessionDetails describe_session(const std::string& name) {
  check_daemons_not_stopped();
  const std::optional<SessionSummary> found = find_session(name);
  if (!found) {
    throw TraceError(fmt::format("there is no trace session '{}'", name),
                     "`launch trace list` shows the sessions that exist");
  }
  SessionDetails details{.summary = *found, .channels = {}, .losses = read_losses(name)};
  const LttngList<lttng_domain> domains(fmt::format("list the domains of session '{}'", name), lttng_list_domains,
                                        name.c_str());
  for (const lttng_domain& domain : domains) {
    if (!has_channels(domain)) {
      continue;
    }
    for (ChannelDetails& channel : channels_of(name, domain)) {
      details.channels.push_back(std::move(channel));
    }
  }
  return details;
}

bool has_buffers_of_processes(const std::string& name) {
  const LttngList<lttng_domain> domains(fmt::format("list the domains of session '{}'", name), lttng_list_domains,
                                        name.c_str());
  return std::any_of(domains.begin(), domains.end(),
                     [](const lttng_domain& domain) { return domain.buf_type == LTTNG_BUFFER_PER_PID; });
}

TraceableEvents list_traceable_events() {
  TraceableEvents events;
  events.started_daemon = ensure_session_daemon();
  events.userspace = userspace_events();
  try {
    check_kernel_tracer();
    events.kernel = kernel_event_names();
    events.syscalls = syscall_names().size();
  } catch (const TraceError& error) {
    events.why_no_kernel = error.what();
    events.kernel_remedy = error.remedy();
  }
  events.context_fields_ust = context_field_names(LTTNG_DOMAIN_UST);
  events.context_fields_kernel = context_field_names(LTTNG_DOMAIN_KERNEL);
  return events;
}

}  // namespace tracing
