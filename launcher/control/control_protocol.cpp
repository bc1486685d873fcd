// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/control_protocol.hpp"

#include <fmt/format.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "base/diagnostics/diagnostic.hpp"
#include "base/processes/outside_number.hpp"
#include "base/text/base64.hpp"
#include "launcher/control/control_groups_text.hpp"

namespace launch {
namespace {

using Json = nlohmann::ordered_json;

// Names and lines of programs may hold any bytes.
std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Appends the text in quotes. What is no UTF-8 is replaced. JSON written as text takes a fraction of the time of a tree
// of values, which counts where there are thousands.
void append_json_string(std::string& to, std::string_view text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char byte) {
    return byte >= ' ' && byte < '\x7f' && byte != '"' && byte != '\\';  // a byte above 127 may be negative
  });
  if (plain) {
    to.append(1, '"').append(text).append(1, '"');
  } else {
    to += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
}

double seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

double seconds(const timeval& time) {
  constexpr std::int64_t kMicroseconds = 1'000'000;
  return static_cast<double>(time.tv_sec * kMicroseconds + time.tv_usec) / static_cast<double>(kMicroseconds);
}

// Seconds since 1970, to the microsecond.
double now() {
  constexpr double kNanoseconds = 1e9;
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec / 1000 * 1000) / kNanoseconds;
}

std::string signal_name(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name == nullptr ? std::to_string(signal) : fmt::format("SIG{}", name);
}

void put_end(Json& json, const ProcessExit& exit) {
  if (exit.code < 0) {
    json["signal"] = signal_name(-exit.code);
  } else {
    json["exit_code"] = exit.code;
  }
  if (exit.out_of_memory) {
    json["out_of_memory"] = true;
  }
  if (exit.lost) {
    json["lost"] = true;
  }
  json["ran_for"] = seconds(exit.ran_for);
}

void append_place(std::string& text, const SourceRange& range) {
  if (!range) {
    text += "null";
    return;
  }
  const SourceFile::Position position = range.file->position(range.begin);
  text += "{\"file\":";
  append_json_string(text, range.file->path());
  fmt::format_to(std::back_inserter(text), ",\"line\":{},\"column\":{}}}", position.line, position.column);
}

const char* state_name(ProcessState state) {
  switch (state) {
    case ProcessState::kStarting:
      return "starting";
    case ProcessState::kRunning:
      return "running";
    case ProcessState::kInterrupting:
    case ProcessState::kTerminating:
    case ProcessState::kKilling:
      return "stopping";
    case ProcessState::kRespawnDelay:
      return "respawning";
    case ProcessState::kDone:
      return "ended";
  }
  return "";
}

void append_process(std::string& text, const SteeredProcess& process, const ProcessSupervisor& supervisor) {
  const auto to = std::back_inserter(text);
  text += "{\"name\":";
  append_json_string(text, process.name);
  text += ",\"names\":[";
  for (const std::string& name : process.names) {
    text += &name == &process.names.front() ? "" : ",";
    append_json_string(text, name);
  }
  text += ']';
  if (!process.groups.empty()) {
    text += ",\"groups\":" + dump(Json(process.groups));
  }
  text += process.scalable ? ",\"scalable\":true" : "";
  text += process.tty ? ",\"tty\":true" : "";
  if (process.id == 0) {
    fmt::format_to(to, ",\"state\":\"{}\"", process.waits ? "waiting" : "skipped");
  } else {
    const ProcessView view = supervisor.view(process.id);
    fmt::format_to(to, ",\"state\":\"{}\"", state_name(view.state));
    const std::string& machine = view.spec.machine;
    if (!machine.empty()) {
      text += ",\"machine\":";
      append_json_string(text, machine);
      text += process.away ? ",\"away\":true" : "";
    }
    if (view.pid >= 0) {
      // Who reads "pid" looks for the process here.
      fmt::format_to(to, ",\"{}\":{},\"running_for\":{}", machine.empty() ? "pid" : "pid_there",
                     machine.empty() ? number_outside(view.pid) : view.pid, seconds(view.running_for));
      if (view.health != Health::kUnwatched) {
        fmt::format_to(to, ",\"health\":\"{}\"", name_of(view.health));
        if (!view.health_reason.empty()) {
          text += ",\"health_reason\":";
          append_json_string(text, view.health_reason);
        }
      }
      if (!view.status.empty()) {
        text += ",\"status\":";
        append_json_string(text, view.status);
      }
      if (const std::string& group = view.spec.limits.control_group; !group.empty()) {
        text += control_groups_text(group);
      }
    }
    fmt::format_to(to, ",\"restarts\":{}", view.runs > 0 ? view.runs - 1 : 0);
    if (view.last_exit) {
      Json end = Json::object();
      put_end(end, *view.last_exit);
      text += ",\"last_end\":" + dump(end);
    }
  }
  text += ",\"place\":";
  append_place(text, process.origin);
  text += '}';
}

