// SPDX-License-Identifier: Apache-2.0
// The launcher's end of launch-ros-client. It starts the program when the first request comes, one program for each ROS
// graph, and exchanges messages with it over a socket (ros_protocol.hpp).
//
// The program has a session of its own, so that Ctrl-C does not reach it. It ends when its socket closes, and so also
// when the launcher is killed.
#pragma once

#include <sys/types.h>

#include <map>
#include <memory>
#include <string>

#include "launcher/ros/ros_client.hpp"

namespace launch {

class Namespaces;

class RosClientProcess final : public RosClient {
 public:
  // The loop must outlive it, and so must the namespaces in which the program runs, if there are any.
  explicit RosClientProcess(EventLoop& loop, std::string program = default_program(),
                            const Namespaces* namespaces = nullptr);
  ~RosClientProcess() override;  // waits for the programs to end, a second at most

  [[nodiscard]] EventLoop::SourcePtr ask(const RosRequest& request, const Environment& environment, Duration timeout,
                                         Done done) override;
  void close() override;

  // ../lib/launch/launch-ros-client, relative to the directory of this program.
  static std::string default_program();

 private:
  class Connection;
  class Ticket;

  EventLoop& loop_;
  std::string program_;
  const Namespaces* namespaces_;
  // The keys are the variables that choose the graph.
  std::map<Environment, std::shared_ptr<Connection>> connections_;
};

}  // namespace launch
