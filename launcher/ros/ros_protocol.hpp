// SPDX-License-Identifier: Apache-2.0
// The messages between the launcher and launch-ros-client: one JSON object a line, both ways.
//
//   {"id": 1, "do": "load_node", "container": "/c", "node": {"package": "demo", …}}       a request
//   {"id": 2, "do": "wait_topic", "topic": "/scan", "timeout": 5.0}                        seconds; none: for ever
//   {"id": 2, "do": "cancel"}
//   {"id": 1, "ok": true, "node": "/talker", "unique_id": 1}                               an answer
//   {"id": 2, "ok": false, "error": "no publisher of '/scan' within 5 s"}
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "launcher/ros/ros_client.hpp"

namespace launch {

using RosRequestId = std::uint64_t;

struct RosRequestLine {
  RosRequestId id = 0;
  std::optional<RosRequest> request;  // none: cancel it
  Duration timeout{0};                // zero: none
};

struct RosAnswerLine {
  RosRequestId id = 0;
  RosAnswer answer;
};

// Writes a message as a line, with its line end.
std::string to_line(const RosRequestLine& line);
std::string to_line(const RosAnswerLine& line);

// Throw std::runtime_error for any other text.
RosRequestLine parse_request_line(std::string_view text);
RosAnswerLine parse_answer_line(std::string_view text);

}  // namespace launch