Json describe(const LaunchFacts& facts, bool ending) {
  Json json = {{"pid", facts.pid},
               {"state", ending ? "ending" : "running"},
               {"files", facts.files},
               {"command", facts.command},
               {"directory", facts.directory},
               {"started", facts.started},
               {"running_for", seconds(std::chrono::steady_clock::now() - facts.started_at)},
               {"log_directory", facts.log_directory},
               {"log_file", facts.log_file}};
  if (!facts.isolation.empty()) {
    json["isolation"] = facts.isolation;
  }
  return json;
}

struct EventWriter {
  Json& json;

  void operator()(const ProcessStarted& started) const {
    json["event"] = "started";
    json["pid"] = number_outside(started.pid);
  }
  void operator()(const ProcessStartFailed& failed) const {
    json["event"] = "start_failed";
    json["error"] = failed.reason;
    json["will_respawn"] = failed.will_respawn;
  }
  void operator()(const ProcessExited& exited) const {
    json["event"] = "exited";
    json["pid"] = number_outside(exited.pid);
    put_end(json, exited.exit);
    json["expected"] = exited.expected;
    json["will_respawn"] = exited.will_respawn;
    timeval cpu{};
    timeradd(&exited.exit.usage.ru_utime, &exited.exit.usage.ru_stime, &cpu);
    json["cpu"] = seconds(cpu);
  }
  void operator()(const SignalSent& sent) const {
    json["event"] = "signalled";
    json["signal"] = signal_name(sent.signal);
  }
  void operator()(const SchedulingChanged& change) const {
    json["event"] = "scheduling";
    json["to"] = change.to;
    if (!change.failure.empty()) {
      json["error"] = change.failure;
    }
  }
  void operator()(const ProcessLeft& left) const {
    json["event"] = "left_running";
    json["pid"] = number_outside(left.pid);
  }
  void operator()(const RespawnSlowed& slowed) const {
    json["event"] = "respawn_slowed";
    json["runs"] = slowed.runs;
  }
  void operator()(const ProcessWaitsForTerminal& waits) const {
    json["event"] = "waits_for_terminal";
    json["pid"] = number_outside(waits.pid);
  }
  void operator()(const HealthChanged& change) const {
    json["event"] = "health";
    json["health"] = name_of(change.health);
    if (!change.reason.empty()) {
      json["reason"] = change.reason;
    }
  }
  void operator()(const StartLimitReached& reached) const {
    json["event"] = "start_limit";
    json["starts"] = reached.starts;
    json["within"] = seconds(reached.within);
    if (reached.cool_down) {
      json["next_start_in"] = seconds(*reached.cool_down);
    }
  }
  void operator()(const ProcessDone&) const { json["event"] = "done"; }
};

}  // namespace

std::string error_line(std::string_view error, std::string_view help) {
  Json json{{"version", kControlVersion}, {"ok", false}, {"error", error}};
  if (!help.empty()) {
    json["help"] = help;
  }
  return dump(json);
}

std::string info_line(const LaunchFacts& facts, bool ending) {
  return dump({{"version", kControlVersion}, {"ok", true}, {"launch", describe(facts, ending)}});
}

