// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/experimental/executors/events_executor/events_executor.hpp"

#include <tracetools/tracetools.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "base/progress.hpp"
#include "executor/executor_entities.hpp"

namespace rclcpp::experimental::executors {

namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

template <typename EntityT>
void add_to(std::unordered_map<const void*, std::weak_ptr<EntityT>>& served,
            const std::vector<std::shared_ptr<EntityT>>& entities) {
  for (const std::shared_ptr<EntityT>& entity : entities) {
    served.emplace(entity.get(), entity);
  }
}

// The entity with that key, null if it has gone.
template <typename EntityT>
std::shared_ptr<EntityT> find_in(const std::unordered_map<const void*, std::weak_ptr<EntityT>>& served,
                                 const void* key) {
  const auto found = served.find(key);
  return found == served.end() ? nullptr : found->second.lock();
}

}  // namespace

EventsExecutor::EventsExecutor(EventsQueue::UniquePtr events_queue, bool execute_timers_separate_thread,
                               const rclcpp::ExecutorOptions& options)
    : Executor(options),
      events_queue_(std::move(events_queue)),
      execute_timers_separate_thread_(execute_timers_separate_thread),
      timers_(context_, [this] { wake(); }) {
  if (!events_queue_) {
    throw std::invalid_argument("events_queue can't be a null pointer");
  }
  entities_->set_on_change([this] { wake(); });
  wake();
}

EventsExecutor::~EventsExecutor() {
  spinning_ = false;
  entities_->set_on_change(nullptr);
  entities_->remove_all();
  timers_.stop();
  refresh();
}

void EventsExecutor::spin() {
  const SpinningScope scope(*this, "spin()");
  const progress::Spin spin(progress::Doing::kNothing);
  struct TimersThread {
    EventsExecutor& executor;
    ~TimersThread() {
      executor.timers_.stop();
      executor.timers_thread_runs_ = false;
    }
  };
  const TimersThread timers_thread{*this};
  if (execute_timers_separate_thread_) {
    timers_.start();
    timers_thread_runs_ = true;
  }
  while (context_->is_valid() && spinning_) {
    take_turn(nanoseconds::max(), !timers_thread_runs_, true);
  }
}

void EventsExecutor::spin_all(nanoseconds max_duration) {
  if (max_duration <= nanoseconds::zero()) {
    throw std::invalid_argument("max_duration must be positive");
  }
  Executor::spin_all(max_duration);
}

void EventsExecutor::spin_once_impl(nanoseconds timeout) {
  const auto start = steady_clock::now();
  Turn turn = Turn::kWakeUp;
  while (context_->is_valid() && spinning_ && turn == Turn::kWakeUp) {
    nanoseconds left = nanoseconds::max();
    if (timeout >= nanoseconds::zero()) {
      left = std::max<nanoseconds>(timeout - (steady_clock::now() - start), nanoseconds::zero());
    }
    turn = take_turn(left, true, true);
  }
}

void EventsExecutor::spin_some_impl(nanoseconds max_duration, bool exhaustive) {
  const auto start = steady_clock::now();
  const auto time_left = [&] {
    return max_duration == nanoseconds::zero() || steady_clock::now() - start < max_duration;
  };
  wake_up_queued_ = false;
  refresh();  // what it finds waiting is in the queue then
  size_t events = events_queue_->size() + (next_ ? 1 : 0);
  size_t timers = timers_.get_number_ready_timers();
  while (context_->is_valid() && spinning_ && time_left()) {
    switch (take_turn(nanoseconds::zero(), exhaustive || timers > 0, exhaustive || events > 0)) {
      case Turn::kNone:
        return;
      case Turn::kTimer:
        timers -= std::min<size_t>(timers, 1);
        break;
      case Turn::kEvent:
      case Turn::kWakeUp:
        events -= std::min<size_t>(events, 1);
        break;
    }
  }
}

void EventsExecutor::remove_node(const NodePtr& node, bool notify) {
  remove_and_disconnect([&] { Executor::remove_node(node, notify); });
}

void EventsExecutor::remove_callback_group(const CallbackGroup::SharedPtr& group, bool notify) {
  remove_and_disconnect([&] { Executor::remove_callback_group(group, notify); });
}

