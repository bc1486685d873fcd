// SPDX-License-Identifier: Apache-2.0
// Loses messages, requests and feedback in each place where they may get lost, and prints for each subscription and
// each client what it has counted itself, as a line of JSON. For counted_losses_test.py.
//
// A message holds its number, so a subscription knows which ones it lacks before the last one that came.
#include <tracetools/tracetools.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <example_interfaces/action/fibonacci.hpp>
#include <example_interfaces/srv/add_two_ints.hpp>
#include <functional>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>
#include <set>
#include <std_msgs/msg/int64.hpp>
#include <string>
#include <vector>

using example_interfaces::action::Fibonacci;
using example_interfaces::srv::AddTwoInts;
using std_msgs::msg::Int64;

namespace {

rclcpp::executors::SingleThreadedExecutor* executor = nullptr;
std::vector<std::shared_ptr<void>> kept;  // until the end: executors do not keep their nodes

void spin_until(const std::function<bool()>& condition) {
  while (rclcpp::ok() && !condition()) {
    executor->spin_once(std::chrono::milliseconds(5));
  }
}

rclcpp::Node::SharedPtr make_node(const std::string& name, bool intra_process = false) {
  auto node = std::make_shared<rclcpp::Node>(name, rclcpp::NodeOptions().use_intra_process_comms(intra_process));
  executor->add_node(node);
  kept.push_back(node);
  return node;
}

class Publisher {
 public:
  Publisher(const rclcpp::Node::SharedPtr& node, const std::string& topic, const rclcpp::QoS& qos)
      : publisher_(node->create_publisher<Int64>(topic, qos)) {}

  void publish(int count = 1) {
    for (int i = 0; i < count; ++i) {
      auto message = std::make_unique<Int64>();
      message->data = ++sent_;
      publisher_->publish(std::move(message));
    }
  }
  void wait_for_subscriptions(std::size_t count) {
    spin_until([&] { return publisher_->get_subscription_count() == count; });
  }
  std::int64_t sent() const { return sent_; }

 private:
  rclcpp::Publisher<Int64>::SharedPtr publisher_;
  std::int64_t sent_ = 0;
};

class Subscription {
 public:
  Subscription(const rclcpp::Node::SharedPtr& node, const std::string& topic, const rclcpp::QoS& qos,
               const rclcpp::SubscriptionOptions& options = {})
      : node_(node->get_fully_qualified_name()),
        subscription_(node->create_subscription<Int64>(
            topic, qos, [this](Int64::UniquePtr message) { receive(*message); }, options)) {}
  ~Subscription() {
    std::printf("{\"topic\": \"%s\", \"node\": \"%s\", \"received\": %zu, \"missing\": %" PRId64 ", \"first\": %" PRId64
                ", \"last\": %" PRId64 "}\n",
                subscription_->get_topic_name(), node_.c_str(), numbers_.size(), missing(), *numbers_.begin(), last());
  }

  std::int64_t last() const { return numbers_.empty() ? 0 : *numbers_.rbegin(); }
  std::size_t count() const { return numbers_.size(); }
  const rclcpp::Subscription<Int64>::SharedPtr& get() const { return subscription_; }
  void wait_for(std::int64_t number) {
    spin_until([&] { return last() >= number; });
  }
  // Its callback takes what is there itself.
  void take_the_rest_in_callback() { takes_the_rest_ = true; }

 private:
  void receive(const Int64& message) {
    numbers_.insert(message.data);
    Int64 other;
    rclcpp::MessageInfo info;
    while (takes_the_rest_ && subscription_->take(other, info)) {
      numbers_.insert(other.data);
    }
  }
  std::int64_t missing() const {
    return numbers_.empty() ? 0 : last() - *numbers_.begin() + 1 - static_cast<std::int64_t>(numbers_.size());
  }

