// SPDX-License-Identifier: Apache-2.0
#include "rclcpp/detail/wait_set_entities.hpp"

#include <rcl/error_handling.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "rclcpp/detail/require_ok.hpp"
#include "rclcpp/event_handler.hpp"
#include "rclcpp/exceptions.hpp"

namespace rclcpp::detail {

namespace {

using std::chrono::nanoseconds;
using std::chrono::steady_clock;

template <typename EntityT>
bool refers_to(const std::weak_ptr<EntityT>& weak, const std::shared_ptr<EntityT>& entity) {
  return !weak.owner_before(entity) && !entity.owner_before(weak);
}

template <typename EntityT>
void claim(const std::shared_ptr<EntityT>& entity, const char* kind) {
  if (!entity) {
    throw std::invalid_argument(std::string(kind) + " is nullptr");
  }
  if (entity->exchange_in_use_by_wait_set_state(true)) {
    throw std::runtime_error(std::string(kind) + " already in use by another wait set");
  }
}

template <typename EntityT>
void release_all(const std::vector<std::weak_ptr<EntityT>>& list) {
  for (const std::weak_ptr<EntityT>& weak : list) {
    if (const std::shared_ptr<EntityT> entity = weak.lock()) {
      entity->exchange_in_use_by_wait_set_state(false);
    }
  }
}

// Takes ownership of the entities that exist, and removes the other ones from the list.
template <typename EntityT>
void own_living(std::vector<std::weak_ptr<EntityT>>& list, std::vector<std::shared_ptr<EntityT>>& owned) {
  list.erase(std::remove_if(list.begin(), list.end(),
                            [&owned](const std::weak_ptr<EntityT>& weak) {
                              std::shared_ptr<EntityT> entity = weak.lock();
                              if (!entity) {
                                return true;
                              }
                              owned.push_back(std::move(entity));
                              return false;
                            }),
             list.end());
}

// Those of which the wait has left the handle.
template <typename EntityT, typename HandleT>
void append_ready(const std::vector<std::shared_ptr<EntityT>>& entities, const HandleT* const* handles,
                  std::vector<std::shared_ptr<EntityT>>& ready) {
  for (size_t i = 0; i < entities.size(); ++i) {
    if (handles[i]) {
      ready.push_back(entities[i]);
    }
  }
}

Context& not_null(const Context::SharedPtr& context) {
  if (!context) {
    throw std::invalid_argument("context is nullptr");
  }
  return *context;
}

}  // namespace

WaitSetEntities::WaitSetEntities(const Context::SharedPtr& context, Threads threads)
    : rcl_context_(not_null(context).get_rcl_context()),
      interrupt_(threads == Threads::kMany ? std::make_unique<GuardCondition>(context) : nullptr),
      wait_set_(rcl_get_zero_initialized_wait_set()) {
  if (!rcl_context_) {
    RCL_SET_ERROR_MSG("call rclcpp::init() first");
    require_ok(RCL_RET_INVALID_ARGUMENT, "a wait set needs an initialized context");
  }
  require_ok(rcl_wait_set_init(&wait_set_, 0, 0, 0, 0, 0, 0, rcl_context_.get(), rcl_get_default_allocator()),
             "failed to create wait set");
}

WaitSetEntities::~WaitSetEntities() {
  release_all(subscriptions_);
  release_all(guard_conditions_);
  release_all(timers_);
  release_all(clients_);
  release_all(services_);
  for (const AssociatedWaitable& associated : waitables_) {
    if (const std::shared_ptr<Waitable> waitable = associated.waitable.lock()) {
      waitable->exchange_in_use_by_wait_set_state(false);
    }
  }
  detail::log_error(rcl_wait_set_fini(&wait_set_), "failed to destroy wait set");
}

template <typename EntityT>
void WaitSetEntities::add(List<EntityT>& list, const std::shared_ptr<EntityT>& entity, const char* kind) {
  claim(entity, kind);
  {
    const std::lock_guard lock(mutex_);
    list.push_back(entity);
  }
  changed();
}

template <typename EntityT>
void WaitSetEntities::remove(List<EntityT>& list, const std::shared_ptr<EntityT>& entity, const char* kind) {
  if (!entity) {
    throw std::invalid_argument(std::string(kind) + " is nullptr");
  }
  {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& weak) { return refers_to(weak, entity); });
    if (found == list.end()) {
      throw std::runtime_error(std::string(kind) + " not in wait set");
    }
    list.erase(found);
  }
  entity->exchange_in_use_by_wait_set_state(false);
  changed();
}

