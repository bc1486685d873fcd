// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_message_watch.hpp"

#include <utility>

namespace launch {

void RosMessageWatch::watch(EventLoop& loop, Report report) {
  if (client_ == nullptr) {
    watch_ = loop.after(Duration(0), [report = std::move(report)] { report("there is no ROS client", {}); });
    return;
  }
  watch_ = client_->ask(request_, environment_, Duration(0), [report = std::move(report)](const RosAnswer& answer) {
    report(answer.ok ? std::nullopt : std::optional(answer.error), answer.messages.value_or(SeenMessages()));
  });
}

}  // namespace launch
