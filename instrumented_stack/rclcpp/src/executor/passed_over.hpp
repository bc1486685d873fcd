// SPDX-License-Identifier: Apache-2.0
// The numbers that executors give to what was ready and had to leave its turn; it goes first the next time. A number is
// an executor's own one, and a count in the lower bits. An entity that comes from another executor may still have one
// of its numbers.
#pragma once

#include <cstdint>
#include <variant>

#include "rclcpp/detail/ready_entity.hpp"

namespace rclcpp::detail {

inline constexpr unsigned kBitsOfCount = 40;

std::uint64_t first_number_of_new_executor();

constexpr bool are_of_same_executor(std::uint64_t number, std::uint64_t other) {
  return number >> kBitsOfCount == other >> kBitsOfCount;
}

inline bool is_waitable(const ReadyEntity& ready) {
  return std::holds_alternative<Waitable::WeakPtr>(ready.entity);
}

}  // namespace rclcpp::detail
