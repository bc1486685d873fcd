// SPDX-License-Identifier: Apache-2.0
#include "executor/executor_wait.hpp"

#include <algorithm>
#include <cstdint>
#include <rcl/rmw_entity.hpp>
#include <utility>

#include "base/progress.hpp"

namespace rclcpp {

ExecutorWait::ExecutorWait(const std::shared_ptr<rcl_context_t>& context, const GuardCondition& interrupt)
    : interrupt_(interrupt), waitables_(context) {}

WaitedEntities ExecutorWait::exchange(WaitedEntities waited) {
  is_registered_ = false;
  timers_.assign({});
  return std::exchange(waited_, std::move(waited));
}

[[gnu::hot]] void ExecutorWait::wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready) {
  struct Release {
    AskedWaitables& waitables;
    ~Release() { waitables.release(); }
  };
  const Release release{waitables_};
  if (!is_registered_) {
    register_all();
  }
  waitables_.ask(waited_, waiter_, first_of_waitables());
  wait_for_ready(timeout, ready);
}

void ExecutorWait::register_all() {
  const auto may_be_taken = [this](const WaitedEntities::Entity& entity) {
    return waited_.groups[entity.group].may_be_taken.get();
  };
  waiter_.remove_from(0);
  waitables_.forget_registrations();
  for (const WaitedEntities::Entity& entity : waited_.entities) {
    waiter_.add(entity.rmw_entity, may_be_taken(entity));
  }
  waiter_.add(rcl::rmw_entity_of(&interrupt_.get_rcl_guard_condition()));
  std::vector<TimerQueue::Timer> timers;
  for (const WaitedEntities::Entity& timer : waited_.timers) {
    waiter_.add(timer.rmw_entity);
    timers.push_back({static_cast<const rcl_timer_t*>(timer.handle.get()), may_be_taken(timer)});
  }
  timers_.assign(std::move(timers));
  is_registered_ = true;
}

[[gnu::hot]] void ExecutorWait::wait_for_ready(std::chrono::nanoseconds timeout,
                                               std::vector<detail::ReadyEntity>& ready) {
  const std::int64_t limit = timeout.count() < 0 ? TimerQueue::kNever : timeout.count();
  const std::int64_t until_timer = std::min(timers_.time_until_first(), waitables_.time_until_first_timer());
  const std::int64_t time = std::max<std::int64_t>(0, std::min(limit, until_timer));
  const std::chrono::nanoseconds longest(time == TimerQueue::kNever ? -1 : time);
  progress::waits(longest);
  waiter_.wait(longest, positions_);
  progress::does(progress::Doing::kBetween);

  const auto begin = positions_.begin();
  const auto end_of_entities = std::lower_bound(begin, positions_.end(), interrupt_position());
  const auto own = std::lower_bound(end_of_entities, positions_.end(), first_of_waitables());
  if (own != end_of_entities && *(own - 1) > interrupt_position()) {
    timers_.forget_times();
  }
  due_.clear();
  timers_.append_due(due_);
  for (const std::size_t index : due_) {
    ready.push_back(waited_.if_ready(waited_.timers[index]));
  }
  for (auto position = begin; position != end_of_entities; ++position) {
    ready.push_back(waited_.if_ready(waited_.entities[*position]));
  }
  waitables_.append_ready(waited_, positions_.data() + (own - begin), positions_.data() + positions_.size(), ready);
}

}  // namespace rclcpp
