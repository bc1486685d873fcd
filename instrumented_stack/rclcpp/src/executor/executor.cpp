// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/executor.hpp"

#include <tracetools/tracetools.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "base/progress.hpp"
#include "executor/executor_entities.hpp"
#include "executor/passed_over.hpp"
#include "rclcpp/node.hpp"

namespace rclcpp {

namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

// Keeps a node in an executor for the time of a call.
class Membership {
 public:
  Membership(Executor& executor, const Executor::NodePtr& node) : executor_(executor), node_(node) {
    executor_.add_node(node_);
  }
  ~Membership() { executor_.remove_node(node_); }
  RCLCPP_DISABLE_COPY(Membership)

 private:
  Executor& executor_;
  const Executor::NodePtr& node_;
};

// Puts an entity that a wait has found into `any_executable`. False if it is no longer ready.
bool choose(const TimerBase::SharedPtr& timer, AnyExecutable& any_executable) {
  any_executable.data = timer->call();
  if (!any_executable.data) {
    return false;
  }
  any_executable.timer = timer;
  return true;
}
bool choose(const SubscriptionBase::SharedPtr& subscription, AnyExecutable& any_executable) {
  any_executable.subscription = subscription;
  return true;
}
bool choose(const ServiceBase::SharedPtr& service, AnyExecutable& any_executable) {
  any_executable.service = service;
  return true;
}
bool choose(const ClientBase::SharedPtr& client, AnyExecutable& any_executable) {
  any_executable.client = client;
  return true;
}
bool choose(const Waitable::SharedPtr& waitable, AnyExecutable& any_executable) {
  any_executable.data = waitable->take_data();
  any_executable.waitable = waitable;
  return true;
}

// After a wait beside which a group was given back. A thread that gives one back may be kept from ending it for long.
constexpr int kMostLooks = 3;

bool are_same_waitable(const detail::ReadyEntity& a, const detail::ReadyEntity& b) {
  const auto* waitable_a = std::get_if<Waitable::WeakPtr>(&a.entity);
  const auto* waitable_b = std::get_if<Waitable::WeakPtr>(&b.entity);
  return waitable_a && waitable_b && !waitable_a->owner_before(*waitable_b) && !waitable_b->owner_before(*waitable_a);
}

}  // namespace

std::string to_string(const FutureReturnCode& future_return_code) {
  switch (future_return_code) {
    case FutureReturnCode::SUCCESS:
      return "SUCCESS (0)";
    case FutureReturnCode::INTERRUPTED:
      return "INTERRUPTED (1)";
    case FutureReturnCode::TIMEOUT:
      return "TIMEOUT (2)";
  }
  return "Unknown enum value (" + std::to_string(static_cast<int>(future_return_code)) + ")";
}

std::ostream& operator<<(std::ostream& stream, const FutureReturnCode& future_return_code) {
  return stream << to_string(future_return_code);
}

Executor::SpinningScope::SpinningScope(Executor& executor, const char* function) : executor_(executor) {
  if (executor_.spinning_.exchange(true)) {
    throw std::runtime_error(std::string(function) + " called while already spinning");
  }
}

Executor::Executor(const ExecutorOptions& options)
    : context_(options.context), entities_(std::make_shared<ExecutorEntities>(options.context)) {
  last_passed_over_ = detail::first_number_of_new_executor();
  progress::join();
  shutdown_callback_ = context_->add_on_shutdown_callback([weak = std::weak_ptr(entities_)] {
    if (const auto entities = weak.lock()) {
      entities->interrupt();
    }
  });
}

Executor::~Executor() {
  context_->remove_on_shutdown_callback(shutdown_callback_);
  entities_->remove_all();
  erase_unserved();
}

void Executor::add_node(const NodePtr& node, bool) {
  entities_->add_node(node);
}
void Executor::add_node(const std::shared_ptr<Node>& node, bool notify) {
  add_node(node->get_node_base_interface(), notify);
}
void Executor::remove_node(const NodePtr& node, bool) {
  entities_->remove_node(node);
}
void Executor::remove_node(const std::shared_ptr<Node>& node, bool notify) {
  remove_node(node->get_node_base_interface(), notify);
}

