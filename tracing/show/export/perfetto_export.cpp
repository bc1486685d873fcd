// SPDX-License-Identifier: Apache-2.0
// Chrome's trace event format, as far as Perfetto's trace processor reads it. Its times are microseconds. They count
// from what is first in the file, because a double can't hold microseconds since the epoch to the nanosecond, and
// because Perfetto reads the digits behind the point of a negative time as positive ones. There is no displayTimeUnit:
// former releases of Perfetto take it for the unit of all times. Ids are texts with hexadecimal numbers, because
// releases of 2022 end at an id that is a number.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "tracing/model/timeline/state_name.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"

namespace tracing {

namespace {

using timeline::Index;
using timeline::Instance;
using timeline::kNone;
using timeline::Message;
using timeline::ThreadState;
using timeline::Timeline;

std::string json_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

class PerfettoWriter {
 public:
  PerfettoWriter(const TracedSystem& system, const std::filesystem::path& file)
      : system_(system), timeline_(system.timeline), file_(file), origin_ns_(timeline_.begin_ns) {
    // Processes start before the first event.
    for (const StartResult& start : system_.results.starts) {
      origin_ns_ = std::min(origin_ns_, start.exec_ns);
    }
  }

  void write() {
    file_.write("{\"otherData\":");
    file_.write(nlohmann::json{{"directory", system_.directory.native()},
                               {"begin_ns", origin_ns_},
                               {"lost_events", system_.results.overview.lost_events()}}
                    .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    file_.write(",\"traceEvents\":[\n");
    choose_pids();
    write_names();
    write_starts();
    write_launcher_events();
    write_callbacks();
    write_messages();
    write_lifecycle();
    write_states();
    write_waiting();
    file_.write("\n]}\n");
    file_.finish();
  }

 private:
  // Takes the members of the event's object, without braces.
  void event(const std::string& members) {
    if (!first_) {
      file_.write(",\n");
    }
    first_ = false;
    file_.write("{");
    file_.write(members);
    file_.write("}");
  }

  static std::string microseconds(std::int64_t ns) { return fmt::format("{}.{:03}", ns / 1000, ns % 1000); }
  std::string time(std::int64_t ns) const { return microseconds(ns - origin_ns_); }

  std::string place(Index thread) const {
    const timeline::Thread& on = timeline_.threads[thread];
    return fmt::format("\"pid\":{},\"tid\":{}", pids_[on.process], on.vtid);
  }

  // Processes of two machines may have equal ids, which the format does not know.
  void choose_pids() {
    std::set<std::int64_t> taken;
    for (const timeline::Process& process : timeline_.processes) {
      std::int64_t pid = process.vpid;
      while (!taken.insert(pid).second) {
        pid += 1'000'000'000;
      }
      pids_.push_back(pid);
      several_hosts_ = several_hosts_ || process.host != timeline_.processes.front().host;
    }
  }

  void write_names() {
    for (std::size_t id = 0; id < timeline_.processes.size(); ++id) {
      const timeline::Process& process = timeline_.processes[id];
      event(fmt::format(R"("ph":"M","name":"process_name","pid":{},"args":{{"name":{}}})", pids_[id],
                        json_text(several_hosts_ ? process.host + " " + process.name : process.name)));
    }
    for (std::size_t id = 0; id < timeline_.threads.size(); ++id) {
      const timeline::Thread& thread = timeline_.threads[id];
      const bool is_main = thread.vtid == timeline_.processes[thread.process].vpid;
      event(fmt::format(R"("ph":"M","name":"thread_name",{},"args":{{"name":"{}"}})", place(static_cast<Index>(id)),
                        is_main ? "main thread" : "thread"));
    }
  }

  void instant(std::int64_t pid, std::int64_t ns, const std::string& name, const std::string& arguments) {
    event(fmt::format(R"("ph":"i","s":"p","cat":"start","name":{},"pid":{},"tid":{},"ts":{},"args":{{{}}})",
                      json_text(name), pid, pid, time(ns), arguments));
  }

  // Of the process on its own machine, if it recorded something.
  std::int64_t pid_of(const StartResult& start) const {
    for (std::size_t id = 0; start.place && id < timeline_.processes.size(); ++id) {
      if (timeline_.processes[id].place == start.place) {
        return pids_[id];
      }
    }
    return start.vpid;
  }

  void write_starts() {
    for (const StartResult& start : system_.results.starts) {
      const std::int64_t pid = pid_of(start);
      const std::string from = fmt::format("\"process\":{},\"file\":{},\"line\":{}", json_text(start.process),
                                           json_text(start.file), start.line);
      instant(pid, start.exec_ns, "exec", from);
      if (start.node_after_ns) {
        instant(pid, start.exec_ns + *start.node_after_ns, "first node", from);
      }
      if (start.ready_after_ns) {
        instant(pid, start.exec_ns + *start.ready_after_ns, "ready", from);
      }
    }
  }

  // Over all processes.
  void write_launcher_events() {
    for (const LauncherEventResult& one : system_.results.launcher_events) {
      if (!one.is_ordinary() && one.time_ns >= origin_ns_) {
        event(fmt::format(
            R"("ph":"i","s":"g","cat":"launcher","name":{},"pid":0,"tid":0,"ts":{},"args":{{"kind":"{}","file":{},"line":{}}})",
            json_text(one.subject + ": " + one.sentence()), time(one.time_ns), one.kind_name(), json_text(one.file),
            one.line));
      }
    }
  }

  std::string callback_name(const timeline::Callback& callback) const {
    switch (callback.owner) {
      case CallbackResult::Owner::kSubscription:
        return "subscription " + timeline_.topics[callback.topic];
      case CallbackResult::Owner::kTimer:
        return fmt::format("timer {} ms", static_cast<double>(callback.period_ns) / 1e6);
      case CallbackResult::Owner::kService:
        return "service " + callback.service;
      case CallbackResult::Owner::kClient:
        return "client of " + callback.service;
      case CallbackResult::Owner::kUnknown:
        break;
    }
    return fmt::format("callback {:#x}", callback.address);
  }

  void write_callbacks() {
    std::vector<std::string> descriptions;  // name and arguments of each callback
    for (const timeline::Callback& callback : timeline_.callbacks) {
      const std::string node = callback.node == kNone ? "" : timeline_.nodes[callback.node].name;
      descriptions.push_back(fmt::format(R"("name":{},"args":{{"node":{},"symbol":{})",
                                         json_text(callback_name(callback)), json_text(node),
                                         json_text(callback.symbol)));
    }
    for (const Instance& instance : timeline_.instances) {
      std::string more;
      if (!instance.finished) {
        more += R"(,"unfinished":true)";
      }
      if (instance.intra_process) {
        more += R"(,"intra_process":true)";
      }
      const std::int64_t duration = instance.end_ns - instance.start_ns;
      event(fmt::format(R"("ph":"X","cat":"callback",{},"ts":{},"dur":{},{}{}}})", place(instance.thread),
                        time(instance.start_ns), microseconds(duration), descriptions[instance.callback], more));
    }
  }

  void write_messages() {
    std::vector<std::string> names;
    for (const std::string& topic : timeline_.topics) {
      names.push_back(json_text(topic));
    }
    for (std::size_t id = 0; id < timeline_.messages.size(); ++id) {
      const Message& message = timeline_.messages[id];
      if (!message.repeated) {
        write_publication(message);
      }
      if (message.receiving_instance == kNone) {
        continue;
      }
      const Instance& receiver = timeline_.instances[message.receiving_instance];
      const std::string flow =
          fmt::format("\"cat\":\"message\",\"name\":{},\"id\":\"{:#x}\"", names[message.topic], id);
      event(fmt::format(R"("ph":"s",{},{},"ts":{})", flow, place(message.publishing_thread), time(message.called_ns)));
      event(fmt::format(R"("ph":"f","bp":"e",{},{},"ts":{})", flow, place(receiver.thread), time(receiver.start_ns)));
      const std::int64_t latency = receiver.start_ns - message.published_ns;
      event(fmt::format(R"("ph":"C","name":{},{},"ts":{},"args":{{"us":{:.3f}}})",
                        json_text("latency of " + timeline_.topics[message.topic]), place(receiver.thread),
                        time(receiver.start_ns), static_cast<double>(latency) / 1e3));
    }
  }

  // A flow needs a slice to begin in.
  void write_publication(const Message& message) {
    const std::int64_t duration = std::max<std::int64_t>(message.published_ns - message.called_ns, 1);
    event(fmt::format(R"("ph":"X","cat":"publish","name":{},{},"ts":{},"dur":{})",
                      json_text("publish " + timeline_.topics[message.topic]), place(message.publishing_thread),
                      time(message.called_ns), microseconds(duration)));
  }

  void write_lifecycle() {
    for (std::size_t id = 0; id < timeline_.lifecycle.size(); ++id) {
      const timeline::LifecycleState& interval = timeline_.lifecycle[id];
      const timeline::Node& node = timeline_.nodes[interval.node];
      const std::int64_t vpid = pids_[node.process];
      const std::string what = fmt::format(R"("cat":"lifecycle","id":"{:#x}","name":{},"pid":{},"tid":{})",
                                           interval.node, json_text(node.name + " " + interval.state), vpid, vpid);
      event(fmt::format(R"("ph":"b",{},"ts":{})", what, time(interval.begin_ns)));
      event(fmt::format(R"("ph":"e",{},"ts":{})", what, time(interval.end_ns)));
    }
  }

  // What a thread did on the machine stands in a row of its own below it.
  std::string state_place(Index thread) const {
    constexpr std::int64_t kNoThread = 2'000'000'000;  // above the numbers of threads
    return fmt::format("\"pid\":{},\"tid\":{}", pids_[timeline_.threads[thread].process], kNoThread + thread);
  }

  void write_states() {
    std::set<Index> named;
    for (const ThreadState& state : timeline_.states) {
      if (named.insert(state.thread).second) {
        event(fmt::format(R"("ph":"M","name":"thread_name",{},"args":{{"name":"thread {} on the machine"}})",
                          state_place(state.thread), timeline_.threads[state.thread].vtid));
      }
      std::string more = fmt::format("\"cpu\":{}", state.cpu);
      if (state.other != kNone) {
        const timeline::OtherThread& other = timeline_.other_threads[state.other];
        more += fmt::format(",\"ran_instead\":{}", json_text(fmt::format("{} [{}]", other.name, other.tid)));
      }
      const std::int64_t duration = state.end_ns - state.begin_ns;
      event(fmt::format(R"("ph":"X","cat":"state","name":"{}",{},"ts":{},"dur":{},"args":{{{}}})",
                        timeline::state_name(state.state), state_place(state.thread), time(state.begin_ns),
                        microseconds(duration), more));
    }
  }

  // How many threads of a process wait for a processor.
  void write_waiting() {
    std::multimap<std::int64_t, std::pair<Index, int>> changes;  // by time: the process, one more or one less
    for (const ThreadState& state : timeline_.states) {
      if (state.state != ThreadState::State::kRunnable) {
        continue;
      }
      const Index process = timeline_.threads[state.thread].process;
      changes.insert({state.begin_ns, {process, 1}});
      changes.insert({state.end_ns, {process, -1}});
    }
    std::map<Index, int> waiting;
    for (const auto& [ns, change] : changes) {
      const auto& [process, more] = change;
      waiting[process] += more;
      event(
          fmt::format(R"("ph":"C","name":"threads that wait for a processor","pid":{},"ts":{},"args":{{"threads":{}}})",
                      pids_[process], time(ns), waiting[process]));
    }
  }

  const TracedSystem& system_;
  const Timeline& timeline_;
  OutputFile file_;
  std::int64_t origin_ns_;
  std::vector<std::int64_t> pids_;  // of the processes
  bool several_hosts_ = false;
  bool first_ = true;
};

}  // namespace

void export_perfetto(const TracedSystem& system, const std::filesystem::path& file) {
  PerfettoWriter(system, file).write();
}

}  // namespace tracing
