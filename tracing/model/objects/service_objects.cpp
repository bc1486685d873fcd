// SPDX-License-Identifier: Apache-2.0
// The services of the model. Those of a state machine are known by their order, where rclcpp has other handles.
#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "tracing/model/objects/object_model.hpp"

namespace tracing {

void ObjectModel::on(const Origin& origin, const ros2::RclServiceInit& event) {
  ServiceObject service{find(node_index_, origin.process, event.node_handle), std::string(event.service_name)};
  const ObjectId id = find(service_index_, origin.process, event.service_handle);
  if (id != kNoObject && services_[id] == service) {
    return;
  }
  std::vector<ObjectId>& made = thread_services_[{origin.process, origin.vtid}].made;
  if (!made.empty() && services_[made.back()].node != service.node) {
    made.clear();
  }
  const auto added = static_cast<ObjectId>(services_.size());
  services_.push_back(std::move(service));
  made.push_back(added);
  service_index_[{origin.process, event.service_handle}] = added;
  rmw_service_index_[{origin.process, event.rmw_service_handle}] = added;
}

// A state machine has made its services when it is ready. rclcpp copies their handles, so nothing tells that the copy
// belongs to the service. But it does so at once, in the same thread and the same order.
void ObjectModel::on(const Origin& origin, const ros2::RclLifecycleStateMachineInit& event) {
  constexpr std::array<std::string_view, 5> kServices = {"/change_state", "/get_state", "/get_available_states",
                                                         "/get_available_transitions", "/get_transition_graph"};
  ThreadServices& services = thread_services_[{origin.process, origin.vtid}];
  services.expected.clear();
  const ObjectId node = find(node_index_, origin.process, event.node_handle);
  if (node == kNoObject || services.made.size() < kServices.size()) {
    return;
  }
  const auto first = services.made.end() - static_cast<std::ptrdiff_t>(kServices.size());
  const bool are_its_own = std::equal(first, services.made.end(), kServices.begin(), [&](ObjectId id, auto name) {
    return services_[id].node == node && services_[id].name == nodes_[node].name + std::string(name);
  });
  if (are_its_own) {
    services.expected.assign(first, services.made.end());
  }
}

ObjectId ObjectModel::next_lifecycle_service(const Origin& origin, ros2::Handle service_handle) {
  const auto services = thread_services_.find({origin.process, origin.vtid});
  if (services == thread_services_.end() || services->second.expected.empty()) {
    return kNoObject;
  }
  const ObjectId service = services->second.expected.front();
  services->second.expected.pop_front();
  service_index_[{origin.process, service_handle}] = service;
  return service;
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppServiceCallbackAdded& event) {
  ObjectId service = find(service_index_, origin.process, event.service_handle);
  if (service == kNoObject) {
    service = next_lifecycle_service(origin, event.service_handle);
  } else if (const auto known = thread_services_.find({origin.process, origin.vtid}); known != thread_services_.end()) {
    known->second = {};
  }
  callbacks_.add(origin.process, event.callback, CallbackObject::Owner::kService, service);
}

}  // namespace tracing
