// SPDX-License-Identifier: Apache-2.0
// Twenty callbacks for bench_comparison: each of ten timers publishes to a subscription of its own. All of them do work
// that is known. Usage:
//   twenty_callbacks SECONDS SHAPE [SLOW MORE]
// SECONDS: so long at least; each callback runs sixty times.
// SHAPE: "equal", all of them do the same work, or "varied", up to twenty times as much as the least one.
// SLOW: the number of the callback that does more, even ones are timers, odd ones subscriptions; -1: none.
// MORE: "2ms" of the time of its thread, or "20%" of its work.
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <thread>
#include <vector>

using std_msgs::msg::UInt64;

namespace {

constexpr int kPairs = 10;
constexpr auto kPeriod = std::chrono::milliseconds(40);

// The same number of steps each time, so that its duration varies as that of real work does.
void work(double steps) {
  volatile std::uint64_t value = 1;
  for (auto left = static_cast<std::int64_t>(steps); left > 0; --left) {
    value = value * 6364136223846793005 + 1442695040888963407;
  }
}

double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

class Callbacks {
 public:
  Callbacks(bool varied, int slow, const std::string& more)
      : varied_(varied),
        slow_(slow),
        part_(more.ends_with('%') ? std::atof(more.c_str()) / 100 : 0),
        seconds_(more.ends_with("ms") ? std::atof(more.c_str()) / 1000 : 0) {}

  // Until each callback has run so often that its times say something.
  void wait() const {
    for (int left = left_; left != 0; left = left_) {
      left_.wait(left);
    }
  }

  void run(int number) {
    constexpr int kEnough = 60;
    if (++calls_[static_cast<std::size_t>(number)] == kEnough && --left_ == 0) {
      left_.notify_all();
    }
    constexpr double kUsual = 330'000;  // steps
    const double steps = varied_ ? kUsual / 3 * std::pow(20, (number * 7 % (2 * kPairs)) / 19.0) : kUsual;
    if (number != slow_) {
      work(steps);
      return;
    }
    work(steps * (1 + part_));
    for (const double end = thread_seconds() + seconds_; thread_seconds() < end;) {
    }
  }

 private:
  bool varied_;
  int slow_;
  double part_;
  double seconds_;
  std::array<int, 2 * kPairs> calls_{};
  std::atomic<int> left_{2 * kPairs};
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  if (argc < 3) {
    return 2;
  }
  Callbacks callbacks(argv[2] == std::string("varied"), argc > 4 ? std::atoi(argv[3]) : -1, argc > 4 ? argv[4] : "");
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
  callbacks.wait();
  timers.cancel();
  subscriptions.cancel();
  sender.join();
  receiver.join();
  rclcpp::shutdown();
}
