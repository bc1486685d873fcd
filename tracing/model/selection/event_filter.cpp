// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/selection/event_filter.hpp"

#include <algorithm>
#include <charconv>
#include <ctime>

namespace tracing {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

// Reads a number such as "12.5" exactly, in nanoseconds.
std::optional<std::int64_t> parse_seconds(std::string_view text) {
  std::int64_t seconds = 0;
  const char* const end = text.data() + text.size();
  const auto [whole_end, error] = std::from_chars(text.data(), end, seconds);
  if (error != std::errc() || seconds < 0 || seconds > INT64_MAX / kSecond - 1) {
    return std::nullopt;
  }
  std::int64_t ns = seconds * kSecond;
  if (whole_end == end) {
    return ns;
  }
  if (*whole_end != '.') {
    return std::nullopt;
  }
  std::int64_t unit = kSecond;
  for (const char* digit = whole_end + 1; digit != end; ++digit) {
    if (*digit < '0' || *digit > '9') {
      return std::nullopt;
    }
    unit /= 10;
    ns += (*digit - '0') * unit;
  }
  return ns;
}

}  // namespace

std::optional<TimeBound> TimeBound::parse(std::string_view text) {
  if (text.starts_with('+')) {
    const auto ns = parse_seconds(text.substr(1));
    return ns ? std::optional(TimeBound{*ns, true}) : std::nullopt;
  }
  if (const auto ns = parse_seconds(text)) {
    return TimeBound{*ns, false};
  }
  std::tm date{};
  const std::string date_text(text);
  const char* const rest = strptime(date_text.c_str(), "%Y-%m-%dT%H:%M:%S", &date);
  if (rest == nullptr) {
    return std::nullopt;
  }
  const std::string fraction = "0" + std::string(rest);
  const auto ns = parse_seconds(fraction);
  if (!ns || *ns >= kSecond) {
    return std::nullopt;
  }
  return TimeBound{static_cast<std::int64_t>(timegm(&date)) * kSecond + *ns, false};
}

bool EventFilter::accepts_name(const EventClass& event_class) {
  if (events.empty()) {
    return true;
  }
  if (event_class.id >= names_.size()) {
    names_.resize(event_class.id + 1, -1);
  }
  std::int8_t& known = names_[event_class.id];
  if (known < 0) {
    event_names_.insert(event_class.name);
    known = std::any_of(events.begin(), events.end(),
                        [&](const std::string& pattern) { return matches_pattern(pattern, event_class.name); })
                ? 1
                : 0;
  }
  return known == 1;
}

namespace {

bool is_process(const std::string& wanted, std::string_view name, const std::optional<std::int64_t>& id) {
  return (id && std::to_string(*id) == wanted) || (!name.empty() && matches_pattern(wanted, name));
}

}  // namespace

bool EventFilter::accepts_process(const Event& event) {
  const std::string_view name = event.procname.value_or("");
  auto seen = seen_processes_.find(name);
  if (seen == seen_processes_.end()) {
    seen = seen_processes_.emplace(name, std::set<std::optional<std::int64_t>>()).first;
  }
  seen->second.insert(event.vpid);
  return std::any_of(processes.begin(), processes.end(),
                     [&](const std::string& process) { return is_process(process, name, event.vpid); });
}

std::vector<std::string> EventFilter::missing_events() const {
  std::vector<std::string> missing;
  for (const std::string& pattern : events) {
    if (std::none_of(event_names_.begin(), event_names_.end(),
                     [&](const std::string& name) { return matches_pattern(pattern, name); })) {
      missing.push_back(pattern);
    }
  }
  return missing;
}

std::vector<std::string> EventFilter::missing_processes() const {
  std::vector<std::string> missing;
  for (const std::string& wanted : processes) {
    if (std::none_of(seen_processes_.begin(), seen_processes_.end(), [&wanted](const auto& seen) {
          return std::any_of(seen.second.begin(), seen.second.end(),
                             [&](const std::optional<std::int64_t>& id) { return is_process(wanted, seen.first, id); });
        })) {
      missing.push_back(wanted);
    }
  }
  return missing;
}

std::vector<std::string> EventFilter::process_names() const {
  std::vector<std::string> names;
  for (const auto& [name, ids] : seen_processes_) {
    for (const std::optional<std::int64_t>& id : ids) {
      names.push_back(id ? name + " [" + std::to_string(*id) + "]" : name);
    }
  }
  return names;
}

std::int64_t EventFilter::absolute(const TimeBound& bound) const {
  return bound.since_first ? *first_ns_ + bound.ns : bound.ns;
}

bool EventFilter::is_behind(const Event& event) {
  note_first(event);
  return end && event.timestamp_ns >= absolute(*end);
}

bool EventFilter::accepts(const Event& event) {
  note_first(event);
  // What is noted of names and processes is of all events, also of those that are not wanted.
  bool wanted = accepts_name(*event.event_class);
  if (!processes.empty() && !accepts_process(event)) {
    wanted = false;
  }
  if (!nodes.empty()) {
    // It learns from all events, also from those that are not wanted.
    if (!node_filter_) {
      node_filter_ = std::make_unique<NodeFilter>(nodes);
    }
    if (!node_filter_->accepts(event)) {
      return false;
    }
  }
  if ((begin && event.timestamp_ns < absolute(*begin)) || is_behind(event)) {
    return false;
  }
  return wanted && std::all_of(conditions.begin(), conditions.end(),
                               [&](const EventCondition& condition) { return condition.holds(event); });
}

}  // namespace tracing
