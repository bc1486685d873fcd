// SPDX-License-Identifier: Apache-2.0
// The launcher's end of launch-ros-client: starts the program when the first request comes, one for each ROS graph that
// requests are about, and talks to it over a socket (ros_protocol.hpp).
//
// The program has a session of its own, so that Ctrl-C does not reach it, and goes when its socket closes, hence also
// when the launcher is killed.
#pragma once

#include <sys/types.h>

#include <map>
#include <memory>
#include <string>

#include "launcher/ros/ros_client.hpp"

namespace launch {

class RosClientProcess final : public RosClient {
 public:
  // The loop must outlive it.
  explicit RosClientProcess(EventLoop& loop, std::string program = default_program());
  ~RosClientProcess() override;  // waits for the programs to end, a second at most

  [[nodiscard]] EventLoop::SourcePtr ask(const RosRequest& request, const Environment& environment, Duration timeout,
                                         Done done) override;
  void close() override;

  // ../lib/launch/launch-ros-client, seen from the directory of this program.
  static std::string default_program();

 private:
  class Connection;
  class Ticket;

  EventLoop& loop_;
  std::string program_;
  // By the variables that choose the graph.
  std::map<Environment, std::shared_ptr<Connection>> connections_;
};

}  // namespace launch
