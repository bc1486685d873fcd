// SPDX-License-Identifier: Apache-2.0
// A filter for a topic that may be left and joined again, and one that pairs the messages of two filters.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/header.hpp"

namespace track_filters {

// Whether a message has a header, found at compile time.
template <class M, class = void>
struct HasHeader : std::false_type {};
template <class M>
struct HasHeader<M, std::void_t<decltype(std::declval<M>().header)>>
    : std::is_same<std::decay_t<decltype(std::declval<M>().header)>, std_msgs::msg::Header> {};

template <class M>
std::enable_if_t<HasHeader<M>::value, rclcpp::Time> stamp_of(const M& message) {
  return message.header.stamp;
}

template <class M>
class SimpleFilter {
 public:
  using ConstPtr = std::shared_ptr<const M>;
  void add(std::function<void(const ConstPtr&)> callback) { callbacks_.push_back(std::move(callback)); }

 protected:
  void signal(const ConstPtr& message) {
    for (const auto& callback : callbacks_) {
      callback(message);
    }
  }

 private:
  std::vector<std::function<void(const ConstPtr&)>> callbacks_;
};

template <class M>
class Subscriber : public SimpleFilter<M> {
 public:
  using Interfaces = rclcpp::node_interfaces::NodeInterfaces<rclcpp::node_interfaces::NodeParametersInterface,
                                                             rclcpp::node_interfaces::NodeTopicsInterface>;

  Subscriber(Interfaces interfaces, const std::string& topic, const rclcpp::QoS& qos,
             rclcpp::SubscriptionOptions options = rclcpp::SubscriptionOptions())
      : interfaces_(interfaces), topic_(topic), qos_(qos), options_(options) {
    subscribe();
  }
  void subscribe() {
    auto parameters = interfaces_.get_node_parameters_interface();
    auto topics = interfaces_.get_node_topics_interface();
    subscription_ = rclcpp::create_subscription<M>(
        parameters, topics, topic_, qos_, [this](const std::shared_ptr<const M> message) { this->signal(message); },
        options_);
  }
  void unsubscribe() { subscription_.reset(); }

 private:
  Interfaces interfaces_;
  const std::string topic_;
  const rclcpp::QoS qos_;
  const rclcpp::SubscriptionOptions options_;
  typename rclcpp::Subscription<M>::SharedPtr subscription_;
};

template <class A, class B>
class Pairs {
 public:
  using Callback = std::function<void(const std::shared_ptr<const A>&, const std::shared_ptr<const B>&)>;
  Pairs(SimpleFilter<A>& a, SimpleFilter<B>& b, Callback callback) : callback_(std::move(callback)) {
    a.add([this](const auto& message) { add(first_, message); });
    b.add([this](const auto& message) { add(second_, message); });
  }

 private:
  template <class M>
  void add(std::map<rclcpp::Time, std::shared_ptr<const M>>& list, const std::shared_ptr<const M>& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const rclcpp::Time stamp = stamp_of(*message);
    list[stamp] = message;
    const auto a = first_.find(stamp);
    const auto b = second_.find(stamp);
    if (a != first_.end() && b != second_.end()) {
      callback_(a->second, b->second);
      first_.erase(first_.begin(), std::next(a));
      second_.erase(second_.begin(), std::next(b));
    }
  }

  const Callback callback_;
  std::mutex mutex_;
  std::map<rclcpp::Time, std::shared_ptr<const A>> first_;
  std::map<rclcpp::Time, std::shared_ptr<const B>> second_;
};

}  // namespace track_filters
