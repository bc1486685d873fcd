// SPDX-License-Identifier: Apache-2.0
// Usage: bench_idle_entities [FEW MANY...]
//
// Measures the time of a message from publish() to the end of its callback in a single-threaded executor: with few idle
// subscriptions beside the one that gets it, with many, and with as many idle timers. Then in an EventsExecutor and in
// an EventsCBGExecutor, with few subscriptions and with as many timers. The executors are in one process and take
// turns, batch by batch, so that other work on the machine affects all of them.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/benchmarks/samples/samples_file.hpp"

namespace {

using rclcpp::executors::EventsCBGExecutor;
using rclcpp::executors::SingleThreadedExecutor;
using rclcpp::experimental::executors::EventsExecutor;
using std_msgs::msg::UInt64;

constexpr std::size_t kFew = 3;
constexpr std::size_t kMany = 1500;
constexpr std::size_t kOfANode = 100;  // subscriptions
constexpr int kBatches = 40;
constexpr std::size_t kMessages = 100;  // of a batch

class Nodes {
 public:
  Nodes(std::unique_ptr<rclcpp::Executor> executor, const std::string& name, std::size_t idle, std::size_t idle_timers)
      : executor_(std::move(executor)) {
    for (std::size_t i = 0; i < idle; ++i) {
      if (i % kOfANode == 0) {
        add_node(name + std::to_string(i / kOfANode));
      }
      subscriptions_.push_back(
          nodes_.back()->create_subscription<UInt64>(name + "_idle" + std::to_string(i), 10, [](const UInt64&) {}));
    }
    for (std::size_t i = 0; i < idle_timers; ++i) {
      timers_.push_back(nodes_.front()->create_wall_timer(std::chrono::hours(1), [] {}));
    }
    publisher_ = nodes_.front()->create_publisher<UInt64>(name, 10);
    subscriptions_.push_back(
        nodes_.back()->create_subscription<UInt64>(name, 10, [this](const UInt64&) { ++received_; }));
    const auto change = nodes_.front()->get_graph_event();
    while (publisher_->get_subscription_count() == 0) {
      nodes_.front()->wait_for_graph_change(change, std::chrono::seconds(1));
    }
    executor_->spin_all(std::chrono::nanoseconds(0));
  }

  // In microseconds.
  double time_of_a_message() {
    const auto start = std::chrono::steady_clock::now();
    received_ = 0;
    for (std::size_t i = 1; i <= kMessages; ++i) {
      publisher_->publish(UInt64());
      while (received_ < i) {
        executor_->spin_once();
      }
    }
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    return took.count() / kMessages;
  }

 private:
  void add_node(const std::string& name) {
    nodes_.push_back(std::make_shared<rclcpp::Node>(name));
    executor_->add_node(nodes_.back());
  }

  std::unique_ptr<rclcpp::Executor> executor_;
  std::vector<rclcpp::Node::SharedPtr> nodes_;
  std::vector<rclcpp::SubscriptionBase::SharedPtr> subscriptions_;
  std::vector<rclcpp::TimerBase::SharedPtr> timers_;
  rclcpp::Publisher<UInt64>::SharedPtr publisher_;
  std::size_t received_ = 0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::string subscriptions(std::size_t count) {
  return fmt::format("{} subscription{}", count, count == 1 ? "" : "s");
}

// An executor with idle entities, and the times of a message in it.
class Case {
 public:
  Case(std::unique_ptr<rclcpp::Executor> executor, std::string what, const std::string& name, std::size_t subscriptions,
       std::size_t timers = 0)
      : what_(std::move(what)),
        idle_(subscriptions + timers),
        nodes_(std::move(executor), name, subscriptions, timers) {}

  void run() { times_.push_back(nodes_.time_of_a_message()); }
  void print(const Case& few) const {
    const double time = median(times_);
    const double floor = median(few.times_);
    fmt::print("{:<32}{:>16.1f}{:>10.2f}{:>16.1f}\n", what_, time, time / floor,
               (time - floor) / static_cast<double>(idle_) * 1e3);
    if (this == &few) {
      benchmarks::report({"a message beside " + what_, "us", times_});
    } else {
      benchmarks::report({"a message beside " + what_, "us", times_, few.what_, few.times_});
    }
  }

 private:
  std::string what_;
  std::size_t idle_;
  Nodes nodes_;
  std::vector<double> times_;  // microseconds, one for each batch
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::vector<std::string> words(argv, argv + argc);
  std::vector<std::size_t> counts;
  for (std::size_t i = 1; i < words.size(); ++i) {
    counts.push_back(std::stoul(words[i]));
  }
  if (counts.empty()) {
    counts = {kFew, kMany};
  }
  {
    const std::size_t few_count = counts.front();
    const std::size_t many_count = counts.back();
    const auto single = [] { return std::make_unique<SingleThreadedExecutor>(); };
    const auto events = [] { return std::make_unique<EventsExecutor>(); };
    const auto groups = [] { return std::make_unique<EventsCBGExecutor>(rclcpp::ExecutorOptions(), 1); };
    // To find a reader in this process, Fast DDS goes through the readers that were made before it: the few come first.
    Case few(single(), subscriptions(few_count), "few", few_count);
    Case few_of_events(events(), subscriptions(few_count) + ", events", "few_events", few_count);
    Case few_of_groups(groups(), subscriptions(few_count) + ", events by group", "few_groups", few_count);
    std::vector<std::pair<std::unique_ptr<Case>, const Case*>> others;  // and what they are compared with
    others.emplace_back(
        std::make_unique<Case>(single(), fmt::format("{} timers", many_count), "timers", few_count, many_count), &few);
    others.emplace_back(std::make_unique<Case>(events(), fmt::format("{} timers, events", many_count), "timers_events",
                                               few_count, many_count),
                        &few_of_events);
    others.emplace_back(std::make_unique<Case>(groups(), fmt::format("{} timers, events by group", many_count),
                                               "timers_groups", few_count, many_count),
                        &few_of_groups);
    for (std::size_t i = 1; i < counts.size(); ++i) {
      others.emplace_back(
          std::make_unique<Case>(single(), subscriptions(counts[i]), "many" + std::to_string(i), counts[i]), &few);
    }
    for (int i = 0; i < kBatches; ++i) {
      few.run();
      few_of_events.run();
      few_of_groups.run();
      for (const auto& [other, floor] : others) {
        other->run();
      }
    }
    fmt::print("{:<32}{:>16}{:>10}{:>16}\n", "idle beside the subscription", "us per message", "of few", "ns for each");
    few.print(few);
    few_of_events.print(few_of_events);
    few_of_groups.print(few_of_events);
    for (const auto& [other, floor] : others) {
      other->print(*floor);
    }
  }
  rclcpp::shutdown();
}
