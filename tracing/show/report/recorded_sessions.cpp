// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/recorded_sessions.hpp"

#include <map>
#include <variant>

#include "tracing/decode/reader/recording.hpp"

namespace tracing {

namespace {

std::string text_of(const TraceDescription& trace, const std::string& name) {
  const auto found = trace.environment.find(name);
  if (found == trace.environment.end()) {
    return {};
  }
  const auto* const text = std::get_if<std::string>(&found->second);
  return text != nullptr ? *text : std::string();
}

}  // namespace

std::vector<std::string> several_sessions(const std::deque<TraceDescription>& traces) {
  std::map<std::string, std::map<std::string, std::string>> names;  // by host and session
  for (const TraceDescription& trace : traces) {
    const std::string name = text_of(trace, "trace_name");
    const Recording recording = recording_of({.hostname = text_of(trace, "hostname"),
                                              .trace_name = name,
                                              .trace_creation_datetime = text_of(trace, "trace_creation_datetime")});
    if (!recording.session.empty()) {
      names[recording.host].emplace(recording.session, name);
    }
  }
  std::vector<std::string> result;
  for (const auto& [host, sessions] : names) {
    if (sessions.size() < 2) {
      continue;
    }
    for (const auto& [session, name] : sessions) {
      result.push_back(name);
    }
  }
  return result;
}

}  // namespace tracing
