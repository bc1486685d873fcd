// SPDX-License-Identifier: Apache-2.0
// A node that goes on for a while, and then does what its argument says: a healthy one, or one that hangs in some way.
#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/int32.hpp>
#include <string>
#include <thread>

using namespace std::chrono_literals;

namespace {

// Never ends, and does not sleep.
void compute() {
  for (std::atomic<unsigned> count = 0;; ++count) {
  }
}

void deadlock() {
  std::mutex mutex;
  const std::lock_guard<std::mutex> held(mutex);
  std::thread([&] { const std::lock_guard<std::mutex> never(mutex); }).join();
}

void sleep_for_ever() {
  for (;;) {
    std::this_thread::sleep_for(1h);
  }
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::string what = argc > 1 ? argv[1] : "";
  const auto node = std::make_shared<rclcpp::Node>("hanging_node");
  const bool has_own = what == "late" || what == "flood";
  std::atomic<int> ticks = 0;
  const std::map<std::string, std::function<void()>> in_callback = {
      {"deadlock", deadlock}, {"compute", compute}, {"sleep", sleep_for_ever}};
  const auto beats = node->create_publisher<std_msgs::msg::Int32>("/beats", 10);
  const auto timer = node->create_wall_timer(50ms, [&] {
    std::printf("tick %d\n", ++ticks);
    std::fflush(stdout);
    // One that falls silent goes on in all other ways.
    if (const bool goes_on = ticks < 20; goes_on || (what == "slow" && ticks % 10 == 0) || what == "ever" || has_own) {
      std_msgs::msg::Int32 beat;
      beat.data = ticks;
      beats->publish(beat);
    }
    if (const auto found = in_callback.find(what); ticks == 5 && found != in_callback.end()) {
      found->second();
    }
    // More than the subscription keeps.
    for (int more = 0; what == "flood" && ticks % 40 == 0 && more < 20; ++more) {
      beats->publish(std_msgs::msg::Int32());
    }
    if (what == "late" && ticks % 40 == 0) {
      std::this_thread::sleep_for(300ms);
    }
  });
  // Waits for the timer, whose thread it shares.
  rclcpp::Subscription<std_msgs::msg::Int32>::SharedPtr own;
  if (has_own) {
    own = node->create_subscription<std_msgs::msg::Int32>("/beats", 10, [](const std_msgs::msg::Int32&) {});
  }
  if (what == "constructor") {
    sleep_for_ever();
  }
  if (what == "away") {
    while (rclcpp::ok() && ticks < 5) {
      rclcpp::spin_some(node);
      std::this_thread::sleep_for(10ms);
    }
    sleep_for_ever();
  }
  if (what == "threads") {
    rclcpp::executors::MultiThreadedExecutor executor(rclcpp::ExecutorOptions(), 3);
    executor.add_node(node);
    const auto group = node->create_callback_group(rclcpp::CallbackGroupType::Reentrant);
    const auto other = node->create_wall_timer(
        10ms, [] {}, group);
    const auto exclusive = node->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
    const auto hangs = node->create_wall_timer(
        10ms,
        [&] {
          if (ticks >= 5) {
            sleep_for_ever();
          }
        },
        exclusive);
    executor.spin();
    return 0;
  }
  if (what == "idle") {
    timer->cancel();
  }
  rclcpp::spin(node);
  rclcpp::shutdown();
  return 0;
}
