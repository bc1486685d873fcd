// SPDX-License-Identifier: Apache-2.0
#include "executor/group_queues.hpp"

#include <tracetools/tracetools.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace rclcpp {

namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

constexpr auto kReadyLater = [](const auto& a, const auto& b) { return a.turn > b.turn; };

// The member of an executable for an entity.
TimerBase::SharedPtr& member_of(AnyExecutable& executable, const TimerBase::WeakPtr&) {
  return executable.timer;
}
SubscriptionBase::SharedPtr& member_of(AnyExecutable& executable, const SubscriptionBase::WeakPtr&) {
  return executable.subscription;
}
ServiceBase::SharedPtr& member_of(AnyExecutable& executable, const ServiceBase::WeakPtr&) {
  return executable.service;
}
ClientBase::SharedPtr& member_of(AnyExecutable& executable, const ClientBase::WeakPtr&) {
  return executable.client;
}
Waitable::SharedPtr& member_of(AnyExecutable& executable, const Waitable::WeakPtr&) {
  return executable.waitable;
}

std::shared_ptr<void> take_out(const detail::AnyEntity& entity, AnyExecutable& executable) {
  return std::visit([&](const auto& weak) -> std::shared_ptr<void> { return std::move(member_of(executable, weak)); },
                    entity);
}

}  // namespace

GroupQueues::Work::~Work() {
  release();
  if (group_) {
    SleepingThreads::Thread* woken = nullptr;
    {
      const std::lock_guard lock(queues_.mutex_);
      queues_.finish(*this);
      woken = queues_.wake_if_needed();
    }
    SleepingThreads::notify(woken);
  }
}

[[gnu::hot]] bool GroupQueues::Work::take_data() {
  if (waitable_) {
    const std::lock_guard lock(waitable_->take_mutex);
    executable_.data = executable_.waitable->take_data_by_entity_id(static_cast<std::size_t>(event_));
  }
  return !executable_.timer || executable_.data;
}

[[gnu::hot]] void GroupQueues::Work::release() {
  executable_.release_group();
  executable_.timer.reset();
  executable_.subscription.reset();
  executable_.service.reset();
  executable_.client.reset();
  executable_.waitable.reset();
  executable_.data.reset();
  waitable_.reset();
}

[[gnu::hot]] void GroupQueues::add(const std::shared_ptr<Entity>& entity, std::size_t count, int event) {
  SleepingThreads::Thread* woken = nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (is_frozen_) {
      arrivals_.push_back({entity, count, event});
      return;
    }
    arrived(*entity, count, event);
    woken = wake_if_needed();
  }
  SleepingThreads::notify(woken);
}

void GroupQueues::timers_changed() {
  are_times_changed_ = true;
  SleepingThreads::Thread* woken = nullptr;
  {
    const std::lock_guard lock(mutex_);
    woken = threads_.wake_for_timers();
  }
  SleepingThreads::notify(woken);
}

void GroupQueues::set_timers(std::vector<std::shared_ptr<Entity>> timers) {
  std::vector<TimerQueue::Timer> queued;
  static const std::atomic_bool kMayBeTaken{true};
  for (const std::shared_ptr<Entity>& timer : timers) {
    queued.push_back({timer->timer.get(), &kMayBeTaken});
  }
  {
    const std::lock_guard lock(mutex_);
    timer_entities_.swap(timers);
    timers_.assign(std::move(queued));
    for (std::size_t i = 0; i < timer_entities_.size(); ++i) {
      timer_entities_[i]->timer_index = i;
      if (timer_entities_[i]->turn != 0) {
        timers_.leave_out(i);
      }
    }
  }
  timers_changed();
}

void GroupQueues::remove(const std::vector<std::shared_ptr<Entity>>& entities) {
  const std::lock_guard lock(mutex_);
  for (const std::shared_ptr<Entity>& entity : entities) {
    unqueue(*entity);
    entity->count = 0;
    entity->is_removed = true;
  }
}

