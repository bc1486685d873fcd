// A node that sends itself a message of its own package.
#include <cstdio>

#include "rclcpp/rclcpp.hpp"
#include "tracetools/tracetools.h"
#include "weather/msg/report.hpp"

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
  rclcpp::spin(node);
  std::printf("tracing %s\n", ros_trace_runtime_status() ? "on" : "off");
}