void Executor::add_callback_group(const CallbackGroup::SharedPtr& group, const NodePtr& node, bool) {
  entities_->add_group(group, node);
}
void Executor::remove_callback_group(const CallbackGroup::SharedPtr& group, bool) {
  entities_->remove_group(group);
}
std::vector<CallbackGroup::WeakPtr> Executor::get_all_callback_groups() {
  return entities_->groups(ExecutorEntities::Origin::kAny);
}
std::vector<CallbackGroup::WeakPtr> Executor::get_manually_added_callback_groups() {
  return entities_->groups(ExecutorEntities::Origin::kAddedByHand);
}
std::vector<CallbackGroup::WeakPtr> Executor::get_automatically_added_callback_groups_from_nodes() {
  return entities_->groups(ExecutorEntities::Origin::kOfNodes);
}

void Executor::spin_once(nanoseconds timeout) {
  const SpinningScope scope(*this, "spin_once()");
  const progress::Spin spin(progress::Doing::kAway);
  spin_once_impl(timeout);
}

void Executor::spin_once_impl(nanoseconds timeout) {
  AnyExecutable any_executable;
  if (get_next_executable(any_executable, timeout)) {
    execute_any_executable(any_executable);
  }
}

void Executor::spin_some(nanoseconds max_duration) {
  const SpinningScope scope(*this, "spin_some()");
  const progress::Spin spin(progress::Doing::kAway);
  spin_some_impl(max_duration, false);
}

void Executor::spin_all(nanoseconds max_duration) {
  if (max_duration < nanoseconds::zero()) {
    throw std::invalid_argument("max_duration must be greater than or equal to 0");
  }
  const SpinningScope scope(*this, "spin_all()");
  const progress::Spin spin(progress::Doing::kAway);
  spin_some_impl(max_duration, true);
}

void Executor::spin_some_impl(nanoseconds max_duration, bool exhaustive) {
  const auto start = steady_clock::now();
  const auto time_left = [&] {
    return max_duration == nanoseconds::zero() || steady_clock::now() - start < max_duration;
  };
  wait_for_work(nanoseconds::zero());
  bool executed_since_wait = false;
  while (context_->is_valid() && spinning_ && time_left()) {
    AnyExecutable any_executable;
    if (get_next_ready_executable(any_executable)) {
      execute_any_executable(any_executable);
      executed_since_wait = true;
    } else if (exhaustive && executed_since_wait) {
      wait_for_work(nanoseconds::zero());
      executed_since_wait = false;
    } else {
      return;
    }
  }
}

void Executor::spin_node_some(const NodePtr& node) {
  const Membership membership(*this, node);
  spin_some();
}
void Executor::spin_node_some(const std::shared_ptr<Node>& node) {
  spin_node_some(node->get_node_base_interface());
}

void Executor::spin_node_all(const NodePtr& node, nanoseconds max_duration) {
  const Membership membership(*this, node);
  spin_all(max_duration);
}
void Executor::spin_node_all(const std::shared_ptr<Node>& node, nanoseconds max_duration) {
  spin_node_all(node->get_node_base_interface(), max_duration);
}

void Executor::spin_node_once_nanoseconds(const NodePtr& node, nanoseconds timeout) {
  const Membership membership(*this, node);
  spin_once(timeout);
}

FutureReturnCode Executor::spin_until(const std::function<bool()>& complete, nanoseconds timeout) {
  if (complete()) {
    return FutureReturnCode::SUCCESS;
  }
  const SpinningScope scope(*this, "spin_until_future_complete()");
  const progress::Spin spin(progress::Doing::kNothing);
  const auto start = steady_clock::now();
  nanoseconds timeout_left = timeout;
  while (context_->is_valid() && spinning_) {
    spin_once_impl(timeout_left);
    if (complete()) {
      return FutureReturnCode::SUCCESS;
    }
    if (timeout < nanoseconds::zero()) {
      continue;
    }
    timeout_left = timeout - (steady_clock::now() - start);
    if (timeout_left <= nanoseconds::zero()) {
      return FutureReturnCode::TIMEOUT;
    }
  }
  return FutureReturnCode::INTERRUPTED;
}

void Executor::cancel() {
  spinning_ = false;
  interrupt();
}

void Executor::interrupt() {
  entities_->interrupt();
}

[[gnu::hot]] bool Executor::get_next_executable(AnyExecutable& any_executable, nanoseconds timeout) {
  if (get_next_ready_executable(any_executable)) {
    return true;
  }
  wait_for_work(timeout);
  return spinning_ && get_next_ready_executable(any_executable);
}

