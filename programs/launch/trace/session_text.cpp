// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/trace/session_text.hpp"

#include <fmt/core.h>

#include <cstddef>

#include "tracing/record/account/loss_text.hpp"

namespace tracing {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

std::string sessions_as_text(const std::vector<SessionSummary>& sessions) {
  if (sessions.empty()) {
    return "no trace sessions\n";
  }
  std::string text;
  for (const SessionSummary& session : sessions) {
    text += fmt::format("{} ({}{}){}{}\n", session.name, session.active ? "recording" : "paused",
                        session.snapshot ? ", snapshot" : "", session.path.empty() ? "" : " ", session.path);
  }
  return text;
}

std::string session_as_text(const SessionDetails& session) {
  std::string text = sessions_as_text({session.summary});
  for (const ChannelDetails& channel : session.channels) {
    text += fmt::format("  {} channel {}: {} of {} bytes per {}, {} when full\n", channel.domain, channel.name,
                        counted(channel.subbuffer_count, "sub-buffer"), channel.subbuffer_size, "processor",
                        channel.overwrite ? "overwrites the oldest events" : "drops the newest events");
    text += fmt::format("    {}: {}\n", counted(channel.events.size(), "event rule"), joined(channel.events));
  }
  for (const auto& [processor, seconds] : session.held_up) {
    text += fmt::format(
        "  processor {}: a process died within an event; what is recorded there is lost, for {:.1f} s now\n", processor,
        seconds);
  }
  return text + fmt::format("  {}\n", describe_losses(session.losses));
}

std::string events_as_text(const TraceableEvents& events) {
  std::string text;
  if (events.started_daemon) {
    text +=
        "the session daemon was not running and has been started: programs that run already tell it of their events "
        "within a moment\n";
  }
  if (events.userspace.empty()) {
    text +=
        "userspace: no running program has registered events; rules for events to come can be enabled all the same\n";
  } else {
    text += fmt::format("userspace: {} of running programs\n", counted(events.userspace.size(), "event"));
    for (const TraceableEvent& event : events.userspace) {
      text += fmt::format("  {} ({})\n", event.name, joined(event.processes));
    }
  }
  if (!events.why_no_kernel.empty()) {
    text += fmt::format("kernel: {}\n  {}\n", events.why_no_kernel, events.kernel_remedy);
  } else {
    text += fmt::format("kernel: {}, {}\n", counted(events.kernel.size(), "event"),
                        counted(events.syscalls, "system call"));
    for (const std::string& name : events.kernel) {
      text += fmt::format("  {}\n", name);
    }
  }
  text += fmt::format("context fields of userspace events: {}, perf:thread:COUNTER, $app.PROVIDER:TYPE\n",
                      joined(events.context_fields_ust));
  text += fmt::format("context fields of kernel events: {}, perf:cpu:COUNTER\n", joined(events.context_fields_kernel));
  return text;
}

}  // namespace tracing
