// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "tracing/model/findings/result_labels.hpp"
#include "tracing/show/report/report_sections.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

// Paths below the trace's directory are shown relative to it.
std::string stream_label(const std::string& stream, const std::filesystem::path& directory) {
  const std::string below = std::filesystem::path(stream).lexically_relative(directory);
  return below.empty() || below.starts_with("..") ? stream : below;
}

std::string loss_section(const Report& report) {
  const TraceOverview& overview = report.results.overview;
  const Hosts hosts(overview);
  std::string doubtful;
  for (ProcessIndex process = 0; process < overview.processes.size(); ++process) {
    if (!overview.processes[process].doubtful) {
      continue;
    }
    doubtful += (doubtful.empty() ? "" : ", ") + hosts.before(process) + process_label(overview.processes[process]);
  }
  const auto events = [](const LossResult& loss) {
    const bool nothing_counted = loss.events == 0 && loss.packets == 0;
    return nothing_counted ? "some" : fmt::format("{}{}", loss.events, loss.uncounted ? "+" : "");
  };
  const auto since_begin = [&](std::optional<std::int64_t> LossResult::*time) {
    return [&overview, time](const LossResult& loss) -> std::string {
      const std::optional<std::int64_t>& at = loss.*time;
      return at && overview.begin_ns ? fmt::format("{:+.3f} s", static_cast<double>(*at - *overview.begin_ns) / 1e9)
                                     : "?";
    };
  };
  const Section<LossResult> section{
      .title = "Losses by stream",
      .label_width = 56,
      .columns = {{"events", 10, events},
                  {"packets", 10, number_of(&LossResult::packets)},
                  {"from", 12, since_begin(&LossResult::begin_ns)},
                  {"to", 12, since_begin(&LossResult::end_ns)}},
      .label = [&](const LossResult& loss) { return "  " + stream_label(loss.stream, report.directory); },
      .end = fmt::format("  What follows may be incomplete for: {}\n", doubtful.empty() ? "all" : doubtful)};
  return section.text(overview.losses);
}

// A column of the table of events: a process, or all processes that only the kernel's events show.
struct EventColumn {
  std::string title;
  std::vector<std::size_t> processes;
};

// A trace with events of the kernel has every process of the machine.
std::vector<EventColumn> event_columns(const TraceOverview& overview) {
  std::vector<EventColumn> columns;
  EventColumn others;
  const Hosts hosts(overview);
  for (std::size_t process = 0; process < overview.processes.size(); ++process) {
    const bool has_events_of_its_own =
        std::any_of(overview.event_counts.begin(), overview.event_counts.end(), [process](const EventCount& count) {
          return count.name.find(':') != std::string::npos && count.by_process[process] > 0;
        });
    if (has_events_of_its_own || overview.event_counts.empty()) {
      columns.push_back({hosts.before(process) + process_label(overview.processes[process]), {process}});
    } else {
      others.processes.push_back(process);
    }
  }
  std::uint64_t folded = 0;
  for (const std::size_t process : others.processes) {
    folded += std::max<std::uint64_t>(overview.processes[process].folded, 1);
  }
  others.title = fmt::format("{} of the kernel alone", folded);
  if (!others.processes.empty()) {
    columns.push_back(std::move(others));
  }
  return columns;
}

// A table has as many columns as fit; the next columns follow in another table below.
std::string event_section(const TraceOverview& overview) {
  constexpr std::size_t kLabel = 42;
  constexpr std::size_t kTotal = 10;
  const std::vector<EventColumn> columns = event_columns(overview);
  std::string text;
  std::size_t first = 0;
  while (first < columns.size()) {
    std::vector<std::size_t> widths{kTotal};
    std::vector<std::string> titles{"total"};
    std::size_t used = kLabel + kTotal;
    std::size_t end = first;
    for (; end < columns.size(); ++end) {
      const std::size_t width = std::max<std::size_t>(columns[end].title.size() + 2, 10);
      if (end > first && used + width > kReportWidth) {
        break;
      }
      titles.push_back(columns[end].title);
      widths.push_back(width);
      used += width;
    }
    const TextTable table(kLabel, widths);
    text += "\n" + table.row("Events by process", titles);
    for (const EventCount& count : overview.event_counts) {
      std::vector<std::string> cells{fmt::format("{}", count.total)};
      for (std::size_t column = first; column < end; ++column) {
        std::uint64_t events = 0;
        for (const std::size_t process : columns[column].processes) {
          events += count.by_process[process];
        }
        cells.push_back(fmt::format("{}", events));
      }
      text += table.row("  " + count.name, cells);
    }
    first = end;
  }
  return text;
}

}  // namespace

std::string event_details(const Report& report) {
  return loss_section(report) + event_section(report.results.overview);
}

}  // namespace tracing
