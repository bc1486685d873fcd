// SPDX-License-Identifier: Apache-2.0
// Answers the clients of a launch's control socket. Costs nothing while nobody asks.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/control/attachments.hpp"
#include "launcher/control/control_protocol.hpp"
#include "launcher/control/control_server.hpp"
#include "launcher/run/reload/reloads.hpp"

namespace launch {

class LaunchControl {
 public:
  // `listener` is the socket of the launch. It and all references must outlive this object. Throws std::system_error.
  LaunchControl(EventLoop& loop, int listener, ProcessSupervisor& supervisor, Steering& steering, LaunchFacts facts);
  ~LaunchControl();
  // Without this, a reload is refused. It must outlive this object.
  void use_reloads(Reloads& reloads);
  // Without this, processes can't be scaled. It must outlive this object.
  void use_scaling(Scaling& scaling) { scaling_ = &scaling; }
  LaunchControl(const LaunchControl&) = delete;
  LaunchControl& operator=(const LaunchControl&) = delete;

  // For LaunchService::observe_conditions().
  void on_condition(const ConditionEvent& event) { tell_followers(condition_line(event)); }

 private:
  using ClientId = ControlServer::ClientId;

  // What a client wants to hear of.
  struct Follower {
    bool events = false;
    bool output = false;
    Steering::Patterns processes;  // whose output; none: of all
    std::size_t dropped = 0;       // lines since its queue became full
  };

  void take(ClientId client, std::string_view line);
  std::string answer(ClientId client, ControlRequest request);
  void attach(ClientId client, const ControlRequest& request);
  std::string scale(const ControlRequest& request);
  std::string follow(ClientId client, ControlRequest request);
  void forget(ClientId client);
  void tell_dropped(ClientId client);
  void offer(ClientId client, Follower& follower, std::string_view line);
  void on_event(const ProcessEvent& event);
  void tell_followers(std::string_view line);
  void on_line(const ProcessSpec& spec, ProcessId id, const std::string& label, OutputStream stream,
               std::string_view line);
  void watch_output();
  std::size_t log_size() const;

  ProcessSupervisor& supervisor_;
  Steering& steering_;
  Reloads* reloads_ = nullptr;
  Scaling* scaling_ = nullptr;
  LaunchFacts facts_;
  std::map<ClientId, Follower> followers_;
  bool watches_output_ = false;
  ControlServer server_;
  Attachments attachments_;
};

}  // namespace launch
