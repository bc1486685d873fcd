// SPDX-License-Identifier: Apache-2.0
// A publisher that does not publish while its node is inactive. Created by LifecycleNode::create_publisher().
#pragma once

#include <memory>
#include <utility>

#include "rclcpp/logging.hpp"
#include "rclcpp/publisher.hpp"
#include "rclcpp_lifecycle/managed_entity.hpp"

namespace rclcpp_lifecycle {

// Publishing while it is off does nothing. It warns the first time after it was switched off.
template <typename MessageT, typename AllocatorT = std::allocator<void>>
class LifecyclePublisher : public SimpleManagedEntity, public rclcpp::Publisher<MessageT, AllocatorT> {
 public:
  using Base = rclcpp::Publisher<MessageT, AllocatorT>;
  using typename Base::MessageUniquePtr;
  using typename Base::ROSMessageType;
  RCLCPP_SMART_PTR_DEFINITIONS(LifecyclePublisher)

  using Base::Base;

  void publish(MessageUniquePtr message) override {
    if (is_activated_or_warn()) {
      Base::publish(std::move(message));
    }
  }
  void publish(const ROSMessageType& message) override {
    if (is_activated_or_warn()) {
      Base::publish(message);
    }
  }
  void publish(rclcpp::LoanedMessage<ROSMessageType, AllocatorT>&& message) override {
    if (is_activated_or_warn()) {
      Base::publish(std::move(message));
    }
  }

  void on_activate() override {
    SimpleManagedEntity::on_activate();
    should_log_ = true;
  }

 private:
  bool is_activated_or_warn() {
    if (is_activated()) {
      return true;
    }
    if (should_log_.exchange(false)) {
      RCLCPP_WARN(rclcpp::get_logger("LifecyclePublisher"),
                  "Trying to publish message on the topic '%s', but the publisher is not activated",
                  this->get_topic_name());
    }
    return false;
  }

  std::atomic_bool should_log_{true};
};

}  // namespace rclcpp_lifecycle
