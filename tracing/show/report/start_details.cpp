// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/report/details.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

std::string process_section(const std::vector<StartResult>& starts) {
  const TextTable table(36, {10, 10, 12, 10, 12, 12});
  std::string text =
      "\n" + table.row("Start of processes", {"spawn", "rcl_init", "first node", "ready", "callback", "message"});
  const auto cell = [](const std::optional<std::int64_t>& after) {
    return after ? format_duration(static_cast<double>(*after)) : std::string("-");
  };
  for (const StartResult& start : starts) {
    std::optional<std::int64_t> spawn;
    if (start.spawn_ns) {
      spawn = start.exec_ns - *start.spawn_ns;
    }
    text += table.row(fmt::format("  {} [{}]", start.process, start.vpid),
                      {cell(spawn), cell(start.init_after_ns), cell(start.node_after_ns), cell(start.ready_after_ns),
                       cell(start.callback_after_ns), cell(start.publication_after_ns)});
  }
  return text +
         "  (spawn: until exec; all others after exec: ready, an executor looks for work; the first callback; the "
         "first\n"
         "  message that it publishes)\n";
}

std::string path_section(const StartupResult& startup) {
  const TextTable table(72, {14, 14});
  std::string text =
      "\n" + table.row(fmt::format("Critical path of the start, {}",
                                   format_duration(static_cast<double>(startup.ready_ns - startup.begin_ns))),
                       {"from", "took"});
  for (const StartStep& step : startup.critical_path) {
    text += table.row(fmt::format("  {}: {}", step.process.empty() ? "launcher" : step.process, step.what),
                      {format_duration(static_cast<double>(step.begin_ns - startup.begin_ns)),
                       format_duration(static_cast<double>(step.end_ns - step.begin_ns))});
  }
  return text;
}

}  // namespace

std::string start_details(const TraceResults& results) {
  if (results.starts.empty()) {
    return "";
  }
  return process_section(results.starts) + (results.startup ? path_section(*results.startup) : "");
}

}  // namespace tracing