std::string ps_line(const LaunchFacts& facts, bool ending, const std::vector<SteeredProcess>& processes,
                    const ProcessSupervisor& supervisor) {
  constexpr std::size_t kUsualProcess = 256;
  std::string line = info_line(facts, ending);
  line.reserve(line.size() + processes.size() * kUsualProcess);
  line.pop_back();
  line += ",\"processes\":[";
  for (const SteeredProcess& process : processes) {
    line += &process == &processes.front() ? "" : ",";
    append_process(line, process, supervisor);
  }
  line += "]}";
  return line;
}

std::string outcome_line(const SteeringOutcome& outcome) {
  if (!outcome.error.empty()) {
    return error_line(outcome.error, outcome.help);
  }
  return dump({{"version", kControlVersion},
               {"ok", true},
               {"done", outcome.done},
               {"dropped", outcome.dropped},
               {"refused", outcome.refused}});
}

std::string done_line() {
  return dump({{"version", kControlVersion}, {"ok", true}});
}

std::string follow_line(std::size_t log_size) {
  return dump({{"version", kControlVersion}, {"ok", true}, {"log_size", log_size}});
}

std::string event_line(const ProcessEvent& event) {
  Json json{{"time", now()}, {"event", ""}, {"process", event.label}};
  if (!event.spec.machine.empty()) {
    json["machine"] = event.spec.machine;
  }
  std::visit(EventWriter{json}, event.what);
  return dump(json);
}

std::string ending_line(const std::string& reason) {
  return dump({{"time", now()}, {"event", "ending"}, {"reason", reason}});
}

std::string condition_line(const ConditionEvent& event) {
  using Kind = tracing::LiveCondition::Kind;
  const tracing::LiveCondition& condition = event.condition;
  Json place;
  if (event.where) {
    const SourceFile::Position position = event.where.file->position(event.where.begin);
    place = {{"file", event.where.file->path()}, {"line", position.line}, {"column", position.column}};
  }
  Json json{{"time", now()},
            {"event", "condition"},
            {"condition", tracing::describe(condition)},
            {tracing::name_of(condition.subject), condition.name},
            {"holds", event.change.holds}};
  if (is_of_process(condition)) {
    if (event.change.holds) {
      json[condition.kind == Kind::kMemory   ? "memory"
           : condition.kind == Kind::kGrowth ? "growth"
                                             : "processor"] = event.change.figure;
    }
  } else if (condition.kind == Kind::kSilence || condition.kind == Kind::kRate) {
    json[condition.kind == Kind::kSilence ? "silent_for" : "rate"] = event.change.figure;
  } else if (event.change.holds) {
    const bool is_loss = condition.kind == Kind::kLoss;
    json[is_loss ? "lost" : "took"] = event.change.figure;
    json[is_loss ? "lost_share" : "late"] = event.change.late;
  }
  json["processes"] = event.change.processes;
  json["place"] = place;
  return dump(json);
}

std::string output_line(const std::string& process, OutputStream stream, std::string_view text) {
  return dump({{"time", now()},
               {"event", "output"},
               {"process", process},
               {"stream", stream == OutputStream::kOut ? "stdout" : "stderr"},
               {"line", text}});
}

std::string dropped_line(std::size_t lines) {
  return dump({{"time", now()}, {"event", "dropped"}, {"lines", lines}});
}

std::string attached_line(const std::string& process, const std::string& terminal, std::size_t clients) {
  return dump(
      {{"version", kControlVersion}, {"ok", true}, {"process", process}, {"terminal", terminal}, {"clients", clients}});
}

std::string taken_line(std::size_t bytes) {
  return dump({{"version", kControlVersion}, {"ok", true}, {"taken", bytes}});
}

std::string terminal_line(std::string_view bytes) {
  return fmt::format("{{\"event\":\"terminal\",\"data\":\"{}\"}}", to_base64(bytes));
}

std::string terminal_dropped_line(std::size_t bytes) {
  return dump({{"event", "terminal_dropped"}, {"bytes", bytes}});
}

std::string terminal_ended_line(const std::string& process, const ProcessExited* exited) {
  Json json{{"time", now()}, {"event", "terminal_ended"}, {"process", process}};
  if (exited != nullptr) {
    put_end(json, exited->exit);
    json["will_respawn"] = exited->will_respawn;
  }
  return dump(json);
}

}  // namespace launch