template <typename RemoveT>
void EventsExecutor::remove_and_disconnect(RemoveT remove) {
  std::vector<std::pair<CallbackGroup::WeakPtr, CallbackGroup::Entities>> before;  // released without the lock
  const std::lock_guard lock(connections_mutex_);
  const detail::OnReadyCallback::HandBack hand_back;
  before = entities_->entities();
  remove();
  const std::vector<CallbackGroup::WeakPtr> after = get_all_callback_groups();
  const auto disconnect = [this](const auto& served, const auto& entities, auto stop) {
    for (const auto& entity : entities) {
      if (served.count(entity.get()) != 0) {
        stop(entity);
        disconnected_.push_back(entity.get());
      }
    }
  };
  const auto remove_timer = [this](const TimerBase::SharedPtr& timer) { timers_.remove_timer(timer); };
  for (const auto& [group, entities] : before) {
    if (std::any_of(after.begin(), after.end(), [&removed = group](const CallbackGroup::WeakPtr& weak) {
          return !weak.owner_before(removed) && !removed.owner_before(weak);
        })) {
      continue;
    }
    disconnect(subscriptions_, entities.subscriptions,
               [](const auto& entity) { entity->clear_on_new_message_callback(); });
    disconnect(services_, entities.services, [](const auto& entity) { entity->clear_on_new_request_callback(); });
    disconnect(clients_, entities.clients, [](const auto& entity) { entity->clear_on_new_response_callback(); });
    disconnect(waitables_, entities.waitables, [](const auto& entity) { entity->clear_on_ready_callback(); });
    disconnect(timers_served_, entities.timers, remove_timer);
    for (const Waitable::SharedPtr& waitable : entities.waitables) {
      disconnect(timers_served_, waitable->get_timers(), remove_timer);
    }
  }
}

EventsExecutor::Turn EventsExecutor::take_turn(nanoseconds timeout, bool of_timers, bool of_events) {
  if (of_timers && timers_left_ > 0) {
    --timers_left_;
    if (timers_.execute_head_timer()) {
      return Turn::kTimer;
    }
    timers_left_ = 0;
  }
  const nanoseconds until_timer = of_timers ? timers_.get_head_timeout() : nanoseconds::max();
  const bool is_due = until_timer <= nanoseconds::zero();
  if (!is_due) {
    had_turns_.clear();
  }
  ExecutorEvent event;
  bool has_event = false;
  if (of_events && next_) {
    event = *next_;
    next_.reset();
    has_event = true;
  } else if (of_events) {
    const nanoseconds longest = std::clamp(until_timer, nanoseconds::zero(), timeout);
    progress::waits(longest);
    has_event = events_queue_->dequeue(event, longest);
    progress::does(progress::Doing::kBetween);
  }
  if (!has_event) {
    return of_timers && until_timer <= timeout && timers_.execute_head_timer() ? Turn::kTimer : Turn::kNone;
  }
  if (is_due && has_had_turn(event)) {
    had_turns_.clear();
    timers_left_ = timers_.get_number_ready_timers();
    next_ = event;
    return take_turn(timeout, of_timers, of_events);
  }
  if (is_due) {
    had_turns_.push_back(event.entity_key);
  }
  execute_event(event);
  return is_wake_up(event) ? Turn::kWakeUp : Turn::kEvent;
}

bool EventsExecutor::has_had_turn(const ExecutorEvent& event) const {
  return std::find(had_turns_.begin(), had_turns_.end(), event.entity_key) != had_turns_.end();
}

void EventsExecutor::execute_event(const ExecutorEvent& event) {
  if (is_wake_up(event)) {
    wake_up_queued_ = false;  // first: what changes from here on needs another one
    refresh();
    return;
  }
  for (size_t i = 0; i < event.num_events; ++i) {
    if (entities_->removals() != removals_seen_) {
      refresh();  // the event may be of what has left
    }
    switch (event.type) {
      case SUBSCRIPTION_EVENT:
        if (const auto subscription = find_in(subscriptions_, event.entity_key)) {
          const progress::Callback callback(progress::Doing::kSubscription);
          subscription->execute();
        }
        break;
      case SERVICE_EVENT:
        if (const auto service = find_in(services_, event.entity_key)) {
          const progress::Callback callback(progress::Doing::kService);
          service->execute();
        }
        break;
      case CLIENT_EVENT:
        if (const auto client = find_in(clients_, event.entity_key)) {
          const progress::Callback callback(progress::Doing::kClient);
          client->execute();
        }
        break;
      case WAITABLE_EVENT:
        if (const auto waitable = find_in(waitables_, event.entity_key)) {
          TRACETOOLS_EXT_TRACEPOINT(rclcpp_executor_execute_waitable, static_cast<const void*>(waitable.get()));
          const progress::Callback callback(progress::Doing::kWaitable);
          waitable->execute(waitable->take_data_by_entity_id(static_cast<size_t>(event.waitable_data)));
        }
        break;
      case TIMER_EVENT:  // of queues that have them; timers are run by their times here
        break;
    }
  }
}

