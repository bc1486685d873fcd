#include <fmt/format.h>

#include "tracing/report/report.hpp"
#include "tracing/report/text_table.hpp"

namespace tracing {

std::string loss_phrase(const TraceOverview& overview) {
  if (overview.losses.empty()) return "none lost";
  const std::uint64_t events = overview.lost_events();
  const std::uint64_t packets = overview.lost_packets();
  if (events == 0 && packets == 0) return "some events lost";
  std::string counted;
  if (events > 0) counted = format_count(events, "event");
  if (packets > 0) counted += (events > 0 ? " and " : "") + format_count(packets, "packet");
  return fmt::format("{}{} lost", overview.lost_uncounted() ? "at least " : "", counted);
}

std::string summary_line(const TraceOverview& overview) {
  if (overview.events == 0 && overview.losses.empty()) return "no events";
  return fmt::format("{}, {}, {}", format_count(overview.events, "event"),
                     format_count(overview.processes.size(), "process"), loss_phrase(overview));
}

std::string process_label(const ProcessResult& process) {
  const std::string name = process.name.empty() ? "process" : process.name;
  return process.vpid ? fmt::format("{} [{}]", name, *process.vpid) : fmt::format("{} [?]", name);
}

}  // namespace tracing
