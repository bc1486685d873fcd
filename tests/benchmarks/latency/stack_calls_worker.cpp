// SPDX-License-Identifier: Apache-2.0
// The measured program for services and actions: clients that time each of their calls, and servers that answer at
// once.
//   latency_calls service_server|service_client|action_server|action_client
// Nothing but rclcpp, rclcpp_action and latency_msgs, so that it can be built against another rclcpp as well.
#include <cstdint>
#include <latency_msgs/action/task.hpp>
#include <latency_msgs/srv/call.hpp>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>
#include <string>
#include <string_view>

#include "stack_worker.hpp"
#include "worker.hpp"

namespace {

using latency_msgs::action::Task;
using latency_msgs::srv::Call;
using Goal = rclcpp_action::ServerGoalHandle<Task>;

void answer_calls(const rclcpp::Node::SharedPtr& node) {
  const auto service = node->create_service<Call>(
      "/call", [](const Call::Request::SharedPtr request, Call::Response::SharedPtr response) {
        response->number = request->number;
      });
  latency::tell_ready();
  rclcpp::spin(node);
}

// From the request to the callback with the response.
void call(const rclcpp::Node::SharedPtr& node) {
  const auto client = node->create_client<Call>("/call");
  latency::wait_until(node, [&] { return client->service_is_ready(); });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  latency::LatencyLog log;
  latency::publish_batches([&](std::size_t, std::int64_t remaining) {
    const auto request = std::make_shared<Call::Request>();
    bool answered = false;
    const std::int64_t sent = latency::monotonic_now();
    client->async_send_request(request, [&](rclcpp::Client<Call>::SharedFuture) {
      log.received(sent, remaining);
      answered = true;
    });
    while (!answered) {
      executor.spin_once();
    }
  });
}

void reach_goals(const rclcpp::Node::SharedPtr& node) {
  const auto server = rclcpp_action::create_server<Task>(
      node, "/task",
      [](const rclcpp_action::GoalUUID&, std::shared_ptr<const Task::Goal>) {
        return rclcpp_action::GoalResponse::ACCEPT_AND_EXECUTE;
      },
      [](const std::shared_ptr<Goal>) { return rclcpp_action::CancelResponse::REJECT; },
      [](const std::shared_ptr<Goal> goal) { goal->succeed(std::make_shared<Task::Result>()); });
  latency::tell_ready();
  rclcpp::spin(node);
}

// From the goal to the callback with its result, which the client asks for when the goal is accepted.
void send_goals(const rclcpp::Node::SharedPtr& node) {
  using Client = rclcpp_action::Client<Task>;
  const auto client = rclcpp_action::create_client<Task>(node, "/task");
  latency::wait_until(node, [&] { return client->action_server_is_ready(); });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  latency::LatencyLog log;
  latency::publish_batches([&](std::size_t, std::int64_t remaining) {
    bool reached = false;
    const std::int64_t sent = latency::monotonic_now();
    Client::SendGoalOptions options;
    options.result_callback = [&](const Client::GoalHandle::WrappedResult&) {
      log.received(sent, remaining);
      reached = true;
    };
    client->async_send_goal(Task::Goal(), options);
    while (!reached) {
      executor.spin_once();
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const std::string_view role = argc == 2 ? argv[1] : "";
  const auto node = std::make_shared<rclcpp::Node>(std::string(role));
  if (role == "service_server") {
    answer_calls(node);
  } else if (role == "service_client") {
    call(node);
  } else if (role == "action_server") {
    reach_goals(node);
  } else {
    send_goals(node);
  }
}
