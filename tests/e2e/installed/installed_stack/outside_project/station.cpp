// SPDX-License-Identifier: Apache-2.0
// A node that sends itself a message of its own package, and watches its service.
#include <cstdio>

#include "rclcpp/rclcpp.hpp"
#include "tracetools/tracetools.h"
#include "weather/msg/report.hpp"
#include "weather/srv/forecast.hpp"

using weather::srv::Forecast;

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<rclcpp::Node>("station");
  const auto publisher = node->create_publisher<weather::msg::Report>("report", 1);
  const auto subscription =
      node->create_subscription<weather::msg::Report>("report", 1, [](const weather::msg::Report& report) {
        std::printf("%s\n", to_yaml(report, true).c_str());
        rclcpp::shutdown();
      });
  const auto timer =
      node->create_wall_timer(std::chrono::milliseconds(20), [&] { publisher->publish(weather::msg::Report()); });
  const auto service = node->create_service<Forecast>(
      "forecast", [](const Forecast::Request::SharedPtr request, Forecast::Response::SharedPtr response) {
        response->reports.resize(request->days);
      });
  service->configure_introspection(node->get_clock(), rclcpp::QoS(1), RCL_SERVICE_INTROSPECTION_CONTENTS);
  std::printf("%s\n", node->get_topic_names_and_types().at("/forecast/_service_event").at(0).c_str());
  rclcpp::spin(node);
  std::printf("tracing %s\n", ros_trace_runtime_status() ? "on" : "off");
}
