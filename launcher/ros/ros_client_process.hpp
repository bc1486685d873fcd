// SPDX-License-Identifier: Apache-2.0
// The launcher's end of launch-ros-client. It starts the program when the first request comes, one program for each ROS
// graph (line_program.hpp), and exchanges messages with it (ros_protocol.hpp).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "launcher/ros/ros_client.hpp"

namespace launch {

class Namespaces;

class RosClientProcess final : public RosClient {
 public:
  // The loop must outlive it, and so must the namespaces in which the program runs, if there are any. `program` is
  // for tests; empty: that of each request's environment (ros_program.hpp).
  explicit RosClientProcess(EventLoop& loop, const Namespaces* namespaces = nullptr, std::string program = {});
  ~RosClientProcess() override;  // waits for the programs to end, a second at most

  [[nodiscard]] EventLoop::SourcePtr ask(const RosRequest& request, const Environment& environment, Duration timeout,
                                         Done done) override;
  void close() override;

 private:
  class Connection;
  class Ticket;

  EventLoop& loop_;
  std::string program_;
  const Namespaces* namespaces_;
  // The keys are the program and the variables that choose the graph.
  std::map<std::pair<std::string, Environment>, std::shared_ptr<Connection>> connections_;
};

}  // namespace launch
