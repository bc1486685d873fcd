// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tracing/show/report/report_sections.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

constexpr std::size_t kTime = 14;

}  // namespace

std::string launcher_section(const std::vector<LauncherEventResult>& all, std::int64_t zero_ns,
                             const ReportOptions& options) {
  std::vector<const LauncherEventResult*> events;
  for (const LauncherEventResult& event : all) {
    if (options.all || !event.is_ordinary()) {
      events.push_back(&event);
    }
  }
  if (events.empty()) {
    return "";
  }
  std::string text = "\n" + styled("While it ran", Style::kBold, options.color) + "\n";
  const std::size_t shown = options.top == 0 || options.all ? events.size() : std::min(events.size(), options.top);
  for (std::size_t i = 0; i < shown; ++i) {
    const LauncherEventResult& event = *events[i];
    const double since = static_cast<double>(event.time_ns - zero_ns) / 1e9;
    const std::size_t room = options.width - kTime;
    const std::string what = event.sentence();
    text += fmt::format("{:>12}  ", fmt::format("{:+.3f} s", since));
    if (event.subject.size() + 2 + what.size() <= room) {
      text += event.subject + ": " + what + "\n";
    } else {
      text += shortened(event.subject, room) + fmt::format("\n{:{}}{}\n", "", kTime, shortened(what, room));
    }
  }
  if (shown < events.size()) {
    text += fmt::format("{:{}}and {} more\n", "", kTime, events.size() - shown);
  }
  return text;
}

}  // namespace tracing
