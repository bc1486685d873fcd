// SPDX-License-Identifier: Apache-2.0
// The connections of a launch to other machines.
#pragma once

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "launcher/machines/machine_connection.hpp"
#include "launcher/traced/machine_recorder.hpp"
#include "launcher/visit/machines.hpp"

namespace launch {

// A thread of its own tells the agents that the launcher is there, because a visit may keep the loop busy: a function
// of a Python launch file takes as long as it wants.
class MachineConnections : public MachineConnector, public MachineRecorders {
 public:
  // The loop must outlive the connections. `tell` gets what is to be told of machines while the launch runs.
  MachineConnections(EventLoop& loop, std::string launch_version, MachineConnection::Tell tell);
  // Asks all agents to end what is left, and waits for them.
  ~MachineConnections() override;
  MachineConnections(const MachineConnections&) = delete;
  MachineConnections& operator=(const MachineConnections&) = delete;

  void connect(const MachineDeclaration& machine) override;
  std::shared_ptr<MachineView> await(const MachineDeclaration& machine) override;
  MachineRecorders* recorders() override { return this; }
  std::vector<std::string> connected() const override;
  std::unique_ptr<MachineRecorder> recorder(const std::string& machine) override;

  // The observer gets each machine whose connection is lost while the loop runs, for good or for now.
  void observe_losses(std::function<void(const LostMachine&)> observer) { observe_losses_ = std::move(observer); }
  // The observer gets each machine to which there is a connection again.
  void observe_returns(std::function<void(const ReturnedMachine&)> observer) { observe_returns_ = std::move(observer); }

  // Null if there was never a connection to the machine.
  RemoteRuns* runs(const std::string& machine);
  // Whether its connection is cut, and is to be made again.
  bool is_away(const std::string& machine) const;
  // The launch ends: a machine that is away is tried for a few seconds more.
  void expect_end();
  // The launcher is stopped from now on, or goes on (Ctrl-Z).
  void suspend(bool stops);

 private:
  struct Machine;

  void ping_all();

  EventLoop& loop_;
  std::string launch_version_;
  MachineConnection::Tell tell_;
  std::function<void(const LostMachine&)> observe_losses_;
  std::function<void(const ReturnedMachine&)> observe_returns_;

  std::mutex mutex_;  // of what follows: the thread reads it
  std::map<std::string, std::unique_ptr<Machine>> machines_;
  bool ends_ = false;
  std::condition_variable wake_;
  Duration between_pings_{0};
  std::thread pings_;
};

}  // namespace launch