void GroupQueues::remove(Group& group) {
  const std::lock_guard lock(mutex_);
  group.is_removed = true;
  std::erase_if(listed_, [&group](const Listed& listed) { return listed.group == &group; });
  std::make_heap(listed_.begin(), listed_.end(), kReadyLater);
  group.is_listed = false;
  std::erase(busy_elsewhere_, &group);
}

void GroupQueues::look_again() {
  const std::lock_guard lock(mutex_);
  for (Group* group : std::exchange(busy_elsewhere_, {})) {
    group->is_busy_elsewhere = false;
    list(*group);
  }
}

bool GroupQueues::take(Work& work) {
  std::uint64_t seen = 0;
  do {
    seen = interruptions_;
    if (wait(work, nanoseconds::zero(), seen)) {
      return true;
    }
  } while (interruptions_ != seen);
  return false;
}

[[gnu::hot]] bool GroupQueues::wait(Work& work, nanoseconds timeout, std::uint64_t seen) {
  Released released;
  SleepingThreads::Thread* woken = nullptr;
  bool has_taken = false;
  {
    std::unique_lock lock(mutex_);
    finish(work);
    auto deadline = steady_clock::time_point::max();
    bool has_deadline = timeout < nanoseconds::zero();
    // An interruption goes first: nothing is begun after a cancellation.
    while (interruptions_ == seen && !(has_taken = take_next(work, released)) && timeout != nanoseconds::zero()) {
      if (!has_deadline) {
        const auto now = steady_clock::now();
        deadline = timeout < deadline - now ? now + timeout : deadline;
        has_deadline = true;
      } else if (deadline != steady_clock::time_point::max() && steady_clock::now() >= deadline) {
        break;
      }
      TRACETOOLS_TRACEPOINT(rclcpp_executor_wait_for_work, timeout.count());
      threads_.sleep(lock, deadline, timers_);
    }
    woken = wake_if_needed();
  }
  SleepingThreads::notify(woken);
  return has_taken;
}

void GroupQueues::interrupt() {
  std::vector<SleepingThreads::Thread*> woken;
  {
    const std::lock_guard lock(mutex_);
    ++interruptions_;
    while (SleepingThreads::Thread* thread = threads_.wake_one()) {
      woken.push_back(thread);
    }
  }
  for (SleepingThreads::Thread* thread : woken) {
    SleepingThreads::notify(thread);
  }
}

GroupQueues::OnlyWhatIsReady::OnlyWhatIsReady(GroupQueues& queues) : queues_(queues) {
  const std::lock_guard lock(queues_.mutex_);
  queues_.queue_due_timers();
  queues_.is_frozen_ = true;
}

GroupQueues::OnlyWhatIsReady::~OnlyWhatIsReady() {
  std::vector<Arrival> arrivals;  // released without the lock
  const std::lock_guard lock(queues_.mutex_);
  queues_.is_frozen_ = false;
  arrivals.swap(queues_.arrivals_);
  for (const Arrival& arrival : arrivals) {
    queues_.arrived(*arrival.entity, arrival.count, arrival.event);
  }
}

[[gnu::hot]] void GroupQueues::arrived(Entity& entity, std::size_t count, int event) {
  if (entity.is_removed || count == 0) {
    return;
  }
  entity.count += count;
  if (std::holds_alternative<Waitable::WeakPtr>(entity.entity)) {
    if (!entity.events.empty() && entity.events.back().first == event) {
      entity.events.back().second += count;
    } else {
      entity.events.emplace_back(event, count);
    }
  }
  if (entity.turn == 0) {
    queue(entity);
  }
}

[[gnu::hot]] void GroupQueues::queue(Entity& entity) {
  entity.turn = ++last_turn_;
  Group& group = *entity.group;
  group.ready.splice(group.ready.end(), entity.unqueued, entity.node);
  list(group);
}

