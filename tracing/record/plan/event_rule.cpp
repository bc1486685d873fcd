// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/plan/event_rule.hpp"

#include <fmt/core.h>
#include <fnmatch.h>
#include <lttng/event.h>

#include <algorithm>
#include <array>

#include "tracing/record/plan/trace_config.hpp"
#include "tracing/record/plan/trace_error.hpp"

namespace tracing {
namespace {

constexpr const char* kForm = "an event is written: PATTERN [except PATTERN,…] [level [=]LEVEL] [if FILTER]";

struct LogLevel {
  std::string_view name;
  int value;
};

constexpr std::array kLogLevels = {
    LogLevel{"EMERG", LTTNG_LOGLEVEL_EMERG},
    LogLevel{"ALERT", LTTNG_LOGLEVEL_ALERT},
    LogLevel{"CRIT", LTTNG_LOGLEVEL_CRIT},
    LogLevel{"ERR", LTTNG_LOGLEVEL_ERR},
    LogLevel{"WARNING", LTTNG_LOGLEVEL_WARNING},
    LogLevel{"NOTICE", LTTNG_LOGLEVEL_NOTICE},
    LogLevel{"INFO", LTTNG_LOGLEVEL_INFO},
    LogLevel{"DEBUG_SYSTEM", LTTNG_LOGLEVEL_DEBUG_SYSTEM},
    LogLevel{"DEBUG_PROGRAM", LTTNG_LOGLEVEL_DEBUG_PROGRAM},
    LogLevel{"DEBUG_PROCESS", LTTNG_LOGLEVEL_DEBUG_PROCESS},
    LogLevel{"DEBUG_MODULE", LTTNG_LOGLEVEL_DEBUG_MODULE},
    LogLevel{"DEBUG_UNIT", LTTNG_LOGLEVEL_DEBUG_UNIT},
    LogLevel{"DEBUG_FUNCTION", LTTNG_LOGLEVEL_DEBUG_FUNCTION},
    LogLevel{"DEBUG_LINE", LTTNG_LOGLEVEL_DEBUG_LINE},
    LogLevel{"DEBUG", LTTNG_LOGLEVEL_DEBUG},
};

constexpr std::string_view kSpace = " \t\n";

// Takes the next word off the front of `rest`; "" at the end.
std::string_view next_word(std::string_view& rest) {
  rest.remove_prefix(std::min(rest.find_first_not_of(kSpace), rest.size()));
  const std::string_view word = rest.substr(0, rest.find_first_of(kSpace));
  rest.remove_prefix(word.size());
  return word;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kSpace), text.size()));
  text.remove_suffix(text.size() - std::min(text.find_last_not_of(kSpace) + 1, text.size()));
  return text;
}

std::vector<std::string> parts(std::string_view list) {
  std::vector<std::string> result;
  while (!list.empty()) {
    const std::string_view part = list.substr(0, list.find(','));
    if (!part.empty()) {
      result.emplace_back(part);
    }
    list.remove_prefix(std::min(part.size() + 1, list.size()));
  }
  return result;
}

int log_level(std::string_view name, const std::string& rule) {
  const auto found =
      std::find_if(kLogLevels.begin(), kLogLevels.end(), [name](const LogLevel& level) { return level.name == name; });
  if (found != kLogLevels.end()) {
    return found->value;
  }
  std::string known;
  for (const LogLevel& level : kLogLevels) {
    known += fmt::format("{}{}", known.empty() ? "" : ", ", level.name);
  }
  throw TraceError(fmt::format("unknown log level '{}' in event '{}'", name, rule),
                   fmt::format("the levels are {}", known));
}

}  // namespace

EventRule parse_event_rule(const std::string& text) {
  EventRule rule;
  std::string_view rest = text;
  rule.pattern = next_word(rest);
  if (rule.pattern.empty() || rule.pattern.size() >= LTTNG_SYMBOL_NAME_LEN) {
    throw TraceError(fmt::format("event name '{}' has {} characters: 1 to {} are possible", rule.pattern,
                                 rule.pattern.size(), LTTNG_SYMBOL_NAME_LEN - 1));
  }
  for (std::string_view word; !(word = next_word(rest)).empty();) {
    if (word == "if") {
      rule.filter = trimmed(rest);
      rest = {};
      if (rule.filter.empty()) {
        throw TraceError(fmt::format("event '{}' ends where its filter is expected", text), kForm);
      }
    } else if (word == "except") {
      rule.exclusions = parts(next_word(rest));
      if (rule.exclusions.empty()) {
        throw TraceError(fmt::format("event '{}' ends where the events to exclude are expected", text), kForm);
      }
    } else if (word == "level") {
      std::string_view name = next_word(rest);
      rule.exactly_that_level = name.starts_with('=');
      if (rule.exactly_that_level) {
        name.remove_prefix(1);
      }
      rule.log_level = log_level(name, text);
    } else {
      throw TraceError(fmt::format("unexpected '{}' in event '{}'", word, text), kForm);
    }
  }
  return rule;
}

std::vector<EventRule> expand_exclusions(const EventRule& rule) {
  if (rule.exclusions.empty()) {
    return {rule};
  }
  if (!rule.pattern.starts_with("ros2:")) {
    throw TraceError(fmt::format("nothing can be taken out of '{}': only of events of provider ros2", rule.pattern),
                     "name the events one by one, or use a filter");
  }
  const auto matches = [](const std::string& pattern, const std::string& event) {
    return fnmatch(pattern.c_str(), event.c_str(), 0) == 0;
  };
  std::vector<EventRule> left;
  for (const std::string& event : default_ros_events()) {
    if (!matches(rule.pattern, event) ||
        std::any_of(rule.exclusions.begin(), rule.exclusions.end(),
                    [&](const std::string& excluded) { return matches(excluded, event); })) {
      continue;
    }
    left.push_back(rule);
    left.back().pattern = event;
    left.back().exclusions.clear();
  }
  return left;
}

std::string event_pattern(std::string_view text) {
  return std::string(next_word(text));
}

std::vector<std::string> event_patterns(const std::vector<std::string>& texts) {
  std::vector<std::string> patterns;
  for (const std::string& text : texts) {
    patterns.push_back(event_pattern(text));
  }
  return patterns;
}

}  // namespace tracing
