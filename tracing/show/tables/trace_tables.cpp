// SPDX-License-Identifier: Apache-2.0
// The trace itself: what it holds, what it lacks, what tracing cost, what is worth a look.
#include <map>

#include "tracing/model/findings/finding.hpp"
#include "tracing/show/tables/table_rows.hpp"

namespace tracing {

namespace {

Table trace_table(const TracedSystem& system) {
  return {"trace",
          "one row",
          {{"directory", kText, ""},
           {"begin_ns", kInteger, "first event, but for `launch:*`: the launcher is no part of the traced system"},
           {"end_ns", kInteger, "last event, but for `launch:*`"},
           {"events", kInteger, "without `launch:*`, which `event_counts` has"},
           {"lost_events", kInteger, "dropped, as far as they were counted"},
           {"lost_packets", kInteger, "overwritten before they were written out"},
           {"error", kText, "why reading stopped early, or what data is missing"},
           {"others", kInteger, "processes that do not belong to the launch, and are left out (`docs/report.md`)"}},
          [&system](const Emit& emit) {
            const TraceOverview& overview = system.results.overview;
            emit({std::string_view(system.directory.native()), optional(overview.begin_ns), optional(overview.end_ns),
                  number(overview.events), number(overview.lost_events()), number(overview.lost_packets()),
                  text(system.error), number(system.others.size())});
          }};
}

bool is_complete(const TracedSystem& system) {
  return system.error.empty() && system.open.empty() && system.results.overview.losses.empty() &&
         system.verdict.absences.empty() && system.verdict.lost_packets == 0;
}

Table verdict_table(const TracedSystem& system) {
  return {"verdict",
          "one row: whether the trace has all that was to be recorded, and the cost of tracing",
          {{"complete", kInteger, "1: nothing is known to be missing; `remarks` and `losses` say what is"},
           {"discarded_events", kInteger, "by the tracer, as the verdict of the recording counts them"},
           {"ns_per_event", kReal, "measured on the machine of the recording"}},
          [&system](const Emit& emit) {
            emit({number(is_complete(system) ? 1 : 0), number(system.verdict.discarded_events),
                  optional(system.verdict.ns_per_event)});
          }};
}

Table remark_table(const TracedSystem& system) {
  return {"remarks",
          "sentences about what is missing or doubtful",
          {{"kind", kText,
            "`absent`, `overwritten`, `open` (a directory that was still being written), `recording` (what the version "
            "of ros2_tracing does not tell) or `warning`"},
           {"text", kText, ""}},
          [&system](const Emit& emit) {
            for (const std::string& absence : system.verdict.absences) {
              emit({std::string_view("absent"), std::string_view(absence)});
            }
            for (const std::string& overwritten : system.verdict.overwritten) {
              emit({std::string_view("overwritten"), std::string_view(overwritten)});
            }
            for (const std::filesystem::path& open : system.open) {
              emit({std::string_view("open"), std::string_view(open.native())});
            }
            for (const std::string& remark : system.results.ros2.remarks) {
              emit({std::string_view("recording"), std::string_view(remark)});
            }
            for (const std::string& warning : system.results.warnings) {
              emit({std::string_view("warning"), std::string_view(warning)});
            }
          }};
}

Table finding_table(const TracedSystem& system) {
  return {"findings",
          "what is most worth a look, from the one most worth it",
          {{"id"},
           {"kind", kText, "as in `docs/report_format.md`"},
           {"weight", kReal, "how much it is worth a look: 0 to 100"},
           {"subject", kText, "what it is about: a text, which may change"},
           {"figures", kText, "likewise"},
           {"callback", kInteger, "in `callbacks`, if it is about one"}},
          [&system](const Emit& emit) {
            std::int64_t id = 0;
            for (const Finding& finding : find_worth_a_look(system.results)) {
              emit({id++, std::string_view(finding.name()), finding.weight, text(finding.subject),
                    text(finding.figures), optional(finding.callback)});
            }
          }};
}

Table host_table(const TracedSystem& system) {
  return {"hosts",
          "the machines",
          {{"id"}, {"name", kText, "as in `processes`"}, {"processes", kInteger, "in the trace"}},
          [&system](const Emit& emit) {
            std::map<std::string_view, std::int64_t> hosts;
            for (const timeline::Process& process : system.timeline.processes) {
              if (!process.host.empty()) {
                ++hosts[process.host];
              }
            }
            std::int64_t id = 0;
            for (const auto& [name, processes] : hosts) {
              emit({id++, name, processes});
            }
          }};
}

Table count_table(const TracedSystem& system) {
  return {"event_counts",
          "",
          {{"vpid", kInteger, "`NULL` for the launcher's own events"}, {"event", kText, ""}, {"events", kInteger, ""}},
          [&overview = system.results.overview](const Emit& emit) {
            for (const EventCount& event : overview.event_counts) {
              if (event.name.starts_with("launch:")) {
                emit({Cell(), std::string_view(event.name), number(event.total)});
              }
              for (std::size_t process = 0; process < event.by_process.size(); ++process) {
                if (event.by_process[process] == 0) {
                  continue;
                }
                emit({optional(overview.processes[process].vpid), std::string_view(event.name),
                      number(event.by_process[process])});
              }
            }
          }};
}

}  // namespace

void add_trace_tables(const TracedSystem& system, std::vector<Table>& tables) {
  tables.push_back(trace_table(system));
  tables.push_back(verdict_table(system));
  tables.push_back(remark_table(system));
  tables.push_back(finding_table(system));
  tables.push_back(result_table("losses", "of the tracer, one row for each stream that lost anything", system,
                                system.results.overview.losses));
  tables.push_back(count_table(system));
  tables.push_back(result_table("tracing_cost", "what tracing cost each process, as the verdict estimates it", system,
                                system.verdict.processes));
  tables.push_back(result_table("starts", "processes that the launcher started, when its events are in the trace",
                                system, system.results.starts));
  tables.push_back(result_table("launcher_events",
                                "what the launcher saw and did while the system ran, when its events are in the trace",
                                system, system.results.launcher_events));
  tables.push_back(host_table(system));
}

}  // namespace tracing
