// SPDX-License-Identifier: Apache-2.0
#include "actions/trace/event_rules.hpp"

#include <algorithm>

#include "base/diagnostics/diagnostic.hpp"
#include "tracing/record/plan/event_rule.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace launch {

namespace {

// Whether the text is a name, and not a word of a rule that was written wrongly.
bool is_name(const std::string& text, Tracepoints of) {
  return of == Tracepoints::kUserspace ? text.find(':') != std::string::npos
                                       : text != "if" && text != "except" && text != "level";
}

}  // namespace

std::vector<std::string> perform_event_rules(const Fields& fields, const std::string& attribute, Scope& scope,
                                             Tracepoints of) {
  std::vector<std::string> events;
  for (const std::string& text : perform_words(fields, attribute, scope)) {
    try {
      tracing::parse_event_rule(text);
      events.push_back(text);
    } catch (const tracing::TraceError& error) {
      const std::vector<std::string> parts = split_names(text);
      if (parts.size() < 2 ||
          !std::all_of(parts.begin(), parts.end(), [of](const std::string& part) { return is_name(part, of); })) {
        throw LaunchError(error.what(), fields.where(attribute), error.remedy());
      }
      events.insert(events.end(), parts.begin(), parts.end());
    }
  }
  return events;
}

}  // namespace launch
