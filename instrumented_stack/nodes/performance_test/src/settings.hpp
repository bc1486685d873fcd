// SPDX-License-Identifier: Apache-2.0
// What perf_test is told by parameters.
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
  int expected_publishers;   // to wait for, everywhere
  int expected_subscribers;  // to wait for, everywhere
  rclcpp::QoS qos{1};
  bool intra_process;
  bool zero_copy;       // publish messages that were made in memory of the middleware
  double max_runtime;   // s; 0: until interrupted
  double ignore;        // s at the beginning that do not count
  std::string logfile;  // .csv or .json; empty: none
};

// Declares the parameters of `node` and reads them. Throws std::invalid_argument naming a parameter that has no
// meaning.
Settings read_settings(rclcpp::Node& node);

}  // namespace performance_test
