// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/analysis/launcher_event_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "tracing/model/analysis/event_fields.hpp"

namespace tracing {

namespace {

std::optional<LauncherEventResult::Kind> kind_of_launcher_event(std::string_view event) {
  for (std::size_t kind = 0; kind < LauncherEventResult::kKinds.size(); ++kind) {
    if (event.starts_with("launch:") && event.substr(7) == LauncherEventResult::kKinds[kind]) {
      return static_cast<LauncherEventResult::Kind>(kind);
    }
  }
  return std::nullopt;
}

std::string signal_text(std::int64_t number) {
  const char* const name = ::sigabbrev_np(static_cast<int>(number));
  return name != nullptr ? fmt::format("SIG{}", name) : fmt::format("signal {}", number);
}

std::string exit_text(std::int64_t code) {
  return code < 0 ? signal_text(-code) : fmt::format("exit code {}", code);
}

}  // namespace

std::string LauncherEventResult::sentence() const {
  switch (kind) {
    case Kind::kScheduling:
      return what.empty() ? "its threads get processors as before" : "its threads get processors by " + what;
    case Kind::kSignal:
      return "was sent " + what;
    case Kind::kExit:
      return "ended, " + what;
    case Kind::kRespawn:
      return "ended, " + what + ", and is started again";
    case Kind::kCut:
      return "no longer recorded, because recording cost too much: " + what;
    case Kind::kCondition:
      break;
  }
  return what;
}

void LauncherEventList::add(const Event& event, std::int64_t time, ProcessId launcher) {
  const std::int64_t zero_ns = event.timestamp_ns - time;
  const auto [known, is_new] = zeros_ns_.emplace(launcher, zero_ns);
  known->second = std::min(known->second, zero_ns);
  using Kind = LauncherEventResult::Kind;
  const std::optional<Kind> kind = kind_of_launcher_event(event.name());
  if (!kind) {
    return;
  }
  LauncherEventResult result{.time_ns = time, .kind = *kind, .subject = text_of(event, "process")};
  result.file = text_of(event, "file");
  result.line = number_of(event, "line");
  switch (*kind) {
    case Kind::kCondition:
      result.subject = text_of(event, "condition");
      result.what = text_of(event, "change");
      break;
    case Kind::kScheduling:
      result.what = text_of(event, "change");
      break;
    case Kind::kSignal:
      result.what = signal_text(number_of(event, "signal"));
      break;
    case Kind::kExit:
    case Kind::kRespawn:
      result.what = exit_text(number_of(event, "exit_code"));
      break;
    case Kind::kCut:
      result.subject = text_of(event, "event_class");
      result.what = text_of(event, "events");
      break;
  }
  events_.push_back({launcher, std::move(result)});
  if (kept_ && events_.size() > 2 * *kept_) {
    events_.erase(events_.begin(), events_.end() - static_cast<std::ptrdiff_t>(*kept_));
  }
}

std::vector<LauncherEventResult> LauncherEventList::results() const {
  std::vector<LauncherEventResult> results;
  for (const Told& told : events_) {
    results.push_back(told.event);
    results.back().time_ns += zeros_ns_.at(told.launcher);
  }
  std::stable_sort(results.begin(), results.end(),
                   [](const LauncherEventResult& a, const LauncherEventResult& b) { return a.time_ns < b.time_ns; });
  return results;
}

}  // namespace tracing
