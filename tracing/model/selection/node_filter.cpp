// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/selection/node_filter.hpp"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "tracing/decode/reader/event_pattern.hpp"

namespace tracing {

bool NodeFilter::is_wanted(ObjectId node) const {
  if (node == kNoObject) {
    return false;
  }
  if (node >= is_wanted_.size()) {
    is_wanted_.resize(node + 1, -1);
  }
  if (is_wanted_[node] < 0) {
    const std::string& name = model_.nodes()[node].name;
    const std::string last = name.substr(name.rfind('/') + 1);
    is_wanted_[node] = std::any_of(patterns_.begin(), patterns_.end(), [&](const std::string& pattern) {
      return matches_pattern(pattern, name) || matches_pattern(pattern, last);
    });
  }
  return is_wanted_[node] == 1;
}

std::vector<std::string> NodeFilter::names() const {
  std::vector<std::string> names;
  for (const NodeObject& node : model_.nodes()) {
    names.push_back(node.name);
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

bool NodeFilter::has_match() const {
  for (ObjectId node = 0; node < model_.nodes().size(); ++node) {
    if (is_wanted(node)) {
      return true;
    }
  }
  return false;
}

bool NodeFilter::is_wanted_callback(ObjectId id) const {
  if (id == kNoObject) {
    return false;
  }
  const CallbackObject& callback = model_.callbacks()[id];
  switch (callback.owner) {
    case CallbackObject::Owner::kSubscription: {
      const ObjectId subscription = model_.subscription_of(callback);
      return subscription != kNoObject && is_wanted(model_.subscriptions()[subscription].node);
    }
    case CallbackObject::Owner::kTimer:
      return is_wanted(model_.timers()[callback.owner_id].node);
    case CallbackObject::Owner::kService:
      return is_wanted(model_.services()[callback.owner_id].node);
    case CallbackObject::Owner::kClient:
      return is_wanted(model_.clients()[callback.owner_id].node);
    case CallbackObject::Owner::kUnknown:
      break;
  }
  return false;
}

bool NodeFilter::is_wanted_handle(ProcessId process, std::string_view field, ros2::Handle handle) {
  const auto node_of = [](const auto& objects, ObjectId id) { return id == kNoObject ? kNoObject : objects[id].node; };
  if (field == "node_handle") {
    return is_wanted(model_.node(process, handle));
  }
  if (field == "callback") {
    return is_wanted_callback(model_.callback(process, handle));
  }
  if (field == "publisher_handle") {
    return is_wanted(node_of(model_.publishers(), model_.publisher(process, handle)));
  }
  if (field == "rmw_publisher_handle") {
    return is_wanted(node_of(model_.publishers(), model_.rmw_publisher(process, handle).id));
  }
  if (field == "subscription_handle") {
    return is_wanted(node_of(model_.subscriptions(), model_.subscription(process, handle)));
  }
  if (field == "rmw_subscription_handle") {
    return is_wanted(node_of(model_.subscriptions(), model_.rmw_subscription(process, handle).id));
  }
  if (field == "timer_handle") {
    return is_wanted(node_of(model_.timers(), model_.timer(process, handle)));
  }
  if (field == "service_handle") {
    return is_wanted(node_of(model_.services(), model_.service(process, handle)));
  }
  if (field == "rmw_service_handle") {
    return is_wanted(node_of(model_.services(), model_.rmw_service(process, handle)));
  }
  if (field == "client_handle") {
    return is_wanted(node_of(model_.clients(), model_.client(process, handle)));
  }
  if (field == "rmw_client_handle") {
    return is_wanted(node_of(model_.clients(), model_.rmw_client(process, handle)));
  }
  if (field == "handle") {  // of what an executor executes
    return is_wanted(node_of(model_.timers(), model_.timer(process, handle))) ||
           is_wanted(node_of(model_.subscriptions(), model_.subscription(process, handle)));
  }
  if (field == "state_machine") {
    const auto found = state_machines_.find({process, static_cast<std::int64_t>(handle)});
    return found != state_machines_.end() && found->second;
  }
  return false;
}

bool NodeFilter::is_wanted_end(ProcessId process, const ros2::ObjectEnd& end) {
  using Kind = ros2::ObjectEnd::Kind;
  switch (end.kind) {
    case Kind::kRclNode:
      return is_wanted_handle(process, "node_handle", end.handle);
    case Kind::kRmwPublisher:
      return is_wanted_handle(process, "rmw_publisher_handle", end.handle);
    case Kind::kRclPublisher:
      return is_wanted_handle(process, "publisher_handle", end.handle);
    case Kind::kRmwSubscription:
      return is_wanted_handle(process, "rmw_subscription_handle", end.handle);
    case Kind::kRclSubscription:
      return is_wanted_handle(process, "subscription_handle", end.handle);
    case Kind::kRclService:
      return is_wanted_handle(process, "service_handle", end.handle);
    case Kind::kRclClient:
      return is_wanted_handle(process, "client_handle", end.handle);
    case Kind::kRclTimer:
      return is_wanted_handle(process, "timer_handle", end.handle);
    case Kind::kRclcppCallback:
      return is_wanted_handle(process, "callback", end.handle);
    case Kind::kRclLifecycleStateMachine:
      return is_wanted_handle(process, "state_machine", end.handle);
    default:
      return false;
  }
}

bool NodeFilter::has_wanted_object(const Origin& origin, const ros2::AnyEvent& event) {
  bool wanted = false;
  std::visit(
      [&]<class Struct>(const Struct& fields) {
        if constexpr (!std::is_same_v<Struct, std::monostate>) {
          Struct::for_each_field(fields, [&]<ros2::FieldType type>(std::string_view name, const auto& value) {
            if constexpr (type == ros2::FieldType::kPointer) {
              wanted = wanted || is_wanted_handle(origin.process, name, value);
            }
          });
        }
      },
      event);
  return wanted;
}

bool NodeFilter::accepts(const Event& event) {
  const Origin origin{event.timestamp_ns, processes_.of(event), event.vtid.value_or(0)};
  model_.learn(processes_);
  const Thread thread{origin.process, origin.vtid};
  const auto running = [&] {
    const auto callbacks = running_.find(thread);
    return callbacks != running_.end() &&
           std::any_of(callbacks->second.begin(), callbacks->second.end(), [](bool wanted) { return wanted; });
  };
  const ros2::AnyEvent* const decoded = decoder_.decode(event);
  if (decoded == nullptr) {
    const std::optional<ros2::ObjectEnd> end = ends_.decode(event);
    if (!end) {
      return running();
    }
    const bool wanted = running() || is_wanted_end(origin.process, *end);
    model_.on(origin, *end);
    return wanted;
  }
  std::visit(
      [&](const auto& fields) {
        if constexpr (requires { model_.on(origin, fields); }) {
          model_.on(origin, fields);
        }
      },
      *decoded);
  if (const auto* const machine = std::get_if<ros2::RclLifecycleStateMachineInit>(decoded)) {
    state_machines_[{origin.process, static_cast<std::int64_t>(machine->state_machine)}] =
        is_wanted(model_.node(origin.process, machine->node_handle));
  }
  const bool wanted = has_wanted_object(origin, *decoded);
  if (std::holds_alternative<ros2::CallbackStart>(*decoded)) {
    running_[thread].push_back(wanted);
  }
  const bool accepted = wanted || running();
  if (std::holds_alternative<ros2::CallbackEnd>(*decoded)) {
    std::vector<bool>& callbacks = running_[thread];
    if (!callbacks.empty()) {
      callbacks.pop_back();
    }
  }
  return accepted;
}

}  // namespace tracing
