// SPDX-License-Identifier: Apache-2.0
// Watches the processes of a launch whose spec says how, tells the supervisor of their health, and lets follow what the
// launch file asks for.
//
// All watches of an interval are looked at in the same turn of the loop, so that a thousand processes cost one timer.
// Time counts only while the launcher looks: when the machine was suspended, the launch was stopped by Ctrl-Z, or the
// launcher got no processor, the processes may have stood still, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/health/health_probe.hpp"
#include "launcher/health/progress_memory.hpp"
#include "launcher/process/process_supervisor.hpp"
#include "launcher/ros/ros_client.hpp"

namespace launch {

class HealthMonitor {
 public:
  struct Callbacks {
    // The process has become unhealthy, for this reason. The supervisor knows it already.
    std::function<void(ProcessId id, const HealthWatch& watch, const std::string& reason)> unhealthy;
    std::function<void(LogLevel level, const std::string& logger, const std::string& text)> tell;
  };

  // No look may be later than this; else the time before it does not count.
  static constexpr Duration kLatest = std::chrono::seconds(1);

  // The references must outlive this object.
  HealthMonitor(EventLoop& loop, ProcessSupervisor& supervisor, Callbacks callbacks)
      : loop_(loop), supervisor_(supervisor), callbacks_(std::move(callbacks)) {}

  // Watches of topics, services and life cycles need it. It must outlive this object.
  void use_ros_client(RosClient& client) { ros_client_ = &client; }

  // The process will start: from now on, its lines may be wanted.
  void expect(const ProcessSpec& spec);
  // To be called before the process with this number starts with a new spec, and before scopes change the spec.
  void prepare(ProcessSpec& spec, ProcessId id);
  void on_event(const ProcessEvent& event);
  void on_line(ProcessId id, OutputStream stream, std::string_view line);
  // Whether some watch wants lines.
  bool watch_output() const { return watches_output_; }
  // The launch ends: what its processes do is not judged any more.
  void shutdown();

 private:
  struct Watch {
    HealthWatch spec;
    std::unique_ptr<HealthProbe> probe;
    Look::Result state = Look::Result::kPending;
    std::string reason{};       // of kBad
    std::string noted{};        // in this run
    std::int64_t failures = 0;  // in a row
    Duration ran_for{0};        // as far as it counts
    Duration last{0};           // look, or the start
    Duration next{0};           // look
  };
  struct Watched {
    std::string label{};
    bool runs = false;
    Health health = Health::kUnwatched;
    std::vector<Watch> watches{};
  };

  // Sets the timer, if the look is due before.
  void wait_until(Duration time);
  // In make_probe.cpp. Throws std::system_error.
  std::unique_ptr<HealthProbe> make_probe(const HealthWatch& watch, ProcessSpec& spec, ProcessId id,
                                          std::size_t number);
  std::unique_ptr<HealthProbe> make_notify_probe(const HealthWatch& watch, bool watchdog, ProcessSpec& spec,
                                                 ProcessId id, std::size_t number);
  // Of a watch that is answered later.
  void answer(ProcessId id, std::size_t number, const Look& look);
  void begin(Watched& process, pid_t pid);
  static void end(Watched& process);
  void look();
  void look_at(Watched& process, Watch& watch, Duration now, bool counts);
  void judge(Watched& process, Watch& watch, const Look& look);
  bool may_judge(ProcessId id, const Watched& process) const;
  void conclude(ProcessId id, Watched& process);

  EventLoop& loop_;
  ProcessSupervisor& supervisor_;
  Callbacks callbacks_;
  RosClient* ros_client_ = nullptr;
  ProgressMemory memory_;
  std::map<ProcessId, Watched> processes_;
  bool watches_output_ = false;
  bool is_over_ = false;
  EventLoop::SourcePtr timer_;
  Duration due_{0};  // of the timer
  std::optional<Duration> said_late_;
};

}  // namespace launch
