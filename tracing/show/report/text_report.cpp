// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tracing/model/findings/finding.hpp"
#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/printable.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/report/launch_filter.hpp"
#include "tracing/show/report/report.hpp"
#include "tracing/show/report/report_sections.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

constexpr std::size_t kFindings = 8;

// Those whose cost is measured. Names of kernel events have no provider.
std::uint64_t userspace_events(const TraceOverview& overview) {
  std::uint64_t events = 0;
  for (const EventCount& event : overview.event_counts) {
    if (event.name.find(':') != std::string::npos) {
      events += event.total;
    }
  }
  return events;
}

std::string cost_line(const Report& report) {
  const TraceOverview& overview = report.results.overview;
  const std::uint64_t events = userspace_events(overview);
  if (!report.verdict.ns_per_event || events == 0) {
    return "";
  }
  const double cost = *report.verdict.ns_per_event * static_cast<double>(events);
  const double span = static_cast<double>(*overview.end_ns - *overview.begin_ns);
  std::string text = fmt::format("Cost       {} of {} for each event", format_duration(cost),
                                 format_duration(*report.verdict.ns_per_event));
  if (span > 0) {
    text += fmt::format(", {:.2g} % of a processor", 100 * cost / span);
  }
  return text + (events < overview.events ? ", without the events of the kernel\n" : "\n");
}

std::string head(const Report& report, bool color) {
  const TraceOverview& overview = report.results.overview;
  std::string text = fmt::format("Trace      {}\n", report.directory.string());
  if (!report.error.empty()) {
    text += styled(fmt::format("Damaged    {}", report.error), Style::kBad, color) + "\n";
  }
  if (!report.open.empty()) {
    text +=
        styled("Open       still being written; what is complete so far is in this report", Style::kWarning, color) +
        "\n";
  }
  if (overview.begin_ns) {
    text += fmt::format("Recorded   {}, for {}\n", format_time(*overview.begin_ns),
                        format_duration(static_cast<double>(*overview.end_ns - *overview.begin_ns)));
  }
  text += fmt::format("Events     {} of {}\n", overview.events, processes_phrase(overview));
  if (!report.others.empty()) {
    text += "Left out   " + others_phrase(report.others) + "\n";
  }
  text += cost_line(report);
  const bool doubtful = !overview.losses.empty() || !report.error.empty();
  const RecordedVerdict& verdict = report.verdict;
  const bool counts_none = overview.losses.empty() && verdict.discarded_events == 0 && verdict.lost_packets == 0;
  const bool is_void = overview.events == 0 && !verdict.found && report.open.empty();
  const bool none = counts_none && report.error.empty() && !verdict.damaged && !is_void;
  const std::string losses = counts_none && !none && is_void       ? "unknown, as nothing tells what was to be recorded"
                             : counts_none && !none                ? "unknown, as a part of the trace is missing"
                             : none && verdict.overwritten.empty() ? "no events lost"
                                                                   : loss_phrase(overview, verdict);
  return text + "Losses     " +
         styled(losses + (doubtful ? "; results marked with * may be wrong" : ""), none ? Style::kGood : Style::kBad,
                color) +
         "\n";
}

std::string absence_section(const std::vector<std::string>& absences, bool color) {
  if (absences.empty()) {
    return "";
  }
  std::string text = "\n" + styled("Not there", Style::kBold, color) + "\n";
  for (const std::string& absence : absences) {
    text += "  " + styled(absence, Style::kBad, color) + "\n";
  }
  return text;
}

std::string finding_section(const Report& report, const ReportOptions& options) {
  std::vector<Finding> findings = find_worth_a_look(report.results);
  if (findings.empty()) {
    return report.results.ros2.callbacks.empty()
               ? ""
               : "\n" + styled("Worth a look", Style::kBold, options.color) + "\n  nothing stands out\n";
  }
  if (findings.size() > kFindings) {
    findings.resize(kFindings);
  }
  std::string text = "\n" + styled("Worth a look", Style::kBold, options.color) + "\n";
  for (const Finding& finding : findings) {
    const Style style = finding.weight >= 70 ? Style::kBad : finding.weight >= 40 ? Style::kWarning : Style::kPlain;
    constexpr std::size_t kTitle = 18;
    const std::string title = fmt::format("  {:{}}", finding.title(), kTitle);
    const std::size_t room = options.width - title.size();
    text += styled(title, style, options.color);
    // One line if it fits, else two, or one that is cut. Then what to do, where there is room.
    if (finding.subject.size() + 2 + finding.figures.size() <= room) {
      text += finding.subject + ": " + finding.figures + "\n";
    } else if (!options.compact) {
      text += shortened(finding.subject, room) +
              fmt::format("\n{:{}}{}\n", "", title.size(), shortened(finding.figures, room));
    } else {
      const std::string subject = shortened(finding.subject, room / 2);
      text += subject + ": " + finding.figures.substr(0, room - subject.size() - 4) + "..\n";
    }
    if (!options.compact && !finding.next.empty()) {
      text += fmt::format("{:{}}{}\n", "", title.size(), shortened("next: " + finding.next, room));
    }
  }
  return text;
}

// The chains that the user asked for, step by step.
std::string chosen_chains(const TraceResults& results, const ReportOptions& options) {
  std::string text;
  for (const ChainResult& chain : results.ros2.chains) {
    if (!is_chosen(chain, options)) {
      continue;
    }
    text += "\n" + duration_header("Step by step") + chain_details(chain, Hosts(results.overview));
  }
  if (!text.empty()) {
    return text;
  }
  return fmt::format("\nNo chain leads from {} to {}.\n", options.chain.first, options.chain.second);
}

}  // namespace

std::string text_report(const Report& of, const ReportOptions& options) {
  Report report = of;
  report.results = printable(std::move(report.results));
  const TraceResults& results = report.results;
  std::string text = head(report, options.color) + absence_section(absences_of(report), options.color);
  if (!options.chain.first.empty()) {
    ReportOptions all = options;  // each one has its steps below
    all.top = 0;
    return text + chain_table(results, all) + chosen_chains(results, options);
  }
  if (options.node.empty() && options.topic.empty()) {
    text += finding_section(report, options) +
            launcher_section(results.launcher_events, results.overview.begin_ns.value_or(0), options);
  }
  text += chain_table(results, options) + callback_table(results, options) + topic_table(results.ros2, options) +
          executor_table(results, options) + service_table(results, options) + action_table(results, options) +
          lifecycle_table(results, options);
  if (options.all) {
    text += details(report);
  } else if (options.events) {
    text += event_details(report);
  }
  return text + notes(report);
}

}  // namespace tracing
