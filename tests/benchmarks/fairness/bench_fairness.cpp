// SPDX-License-Identifier: Apache-2.0
// Usage: bench_fairness [TURNS]
//
// Counts how many turns of another entity an entity waits for that is always ready, in each executor: the most in a
// run, and how often it was more than two. All entities are of one exclusive group, so one callback runs at a time:
// timers that are always due, and subscriptions that get a message for each one that they take. The exit code is 1 if
// an entity was overtaken.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <rclcpp/experimental/executors/events_executor/events_executor.hpp>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/u_int64.hpp>
#include <string>
#include <vector>

#include "tests/benchmarks/samples/samples_file.hpp"
#include "tests/support/overtaking.hpp"

namespace {

using rclcpp::executors::EventsCBGExecutor;
using rclcpp::executors::MultiThreadedExecutor;
using rclcpp::executors::SingleThreadedExecutor;
using rclcpp::experimental::executors::EventsExecutor;
using std_msgs::msg::UInt64;
using test_support::Overtaking;

constexpr std::size_t kTurns = 2000;  // of a run
constexpr int kRuns = 5;
constexpr int kWaiting = 20;  // messages of each subscription
constexpr std::chrono::microseconds kWork(100);

// What is ready all the time.
struct Entities {
  const char* name;
  int timers;
  int subscriptions;
  bool beside_a_busy_group;  // so that an executor of several threads always has something to do
};

class Run {
 public:
  Run(std::shared_ptr<rclcpp::Executor> executor, const Entities& entities, std::size_t turns)
      : executor_(std::move(executor)), turns_wanted_(turns) {
    for (int i = 0; i < entities.timers; ++i) {
      add_timer("timer" + std::to_string(i));
    }
    for (int i = 0; i < entities.subscriptions; ++i) {
      add_subscription("topic" + std::to_string(i));
    }
    if (entities.beside_a_busy_group) {
      busy_ = node_->create_wall_timer(
          std::chrono::milliseconds(0), [] {}, node_->create_callback_group(rclcpp::CallbackGroupType::Reentrant));
    }
    const auto change = node_->get_graph_event();
    for (const auto& publisher : publishers_) {
      while (publisher->get_subscription_count() == 0) {
        node_->wait_for_graph_change(change, std::chrono::seconds(1));
      }
    }
    for (int i = 0; i < kWaiting; ++i) {
      for (const auto& publisher : publishers_) {
        publisher->publish(UInt64());
      }
    }
  }

  // The worst of all entities.
  Overtaking measure() {
    executor_->add_node(node_);
    executor_->spin();
    executor_->remove_node(node_);
    Overtaking worst;
    for (const std::string& name : names_) {
      const Overtaking found = test_support::overtaking(turns_, name);
      worst = {std::max(worst.most, found.most), worst.times + found.times};
    }
    return worst;
  }

 private:
  void take_a_turn(const std::string& name) {
    turns_.push_back(name);
    const auto end = std::chrono::steady_clock::now() + kWork;
    while (std::chrono::steady_clock::now() < end) {
    }
    if (turns_.size() >= turns_wanted_) {
      executor_->cancel();
    }
  }
  void add_timer(const std::string& name) {
    names_.push_back(name);
    timers_.push_back(node_->create_wall_timer(
        std::chrono::milliseconds(0), [this, name] { take_a_turn(name); }, group_));
  }
  void add_subscription(const std::string& name) {
    names_.push_back(name);
    publishers_.push_back(node_->create_publisher<UInt64>(name, 2 * kWaiting));
    rclcpp::SubscriptionOptions options;
    options.callback_group = group_;
    subscriptions_.push_back(node_->create_subscription<UInt64>(
        name, 2 * kWaiting,
        [this, name, publisher = publishers_.back()](const UInt64& message) {
          publisher->publish(message);
          take_a_turn(name);
        },
        options));
  }

  std::shared_ptr<rclcpp::Executor> executor_;
  const std::size_t turns_wanted_;
  const rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  const rclcpp::CallbackGroup::SharedPtr group_ =
      node_->create_callback_group(rclcpp::CallbackGroupType::MutuallyExclusive);
  std::vector<rclcpp::TimerBase::SharedPtr> timers_;
  rclcpp::TimerBase::SharedPtr busy_;
  std::vector<rclcpp::Publisher<UInt64>::SharedPtr> publishers_;
  std::vector<rclcpp::Subscription<UInt64>::SharedPtr> subscriptions_;
  std::vector<std::string> names_;
  std::vector<std::string> turns_;  // of the exclusive group, so it needs no lock
};

struct Candidate {
  std::string name;
  std::function<std::shared_ptr<rclcpp::Executor>()> make;
};

std::vector<Candidate> candidates() {
  std::vector<Candidate> all = {
      {"SingleThreadedExecutor", [] { return std::make_shared<SingleThreadedExecutor>(); }},
      {"EventsExecutor", [] { return std::make_shared<EventsExecutor>(); }},
  };
  for (const std::size_t threads : {1, 2, 4}) {
    const std::string with_threads = fmt::format(", {} thread{}", threads, threads == 1 ? "" : "s");
    all.push_back({"MultiThreadedExecutor" + with_threads,
                   [threads] { return std::make_shared<MultiThreadedExecutor>(rclcpp::ExecutorOptions(), threads); }});
    all.push_back({"EventsCBGExecutor" + with_threads,
                   [threads] { return std::make_shared<EventsCBGExecutor>(rclcpp::ExecutorOptions(), threads); }});
  }
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::size_t turns = argc > 1 ? std::stoul(argv[1]) : kTurns;
  bool is_fair = true;
  fmt::print("{:<34}{:<34}{:>8}{:>20}{:>18}\n", "executor", "always ready", "turns", "overtaken at most",
             "more than twice");
  for (const Candidate& candidate : candidates()) {
    for (const Entities& entities :
         {Entities{"3 timers", 3, 0, false}, Entities{"2 subscriptions, 1 timer", 1, 2, false},
          Entities{"5 subscriptions, 2 timers", 2, 5, false}, Entities{"2 timers beside a busy group", 2, 0, true}}) {
      Overtaking worst;
      std::vector<double> most;  // of each run
      for (int i = 0; i < kRuns; ++i) {
        const Overtaking found = Run(candidate.make(), entities, turns).measure();
        worst = {std::max(worst.most, found.most), worst.times + found.times};
        most.push_back(static_cast<double>(found.most));
      }
      is_fair = is_fair && worst.times == 0;
      fmt::print("{:<34}{:<34}{:>8}{:>20}{:>18}\n", candidate.name, entities.name, kRuns * turns, worst.most,
                 worst.times);
      std::fflush(stdout);
      benchmarks::report({fmt::format("overtaken in {}, {}", candidate.name, entities.name), "turns", most});
    }
  }
  rclcpp::shutdown();
  return is_fair ? 0 : 1;
}
