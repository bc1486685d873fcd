// SPDX-License-Identifier: Apache-2.0
// Watches the messages of a topic through the ROS client.
#pragma once

#include <string>

#include "launcher/language/message_watch.hpp"
#include "launcher/ros/ros_client.hpp"

namespace launch {

class RosMessageWatch final : public MessageWatch {
 public:
  // The client may be null when nothing is watched, as in a dry run; otherwise it must outlive this object.
  // `environment` chooses the graph.
  RosMessageWatch(RosClient* client, WatchMessages request, Environment environment)
      : client_(client), request_(std::move(request)), environment_(std::move(environment)) {}

  void watch(EventLoop& loop, Report report) override;
  const std::string& topic() const override { return request_.topic; }
  const std::string& type() const override { return request_.type; }
  const std::string& condition() const override { return request_.condition; }

 private:
  RosClient* client_;
  WatchMessages request_;
  Environment environment_;
  EventLoop::SourcePtr watch_;
};

}  // namespace launch