void WaitSetEntities::add_subscription(const std::shared_ptr<SubscriptionBase>& subscription,
                                       const SubscriptionWaitSetMask& mask) {
  if (!subscription) {
    throw std::invalid_argument("subscription is nullptr");
  }
  if (mask.include_subscription) {
    add(subscriptions_, subscription, "subscription");
  }
  if (mask.include_events) {
    for (const auto& [type, handler] : subscription->get_event_handlers()) {
      add_waitable(handler, subscription);
    }
  }
  if (mask.include_intra_process_waitable) {
    if (const auto intra_process = subscription->get_intra_process_waitable()) {
      add_waitable(intra_process, subscription);
    }
  }
}

void WaitSetEntities::remove_subscription(const std::shared_ptr<SubscriptionBase>& subscription,
                                          const SubscriptionWaitSetMask& mask) {
  if (!subscription) {
    throw std::invalid_argument("subscription is nullptr");
  }
  if (mask.include_subscription) {
    remove(subscriptions_, subscription, "subscription");
  }
  if (mask.include_events) {
    for (const auto& [type, handler] : subscription->get_event_handlers()) {
      remove_waitable(handler);
    }
  }
  if (mask.include_intra_process_waitable) {
    if (const auto intra_process = subscription->get_intra_process_waitable()) {
      remove_waitable(intra_process);
    }
  }
}

void WaitSetEntities::add_guard_condition(const std::shared_ptr<GuardCondition>& guard_condition) {
  add(guard_conditions_, guard_condition, "guard condition");
}
void WaitSetEntities::remove_guard_condition(const std::shared_ptr<GuardCondition>& guard_condition) {
  remove(guard_conditions_, guard_condition, "guard condition");
}
void WaitSetEntities::add_timer(const std::shared_ptr<TimerBase>& timer) {
  add(timers_, timer, "timer");
}
void WaitSetEntities::remove_timer(const std::shared_ptr<TimerBase>& timer) {
  remove(timers_, timer, "timer");
}
void WaitSetEntities::add_client(const std::shared_ptr<ClientBase>& client) {
  add(clients_, client, "client");
}
void WaitSetEntities::remove_client(const std::shared_ptr<ClientBase>& client) {
  remove(clients_, client, "client");
}
void WaitSetEntities::add_service(const std::shared_ptr<ServiceBase>& service) {
  add(services_, service, "service");
}
void WaitSetEntities::remove_service(const std::shared_ptr<ServiceBase>& service) {
  remove(services_, service, "service");
}

void WaitSetEntities::add_waitable(const std::shared_ptr<Waitable>& waitable,
                                   const std::shared_ptr<void>& associated_entity) {
  claim(waitable, "waitable");
  {
    const std::lock_guard lock(mutex_);
    waitables_.push_back({waitable, associated_entity != nullptr, associated_entity});
  }
  changed();
}

void WaitSetEntities::remove_waitable(const std::shared_ptr<Waitable>& waitable) {
  if (!waitable) {
    throw std::invalid_argument("waitable is nullptr");
  }
  {
    const std::lock_guard lock(mutex_);
    const auto found = std::find_if(waitables_.begin(), waitables_.end(),
                                    [&](const auto& associated) { return refers_to(associated.waitable, waitable); });
    if (found == waitables_.end()) {
      throw std::runtime_error("waitable not in wait set");
    }
    waitables_.erase(found);
  }
  waitable->exchange_in_use_by_wait_set_state(false);
  changed();
}

void WaitSetEntities::prune_deleted_entities() {
  (void)own();
}

void WaitSetEntities::changed() {
  if (interrupt_) {
    interrupt_->trigger();
  }
}

WaitSetEntities::Owned WaitSetEntities::own() {
  Owned owned;
  const std::lock_guard lock(mutex_);
  own_living(timers_, owned.timers);
  own_living(subscriptions_, owned.subscriptions);
  own_living(services_, owned.services);
  own_living(clients_, owned.clients);
  own_living(guard_conditions_, owned.guard_conditions);
  waitables_.erase(std::remove_if(waitables_.begin(), waitables_.end(),
                                  [&owned](const AssociatedWaitable& associated) {
                                    std::shared_ptr<Waitable> waitable = associated.waitable.lock();
                                    std::shared_ptr<void> entity = associated.associated_entity.lock();
                                    if (!waitable || (associated.has_associated_entity && !entity)) {
                                      return true;
                                    }
                                    owned.waitables.push_back(std::move(waitable));
                                    owned.associated_entities.push_back(std::move(entity));
                                    return false;
                                  }),
                   waitables_.end());
  return owned;
}