void EventsExecutor::wake() {
  if (!wake_up_queued_.exchange(true)) {
    events_queue_->enqueue({this, 0, WAITABLE_EVENT, 1});
  }
}

void EventsExecutor::enqueue(const void* entity, ExecutorEventType type, size_t count, int waitable_data) {
  events_queue_->enqueue({entity, waitable_data, type, count});
}

void EventsExecutor::refresh() {
  Served<SubscriptionBase> subscriptions;
  Served<ServiceBase> services;
  Served<ClientBase> clients;
  Served<Waitable> waitables;
  Served<TimerBase> timers;
  std::vector<std::pair<CallbackGroup::WeakPtr, CallbackGroup::Entities>> groups;  // released without the lock
  const std::lock_guard lock(connections_mutex_);
  for (const void* key : disconnected_) {
    subscriptions_.erase(key);
    services_.erase(key);
    clients_.erase(key);
    waitables_.erase(key);
    timers_served_.erase(key);
  }
  disconnected_.clear();
  removals_seen_ = entities_->removals();
  groups = entities_->entities();
  for (const auto& [group, entities] : groups) {
    add_to(subscriptions, entities.subscriptions);
    add_to(services, entities.services);
    add_to(clients, entities.clients);
    add_to(waitables, entities.waitables);
    add_to(timers, entities.timers);
    for (const Waitable::SharedPtr& waitable : entities.waitables) {
      add_to(timers, waitable->get_timers());
    }
  }
  update(
      subscriptions_, std::move(subscriptions),
      [this](SubscriptionBase& subscription) {
        subscription.set_on_new_message_callback(
            [this, key = &subscription](size_t count) { enqueue(key, SUBSCRIPTION_EVENT, count); });
      },
      [](SubscriptionBase& subscription) { subscription.clear_on_new_message_callback(); });
  update(
      services_, std::move(services),
      [this](ServiceBase& service) {
        service.set_on_new_request_callback(
            [this, key = &service](size_t count) { enqueue(key, SERVICE_EVENT, count); });
      },
      [](ServiceBase& service) { service.clear_on_new_request_callback(); });
  update(
      clients_, std::move(clients),
      [this](ClientBase& client) {
        client.set_on_new_response_callback([this, key = &client](size_t count) { enqueue(key, CLIENT_EVENT, count); });
      },
      [](ClientBase& client) { client.clear_on_new_response_callback(); });
  update(
      waitables_, std::move(waitables),
      [this](Waitable& waitable) {
        waitable.set_on_ready_callback(
            [this, key = &waitable](size_t count, int id) { enqueue(key, WAITABLE_EVENT, count, id); });
      },
      [](Waitable& waitable) { waitable.clear_on_ready_callback(); });
  for (const auto& [key, weak] : timers_served_) {
    if (timers.count(key) == 0) {
      if (const TimerBase::SharedPtr timer = weak.lock()) {
        timers_.remove_timer(timer);
      }
    }
  }
  for (const auto& [key, weak] : timers) {
    const auto known = timers_served_.find(key);
    const TimerBase::SharedPtr timer = weak.lock();
    if (timer && (known == timers_served_.end() || known->second.expired())) {
      timers_.add_timer(timer);
    }
  }
  timers_.remove_expired();
  timers_served_ = std::move(timers);
}

template <typename EntityT, typename StartT, typename StopT>
void EventsExecutor::update(Served<EntityT>& served, Served<EntityT> found, StartT start, StopT stop) {
  const detail::OnReadyCallback::HandBack hand_back;
  for (auto it = served.begin(); it != served.end();) {
    // Another entity can be where one was that has gone.
    const std::shared_ptr<EntityT> entity = it->second.lock();
    const bool stays = entity && found.count(it->first) != 0;
    if (entity && !stays) {
      stop(*entity);
    }
    it = stays ? std::next(it) : served.erase(it);
  }
  for (auto& [key, weak] : found) {
    if (const std::shared_ptr<EntityT> entity = weak.lock(); entity && served.count(key) == 0) {
      start(*entity);
      served.emplace(key, weak);
    }
  }
}

}  // namespace rclcpp::experimental::executors
