#include "executor_entities.hpp"

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "rclcpp/exceptions.hpp"
#include "rclcpp/logging.hpp"

namespace rclcpp {

namespace {

void require_ok(rcl_ret_t ret, const char* what) {
  if (ret != RCL_RET_OK) {
    exceptions::throw_from_rcl_error(ret, what);
  }
}

// The entities of which the wait has left the handle.
template <typename WaitableT, typename HandleT>
void append_ready(const std::vector<WaitableT>& waitables, const HandleT* const* handles,
                  std::vector<detail::ReadyEntity>& ready) {
  for (size_t i = 0; i < waitables.size(); ++i) {
    if (handles[i]) {
      ready.emplace_back(waitables[i].entity);
    }
  }
}

// Compares without owning, not even for a moment.
template <typename T>
bool refers_to(const std::weak_ptr<T>& weak, const std::shared_ptr<T>& shared) {
  return !weak.owner_before(shared) && !shared.owner_before(weak);
}

}  // namespace

ExecutorEntities::ExecutorEntities(const Context::SharedPtr& context)
    : rcl_context_(context->get_rcl_context()), interrupt_(context), wait_set_(rcl_get_zero_initialized_wait_set()) {
  require_ok(rcl_wait_set_init(&wait_set_, 0, 1, 0, 0, 0, 0, rcl_context_.get(), rcl_get_default_allocator()),
             "failed to create wait set");
}

ExecutorEntities::~ExecutorEntities() {
  if (rcl_wait_set_fini(&wait_set_) != RCL_RET_OK) {
    RCLCPP_ERROR(get_logger("rclcpp"), "failed to destroy wait set: %s", rcl_get_error_string().str);
    rcl_reset_error();
  }
}

void ExecutorEntities::add_node(const NodePtr& node) {
  if (node->get_associated_with_executor_atomic().exchange(true)) {
    throw std::runtime_error(std::string("Node '") + node->get_fully_qualified_name() +
                             "' has already been added to an executor.");
  }
  node->set_on_change([weak = weak_from_this()] {
    if (const auto self = weak.lock()) {
      self->changed();
    }
  });
  {
    const std::lock_guard lock(mutex_);
    nodes_.push_back(node);
  }
  changed();
}

void ExecutorEntities::remove_node(const NodePtr& node) {
  Owners owners;
  const std::lock_guard lock(mutex_);
  const auto found =
      std::find_if(nodes_.begin(), nodes_.end(), [&node](const auto& weak) { return refers_to(weak, node); });
  if (found == nodes_.end()) {
    throw std::runtime_error("Node needs to be associated with this executor.");
  }
  nodes_.erase(found);
  node->set_on_change(nullptr);
  node->get_associated_with_executor_atomic() = false;
  for (auto served = groups_.begin(); served != groups_.end();) {
    const CallbackGroup::SharedPtr group = served->group.lock();
    owners.groups.push_back(group);
    if (group && group->automatically_add_to_executor_with_node() && refers_to(served->node, node)) {
      release(group);
      served = groups_.erase(served);
    } else {
      ++served;
    }
  }
  ++removals_;
  mark_changed(owners);
}

void ExecutorEntities::add_group(const CallbackGroup::SharedPtr& group, const NodePtr& node) {
  if (group->get_associated_with_executor_atomic().exchange(true)) {
    throw std::runtime_error("Callback group has already been added to an executor.");
  }
  {
    const std::lock_guard lock(mutex_);
    serve(group, node);
  }
  changed();
}

void ExecutorEntities::remove_group(const CallbackGroup::SharedPtr& group) {
  Owners owners;
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(groups_.begin(), groups_.end(),
                                  [&group](const ServedGroup& served) { return refers_to(served.group, group); });
  if (found == groups_.end()) {
    throw std::runtime_error("Callback group needs to be associated with this executor.");
  }
  groups_.erase(found);
  release(group);
  ++removals_;
  mark_changed(owners);
}

void ExecutorEntities::remove_all() {
  Owners owners;
  const std::lock_guard lock(mutex_);
  for (const auto& weak : nodes_) {
    if (NodePtr node = weak.lock()) {
      node->set_on_change(nullptr);
      node->get_associated_with_executor_atomic() = false;
      owners.nodes.push_back(std::move(node));
    }
  }
  for (const ServedGroup& served : groups_) {
    if (CallbackGroup::SharedPtr group = served.group.lock()) {
      release(group);
      owners.groups.push_back(std::move(group));
    }
  }
  nodes_.clear();
  groups_.clear();
  mark_changed(owners);
}

std::vector<CallbackGroup::WeakPtr> ExecutorEntities::groups() {
  Owners owners;
  const std::lock_guard lock(mutex_);
  if (!waiting_) {
    rebuild(owners);  // a new node's groups count from its adding, not from the next wait
  }
  std::vector<CallbackGroup::WeakPtr> groups;
  for (const ServedGroup& served : groups_) {
    groups.push_back(served.group);
  }
  return groups;
}

void ExecutorEntities::wait(std::chrono::nanoseconds timeout, std::vector<detail::ReadyEntity>& ready) {
  {
    Owners owners;
    const std::lock_guard lock(mutex_);
    if (changed_) {
      rebuild(owners);
    }
    waiting_ = true;
  }

  rcl_ret_t ret = RCL_RET_OK;
  std::exception_ptr failure;
  try {
    fill_wait_set();
    ret = rcl_wait(&wait_set_, timeout.count());
    if (ret != RCL_RET_OK && ret != RCL_RET_TIMEOUT) {
      exceptions::throw_from_rcl_error(ret, "rcl_wait() failed");
    }
    rcl_reset_error();
    append_ready(waitables_.timers, wait_set_.timers, ready);
    append_ready(waitables_.subscriptions, wait_set_.subscriptions, ready);
    append_ready(waitables_.services, wait_set_.services, ready);
    append_ready(waitables_.clients, wait_set_.clients, ready);
    for (const rclcpp::Waitable::SharedPtr& waitable : held_) {
      if (waitable->is_ready(wait_set_)) {
        ready.emplace_back(rclcpp::Waitable::WeakPtr(waitable));
      }
    }
  } catch (...) {
    failure = std::current_exception();
  }
  held_.clear();

  Owners owners;
  const std::lock_guard lock(mutex_);
  waiting_ = false;
  if (changed_) {
    mark_changed(owners);
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

void ExecutorEntities::fill_wait_set() {
  require_ok(rcl_wait_set_clear(&wait_set_), "couldn't clear wait set");
  require_ok(rcl_wait_set_add_guard_condition(&wait_set_, &interrupt_.get_rcl_guard_condition(), nullptr),
             "couldn't add guard condition to wait set");
  for (const auto& timer : waitables_.timers) {
    require_ok(rcl_wait_set_add_timer(&wait_set_, timer.handle.get(), nullptr), "couldn't add timer to wait set");
  }
  for (const auto& subscription : waitables_.subscriptions) {
    require_ok(rcl_wait_set_add_subscription(&wait_set_, subscription.handle.get(), nullptr),
               "couldn't add subscription to wait set");
  }
  for (const auto& service : waitables_.services) {
    require_ok(rcl_wait_set_add_service(&wait_set_, service.handle.get(), nullptr), "couldn't add service to wait set");
  }
  for (const auto& client : waitables_.clients) {
    require_ok(rcl_wait_set_add_client(&wait_set_, client.handle.get(), nullptr), "couldn't add client to wait set");
  }
  for (const rclcpp::Waitable::WeakPtr& other : waitables_.others) {  // last: those before are found by their index
    if (rclcpp::Waitable::SharedPtr waitable = other.lock()) {
      waitable->add_to_wait_set(wait_set_);
      held_.push_back(std::move(waitable));
    }
  }
}

void ExecutorEntities::changed() {
  Owners owners;
  const std::lock_guard lock(mutex_);
  mark_changed(owners);
}

void ExecutorEntities::mark_changed(Owners& owners) {
  changed_ = true;
  if (waiting_) {
    interrupt_.trigger();
  } else {
    owners.waitables = std::exchange(waitables_, {});
  }
}

void ExecutorEntities::rebuild(Owners& owners) {
  const auto expired = [](const auto& weak) { return weak.expired(); };
  nodes_.erase(std::remove_if(nodes_.begin(), nodes_.end(), expired), nodes_.end());
  for (const auto& weak : nodes_) {
    if (NodePtr node = weak.lock()) {
      for (CallbackGroup::SharedPtr& group : node->callback_groups()) {
        if (group->automatically_add_to_executor_with_node() &&
            !group->get_associated_with_executor_atomic().exchange(true)) {
          serve(group, node);
        }
        owners.groups.push_back(std::move(group));
      }
      owners.nodes.push_back(std::move(node));
    }
  }
  groups_.erase(std::remove_if(groups_.begin(), groups_.end(),
                               [](const ServedGroup& s) { return s.group.expired() || s.node.expired(); }),
                groups_.end());
  for (const ServedGroup& served : groups_) {
    if (CallbackGroup::SharedPtr group = served.group.lock()) {
      group->collect(owners.entities);
      owners.groups.push_back(std::move(group));
    }
  }

  owners.waitables = std::exchange(waitables_, {});
  for (const TimerBase::SharedPtr& timer : owners.entities.timers) {
    waitables_.timers.push_back({timer->get_timer_handle(), timer});
  }
  for (const SubscriptionBase::SharedPtr& subscription : owners.entities.subscriptions) {
    waitables_.subscriptions.push_back({subscription->get_subscription_handle(), subscription});
  }
  for (const ServiceBase::SharedPtr& service : owners.entities.services) {
    waitables_.services.push_back({service->get_service_handle(), service});
  }
  for (const ClientBase::SharedPtr& client : owners.entities.clients) {
    waitables_.clients.push_back({client->get_client_handle(), client});
  }
  size_t subscriptions = waitables_.subscriptions.size();
  size_t guard_conditions = 1;
  size_t timers = waitables_.timers.size();
  size_t clients = waitables_.clients.size();
  size_t services = waitables_.services.size();
  size_t events = 0;
  for (const rclcpp::Waitable::SharedPtr& waitable : owners.entities.waitables) {
    subscriptions += waitable->get_number_of_ready_subscriptions();
    guard_conditions += waitable->get_number_of_ready_guard_conditions();
    timers += waitable->get_number_of_ready_timers();
    clients += waitable->get_number_of_ready_clients();
    services += waitable->get_number_of_ready_services();
    events += waitable->get_number_of_ready_events();
    waitables_.others.push_back(waitable);
  }
  require_ok(rcl_wait_set_resize(&wait_set_, subscriptions, guard_conditions, timers, clients, services, events),
             "couldn't resize the wait set");
  changed_ = false;
}

void ExecutorEntities::serve(const CallbackGroup::SharedPtr& group, const NodePtr& node) {
  group->set_on_change([weak = weak_from_this()] {
    if (const auto self = weak.lock()) {
      self->changed();
    }
  });
  groups_.push_back({group, node});
}

void ExecutorEntities::release(const CallbackGroup::SharedPtr& group) {
  group->set_on_change(nullptr);
  group->get_associated_with_executor_atomic() = false;
}

}  // namespace rclcpp
