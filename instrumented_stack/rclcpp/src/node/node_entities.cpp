// SPDX-License-Identifier: Apache-2.0
// How a node gets its publishers, subscriptions, services, clients, timers and waitables: each in a callback group.
#include <tracetools/tracetools.h>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/node_interfaces/node_services.hpp"
#include "rclcpp/node_interfaces/node_timers.hpp"
#include "rclcpp/node_interfaces/node_topics.hpp"
#include "rclcpp/node_interfaces/node_waitables.hpp"

namespace rclcpp::node_interfaces {

namespace {

// The group that serves an entity: `group`, or the one that a node has for those without.
CallbackGroup::SharedPtr serving(NodeBaseInterface& node_base, const CallbackGroup::SharedPtr& group,
                                 const char* kind) {
  if (group && !node_base.callback_group_in_node(group)) {
    throw exceptions::MissingGroupNodeException(kind);
  }
  return group ? group : node_base.get_default_callback_group();
}

}  // namespace

PublisherBase::SharedPtr NodeTopics::create_publisher(const std::string& topic_name,
                                                      const PublisherFactory& publisher_factory, const QoS& qos) {
  return publisher_factory.create_typed_publisher(node_base_.get(), topic_name, qos);
}

SubscriptionBase::SharedPtr NodeTopics::create_subscription(const std::string& topic_name,
                                                            const SubscriptionFactory& subscription_factory,
                                                            const QoS& qos) {
  return subscription_factory.create_typed_subscription(node_base_.get(), topic_name, qos);
}

void NodeTopics::add_publisher(PublisherBase::SharedPtr publisher, CallbackGroup::SharedPtr group) {
  group = serving(*node_base_, group, "publisher");
  publisher->set_callback_group(group);
  for (const auto& [type, handler] : publisher->get_event_handlers()) {
    group->add_waitable(handler);
  }
}

void NodeTopics::add_subscription(SubscriptionBase::SharedPtr subscription, CallbackGroup::SharedPtr group) {
  group = serving(*node_base_, group, "subscription");
  group->add_subscription(subscription);
  for (const auto& [type, handler] : subscription->get_event_handlers()) {
    group->add_waitable(handler);
  }
  if (const Waitable::SharedPtr intra_process = subscription->get_intra_process_waitable()) {
    group->add_waitable(intra_process);
  }
}

void NodeServices::add_service(ServiceBase::SharedPtr service, CallbackGroup::SharedPtr group) {
  serving(*node_base_, group, "service")->add_service(service);
}

void NodeServices::add_client(ClientBase::SharedPtr client, CallbackGroup::SharedPtr group) {
  serving(*node_base_, group, "client")->add_client(client);
}

void NodeTimers::add_timer(TimerBase::SharedPtr timer, CallbackGroup::SharedPtr group) {
  serving(*node_base_, group, "timer")->add_timer(timer);
  TRACETOOLS_TRACEPOINT(rclcpp_timer_link_node, static_cast<const void*>(timer->get_timer_handle().get()),
                        static_cast<const void*>(node_base_->get_rcl_node_handle()));
}

void NodeWaitables::add_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) {
  serving(*node_base_, group, "waitable")->add_waitable(waitable);
}

void NodeWaitables::remove_waitable(Waitable::SharedPtr waitable, CallbackGroup::SharedPtr group) noexcept {
  if (group && !node_base_->callback_group_in_node(group)) {
    return;
  }
  (group ? group : node_base_->get_default_callback_group())->remove_waitable(waitable);
}

}  // namespace rclcpp::node_interfaces
