// SPDX-License-Identifier: Apache-2.0
// Fifty callbacks for bench_comparison: each of 25 timers publishes to a subscription of its own. All of them do some
// work. Usage:
//   fifty_callbacks SECONDS [SLOW [MILLISECONDS]]
// SLOW: the number of the callback that takes longer, from 0 on; even ones are timers, odd ones subscriptions.
#include <chrono>
#include <cstdlib>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <thread>
#include <vector>

using std_msgs::msg::UInt64;

namespace {

constexpr int kPairs = 25;
constexpr auto kPeriod = std::chrono::milliseconds(20);

// The same number of steps each time, so that its duration varies as that of real work does.
void work() {
  volatile std::uint64_t value = 1;
  for (int step = 0; step < 20'000; ++step) {
    value = value * 6364136223846793005 + 1442695040888963407;
  }
}

class Callbacks {
 public:
  Callbacks(int slow, std::chrono::milliseconds longer) : slow_(slow), longer_(longer) {}

  void run(int number) const {
    work();
    if (number == slow_) {
      std::this_thread::sleep_for(longer_);
    }
  }

 private:
  int slow_;
  std::chrono::milliseconds longer_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  if (argc < 2) {
    return 2;
  }
  const Callbacks callbacks(argc > 2 ? std::atoi(argv[2]) : -1,
                            std::chrono::milliseconds(argc > 3 ? std::atoi(argv[3]) : 2));
  rclcpp::executors::SingleThreadedExecutor timers;
  rclcpp::executors::SingleThreadedExecutor subscriptions;
  std::vector<rclcpp::Node::SharedPtr> nodes;
  std::vector<std::shared_ptr<void>> kept;
  for (int pair = 0; pair < kPairs; ++pair) {
    const std::string number = std::to_string(pair);
    const auto source = nodes.emplace_back(std::make_shared<rclcpp::Node>("source_" + number));
    const auto publisher = source->create_publisher<UInt64>("topic_" + number, 10);
    kept.push_back(source->create_wall_timer(kPeriod, [&callbacks, publisher, pair] {
      callbacks.run(2 * pair);
      publisher->publish(UInt64());
    }));
    timers.add_node(source);
    const auto sink = nodes.emplace_back(std::make_shared<rclcpp::Node>("sink_" + number));
    kept.push_back(sink->create_subscription<UInt64>(
        "topic_" + number, 10, [&callbacks, pair](const UInt64&) { callbacks.run(2 * pair + 1); }));
    subscriptions.add_node(sink);
  }
  std::thread receiver([&] { subscriptions.spin(); });
  std::thread sender([&] { timers.spin(); });
  std::this_thread::sleep_for(std::chrono::seconds(std::atoi(argv[1])));
  timers.cancel();
  subscriptions.cancel();
  sender.join();
  receiver.join();
  rclcpp::shutdown();
}
