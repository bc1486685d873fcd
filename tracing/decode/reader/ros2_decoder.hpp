// SPDX-License-Identifier: Apache-2.0
// Turns recorded events of ros2_tracing into structs.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tracing/decode/reader/event.hpp"
#include "tracing/decode/reader/ros2_events.hpp"

namespace tracing::ros2 {

class Decoder {
 public:
  // Calls `report` once per event class for fields that are missing or have an unexpected type: "ros2:rmw_publish has
  // no field timestamp". Such events are decoded all the same. Extra fields are ignored.
  // `provider`: whose events are decoded. Those of CARET have the names of ROS 2's, and dds_write stands for
  // rmw_publish.
  enum class Provider { kRos2, kCaret };
  explicit Decoder(std::function<void(const std::string&)> report, Provider provider = Provider::kRos2);
  ~Decoder();

  // The event as a struct, valid until the next call; null when it is not one of the 42.
  const AnyEvent* decode(const Event& event);

  // The facts about an event class, known since its first event.
  struct Plan;

 private:
  const Plan& plan_for(const Event& event);

  std::function<void(const std::string&)> report_;
  Provider provider_;
  std::vector<std::unique_ptr<Plan>> plans_;  // by EventClass::id
  AnyEvent decoded_;
};

}  // namespace tracing::ros2