WaitResultKind WaitSetEntities::wait(nanoseconds time_to_wait, WaitSetFindings& findings) {
  const auto start = steady_clock::now();
  nanoseconds left = time_to_wait;
  while (true) {
    const Owned owned = own();
    fill(owned);
    const rcl_ret_t ret = rcl_wait(&wait_set_, left.count());
    if (ret == RCL_RET_WAIT_SET_EMPTY) {
      rcl_reset_error();
      return WaitResultKind::Empty;
    }
    if (ret == RCL_RET_TIMEOUT) {
      rcl_reset_error();
      return WaitResultKind::Timeout;
    }
    require_ok(ret, "rcl_wait() failed");
    const bool interrupted = interrupt_ && wait_set_.guard_conditions[wait_set_.size_of_guard_conditions - 1];
    find_ready(owned, findings);
    const auto* const* conditions = wait_set_.guard_conditions;
    const bool any_condition = std::any_of(conditions, conditions + owned.guard_conditions.size(),
                                           [](const rcl_guard_condition_t* condition) { return condition != nullptr; });
    if (any_condition || !findings.timers.empty() || !findings.subscriptions.empty() || !findings.services.empty() ||
        !findings.clients.empty() || !findings.waitables.empty() || !interrupted) {
      return WaitResultKind::Ready;
    }
    // Only the list of entities has changed.
    if (time_to_wait >= nanoseconds::zero()) {
      left = std::max<nanoseconds>(time_to_wait - (steady_clock::now() - start), nanoseconds::zero());
    }
  }
}

void WaitSetEntities::fill(const Owned& owned) {
  size_t timers = owned.timers.size();
  size_t subscriptions = owned.subscriptions.size();
  size_t services = owned.services.size();
  size_t clients = owned.clients.size();
  size_t events = 0;
  size_t guard_conditions = owned.guard_conditions.size() + (interrupt_ ? 1 : 0);
  for (const std::shared_ptr<Waitable>& waitable : owned.waitables) {
    timers += waitable->get_number_of_ready_timers();
    subscriptions += waitable->get_number_of_ready_subscriptions();
    services += waitable->get_number_of_ready_services();
    clients += waitable->get_number_of_ready_clients();
    events += waitable->get_number_of_ready_events();
    guard_conditions += waitable->get_number_of_ready_guard_conditions();
  }
  require_ok(rcl_wait_set_resize(&wait_set_, subscriptions, guard_conditions, timers, clients, services, events),
             "Couldn't resize the wait set");
  for (const auto& timer : owned.timers) {
    require_ok(rcl_wait_set_add_timer(&wait_set_, timer->get_timer_handle().get(), nullptr), "Couldn't fill wait set");
  }
  for (const auto& subscription : owned.subscriptions) {
    require_ok(rcl_wait_set_add_subscription(&wait_set_, subscription->get_subscription_handle().get(), nullptr),
               "Couldn't fill wait set");
  }
  for (const auto& service : owned.services) {
    require_ok(rcl_wait_set_add_service(&wait_set_, service->get_service_handle().get(), nullptr),
               "Couldn't fill wait set");
  }
  for (const auto& client : owned.clients) {
    require_ok(rcl_wait_set_add_client(&wait_set_, client->get_client_handle().get(), nullptr),
               "Couldn't fill wait set");
  }
  for (const auto& guard_condition : owned.guard_conditions) {
    require_ok(rcl_wait_set_add_guard_condition(&wait_set_, &guard_condition->get_rcl_guard_condition(), nullptr),
               "Couldn't fill wait set");
  }
  // After the entities of the user, which the user finds by their index.
  for (const auto& waitable : owned.waitables) {
    waitable->add_to_wait_set(wait_set_);
  }
  if (interrupt_) {
    require_ok(rcl_wait_set_add_guard_condition(&wait_set_, &interrupt_->get_rcl_guard_condition(), nullptr),
               "Couldn't fill wait set");
  }
}

void WaitSetEntities::find_ready(const Owned& owned, WaitSetFindings& findings) const {
  append_ready(owned.timers, wait_set_.timers, findings.timers);
  append_ready(owned.subscriptions, wait_set_.subscriptions, findings.subscriptions);
  append_ready(owned.services, wait_set_.services, findings.services);
  append_ready(owned.clients, wait_set_.clients, findings.clients);
  for (const std::shared_ptr<Waitable>& waitable : owned.waitables) {
    // What the wait has found is told only once, so an exception must not lose it. The program gets the exception when
    // it comes to this waitable.
    try {
      if (waitable->is_ready(wait_set_)) {
        findings.waitables.push_back({waitable, nullptr});
      }
    } catch (...) {
      findings.waitables.push_back({waitable, std::current_exception()});
    }
  }
}

}  // namespace rclcpp::detail
