// SPDX-License-Identifier: Apache-2.0
// How many of a process run: `launch scale`. Copies of a process that the launch file declares scalable start and end.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "launcher/process/process_supervisor.hpp"
#include "launcher/run/start/processes.hpp"
#include "launcher/run/user/steering.hpp"
#include "launcher/visit/requests.hpp"

namespace launch {

class Scaling {
 public:
  static constexpr std::size_t kMost = 1000;  // processes of one name

  // Starts the processes of the requests, which no reading of the launch file is compared with.
  using Start = std::function<void(Requests requests)>;

  // The references must outlive this object.
  Scaling(ProcessSupervisor& supervisor, Processes& processes, Start start)
      : supervisor_(supervisor), processes_(processes), start_(std::move(start)) {}

  // Lets `count` of the process run, itself included: starts copies, or ends the last ones. `done` are the labels of
  // those that end and the names of those that start. Nothing is done if there is an error: nobody or several have the
  // name, it is not scalable, it waits for its start.
  SteeringOutcome scale(const std::string& name, std::size_t count);

  // Another reading of the launch file has ended a process, or starts it anew with this spec: its copies follow.
  void end_copies(const TrackedProcess& of);
  void replace_copies(const TrackedProcess& of);

 private:
  void end(TrackedProcess& copy);

  ProcessSupervisor& supervisor_;
  Processes& processes_;
  Start start_;
  std::map<const TrackedProcess*, std::vector<TrackedProcess*>> copies_;  // by the process of the launch file
};

// The copy with this number, from 2 on, of a process: name, node and the parameters of the node have "_2" behind them.
// LAUNCH_INSTANCE in its environment is the number.
ProcessSpec copy_of(const ProcessSpec& spec, std::size_t number);

}  // namespace launch
