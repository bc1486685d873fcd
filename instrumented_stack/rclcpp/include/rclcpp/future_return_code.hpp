// SPDX-License-Identifier: Apache-2.0
// How spin_until_future_complete() ended.
#pragma once

#include <ostream>
#include <string>

namespace rclcpp {

enum class FutureReturnCode {
  SUCCESS,
  INTERRUPTED,  // by shutdown or cancel()
  TIMEOUT,
};

std::string to_string(const FutureReturnCode& future_return_code);
std::ostream& operator<<(std::ostream& stream, const FutureReturnCode& future_return_code);

}  // namespace rclcpp
