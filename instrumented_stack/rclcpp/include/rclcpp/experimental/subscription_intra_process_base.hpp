// SPDX-License-Identifier: Apache-2.0
// The part of a subscription that receives from publishers of the same context. It is a waitable besides the
// subscription itself.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "rclcpp/context.hpp"
#include "rclcpp/guard_condition.hpp"
#include "rclcpp/macros.hpp"
#include "rclcpp/message_info.hpp"
#include "rclcpp/qos.hpp"
#include "rclcpp/waitable.hpp"

namespace rclcpp::topic_statistics {
class SubscriptionTopicStatistics;
}  // namespace rclcpp::topic_statistics

namespace rclcpp::experimental {

class SubscriptionIntraProcessBase : public Waitable {
 public:
  RCLCPP_SMART_PTR_ALIASES_ONLY(SubscriptionIntraProcessBase)

  // What set_on_ready_callback() reports.
  enum class EntityType : std::size_t { Subscription };

  SubscriptionIntraProcessBase(const Context::SharedPtr& context, const std::string& topic_name, const QoS& qos)
      : guard_condition_(context), topic_name_(topic_name), qos_(qos) {}

  const char* get_topic_name() const { return topic_name_.c_str(); }
  const QoS& get_actual_qos() const { return qos_; }
  bool is_durability_transient_local() const { return qos_.durability() == DurabilityPolicy::TransientLocal; }

  // Whether messages may be shared with other subscriptions, which saves a copy.
  virtual bool use_take_shared_method() const = 0;
  virtual size_t available_capacity() const = 0;

  size_t get_number_of_ready_guard_conditions() override { return 1; }
  void add_to_wait_set(rcl_wait_set_t& wait_set) override;
  bool is_ready(const rcl_wait_set_t& wait_set) override;
  std::shared_ptr<void> take_data_by_entity_id(size_t id) override;

  // Runs the callback with the result of take_data(); does nothing for null.
  void execute(const std::shared_ptr<void>& data) override;

  // Sets the statistics that also measure these messages; their age is not known. Null: no statistics. Call it before
  // the first execute().
  void set_topic_statistics(std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics) {
    statistics_ = std::move(statistics);
  }

  // Without callbacks, messages are taken and forgotten.
  void set_has_callbacks(bool has_callbacks) { has_callbacks_ = has_callbacks; }

  // Earlier messages are reported at once, at most as many as the queue holds.
  void set_on_ready_callback(std::function<void(size_t, int)> callback) override;
  void clear_on_ready_callback() override;

 protected:
  virtual bool has_data() const = 0;
  virtual void dispatch(const std::shared_ptr<void>& data, const MessageInfo& message_info) = 0;

  // Call it after a message was put into the buffer.
  void notify();

  GuardCondition guard_condition_;

 private:
  std::string topic_name_;
  QoS qos_;
  std::recursive_mutex callback_mutex_;  // recursive: the callback may replace itself
  std::function<void(size_t, int)> on_ready_;
  size_t unread_count_ = 0;
  std::atomic_bool has_callbacks_{true};
  std::shared_ptr<topic_statistics::SubscriptionTopicStatistics> statistics_;
};

}  // namespace rclcpp::experimental