[[gnu::hot]] void GroupQueues::unqueue(Entity& entity) {
  if (entity.turn != 0) {
    entity.turn = 0;
    entity.unqueued.splice(entity.unqueued.begin(), entity.group->ready, entity.node);
  }
}

[[gnu::hot]] void GroupQueues::list(Group& group) {
  if (group.ready.empty() || group.is_listed || group.is_running || group.is_busy_elsewhere || group.is_removed) {
    return;
  }
  group.is_listed = true;
  listed_.push_back({group.ready.front()->turn, &group});
  std::push_heap(listed_.begin(), listed_.end(), kReadyLater);
}

[[gnu::hot]] void GroupQueues::finish(Work& work) {
  if (work.group_) {
    work.group_->is_running = false;
    list(*work.group_);
    work.group_.reset();
  }
}

[[gnu::hot]] void GroupQueues::queue_due_timers() {
  if (are_times_changed_.load(std::memory_order_relaxed) && are_times_changed_.exchange(false)) {
    timers_.forget_times();
  }
  if (timer_entities_.empty()) {
    return;
  }
  due_.clear();
  timers_.take_due(due_);
  for (const std::size_t index : due_) {
    arrived(*timer_entities_[index], 1, 0);
  }
}

[[gnu::hot]] bool GroupQueues::take_next(Work& work, Released& released) {
  TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready);
  if (!is_frozen_) {
    queue_due_timers();
  }
  while (!listed_.empty()) {
    std::pop_heap(listed_.begin(), listed_.end(), kReadyLater);
    Group& group = *listed_.back().group;
    listed_.pop_back();
    group.is_listed = false;
    CallbackGroup::SharedPtr living = group.group.lock();
    if (!living) {
      continue;  // the change that removes it is on its way
    }
    if (!find_first(group, work.executable_, released)) {
      released.groups.push_back(std::move(living));
      continue;
    }
    if (group.is_exclusive && !living->can_be_taken_from().exchange(false)) {
      group.is_busy_elsewhere = true;
      busy_elsewhere_.push_back(&group);
      released.entities.push_back(take_out(group.ready.front()->entity, work.executable_));
      released.groups.push_back(std::move(living));
      continue;
    }
    work.executable_.callback_group = std::move(living);
    take_first(group, work);
    return true;
  }
  return false;
}

[[gnu::hot]] bool GroupQueues::find_first(Group& group, AnyExecutable& executable, Released& released) {
  while (!group.ready.empty()) {
    Entity& entity = *group.ready.front();
    const bool lives = std::visit(
        [&](const auto& weak) {
          auto& member = member_of(executable, weak);
          member = weak.lock();
          return member != nullptr;
        },
        entity.entity);
    if (lives && (!executable.timer || executable.timer->is_ready())) {
      return true;
    }
    unqueue(entity);
    entity.count = 0;
    if (lives) {  // a timer that was reset or canceled meanwhile
      timers_.put_back(entity.timer_index);
      released.entities.push_back(take_out(entity.entity, executable));
    }
  }
  return false;
}

[[gnu::hot]] void GroupQueues::take_first(Group& group, Work& work) {
  Entity& entity = *group.ready.front();
  work.group_ = entity.group;
  group.is_running = group.is_exclusive;
  unqueue(entity);
  --entity.count;
  if (work.executable_.timer) {
    work.executable_.data = work.executable_.timer->call();
    timers_.put_back(entity.timer_index);
  } else if (work.executable_.waitable) {
    work.waitable_ = entity.shared_from_this();
    auto& [event, count] = entity.events.front();
    work.event_ = event;
    if (--count == 0) {
      entity.events.erase(entity.events.begin());
    }
  }
  if (entity.count > 0) {
    queue(entity);
  }
  list(group);
}

[[gnu::hot]] SleepingThreads::Thread* GroupQueues::wake_if_needed() {
  return threads_.is_one_needed(listed_.size()) ? threads_.wake_one() : nullptr;
}

}  // namespace rclcpp
