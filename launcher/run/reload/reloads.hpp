// SPDX-License-Identifier: Apache-2.0
// Reads the launch file of a launch that runs again, and makes the launch what the file says now.
//
// A reload is done whole or not at all: a file with an error changes nothing. What is gone ends first; what is new
// starts when that has ended, because it may need the same device. A reload that is asked for while another one is at
// work, or while the launch still starts, waits for its turn.
//
// What event handlers have started is left alone. The trace goes on as it began.
#pragma once

#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "launcher/process/event_loop.hpp"
#include "launcher/process/process_event.hpp"
#include "launcher/ros/ros_client.hpp"
#include "launcher/run/handlers/handlers.hpp"
#include "launcher/run/handlers/timers.hpp"
#include "launcher/run/reload/file_reading.hpp"
#include "launcher/run/reload/known_components.hpp"
#include "launcher/run/reload/reload_plan.hpp"
#include "launcher/run/reload/reload_report.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/run/start/rounds.hpp"
#include "launcher/run/user/scaling.hpp"
#include "launcher/run/user/steering.hpp"
#include "launcher/visit/launch_context.hpp"

namespace launch {

class Reloads {
 public:
  // A node that has not answered after this time is started again instead.
  static constexpr Duration kPatience = std::chrono::seconds(5);

  struct Parts {
    LaunchContext& context;
    EventLoop& loop;
    ProcessSupervisor& supervisor;
    Processes& processes;
    Handlers& handlers;
    Timers& timers;
    Steering& steering;
    Scaling& scaling;
    RosTasks& ros_tasks;
  };
  struct Callbacks {
    std::function<bool()> quiet;                       // nothing is being started or visited
    std::function<void(Requests requests)> carry_out;  // calls note() for them
    std::function<void(const LaunchError&)> tell_error;
    std::function<void()> idle;  // the launch may have nothing left to run
  };
  struct Wish {
    bool only_show = false;
    bool restart = false;  // nodes whose parameters have changed are started again
  };

  Reloads(Parts parts, Callbacks callbacks)
      : parts_(parts), callbacks_(std::move(callbacks)), components_(parts.ros_tasks) {}

  // Without this, no reload is possible.
  void use(FileReading::Load load) { load_ = std::move(load); }
  // Called with each report, and with the end of each reload that was carried out.
  void observe(std::function<void(const ReloadReport&)> report, std::function<void(const ReloadEnd&)> end) {
    observers_.push_back({std::move(report), std::move(end)});
  }

  // Its report comes in a later turn of the loop.
  ReloadNumber ask(Wish wish);
  // What was asked for last has not begun: another wish without a number would do the same.
  bool has_queued() const { return !queue_.empty(); }

  // For the service: the first requests of the file, before they are carried out; then what timers of the file ask for.
  void note(const Round& round);
  void note(const Invocation& invocation) { handled_.note(*invocation.handler); }
  void on_event(const ProcessEvent& event);
  // Whether a reload has asked for this end, so that no handler shall react to it.
  bool has_asked_for(const ProcessEvent& event) const;
  // To be called when something has started or was visited.
  void proceed();
  void shutdown();
  bool idle() const { return !work_ && queue_.empty(); }

 private:
  struct Observer {
    std::function<void(const ReloadReport&)> report;
    std::function<void(const ReloadEnd&)> end;
  };
  struct Queued {
    ReloadNumber number;
    Wish wish;
  };
  // A reload that is being carried out.
  struct Work {
    ReloadEnd end;
    std::map<ProcessId, std::string> ending;      // processes that are gone, by their labels
    std::map<ProcessId, std::string> restarting;  // those that start again
    std::optional<Requests> rest;                 // what begins when those that are gone have ended
  };
  struct Setting {
    ProcessId id;
    std::string label;
    EventLoop::SourcePtr answer;
  };

  void begin();
  void reload(const Queued& queued);
  ReloadReport report_of(const Queued& queued, const ReloadPlan& plan, const Requests& requests) const;
  void carry_out(ReloadNumber number, ReloadPlan plan, FileReading& reading);
  void end_process(TrackedProcess& process);
  void restart(ProcessId id, const std::string& label);
  void set_parameters(const PlannedProcess& planned, const DeclaredProcess& declared, const Environment& environment);
  void go_on();
  void refuse(ReloadReport& report, const LaunchError& error);
  void say(const ReloadReport& report) const;
  void tell(const ReloadReport& report);

  Parts parts_;
  Callbacks callbacks_;
  FileReading::Load load_;
  std::vector<Observer> observers_;
  ReloadNumber last_ = 0;
  std::deque<Queued> queue_;
  bool posted_ = false;
  bool shut_down_ = false;
  std::optional<Duration> began_;  // the launch, nothing yet
  std::vector<KnownProcess> known_;
  std::vector<std::string> traces_;
  std::size_t coroutines_ = 0;
  KnownComponents components_;
  HandledOnce handled_;
  std::optional<Work> work_;
  std::list<Setting> settings_;
};

}  // namespace launch
