// SPDX-License-Identifier: Apache-2.0
#include "executor/passed_over.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "rclcpp/executor.hpp"

namespace rclcpp {

namespace detail {

std::uint64_t first_number_of_new_executor() {
  static std::atomic<std::uint64_t> executors{0};
  return ++executors << kBitsOfCount;
}

}  // namespace detail

void Executor::pass_over(detail::ReadyEntity ready) {
  std::visit(
      [this](const auto& weak) {
        if (const auto entity = weak.lock();
            entity && !detail::are_of_same_executor(passed_over(*entity), last_passed_over_)) {
          passed_over(*entity) = ++last_passed_over_;
          ++count_passed_over_;
        }
      },
      ready.entity);
  if (detail::is_waitable(ready)) {
    postponed_.push_back(std::move(ready));
  }
}

void Executor::put_in_order() {
  for (detail::ReadyEntity& ready : ready_) {
    const std::uint64_t turn = std::visit(
        [](const auto& weak) {
          const auto entity = weak.lock();
          return entity ? passed_over(*entity) : 0;
        },
        ready.entity);
    ready.turn =
        detail::are_of_same_executor(turn, last_passed_over_) ? turn : std::numeric_limits<std::uint64_t>::max();
  }
  std::stable_sort(ready_.begin(), ready_.end(), [](const auto& a, const auto& b) { return a.turn < b.turn; });
}

}  // namespace rclcpp
