// SPDX-License-Identifier: Apache-2.0
// The result of a WaitSet's wait().
#pragma once

#include <cstddef>
#include <exception>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "rclcpp/detail/wait_set_entities.hpp"
#include "rclcpp/wait_result_kind.hpp"

namespace rclcpp {

// Owns the entities that are ready. Refers to the wait set, which must outlive it.
template <typename WaitSetT>
class WaitResult final {
 public:
  WaitResult(WaitResultKind kind, WaitSetT& wait_set, detail::WaitSetFindings findings)
      : kind_(kind), wait_set_(&wait_set), findings_(std::move(findings)) {}
  WaitResult(WaitResult&& other) noexcept
      : kind_(std::exchange(other.kind_, WaitResultKind::Invalid)),
        wait_set_(other.wait_set_),
        findings_(std::move(other.findings_)) {}
  WaitResult(const WaitResult&) = delete;
  WaitResult& operator=(const WaitResult&) = delete;

  WaitResultKind kind() const { return kind_; }

  // Gives access to get_rcl_wait_set(). Throw std::runtime_error unless an entity was ready.
  const WaitSetT& get_wait_set() const {
    require_ready();
    return *wait_set_;
  }
  WaitSetT& get_wait_set() {
    require_ready();
    return *wait_set_;
  }

  // The first ready timer at that index or after it, and its index; null if there is none.
  std::pair<std::shared_ptr<TimerBase>, size_t> peek_next_ready_timer(size_t start_index = 0) {
    require_ready();
    for (size_t i = start_index; i < findings_.timers.size(); ++i) {
      if (findings_.timers[i]) {
        return {findings_.timers[i], i};
      }
    }
    return {nullptr, findings_.timers.size()};
  }
  // Marks the timer as handled.
  void clear_timer_with_index(size_t index) { findings_.timers.at(index).reset(); }

  // Returns each ready one once, then null.
  std::shared_ptr<SubscriptionBase> next_ready_subscription() { return next(findings_.subscriptions); }
  std::shared_ptr<ServiceBase> next_ready_service() { return next(findings_.services); }
  std::shared_ptr<ClientBase> next_ready_client() { return next(findings_.clients); }
  // Throws what is_ready() of a waitable has thrown; the next call goes on behind that waitable.
  std::shared_ptr<Waitable> next_ready_waitable() {
    require_ready();
    for (detail::ReadyWaitable& ready : findings_.waitables) {
      if (ready.waitable) {
        const std::shared_ptr<Waitable> waitable = std::exchange(ready.waitable, nullptr);
        if (ready.error) {
          std::rethrow_exception(ready.error);
        }
        return waitable;
      }
    }
    return nullptr;
  }

 private:
  void require_ready() const {
    if (kind_ != WaitResultKind::Ready) {
      throw std::runtime_error("cannot access wait set when the result was not ready");
    }
  }

  template <typename EntityT>
  std::shared_ptr<EntityT> next(std::vector<std::shared_ptr<EntityT>>& entities) {
    require_ready();
    for (std::shared_ptr<EntityT>& entity : entities) {
      if (entity) {
        return std::exchange(entity, nullptr);
      }
    }
    return nullptr;
  }

  WaitResultKind kind_;
  WaitSetT* wait_set_;
  detail::WaitSetFindings findings_;
};

}  // namespace rclcpp
