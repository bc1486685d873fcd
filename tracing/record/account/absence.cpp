// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/absence.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/text/names.hpp"
#include "tracing/decode/ctf/metadata_text.hpp"
#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/record/account/stream_packets.hpp"
#include "tracing/record/plan/ros_events.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostToldOf = 5;  // processes
constexpr const char* kPythonEvent = "lttng_python:event";
constexpr const char* kLaunchEvents = "launch:*";  // the launcher's own

std::string some_events(std::uint64_t count) {
  return fmt::format("{} event{}", count, count == 1 ? "" : "s");
}

std::string describe(const EventCounts& process) {
  const std::string label = fmt::format("{} [{}]", process.process, process.pid);
  if (process.reached == 0) {
    return fmt::format("{} was never registered with the session daemon: {} that it fired {} missing", label,
                       some_events(process.missed), process.missed == 1 ? "is" : "are");
  }
  const double seconds = to_seconds(process.reached - process.begin);
  return fmt::format("{} is recorded from {:.1f} s after its start on: {} that it fired before {} missing", label,
                     seconds, some_events(process.missed), process.missed == 1 ? "is" : "are");
}

std::vector<std::string> ros_event_names() {
  std::vector<std::string> names;
  for (const RosEvent& event : all_ros_events()) {
    names.push_back(event.name);
  }
  return names;
}

std::vector<Absence> absent_launcher(const RecordedEvents& events, const std::set<std::string>& declared) {
  const bool wanted = std::any_of(events.rules.begin(), events.rules.end(),
                                  [](const RecordedEvents::Rule& rule) { return rule.pattern == kLaunchEvents; });
  const bool there = std::any_of(declared.begin(), declared.end(),
                                 [](const std::string& name) { return name.starts_with("launch:"); });
  if (!wanted || there) {
    return {};
  }
  return {{.text = "the launcher's own events are missing: the session daemon had not registered the launcher when the "
                   "launch ended",
           .is_loss = true}};
}

std::string did_you_mean(const std::string& pattern, const std::vector<std::string>& names) {
  const std::string nearest = launch::nearest_name(pattern, names);
  return nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest);
}

}  // namespace

std::vector<Absence> absent_processes(const std::vector<EventCounts>& counts) {
  std::vector<const EventCounts*> absent;
  for (const EventCounts& process : counts) {
    if (process.missed != 0) {
      absent.push_back(&process);
    }
  }
  std::stable_sort(absent.begin(), absent.end(),
                   [](const EventCounts* a, const EventCounts* b) { return a->missed > b->missed; });
  std::vector<Absence> absences;
  for (std::size_t i = 0; i < std::min(absent.size(), kMostToldOf); ++i) {
    absences.push_back({.text = describe(*absent[i]), .is_loss = true});
  }
  if (absent.size() > kMostToldOf) {
    std::uint64_t missed = 0;
    for (std::size_t i = kMostToldOf; i < absent.size(); ++i) {
      missed += absent[i]->missed;
    }
    absences.push_back(
        {.text = fmt::format(
             "{} more recorded late or never: {} missing",
             absent.size() - kMostToldOf == 1 ? "1 process" : fmt::format("{} processes", absent.size() - kMostToldOf),
             some_events(missed)),
         .is_loss = true});
  }
  return absences;
}

std::vector<Absence> absent_from_snapshot(const std::vector<EventCounts>& counts, const std::vector<Stream>& streams) {
  std::vector<Absence> absences;
  for (const EventCounts& process : counts) {
    const bool is_there = std::any_of(streams.begin(), streams.end(),
                                      [&process](const Stream& stream) { return stream.pid == process.pid; });
    if (is_there || process.events.empty()) {
      continue;
    }
    absences.push_back({.text = fmt::format("{} [{}] had ended, and its buffers with it: its events are not in the "
                                            "snapshot",
                                            process.process, process.pid),
                        .is_loss = true});
  }
  return absences;
}

std::optional<std::set<std::string>> declared_events(const fs::path& recording) {
  std::set<std::string> names;
  std::error_code error;
  fs::recursive_directory_iterator entry(recording, error);
  for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
    if (entry->path().filename() != "metadata") {
      continue;
    }
    try {
      for (const ctf::EventDeclaration& event : ctf::parse_metadata(ctf::read_metadata(entry->path())).events) {
        names.insert(event.name);
      }
    } catch (const ctf::UnsupportedTrace&) {
      return std::nullopt;
    }
  }
  return names;
}

std::vector<Absence> absent_events(const RecordedEvents& events, const std::set<std::string>& declared,
                                   bool nothing_to_record) {
  std::vector<Absence> absences = absent_launcher(events, declared);
  if (events.python && !declared.contains(kPythonEvent)) {
    absences.push_back(
        {"no Python program that ran tells LTTng what it logs: it has to import lttngust, of package "
         "python3-lttngust"});
  }
  std::vector<const RecordedEvents::Rule*> rules;
  for (const RecordedEvents::Rule& rule : events.rules) {
    if (!is_our_own(rule.pattern)) {
      rules.push_back(&rule);
    }
  }
  if (rules.empty()) {
    return absences;
  }
  std::vector<std::string> names = ros_event_names();
  names.insert(names.end(), declared.begin(), declared.end());
  const auto takes_one_of = [](const RecordedEvents::Rule& rule, const auto& candidates) {
    return std::any_of(candidates.begin(), candidates.end(),
                       [&rule](const std::string& name) { return !is_our_own(name) && rule.takes(name); });
  };
  const bool nothing = !(events.python && declared.contains(kPythonEvent)) &&
                       std::none_of(rules.begin(), rules.end(),
                                    [&](const RecordedEvents::Rule* rule) { return takes_one_of(*rule, declared); });
  std::set<std::string> told;
  bool has_known_rule = false;
  for (const RecordedEvents::Rule* rule : rules) {
    if (takes_one_of(*rule, names)) {
      has_known_rule = true;
    } else if (told.insert(rule->pattern).second) {
      absences.push_back({fmt::format("no program that ran has an event '{}'{}", rule->pattern,
                                      did_you_mean(rule->pattern, ros_event_names()))});
    }
  }
  if (nothing && has_known_rule && !nothing_to_record) {
    absences.push_back(
        {"no userspace event was recorded: no program that ran has events of the session and was registered with "
         "the session daemon"});
  }
  return absences;
}

}  // namespace tracing
