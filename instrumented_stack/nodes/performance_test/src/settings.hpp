// SPDX-License-Identifier: Apache-2.0
// The settings of perf_test, from parameters.
#pragma once

#include <cstdint>
#include <rclcpp/rclcpp.hpp>
#include <string>

namespace performance_test {

struct Settings {
  std::string msg;  // Array1k … Array4m
  std::string topic;
  double rate;               // messages per second and publisher; 0: as fast as possible
  int publishers;            // in this process
  int subscribers;           // in this process
  int expected_publishers;   // to wait for, in all processes
  int expected_subscribers;  // to wait for, in all processes
  rclcpp::QoS qos{1};
  bool intra_process;
  bool zero_copy;       // publish messages that were created in memory of the middleware
  double max_runtime;   // s; 0: until interrupted
  double ignore;        // s at the beginning that do not count
  std::string logfile;  // .csv or .json; empty: none
};

// Declares the parameters of `node` and reads them. Throws std::invalid_argument, which names the parameter, for a
// meaningless value.
Settings read_settings(rclcpp::Node& node);

}  // namespace performance_test
