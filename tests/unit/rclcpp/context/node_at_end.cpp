// SPDX-License-Identifier: Apache-2.0
// A process that ends while its node is still there. The argument says how:
//   static       a static node with its endpoints and executor, without shutdown()
//   shutdown     the same, after shutdown()
//   leaked       a node that nobody destroys
//   thread       the same, while another thread spins
//   callback     exit() within a callback
//   fork         the child of a fork calls exit()
// It waits until somebody listens on the topic `ends`, publishes "here" there, and ends with exit code 7.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <std_srvs/srv/trigger.hpp>
#include <string_view>
#include <thread>

using std_msgs::msg::String;
using std_srvs::srv::Trigger;

namespace {

constexpr int kExitCode = 7;

class Speaker : public rclcpp::Node {
 public:
  Speaker() : Node("speaker") {}
  ~Speaker() override { publisher->publish(String()); }  // to nobody: others are told of the end before

  rclcpp::Publisher<String>::SharedPtr publisher = create_publisher<String>("ends", rclcpp::QoS(1).transient_local());
  rclcpp::Subscription<String>::SharedPtr subscription = create_subscription<String>("begins", 1, [](const String&) {});
  rclcpp::Service<Trigger>::SharedPtr service =
      create_service<Trigger>("answer", [](const Trigger::Request::SharedPtr&, const Trigger::Response::SharedPtr&) {});
  rclcpp::Client<Trigger>::SharedPtr client = create_client<Trigger>("ask");
  rclcpp::TimerBase::SharedPtr timer;
};

std::shared_ptr<Speaker> node;
std::unique_ptr<rclcpp::Executor> executor;
std::shared_ptr<Speaker>* never_destroyed_node = nullptr;
rclcpp::Executor* never_destroyed_executor = nullptr;

void wait_for_listener() {
  while (node->publisher->get_subscription_count() == 0) {
    node->wait_for_graph_change(node->get_graph_event(), std::chrono::seconds(1));
  }
  String here;
  here.data = "here";
  node->publisher->publish(here);
  node->publisher->wait_for_all_acked();
}

int status_of_forked_child() {
  const pid_t child = fork();
  if (child == 0) {
    std::exit(kExitCode);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::string_view how = argv[1];
  node = std::make_shared<Speaker>();
  executor = std::make_unique<rclcpp::executors::SingleThreadedExecutor>();
  executor->add_node(node);
  executor->spin_some();
  wait_for_listener();
  if (how == "shutdown") {
    rclcpp::shutdown();
  }
  if (how == "leaked" || how == "thread") {
    never_destroyed_node = new std::shared_ptr<Speaker>(node);
    never_destroyed_executor = executor.release();
    if (how == "thread") {
      std::thread([] { never_destroyed_executor->spin(); }).detach();
    }
  }
  if (how == "callback") {
    node->timer = node->create_wall_timer(std::chrono::milliseconds(1), [] { std::exit(kExitCode); });
    executor->spin();
  }
  if (how == "fork") {
    const int status = status_of_forked_child();
    rclcpp::shutdown();
    return status;
  }
  return kExitCode;
}
