// SPDX-License-Identifier: Apache-2.0
// The nodes of a system with six problems, for six_problems_test.py: `six_problems_worker NODE…`, each with an executor
// of its own. A callback that takes long sleeps, so that the problems are the same on every machine.
#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <std_msgs/msg/int64.hpp>
#include <string>
#include <thread>
#include <vector>

using namespace std::chrono_literals;
using std_msgs::msg::Int64;

namespace {

using Executor = rclcpp::executors::SingleThreadedExecutor;

// What a node must keep.
std::vector<std::shared_ptr<void>> kept;

void work(std::chrono::microseconds time) {
  std::this_thread::sleep_for(time);
}

rclcpp::Node::SharedPtr make_node(Executor& executor, const std::string& name) {
  auto node = std::make_shared<rclcpp::Node>(name);
  executor.add_node(node);
  kept.push_back(node);
  return node;
}

void add_timer(const rclcpp::Node::SharedPtr& node, std::chrono::milliseconds period, std::function<void()> callback) {
  kept.push_back(node->create_wall_timer(period, std::move(callback)));
}

rclcpp::Publisher<Int64>::SharedPtr add_publisher(const rclcpp::Node::SharedPtr& node, const std::string& topic) {
  return node->create_publisher<Int64>(topic, 10);
}

void add_subscription(const rclcpp::Node::SharedPtr& node, const std::string& topic, std::size_t depth,
                      std::function<void(const Int64&)> callback) {
  kept.push_back(node->create_subscription<Int64>(topic, depth, std::move(callback)));
}

// Sends ten messages at once; the lossy subscriber has room for one.
void make_source(Executor& executor) {
  const auto node = make_node(executor, "source");
  add_timer(node, 100ms, [publisher = add_publisher(node, "burst")] {
    for (int i = 0; i < 10; ++i) {
      publisher->publish(Int64());
    }
  });
}

void make_lossy_subscriber(Executor& executor) {
  add_subscription(make_node(executor, "lossy_subscriber"), "burst", 1, [](const Int64&) { work(300us); });
}

void make_camera(Executor& executor) {
  const auto node = make_node(executor, "camera");
  add_timer(node, 200ms, [publisher = add_publisher(node, "image")] { publisher->publish(Int64()); });
}

// The chain from the camera to the brake may take 10 ms.
void make_fusion(Executor& executor) {
  const auto node = make_node(executor, "fusion");
  add_subscription(node, "image", 10, [publisher = add_publisher(node, "obstacle")](const Int64& message) {
    work(20ms);
    publisher->publish(message);
  });
}

void make_brake(Executor& executor) {
  add_subscription(make_node(executor, "brake"), "obstacle", 10, [](const Int64&) {});
}

// Two nodes share an executor.
void make_starved(Executor& executor) {
  add_timer(make_node(executor, "hog"), 500ms, [] { work(100ms); });
  const auto victim = make_node(executor, "victim");
  add_timer(victim, 20ms, [publisher = add_publisher(victim, "tick")] { publisher->publish(Int64()); });
  add_subscription(victim, "tick", 100, [](const Int64&) {});
}

// Its timer starts anew when its work is done: 104 ms for 100.
void make_drifting(Executor& executor) {
  const auto node = make_node(executor, "drifting");
  const auto timer = std::make_shared<rclcpp::TimerBase::WeakPtr>();
  const rclcpp::TimerBase::SharedPtr made = node->create_wall_timer(100ms, [timer] {
    work(4ms);
    timer->lock()->reset();
  });
  *timer = made;
  kept.push_back(made);
}

// 64 % of the time of its executor.
void make_dominating(Executor& executor) {
  add_timer(make_node(executor, "dominating"), 50ms, [] { work(32ms); });
}

// Asks for memory while it is active.
void make_allocating(Executor& executor) {
  const auto node = std::make_shared<rclcpp_lifecycle::LifecycleNode>("allocating");
  executor.add_node(node->get_node_base_interface());
  kept.push_back(node);
  kept.push_back(node->create_wall_timer(100ms, [history = std::vector<std::unique_ptr<int>>()]() mutable {
    history.push_back(std::make_unique<int>());
  }));
  node->configure();
  node->activate();
}

const std::map<std::string, void (*)(Executor&)> kNodes{
    {"source", make_source},         {"lossy_subscriber", make_lossy_subscriber},
    {"camera", make_camera},         {"fusion", make_fusion},
    {"brake", make_brake},           {"starved", make_starved},
    {"drifting", make_drifting},     {"dominating", make_dominating},
    {"allocating", make_allocating},
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  std::vector<std::unique_ptr<Executor>> executors;
  std::vector<std::thread> threads;
  for (int i = 1; i < argc; ++i) {
    executors.push_back(std::make_unique<Executor>());
    kNodes.at(argv[i])(*executors.back());
  }
  for (const auto& executor : executors) {
    threads.emplace_back([&executor] { executor->spin(); });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  kept.clear();
  executors.clear();
  rclcpp::shutdown();
}
