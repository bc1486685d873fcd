// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "tracing/model/findings/hosts.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/findings/result_labels.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

std::string processes_phrase(const TraceOverview& overview) {
  const auto folded = static_cast<std::size_t>(std::count_if(overview.processes.begin(), overview.processes.end(),
                                                             [](const auto& one) { return one.folded > 0; }));
  std::string text = format_count(overview.processes.size() - folded, "process");
  if (folded > 0) {
    text += fmt::format(" and {} more of the kernel's events", overview.folded_processes());
  }
  return text;
}

bool has_losses(const TraceOverview& overview, const RecordedVerdict& verdict) {
  return !overview.losses.empty() || verdict.discarded_events > 0 || verdict.lost_packets > 0;
}

std::string loss_phrase(const TraceOverview& overview, const RecordedVerdict& verdict) {
  const std::uint64_t events = std::max(overview.lost_events(), verdict.discarded_events);
  const std::uint64_t packets = std::max(overview.lost_packets(), verdict.lost_packets);
  std::string text;
  if (events != 0 || packets != 0) {
    std::string counted;
    if (events > 0) {
      counted = format_count(events, "event");
    }
    if (packets > 0) {
      counted += (events > 0 ? " and " : "") + format_count(packets, "packet");
    }
    text = fmt::format("{}{} lost", overview.lost_uncounted() ? "at least " : "", counted);
  } else {
    text = verdict.damaged ? "unknown how many lost" : overview.losses.empty() ? "none lost" : "some events lost";
  }
  for (const std::string& overwritten : verdict.overwritten) {
    text += ", " + overwritten;
  }
  return text;
}

std::string incomplete_phrase(const TraceOverview& overview, const RecordedVerdict& verdict) {
  if (has_losses(overview, verdict)) {
    return loss_phrase(overview, verdict);
  }
  if (overview.events == 0 && !verdict.found) {
    return "it has no events, and no verdict";
  }
  return verdict.absences.empty() ? "" : verdict.absences.front();
}

namespace {

constexpr std::size_t kMostNamed = 5;

// "; doubtful: talker [12], listener [13]", the processes that may have lost events; "" when none has.
std::string doubtful_phrase(const TraceOverview& overview) {
  std::set<std::size_t> doubtful;
  for (const LossResult& loss : overview.losses) {
    doubtful.insert(loss.processes.begin(), loss.processes.end());
  }
  const Hosts hosts(overview);
  std::string text;
  std::size_t named = 0;
  for (const std::size_t process : doubtful) {
    if (named++ == kMostNamed) {
      break;
    }
    text += fmt::format("{}{}{}", text.empty() ? "; doubtful: " : ", ", hosts.before(process),
                        process_label(overview.processes.at(process)));
  }
  if (doubtful.size() > kMostNamed) {
    text += fmt::format(" and {} more", doubtful.size() - kMostNamed);
  }
  return text;
}

}  // namespace

std::string summary_line(const TraceOverview& overview, const RecordedVerdict& verdict) {
  if (overview.events == 0 && overview.losses.empty()) {
    return "no events";
  }
  return fmt::format("{}, {}, {}{}", format_count(overview.events, "event"), processes_phrase(overview),
                     loss_phrase(overview, verdict), doubtful_phrase(overview));
}

std::vector<std::string> absences_of(const Report& report) {
  std::vector<std::string> absences = report.verdict.absences;
  for (const std::string& chain : report.results.ros2.unseen_chains) {
    absences.push_back(fmt::format("chain '{}': no callbacks were seen that cause one another in this order", chain));
  }
  return absences;
}

}  // namespace tracing
