// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/trace_findings.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

#include "tracing/record/plan/context_fields.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/ros_events.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace launch {

void find_unknown_context_fields(const std::vector<std::string>& fields, lttng_domain_type domain,
                                 const SourceRange& where, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  for (const std::string& name : fields) {
    try {
      tracing::ContextField(name, domain);
    } catch (const tracing::TraceError& error) {
      context.exploration().remark(
          {Severity::kError, error.what(), where, error.remedy(), Finding::kUnknownContextField});
    }
  }
}

void find_unknown_events(const std::vector<std::string>& rules, const SourceRange& where, LaunchContext& context) {
  if (!context.exploration().is_on()) {
    return;
  }
  std::vector<std::string> names;
  for (const tracing::RosEvent& event : tracing::all_ros_events()) {
    names.push_back(event.name);
  }
  for (const std::string& pattern : tracing::event_patterns(rules)) {
    const bool known = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return ::fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    });
    const std::string help = did_you_mean(pattern.find(':') == std::string::npos ? "ros2:" + pattern : pattern, names);
    const bool lacks_provider = std::find(names.begin(), names.end(), "ros2:" + pattern) != names.end();
    if (lacks_provider) {
      context.exploration().remark({Severity::kWarning, fmt::format("event '{}' has no provider", pattern), where,
                                    fmt::format("did you mean 'ros2:{}'?", pattern), Finding::kUnknownEvent});
    } else if (pattern.starts_with("ros2:") && !known) {
      context.exploration().remark({Severity::kWarning, fmt::format("ROS 2 has no event '{}'", pattern), where,
                                    help.empty() ? "launch trace --help tells how to list them" : help,
                                    Finding::kUnknownEvent});
    }
  }
}

}  // namespace launch