[[gnu::hot]] bool Executor::get_next_ready_executable(AnyExecutable& any_executable) {
  TRACETOOLS_TRACEPOINT(rclcpp_executor_get_next_ready);
  if (const size_t removals = entities_->removals(); removals != removals_seen_) {
    removals_seen_ = removals;
    erase_unserved();
  }
  while (next_ready_ < ready_.size()) {
    detail::ReadyEntity& ready = ready_[next_ready_++];
    CallbackGroup::SharedPtr group = ready.group.lock();
    if (!group) {
      continue;
    }
    if (group->type() == CallbackGroupType::MutuallyExclusive && !group->can_be_taken_from().exchange(false)) {
      pass_over(std::move(ready));
      continue;
    }
    any_executable.callback_group = std::move(group);
    if (std::visit([&](const auto& weak) { return choose_living(weak.lock(), any_executable); }, ready.entity)) {
      return true;
    }
    any_executable.release_group();
  }
  return false;
}

template <typename EntityT>
bool Executor::choose_living(const std::shared_ptr<EntityT>& entity, AnyExecutable& any_executable) {
  if (!entity) {
    return false;
  }
  if (detail::are_of_same_executor(std::exchange(passed_over(*entity), 0), last_passed_over_) &&
      count_passed_over_ > 0) {
    --count_passed_over_;
  }
  return choose(entity, any_executable);
}

void Executor::erase_unserved() {
  ready_.erase(ready_.begin(), ready_.begin() + static_cast<std::ptrdiff_t>(next_ready_));
  next_ready_ = 0;
  entities_->erase_unserved(ready_);
  entities_->erase_unserved(postponed_);
}

[[gnu::hot]] void Executor::wait_for_work(nanoseconds timeout) {
  TRACETOOLS_TRACEPOINT(rclcpp_executor_wait_for_work, timeout.count());
  for (; next_ready_ < ready_.size(); ++next_ready_) {
    pass_over(std::move(ready_[next_ready_]));
  }
  ready_.clear();
  next_ready_ = 0;
  size_t given_back = entities_->count_given_back();
  entities_->wait(timeout, ready_, postponed_);
  for (int again = 0; again < kMostLooks && !ready_.empty() && entities_->is_given_back_since(given_back); ++again) {
    std::copy_if(ready_.begin(), ready_.end(), std::back_inserter(postponed_), detail::is_waitable);
    ready_.clear();
    given_back = entities_->count_given_back();
    entities_->wait(nanoseconds::zero(), ready_, postponed_);
  }
  for (detail::ReadyEntity& postponed : postponed_) {
    if (std::none_of(ready_.begin(), ready_.end(),
                     [&](const detail::ReadyEntity& ready) { return are_same_waitable(ready, postponed); })) {
      ready_.push_back(std::move(postponed));
    }
  }
  postponed_.clear();
  if (count_passed_over_ > 0) {
    put_in_order();
  }
}

[[gnu::hot]] void Executor::execute_any_executable(AnyExecutable& any_executable) {
  if (spinning_) {
    execute_chosen(any_executable);
  }
}

[[gnu::hot]] void Executor::execute_chosen(AnyExecutable& any_executable) {
  if (any_executable.timer) {
    TRACETOOLS_TRACEPOINT(rclcpp_executor_execute,
                          static_cast<const void*>(any_executable.timer->get_timer_handle().get()));
    const progress::Callback callback(progress::Doing::kTimer);
    any_executable.timer->execute_callback(any_executable.data);
  }
  if (any_executable.subscription) {
    TRACETOOLS_TRACEPOINT(rclcpp_executor_execute,
                          static_cast<const void*>(any_executable.subscription->get_subscription_handle().get()));
    const progress::Callback callback(progress::Doing::kSubscription);
    any_executable.subscription->execute();
  }
  // These have no rclcpp_executor_execute.
  if (any_executable.service) {
    const progress::Callback callback(progress::Doing::kService);
    any_executable.service->execute();
  }
  if (any_executable.client) {
    const progress::Callback callback(progress::Doing::kClient);
    any_executable.client->execute();
  }
  if (any_executable.waitable) {
    TRACETOOLS_EXT_TRACEPOINT(rclcpp_executor_execute_waitable,
                              static_cast<const void*>(any_executable.waitable.get()));
    const progress::Callback callback(progress::Doing::kWaitable);
    any_executable.waitable->execute(any_executable.data);
  }
  any_executable.release_group();
}

}  // namespace rclcpp
