// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/execution/first_activity.hpp"

namespace tracing {

void FirstActivity::on_callback_begin(const CallbackInstance& instance) {
  FirstActivityRecord& first = record(instance.thread.process);
  if (!first.callback_ns) {
    first.callback_ns = instance.begin_ns;
  }
}

void FirstActivity::on_publication(const Publication& publication) {
  FirstActivityRecord& first = record(publication.thread.process);
  if (first.publication_ns) {
    return;
  }
  // rclcpp publishes on these two by itself.
  const std::string& topic = model_.topics()[publication.topic].name;
  if (topic != "/rosout" && topic != "/parameter_events") {
    first.publication_ns = publication.published_ns;
  }
}

}  // namespace tracing
