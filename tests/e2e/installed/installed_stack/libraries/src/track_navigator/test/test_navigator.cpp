// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <composition_interfaces/srv/load_node.hpp>
#include <nav_msgs/msg/occupancy_grid.hpp>
#include <rclcpp_components/component_manager.hpp>

#include "track_navigator/lifecycle_manager.hpp"
#include "track_navigator/navigator.hpp"

using lifecycle_msgs::msg::State;
using track_navigator::LifecycleManager;
using track_navigator::Navigator;
using Action = Navigator::Action;
using composition_interfaces::srv::LoadNode;

// The map 0 0 9 0 0 with a radius of 1 around what is occupied. The navigator is a component of a container.
TEST(Navigator, IsBroughtUpComputesAndIsTakenDown) {
  rclcpp::init(0, nullptr);
  const auto executor = std::make_shared<rclcpp::executors::MultiThreadedExecutor>();
  const auto container = std::make_shared<rclcpp_components::ComponentManager>(executor);
  const auto manager = std::make_shared<LifecycleManager>(
      rclcpp::NodeOptions().parameter_overrides({{"node_names", std::vector<std::string>{"navigator"}}}));
  const auto client_node = std::make_shared<rclcpp::Node>("client");
  executor->add_node(container);
  executor->add_node(manager);
  std::thread thread([&executor] { executor->spin(); });

  const auto load = client_node->create_client<LoadNode>("ComponentManager/_container/load_node");
  ASSERT_TRUE(load->wait_for_service(std::chrono::seconds(60)));
  const auto request = std::make_shared<LoadNode::Request>();
  request->package_name = "track_navigator";
  request->plugin_name = "track_navigator::Navigator";
  auto loaded = load->async_send_request(request);
  ASSERT_EQ(rclcpp::spin_until_future_complete(client_node, loaded), rclcpp::FutureReturnCode::SUCCESS);
  const auto response = loaded.get();
  EXPECT_EQ(response->error_message, "");
  EXPECT_EQ(response->full_node_name, "/navigator");

  const auto map = client_node->create_publisher<nav_msgs::msg::OccupancyGrid>("map", rclcpp::QoS(1).transient_local());
  nav_msgs::msg::OccupancyGrid grid;
  grid.data = {0, 0, 9, 0, 0};
  map->publish(grid);

  ASSERT_TRUE(manager->startup());
  EXPECT_EQ(manager->state_of("navigator"), State::PRIMARY_STATE_ACTIVE);

  const auto client = rclcpp_action::create_client<Action>(client_node, "compute");
  ASSERT_TRUE(client->wait_for_action_server(std::chrono::seconds(60)));
  std::vector<int> result;
  while (result.empty()) {  // until the map has come
    auto goal = client->async_send_goal(Action::Goal());
    ASSERT_EQ(rclcpp::spin_until_future_complete(client_node, goal), rclcpp::FutureReturnCode::SUCCESS);
    ASSERT_NE(goal.get(), nullptr);
    auto answer = client->async_get_result(goal.get());
    ASSERT_EQ(rclcpp::spin_until_future_complete(client_node, answer), rclcpp::FutureReturnCode::SUCCESS);
    EXPECT_EQ(answer.get().code, rclcpp_action::ResultCode::SUCCEEDED);
    result.assign(answer.get().result->sequence.begin(), answer.get().result->sequence.end());
  }
  EXPECT_EQ(result, (std::vector<int>{0, 9, 9, 9, 0}));

  rclcpp::SyncParametersClient parameters(client_node, "navigator");
  ASSERT_TRUE(parameters.wait_for_service(std::chrono::seconds(60)));
  EXPECT_TRUE(parameters.set_parameters({rclcpp::Parameter("inflation.radius", 2)}).at(0).successful);

  EXPECT_TRUE(manager->shutdown());
  EXPECT_EQ(manager->state_of("navigator"), State::PRIMARY_STATE_UNCONFIGURED);
  executor->cancel();
  thread.join();
  rclcpp::shutdown();
}
