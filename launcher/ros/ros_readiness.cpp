// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_readiness.hpp"

#include <fmt/format.h>

namespace launch {

namespace {

struct Sentence {
  std::string operator()(const NodePresent& wait) const { return fmt::format("node '{}' is there", wait.node); }
  std::string operator()(const TopicPresent& wait) const { return fmt::format("topic '{}' is published", wait.topic); }
  std::string operator()(const ServicePresent& wait) const {
    return fmt::format("service '{}' is offered", wait.service);
  }
  std::string operator()(const MessagePublished& wait) const {
    return fmt::format("a message has come on '{}'", wait.topic);
  }
  std::string operator()(const StateReached& wait) const { return fmt::format("'{}' is {}", wait.node, wait.state); }
  std::string operator()(const ParameterReached& wait) const {
    return fmt::format("parameter '{}' of '{}' is {}", wait.parameter.name, wait.node,
                       to_python_text(wait.parameter.value));
  }
  // These requests are no conditions; the registry of actions doesn't make conditions of them.
  template <typename Request>
  std::string operator()(const Request& request) const {
    return launch::describe(request);
  }
};

}  // namespace

void RosReadiness::watch(EventLoop& loop, Done done) {
  if (client_ == nullptr) {
    watch_ = loop.after(Duration(0), [done = std::move(done)] { done("there is no ROS client"); });
    return;
  }
  watch_ = client_->ask(condition_, environment_, Duration(0), [this, done = std::move(done)](const RosAnswer& answer) {
    if (!answer.seen.empty()) {
      seen_ = answer.seen;
    } else {
      done(answer.ok ? std::nullopt : std::optional(answer.error));
    }
  });
}

std::string RosReadiness::describe() const {
  return std::visit(Sentence(), condition_);
}

}  // namespace launch
