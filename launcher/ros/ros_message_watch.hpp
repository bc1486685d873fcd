// SPDX-License-Identifier: Apache-2.0
// Watches the messages of a topic through the ROS client.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "launcher/language/message_watch.hpp"
#include "launcher/ros/ros_client.hpp"

namespace launch {

class RosMessageWatch final : public MessageWatch {
 public:
  // The client may be null when nothing is watched, as in a dry run; otherwise it must outlive this object.
  // `environment` chooses the graph.
  RosMessageWatch(RosClient* client, WatchMessages request, Environment environment)
      : client_(client), request_(std::move(request)), environment_(std::move(environment)) {}

  void watch(EventLoop& loop, Report report) override {
    if (client_ == nullptr) {
      watch_ = loop.after(Duration(0), [report = std::move(report)] { report("there is no ROS client", {}); });
      return;
    }
    watch_ = client_->ask(request_, environment_, Duration(0), [report = std::move(report)](const RosAnswer& answer) {
      report(answer.ok ? std::nullopt : std::optional(answer.error), answer.messages.value_or(SeenMessages()));
    });
  }
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