  std::string node_;
  bool takes_the_rest_ = false;
  std::set<std::int64_t> numbers_;
  rclcpp::Subscription<Int64>::SharedPtr subscription_;
};

// While nobody takes them, more messages come than the history of the reader holds.
void overwrite_in_reader() {
  const auto node = make_node("reader");
  Publisher publisher(node, "reader", rclcpp::QoS(100));
  Subscription small(node, "reader", rclcpp::QoS(5));
  Subscription large(make_node("large_reader"), "reader", rclcpp::QoS(100));
  Subscription lossy(make_node("lossy_reader"), "reader", rclcpp::QoS(7).best_effort());
  publisher.wait_for_subscriptions(3);
  for (int burst = 0; burst < 2; ++burst) {
    publisher.publish();
    for (Subscription* subscription : {&small, &large, &lossy}) {
      subscription->wait_for(publisher.sent());
    }
    publisher.publish(50);
    for (Subscription* subscription : {&small, &large, &lossy}) {
      subscription->wait_for(publisher.sent());
    }
  }
}

// A subscription within the process has a buffer, one that is not has a history.
void overwrite_in_buffer() {
  const auto node = make_node("buffer", true);
  Publisher publisher(node, "buffer", rclcpp::QoS(100));
  Subscription near(node, "buffer", rclcpp::QoS(3));
  Subscription deep(make_node("deep_buffer", true), "buffer", rclcpp::QoS(100));
  Subscription far(make_node("beside_buffer"), "buffer", rclcpp::QoS(6));
  publisher.wait_for_subscriptions(3);
  publisher.publish();
  for (Subscription* subscription : {&near, &deep, &far}) {
    subscription->wait_for(publisher.sent());
  }
  publisher.publish(20);
  for (Subscription* subscription : {&near, &deep, &far}) {
    subscription->wait_for(publisher.sent());
  }
}

void filter() {
  const auto node = make_node("filter");
  Publisher publisher(node, "filter", rclcpp::QoS(100));
  rclcpp::SubscriptionOptions options;
  options.content_filter_options.filter_expression = "data < 5 OR data = 30";
  Subscription filtered(node, "filter", rclcpp::QoS(10), options);
  publisher.wait_for_subscriptions(1);
  publisher.publish(30);
  filtered.wait_for(30);
}

void take_in_callback() {
  const auto node = make_node("taker");
  Publisher publisher(node, "taker", rclcpp::QoS(100));
  Subscription subscription(node, "taker", rclcpp::QoS(100));
  subscription.take_the_rest_in_callback();
  publisher.wait_for_subscriptions(1);
  for (int burst = 0; burst < 3; ++burst) {
    publisher.publish(10);
    subscription.wait_for(publisher.sent());
  }
}

// A program without an executor, which throws away two of three messages that it takes.
void throw_away() {
  const auto node = make_node("thrower");
  Publisher publisher(node, "thrower", rclcpp::QoS(100));
  const auto group = node->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  rclcpp::SubscriptionOptions options;
  options.callback_group = group;
  const auto subscription = node->create_subscription<Int64>(
      "thrower", rclcpp::QoS(100), [](const Int64&) {}, options);
  publisher.wait_for_subscriptions(1);
  rclcpp::WaitSet wait_set;
  wait_set.add_subscription(subscription);
  std::size_t taken = 0;
  std::size_t used = 0;
  for (int burst = 0; burst < 3; ++burst) {
    publisher.publish(10);
    while (static_cast<std::int64_t>(taken) < publisher.sent() &&
           wait_set.wait().kind() == rclcpp::WaitResultKind::Ready) {
      Int64 message;
      rclcpp::MessageInfo info;
      while (subscription->take(message, info)) {
        used += ++taken % 3 == 0 ? 1 : 0;
      }
    }
  }
  wait_set.remove_subscription(subscription);
  std::printf(
      "{\"topic\": \"/thrower\", \"node\": \"/thrower\", \"received\": %zu, \"missing\": 0, \"first\": 1, \"used\": "
      "%zu}\n",
      taken, used);
}

// An executor of the program's own, which executes every subscription that is ready, but gives every third message to
// nobody.
void execute_some() {
  const auto node = make_node("own_executor");
  Publisher publisher(node, "own_executor", rclcpp::QoS(100));
  const auto group = node->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive, false);
  rclcpp::SubscriptionOptions options;
  options.callback_group = group;
  Subscription subscription(node, "own_executor", rclcpp::QoS(100), options);
  publisher.wait_for_subscriptions(1);
  rclcpp::WaitSet wait_set;
  wait_set.add_subscription(subscription.get());
  std::int64_t taken = 0;
  publisher.publish(31);
  while (taken < publisher.sent() && wait_set.wait().kind() == rclcpp::WaitResultKind::Ready) {
    TRACETOOLS_TRACEPOINT(rclcpp_executor_execute,
                          static_cast<const void*>(subscription.get()->get_subscription_handle().get()));
    const auto message = std::make_shared<Int64>();
    rclcpp::MessageInfo info;
    if (subscription.get()->take(*message, info) && ++taken % 3 != 0) {
      subscription.get()->handle_message(message, info);
    }
  }
  wait_set.remove_subscription(subscription.get());
}

