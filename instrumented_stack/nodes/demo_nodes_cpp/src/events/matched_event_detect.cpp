// SPDX-License-Identifier: Apache-2.0
// Prints when subscriptions match a publisher and leave it, and when publishers match a subscription and leave it.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "rclcpp/rclcpp.hpp"
#include "std_msgs/msg/string.hpp"

namespace {

using std_msgs::msg::String;

constexpr const char* kPublisherTopic = "pub_topic_matched_event_detect";
constexpr const char* kSubscriptionTopic = "sub_topic_matched_event_detect";

class MatchedEventDetectNode : public rclcpp::Node {
 public:
  MatchedEventDetectNode() : Node("matched_event_detect_node") {
    rclcpp::PublisherOptions publisher_options;
    publisher_options.event_callbacks.matched_callback = [this](rclcpp::MatchedInfo& info) {
      tell("subscription", info);
    };
    publisher_ = create_publisher<String>(kPublisherTopic, 10, publisher_options);
    rclcpp::SubscriptionOptions subscription_options;
    subscription_options.event_callbacks.matched_callback = [this](rclcpp::MatchedInfo& info) {
      tell("publisher", info);
    };
    subscription_ = create_subscription<String>(
        kSubscriptionTopic, 10, [](const String&) {}, subscription_options);
  }

  // The number of reported events.
  size_t events() const { return events_; }

 private:
  void tell(const char* other_side, const rclcpp::MatchedInfo& info) {
    ++events_;
    if (info.current_count == 0) {
      RCLCPP_INFO(get_logger(), "Last %s is disconnected.", other_side);
    } else if (static_cast<int64_t>(info.current_count) == info.current_count_change) {
      RCLCPP_INFO(get_logger(), "First %s is connected.", other_side);
    } else {
      RCLCPP_INFO(get_logger(), "The changed number of connected %s is %d and current number of connected %s is %zu.",
                  other_side, info.current_count_change, other_side, info.current_count);
    }
  }

  size_t events_ = 0;
  rclcpp::Publisher<String>::SharedPtr publisher_;
  rclcpp::Subscription<String>::SharedPtr subscription_;
};

// Creates two entities with `create`, one after the other, and destroys them in the same order.
template <typename CreateT>
void come_and_go(rclcpp::Executor& executor, const MatchedEventDetectNode& detector, const rclcpp::Node& node,
                 const char* what, CreateT create) {
  auto wait_for_event = [&executor, &detector, before = detector.events()]() mutable {
    while (rclcpp::ok() && detector.events() == before) {
      executor.spin_once();
    }
    before = detector.events();
  };
  std::vector<decltype(create())> made;
  for (int i = 0; i < 2; ++i) {
    RCLCPP_INFO(node.get_logger(), "Create a new %s.", what);
    made.push_back(create());
    wait_for_event();
  }
  while (!made.empty()) {
    RCLCPP_INFO(node.get_logger(), "Destroy a %s.", what);
    made.erase(made.begin());
    wait_for_event();
  }
}

void run() {
  const auto detector = std::make_shared<MatchedEventDetectNode>();
  const auto subscriber = std::make_shared<rclcpp::Node>("multi_sub_node");
  const auto talker = std::make_shared<rclcpp::Node>("multi_pub_node");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(detector);
  executor.add_node(subscriber);
  executor.add_node(talker);
  come_and_go(executor, *detector, *subscriber, "subscription",
              [&] { return subscriber->create_subscription<String>(kPublisherTopic, 10, [](const String&) {}); });
  come_and_go(executor, *detector, *talker, "publisher",
              [&] { return talker->create_publisher<String>(kSubscriptionTopic, 10); });
}

}  // namespace

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    run();
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "matched_event_detect: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
