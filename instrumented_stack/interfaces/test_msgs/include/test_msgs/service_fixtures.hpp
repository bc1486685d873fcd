// SPDX-License-Identifier: Apache-2.0
// Requests of each service of test_msgs with their responses, for tests. The values are those of ROS 2, so tests that
// expect them pass. test_msgs/service_fixtures.py has the same in Python.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "test_msgs/message_fixtures.hpp"
#include "test_msgs/srv/arrays.hpp"
#include "test_msgs/srv/basic_types.hpp"
#include "test_msgs/srv/empty.hpp"

namespace test_msgs::fixtures {

template <class Service>
using Services =
    std::vector<std::pair<std::shared_ptr<typename Service::Request>, std::shared_ptr<typename Service::Response>>>;

template <class Service>
std::pair<std::shared_ptr<typename Service::Request>, std::shared_ptr<typename Service::Response>> make_service() {
  return {std::make_shared<typename Service::Request>(), std::make_shared<typename Service::Response>()};
}

// The integers are 1, 2, … times `factor`.
template <class Part>
void set_counted(Part& part, int factor) {
  set_basic_types(part, true, factor, 0.0);
  part.float32_value = static_cast<float>(factor) + 0.125F;
  part.uint8_value = static_cast<uint8_t>(2 * factor);
  part.int16_value = static_cast<int16_t>(3 * factor);
  part.uint16_value = static_cast<uint16_t>(4 * factor);
  part.int32_value = 5 * factor;
  part.uint32_value = static_cast<uint32_t>(6 * factor);
  part.int64_value = 7 * factor;
  part.uint64_value = static_cast<uint64_t>(8 * factor);
  part.string_value = digits(20000);
}

template <class Part>
void swap_first_two(Part& part) {
  const auto swap = [](auto&... values) { (std::swap(values[0], values[1]), ...); };
  swap(part.bool_values, part.byte_values, part.char_values, part.float32_values, part.float64_values, part.int8_values,
       part.uint8_values, part.int16_values, part.uint16_values, part.int32_values, part.uint32_values,
       part.int64_values, part.uint64_values, part.string_values, part.basic_types_values);
}

}  // namespace test_msgs::fixtures

inline test_msgs::fixtures::Services<test_msgs::srv::Empty> get_services_empty() {
  return {test_msgs::fixtures::make_service<test_msgs::srv::Empty>()};
}

inline test_msgs::fixtures::Services<test_msgs::srv::BasicTypes> get_services_basic_types() {
  const auto zeros = test_msgs::fixtures::make_service<test_msgs::srv::BasicTypes>();
  zeros.first->string_value = "request";
  zeros.second->string_value = "reply";
  const auto counted = test_msgs::fixtures::make_service<test_msgs::srv::BasicTypes>();
  test_msgs::fixtures::set_counted(*counted.first, 1);
  counted.first->float64_value = 1.11;
  test_msgs::fixtures::set_counted(*counted.second, 11);
  counted.second->float64_value = 11.11;
  return {zeros, counted};
}

// The response is the request with the first two elements of each array exchanged.
inline test_msgs::fixtures::Services<test_msgs::srv::Arrays> get_services_arrays() {
  const auto service = test_msgs::fixtures::make_service<test_msgs::srv::Arrays>();
  const auto basic_types = get_messages_basic_types();
  test_msgs::fixtures::set_arrays(*service.first, basic_types);
  test_msgs::fixtures::set_arrays(*service.second, basic_types);
  test_msgs::fixtures::swap_first_two(*service.second);
  return {service};
}