// What was published before the subscription was there, and after it had gone.
void come_late_and_leave_early() {
  const auto node = make_node("visitor");
  Publisher publisher(node, "visitor", rclcpp::QoS(3).transient_local());
  publisher.publish(5);
  {
    Subscription early(node, "visitor", rclcpp::QoS(10).transient_local());
    early.wait_for(publisher.sent());
    publisher.wait_for_subscriptions(1);
    publisher.publish();
    early.wait_for(publisher.sent());
  }
  publisher.wait_for_subscriptions(0);
  publisher.publish(4);
}

// The service answers the even ones alone.
void ask() {
  const auto node = make_node("asker");
  const auto service =
      make_node("answerer")
          ->create_service<AddTwoInts>("ask", [](const std::shared_ptr<rclcpp::Service<AddTwoInts>>& self,
                                                 const std::shared_ptr<rmw_request_id_t>& id,
                                                 const std::shared_ptr<AddTwoInts::Request>& request) {
            if (request->a % 2 == 0) {
              AddTwoInts::Response response;
              self->send_response(*id, response);
            }
          });
  const auto client = node->create_client<AddTwoInts>("ask");
  kept.insert(kept.begin(), {service, client});
  spin_until([&] { return client->service_is_ready(); });
  int requests = 0;
  int responses = 0;
  for (const int number : {1, 3, 5, 2, 4, 6, 8}) {
    auto request = std::make_shared<AddTwoInts::Request>();
    request->a = number;
    ++requests;
    client->async_send_request(request, [&](const rclcpp::Client<AddTwoInts>::SharedFuture&) { ++responses; });
  }
  spin_until([&] { return responses == 4; });
  std::printf("{\"service\": \"/ask\", \"requests\": %d, \"responses\": %d}\n", requests, responses);
}

// All feedback is sent before the client takes any. Its history holds the last ten.
void act() {
  using ServerGoal = rclcpp_action::ServerGoalHandle<Fibonacci>;
  using Client = rclcpp_action::Client<Fibonacci>;
  const auto node = make_node("actor");
  const auto server = rclcpp_action::create_server<Fibonacci>(
      make_node("stage"), "act",
      [](const rclcpp_action::GoalUUID&, const std::shared_ptr<const Fibonacci::Goal>&) {
        return rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
      },
      [](const std::shared_ptr<ServerGoal>&) { return rclcpp_action::CancelResponse::ACCEPT; },
      [](const std::shared_ptr<ServerGoal>& goal) {
        for (int number = 1; number <= goal->get_goal()->order; ++number) {
          const auto feedback = std::make_shared<Fibonacci::Feedback>();
          feedback->sequence = {number};
          goal->publish_feedback(feedback);
        }
        goal->succeed(std::make_shared<Fibonacci::Result>());
      });
  const auto client = rclcpp_action::create_client<Fibonacci>(node, "act");
  spin_until([&] { return client->action_server_is_ready(); });
  std::size_t feedback = 0;
  int results = 0;
  Client::SendGoalOptions options;
  options.feedback_callback = [&](const Client::GoalHandle::SharedPtr&,
                                  const std::shared_ptr<const Fibonacci::Feedback>&) { ++feedback; };
  options.result_callback = [&](const Client::GoalHandle::WrappedResult&) { ++results; };
  int sent = 0;
  for (const int order : {4, 40, 8}) {
    Fibonacci::Goal goal;
    goal.order = order;
    sent += order;
    const int before = results;
    client->async_send_goal(goal, options);
    spin_until([&] { return results > before; });
  }
  std::printf("{\"action\": \"/act\", \"sent\": %d, \"feedback\": %zu, \"results\": %d}\n", sent, feedback, results);
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  rclcpp::executors::SingleThreadedExecutor spinning;
  executor = &spinning;
  ask();
  overwrite_in_reader();
  overwrite_in_buffer();
  filter();
  take_in_callback();
  throw_away();
  execute_some();
  come_late_and_leave_early();
  act();
  kept.clear();
  rclcpp::shutdown();
}
