#include <cstdio>

#include "tracetools/tracetools.h"
#include "weather/msg/report.hpp"

int main() {
  const weather::msg::Report report;
  std::printf("%s\n", to_yaml(report, true).c_str());
  TRACETOOLS_TRACEPOINT(rclcpp_publish, nullptr, &report);
  std::printf("tracing %s\n", ros_trace_runtime_status() ? "on" : "off");
}
