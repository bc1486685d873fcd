// SPDX-License-Identifier: Apache-2.0
// Nodes that measure themselves, for self_measurement_test.cpp: how often their callbacks run, how long they take, when
// messages come, how many of a burst, how long services take, and how much memory they ask for. They write what they
// measured to a file, and to FILE.spans when each callback and each publication began and ended.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <ostream>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <std_srvs/srv/trigger.hpp>
#include <string>
#include <vector>

using std_msgs::msg::UInt64;
using std_srvs::srv::Trigger;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int kTicks = 100;
constexpr int kBurst = 40;
constexpr int kCalls = 30;
constexpr auto kPeriod = std::chrono::milliseconds(10);
constexpr auto kWork = std::chrono::milliseconds(1);
constexpr auto kLateWork = std::chrono::milliseconds(35);

std::int64_t now_ns() {
  return std::chrono::nanoseconds(Clock::now().time_since_epoch()).count();
}

void work(std::chrono::nanoseconds duration = kWork) {
  const Clock::time_point end = Clock::now() + duration;
  while (Clock::now() < end) {
  }
}

struct Measured {
  std::vector<std::int64_t> values;

  std::int64_t sum() const {
    std::int64_t total = 0;
    for (const std::int64_t value : values) {
      total += value;
    }
    return total;
  }
  // By nearest rank, and the value so many places above it.
  std::int64_t median(std::ptrdiff_t above = 0) const {
    std::vector<std::int64_t> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const std::ptrdiff_t count = std::ssize(sorted);
    return sorted.empty() ? 0 : sorted[std::clamp<std::ptrdiff_t>((count + 1) / 2 - 1 + above, 0, count - 1)];
  }
};

void write(std::ostream& file, const std::string& name, const Measured& measured) {
  file << name << "_count " << measured.values.size() << "\n"
       << name << "_sum " << measured.sum() << "\n"
       << name << "_below_median " << measured.median(-1) << "\n"
       << name << "_median " << measured.median() << "\n"
       << name << "_above_median " << measured.median(1) << "\n";
}

class Spans {
 public:
  explicit Spans(const std::string& path) : file_(path + ".spans") {}
  void add(const char* of, std::int64_t begin, std::int64_t end) { file_ << of << " " << begin << " " << end << "\n"; }

 private:
  std::ofstream file_;
};

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
  Spans spans(path);
  std::int64_t last = 0;
  std::int64_t missed = 0;
  std::int64_t overruns = 0;
  const auto timer = node->create_wall_timer(kPeriod, [&] {
    constexpr std::int64_t kPeriodNs = std::chrono::nanoseconds(kPeriod).count();
    const std::int64_t begin = now_ns();
    if (last != 0) {
      intervals.values.push_back(begin - last);
    }
    if (last != 0 && begin - last > kPeriodNs * 3 / 2) {
      missed += (begin - last + kPeriodNs / 2) / kPeriodNs - 1;
    }
    last = begin;
    if (intervals.values.size() == kTicks / 4) {
      work(kLateWork);
    }
    const bool is_last = intervals.values.size() + 1 == kTicks;
    if (is_last) {
      executor.cancel();
    }
    // Long before the end: the listener leaves as soon as it gets the end.
    if (intervals.values.size() == kTicks / 2) {
      for (int i = 0; i < kBurst; ++i) {
        burst->publish(UInt64());
      }
    }
    UInt64 message;
    message.data = is_last ? 0 : static_cast<std::uint64_t>(now_ns());  // 0: the end
    const std::int64_t called = now_ns();
    publisher->publish(message);
    const std::int64_t end = now_ns();
    spans.add("publication", called, end);
    durations.values.push_back(end - begin);
    if (end - begin > kPeriodNs) {
      ++overruns;
    }
    spans.add("timer", begin, end);
  });
  executor.spin();
  // The listener leaves when it has got the end.
  while (publisher->get_subscription_count() != 0) {
    node->wait_for_graph_change(change, std::chrono::seconds(1));
  }
  std::ofstream file(path);
  write(file, "duration", durations);
  write(file, "interval", intervals);
  file << "missed " << missed << "\noverruns " << overruns << "\n";
}

void listen(const std::string& path) {
  const auto node = std::make_shared<rclcpp::Node>("listener");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  Measured latencies;
  Measured durations;
  Spans spans(path);
  int burst = 0;
  const auto subscription = node->create_subscription<UInt64>("topic", 10, [&](const UInt64& message) {
    const std::int64_t begin = now_ns();
    if (message.data == 0) {
      executor.cancel();
      return;
    }
    latencies.values.push_back(begin - static_cast<std::int64_t>(message.data));
    work();
    const std::int64_t end = now_ns();
    durations.values.push_back(end - begin);
    spans.add("subscription", begin, end);
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

// A service and its client, a node each.
void call(const std::string& path) {
  const auto server = std::make_shared<rclcpp::Node>("server");
  const auto asker = std::make_shared<rclcpp::Node>("asker");
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(server);
  executor.add_node(asker);
  Measured durations;
  Measured round_trips;
  const auto service = server->create_service<Trigger>(
      "question", [&](const Trigger::Request::SharedPtr&, const Trigger::Response::SharedPtr&) {
        const std::int64_t begin = now_ns();
        work();
        durations.values.push_back(now_ns() - begin);
      });
  const auto client = asker->create_client<Trigger>("question");
  client->wait_for_service();
  std::function<void()> ask = [&] {
    const std::int64_t begin = now_ns();
    client->async_send_request(std::make_shared<Trigger::Request>(), [&, begin](rclcpp::Client<Trigger>::SharedFuture) {
      round_trips.values.push_back(now_ns() - begin);
      if (round_trips.values.size() == kCalls) {
        return executor.cancel();
      }
      ask();
    });
  };
  ask();
  executor.spin();
  std::ofstream file(path);
  write(file, "duration", durations);
  write(file, "round_trip", round_trips);
}

// Sends a burst to a subscription of its own process, which has room for three messages.
void burst_inside(const std::string& path) {
  const auto node = std::make_shared<rclcpp::Node>("inside", rclcpp::NodeOptions().use_intra_process_comms(true));
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  const auto publisher = node->create_publisher<UInt64>("inner", 3);
  int got = 0;
  const auto subscription = node->create_subscription<UInt64>("inner", 3, [&](const UInt64& message) {
    ++got;
    if (message.data == kBurst) {
      executor.cancel();
    }
  });
  rclcpp::TimerBase::SharedPtr timer;
  timer = node->create_wall_timer(std::chrono::milliseconds(1), [&] {
    for (std::uint64_t i = 1; i <= kBurst; ++i) {
      UInt64 message;
      message.data = i;
      publisher->publish(message);
    }
    timer->cancel();
  });
  executor.spin();
  std::ofstream(path) << "got " << got << "\n";
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
    for (void* const block : blocks) {
      std::free(block);
    }
    if (++runs == kRuns) {
      executor.cancel();
    }
  });
  executor.spin();
  std::ofstream(path) << "runs " << runs << "\ncalls " << calls << "\nbytes " << bytes << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  if (argc < 3) {
    return 2;
  }
  const std::map<std::string, void (*)(const std::string&)> modes = {
      {"talk", talk}, {"listen", listen}, {"call", call}, {"burst_inside", burst_inside}, {"allocate", allocate}};
  modes.at(argv[1])(argv[2]);
  rclcpp::shutdown();
}
