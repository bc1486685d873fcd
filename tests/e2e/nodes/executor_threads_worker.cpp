// SPDX-License-Identifier: Apache-2.0
// Keeps three threads of an executor busy, for executor_threads_trace_test.cpp: two timers of one group, which take
// turns, and a subscription whose callbacks run at the same time.
#include <condition_variable>
#include <mutex>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/u_int64.hpp>

using std_msgs::msg::UInt64;

namespace {

constexpr int kTicks = 20;  // of each timer

// Returns when this number of threads has arrived.
class Meeting {
 public:
  explicit Meeting(int threads) : missing_(threads) {}

  void arrive_and_wait() {
    {
      const std::lock_guard lock(mutex_);
      --missing_;
    }
    changed_.notify_all();
    wait();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return missing_ == 0; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int missing_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("worker");
  rclcpp::executors::MultiThreadedExecutor executor(rclcpp::ExecutorOptions(), 3);
  executor.add_node(node);

  Meeting meeting(2);
  rclcpp::SubscriptionOptions options;
  options.callback_group = node->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
  const auto publisher = node->create_publisher<UInt64>("topic", 10);
  const auto subscription = node->create_subscription<UInt64>(
      "topic", 10, [&](const UInt64&) { meeting.arrive_and_wait(); }, options);
  const auto graph_change = node->get_graph_event();
  while (publisher->get_subscription_count() == 0) {
    node->wait_for_graph_change(graph_change, std::chrono::seconds(1));
  }
  publisher->publish(UInt64());
  publisher->publish(UInt64());

  // They are in one group, so one thread runs at a time.
  const auto group = node->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  int ticks = 0;
  const auto tick = [&] {
    if (++ticks == 2 * kTicks) {
      meeting.wait();
      executor.cancel();
    }
  };
  const auto first = node->create_wall_timer(std::chrono::milliseconds(1), tick, group);
  const auto second = node->create_wall_timer(
      std::chrono::milliseconds(1), [tick] { tick(); }, group);
  executor.spin();
  rclcpp::shutdown();
}
