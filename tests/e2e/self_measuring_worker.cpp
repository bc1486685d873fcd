// SPDX-License-Identifier: Apache-2.0
// Nodes that measure themselves, for self_measurement_test.cpp: how often their callbacks run, how long they take, when
// messages come, how many of a burst, and how much memory they ask for. They write what they measured to a file.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <ostream>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <vector>

using std_msgs::msg::UInt64;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int kTicks = 100;
constexpr int kBurst = 40;
constexpr auto kPeriod = std::chrono::milliseconds(10);
constexpr auto kWork = std::chrono::milliseconds(1);

std::int64_t now_ns() {
  return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
}

void work() {
  const Clock::time_point end = Clock::now() + kWork;
  while (Clock::now() < end) {
  }
}

struct Measured {
  std::vector<std::int64_t> values;

  std::int64_t sum() const {
    std::int64_t total = 0;
    for (const std::int64_t value : values) total += value;
    return total;
  }
  std::int64_t median() const {  // by nearest rank
    std::vector<std::int64_t> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    return sorted.empty() ? 0 : sorted[(sorted.size() + 1) / 2 - 1];
  }
};

void write(std::ostream& file, const std::string& name, const Measured& measured) {
  file << name << "_count " << measured.values.size() << "\n"
       << name << "_sum " << measured.sum() << "\n"
       << name << "_median " << measured.median() << "\n";
}

void talk(const std::string& path) {
  const auto node = std::make_shared<rclcpp::Node>("talker");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  const auto publisher = node->create_publisher<UInt64>("topic", 10);
  const auto burst = node->create_publisher<UInt64>("burst", kBurst);
  const auto change = node->get_graph_event();
  while (publisher->get_subscription_count() == 0 || burst->get_subscription_count() == 0) {
    node->wait_for_graph_change(change, std::chrono::seconds(1));
  }
  Measured durations;
  Measured intervals;
  std::int64_t last = 0;
  const auto timer = node->create_wall_timer(kPeriod, [&] {
    const std::int64_t begin = now_ns();
    if (last != 0) intervals.values.push_back(begin - last);
    last = begin;
    const bool is_last = intervals.values.size() + 1 == kTicks;
    if (is_last) executor.cancel();
    // Long before the end: the listener leaves as soon as it gets the end.
    if (intervals.values.size() == kTicks / 2) {
      for (int i = 0; i < kBurst; ++i) burst->publish(UInt64());
    }
    UInt64 message;
    message.data = is_last ? 0 : static_cast<std::uint64_t>(now_ns());  // 0: the end
    publisher->publish(message);
    durations.values.push_back(now_ns() - begin);
  });
  executor.spin();
  // The listener leaves when it has got the end.
  while (publisher->get_subscription_count() != 0) node->wait_for_graph_change(change, std::chrono::seconds(1));
  std::ofstream file(path);
  write(file, "duration", durations);
  write(file, "interval", intervals);
}

void listen(const std::string& path) {
  const auto node = std::make_shared<rclcpp::Node>("listener");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  Measured latencies;
  Measured durations;
  int burst = 0;
  const auto subscription = node->create_subscription<UInt64>("topic", 10, [&](const UInt64& message) {
    const std::int64_t begin = now_ns();
    if (message.data == 0) {
      executor.cancel();
      return;
    }
    latencies.values.push_back(begin - static_cast<std::int64_t>(message.data));
    work();
    durations.values.push_back(now_ns() - begin);
  });
  const auto burst_subscription = node->create_subscription<UInt64>("burst", 2, [&](const UInt64&) {
    ++burst;
    work();
  });
  executor.spin();
  std::ofstream file(path);
  write(file, "latency", latencies);
  write(file, "duration", durations);
  file << "burst " << burst << "\n";
}

// Asks for memory in its callback, and counts that.
void allocate(const std::string& path) {
  constexpr int kRuns = 50;
  constexpr std::size_t kBlocks = 7;
  const auto node = std::make_shared<rclcpp::Node>("allocator");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  int runs = 0;
  std::size_t calls = 0;
  std::size_t bytes = 0;
  std::array<void* volatile, kBlocks> blocks{};  // so that the compiler leaves the calls
  const auto timer = node->create_wall_timer(std::chrono::milliseconds(2), [&] {
    for (std::size_t i = 0; i < kBlocks; ++i) {
      const std::size_t size = 100 + i;
      blocks[i] = std::malloc(size);
      ++calls;
      bytes += size;
    }
    for (void* const block : blocks) std::free(block);
    if (++runs == kRuns) executor.cancel();
  });
  executor.spin();
  std::ofstream(path) << "runs " << runs << "\ncalls " << calls << "\nbytes " << bytes << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  if (argc < 3) return 2;
  const std::string what = argv[1];
  (what == "talk" ? talk : what == "listen" ? listen : allocate)(argv[2]);
  rclcpp::shutdown();
}
