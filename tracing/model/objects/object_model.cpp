// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/object_model.hpp"

#include <utility>

namespace tracing {

namespace {

template <class Object>
ObjectId append(std::vector<Object>& objects, Object object) {
  objects.push_back(std::move(object));
  return static_cast<ObjectId>(objects.size() - 1);
}

std::string qualified_name(std::string_view name_space, std::string_view name) {
  std::string result(name_space);
  if (!result.ends_with('/')) {
    result += '/';
  }
  return result.append(name);
}

}  // namespace

ObjectId ObjectModel::find(const Index& index, ProcessId process, ros2::Handle handle) const {
  const ObjectId* const found = earlier_.find(index, process, handle);
  return found == nullptr ? kNoObject : *found;
}

RmwLookup ObjectModel::find_rmw(const RmwIndex& index, ProcessId process, ros2::Handle handle) const {
  const RmwEndpoint* const found = earlier_.find(index, process, handle);
  if (found == nullptr) {
    return {RmwHandle::kUnknown, kNoObject};
  }
  return {found->endpoint == kNoObject ? RmwHandle::kInternal : RmwHandle::kKnown, found->endpoint};
}

void ObjectModel::add_rmw(RmwIndex& index, ProcessId process, ros2::Handle handle, const ros2::Gid& gid) {
  RmwEndpoint& entry = index[{process, handle}];
  if (entry.gid != gid || gid.size == 0) {
    entry = {gid};
  }
}

std::optional<ros2::EndpointQos> ObjectModel::qos_of(const RmwIndex& index, const HandleKey& key) {
  const RmwEndpoint* const found = index.find(key);
  return found == nullptr ? std::nullopt : found->qos;
}

bool ObjectModel::is_endpoint(const Index& index, const std::vector<EndpointObject>& endpoints, ProcessId process,
                              ros2::Handle handle, const RmwLookup& rmw, const EndpointObject& endpoint) const {
  const ObjectId id = find(index, process, handle);
  return id != kNoObject && rmw.id == id && endpoints[id] == endpoint;
}

ObjectId ObjectModel::topic(std::string_view name) {
  const auto [found, is_new] = topic_index_.try_emplace(std::string(name), kNoObject);
  if (is_new) {
    found->second = append(topics_, TopicObject{std::string(name), 0, 0});
  }
  return found->second;
}

void ObjectModel::on(const Origin& origin, const ros2::RclNodeInit& event) {
  NodeObject node{origin.process, qualified_name(event.namespace_, event.node_name)};
  const ObjectId id = find(node_index_, origin.process, event.node_handle);
  if (id != kNoObject && nodes_[id].name == node.name) {
    return;
  }
  node_index_[{origin.process, event.node_handle}] = append(nodes_, std::move(node));
}

void ObjectModel::on(const Origin& origin, const ros2::RmwPublisherInit& event) {
  add_rmw(rmw_publisher_index_, origin.process, event.rmw_publisher_handle, event.gid);
}

void ObjectModel::on(const Origin& origin, const ros2::RclPublisherInit& event) {
  const EndpointObject endpoint{
      find(node_index_, origin.process, event.node_handle), topic(event.topic_name), event.queue_depth,
      qos_of(rmw_publisher_index_, {origin.process, event.rmw_publisher_handle}), origin.process};
  if (is_endpoint(publisher_index_, publishers_, origin.process, event.publisher_handle,
                  rmw_publisher(origin.process, event.rmw_publisher_handle), endpoint)) {
    return;
  }
  ++topics_[endpoint.topic].publishers;
  const ObjectId id = append(publishers_, endpoint);
  publisher_index_[{origin.process, event.publisher_handle}] = id;
  rmw_publisher_index_[{origin.process, event.rmw_publisher_handle}].endpoint = id;
}

void ObjectModel::on(const Origin& origin, const ros2::RmwSubscriptionInit& event) {
  add_rmw(rmw_subscription_index_, origin.process, event.rmw_subscription_handle, event.gid);
}

void ObjectModel::on(const Origin& origin, const ros2::RclSubscriptionInit& event) {
  const EndpointObject endpoint{
      find(node_index_, origin.process, event.node_handle), topic(event.topic_name), event.queue_depth,
      qos_of(rmw_subscription_index_, {origin.process, event.rmw_subscription_handle}), origin.process};
  if (is_endpoint(subscription_index_, subscriptions_, origin.process, event.subscription_handle,
                  rmw_subscription(origin.process, event.rmw_subscription_handle), endpoint)) {
    return;
  }
  ++topics_[endpoint.topic].subscriptions;
  const ObjectId id = append(subscriptions_, endpoint);
  subscription_index_[{origin.process, event.subscription_handle}] = id;
  rmw_subscription_index_[{origin.process, event.rmw_subscription_handle}].endpoint = id;
}

// The two events of a subscription object come in either order: with intra-process communication its callback is
// announced first. When a callback is announced again, the other event tells whether it belongs to the same object.
void ObjectModel::on(const Origin& origin, const ros2::RclcppSubscriptionInit& event) {
  const ObjectId subscription = find(subscription_index_, origin.process, event.subscription_handle);
  const ObjectId id = find(subscription_object_index_, origin.process, event.subscription);
  if (id == kNoObject) {
    add_subscription_object(origin.process, event.subscription, {subscription, false});
    count_rclcpp_object(subscription);
    return;
  }
  SubscriptionObject& object = subscription_objects_[id];
  const bool callback_repeated = std::exchange(object.callback_repeated, false);
  if (object.subscription == kNoObject) {
    object.subscription = subscription;
    count_rclcpp_object(subscription);
  } else if (object.subscription != subscription) {  // a new object at the address of an older one
    count_rclcpp_object(subscription);
    const ObjectId added =
        add_subscription_object(origin.process, event.subscription, {subscription, callback_repeated});
    if (callback_repeated) {
      callbacks_.move(origin.process, CallbackObject::Owner::kSubscription, id, added);
    }
  }
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppSubscriptionCallbackAdded& event) {
  ObjectId object = find(subscription_object_index_, origin.process, event.subscription);
  if (object != kNoObject && subscription_objects_[object].has_callback &&
      callbacks_.belongs_to(origin.process, event.callback, CallbackObject::Owner::kSubscription, object)) {
    subscription_objects_[object].callback_repeated = true;
    return;
  }
  if (object != kNoObject && !subscription_objects_[object].has_callback) {
    subscription_objects_[object].has_callback = true;
  } else {
    object = add_subscription_object(origin.process, event.subscription, {kNoObject, true});
  }
  callbacks_.add(origin.process, event.callback, CallbackObject::Owner::kSubscription, object);
}

void ObjectModel::on(const Origin& origin, const ros2::RmwClientInit& event) {
  add_rmw(rmw_client_index_, origin.process, event.rmw_client_handle, event.gid);
}

void ObjectModel::on(const Origin& origin, const ros2::RclClientInit& event) {
  RmwEndpoint& rmw = rmw_client_index_[{origin.process, event.rmw_client_handle}];
  ClientObject client{find(node_index_, origin.process, event.node_handle), std::string(event.service_name), rmw.gid};
  const ObjectId id = find(client_index_, origin.process, event.client_handle);
  if (id != kNoObject && rmw.endpoint == id && clients_[id] == client) {
    return;
  }
  rmw.endpoint = append(clients_, std::move(client));
  client_index_[{origin.process, event.client_handle}] = rmw.endpoint;
}

void ObjectModel::on(const Origin& origin, const ros2::RclTimerInit& event) {
  const ObjectId id = find(timer_index_, origin.process, event.timer_handle);
  if (id != kNoObject && timers_[id].period_ns == event.period) {
    return;
  }
  timer_index_[{origin.process, event.timer_handle}] = append(timers_, TimerObject{kNoObject, event.period});
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppTimerCallbackAdded& event) {
  callbacks_.add(origin.process, event.callback, CallbackObject::Owner::kTimer,
                 find(timer_index_, origin.process, event.timer_handle));
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppTimerLinkNode& event) {
  const ObjectId timer = find(timer_index_, origin.process, event.timer_handle);
  const ObjectId node = find(node_index_, origin.process, event.node_handle);
  if (timer == kNoObject) {
    return;
  }
  if (timers_[timer].node == kNoObject) {
    timers_[timer].node = node;
  } else if (timers_[timer].node != node) {  // a new timer at the address of an older one
    const ObjectId added = append(timers_, TimerObject{node, timers_[timer].period_ns});
    timer_index_[{origin.process, event.timer_handle}] = added;
    callbacks_.move(origin.process, CallbackObject::Owner::kTimer, timer, added);
  }
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppCallbackRegister& event) {
  callbacks_.name(origin.process, event.callback, event.symbol);
}

void ObjectModel::on(const Origin& origin, const ros2::ObjectEnd& end) {
  using Kind = ros2::ObjectEnd::Kind;
  const HandleKey key{origin.process, end.handle};
  switch (end.kind) {
    case Kind::kRclNode:
      node_index_.erase(key);
      break;
    case Kind::kRmwPublisher:
      rmw_publisher_index_.erase(key);
      break;
    case Kind::kRclPublisher:
      publisher_index_.erase(key);
      break;
    case Kind::kRmwSubscription:
      rmw_subscription_index_.erase(key);
      break;
    case Kind::kRclSubscription:
      subscription_index_.erase(key);
      break;
    case Kind::kRclcppSubscription:
      subscription_object_index_.erase(key);
      break;
    case Kind::kRclService:
      service_index_.erase(key);
      break;
    case Kind::kRmwService:
      rmw_service_index_.erase(key);
      break;
    case Kind::kRclClient:
      client_index_.erase(key);
      break;
    case Kind::kRmwClient:
      rmw_client_index_.erase(key);
      break;
    case Kind::kRclTimer:
      timer_index_.erase(key);
      break;
    case Kind::kRclcppCallback:
      callbacks_.end(origin.process, end.handle);
      break;
    case Kind::kRclLifecycleStateMachine:
      break;
  }
}

void ObjectModel::on(const Origin& origin, const ros2::EndpointQosEvent& event, const ros2::EndpointQos& qos) {
  const bool is_publisher = event.kind == ros2::EndpointQosEvent::Kind::kPublisher;
  RmwIndex& index = is_publisher ? rmw_publisher_index_ : rmw_subscription_index_;
  RmwEndpoint* const found = index.find({origin.process, event.handle});
  if (found == nullptr) {
    return;
  }
  found->qos = qos;
  const ObjectId endpoint = found->endpoint;
  if (endpoint != kNoObject) {
    (is_publisher ? publishers_ : subscriptions_)[endpoint].qos = qos;
  }
}

ObjectId ObjectModel::node(ProcessId process, ros2::Handle handle) const {
  return find(node_index_, process, handle);
}

ObjectId ObjectModel::publisher(ProcessId process, ros2::Handle rcl_handle) const {
  return find(publisher_index_, process, rcl_handle);
}

ObjectId ObjectModel::subscription(ProcessId process, ros2::Handle rcl_handle) const {
  return find(subscription_index_, process, rcl_handle);
}

ObjectId ObjectModel::subscription_of_object(ProcessId process, ros2::Handle object) const {
  const ObjectId id = find(subscription_object_index_, process, object);
  return id == kNoObject ? kNoObject : subscription_objects_[id].subscription;
}

RmwLookup ObjectModel::rmw_publisher(ProcessId process, ros2::Handle handle) const {
  return find_rmw(rmw_publisher_index_, process, handle);
}

RmwLookup ObjectModel::rmw_subscription(ProcessId process, ros2::Handle handle) const {
  return find_rmw(rmw_subscription_index_, process, handle);
}

ObjectId ObjectModel::timer(ProcessId process, ros2::Handle handle) const {
  return find(timer_index_, process, handle);
}

ObjectId ObjectModel::service(ProcessId process, ros2::Handle rcl_handle) const {
  return find(service_index_, process, rcl_handle);
}

ObjectId ObjectModel::client(ProcessId process, ros2::Handle rcl_handle) const {
  return find(client_index_, process, rcl_handle);
}

ObjectId ObjectModel::rmw_service(ProcessId process, ros2::Handle handle) const {
  return find(rmw_service_index_, process, handle);
}

ObjectId ObjectModel::rmw_client(ProcessId process, ros2::Handle handle) const {
  return find_rmw(rmw_client_index_, process, handle).id;
}

ObjectId ObjectModel::callback(ProcessId process, ros2::Handle address) {
  return callbacks_.at(process, address);
}

ObjectId ObjectModel::client_callback(ProcessId process, ros2::Handle rcl_handle) {
  return callbacks_.add(process, rcl_handle, CallbackObject::Owner::kClient, client(process, rcl_handle));
}

ObjectId ObjectModel::subscription_of(const CallbackObject& callback) const {
  if (callback.owner != CallbackObject::Owner::kSubscription || callback.owner_id == kNoObject) {
    return kNoObject;
  }
  return subscription_objects_[callback.owner_id].subscription;
}

ObjectId ObjectModel::node_of(const CallbackObject& callback) const {
  if (callback.owner_id == kNoObject) {
    return kNoObject;
  }
  switch (callback.owner) {
    case CallbackObject::Owner::kSubscription: {
      const ObjectId subscription = subscription_of(callback);
      return subscription == kNoObject ? kNoObject : subscriptions_[subscription].node;
    }
    case CallbackObject::Owner::kTimer:
      return timers_[callback.owner_id].node;
    case CallbackObject::Owner::kService:
      return services_[callback.owner_id].node;
    case CallbackObject::Owner::kClient:
      return clients_[callback.owner_id].node;
    case CallbackObject::Owner::kUnknown:
      return kNoObject;
  }
  return kNoObject;
}

void ObjectModel::count_rclcpp_object(ObjectId subscription) {
  if (subscription == kNoObject) {
    return;
  }
  if (subscription >= rclcpp_objects_.size()) {
    rclcpp_objects_.resize(subscription + 1);
  }
  ++rclcpp_objects_[subscription];
}

ObjectId ObjectModel::add_subscription_object(ProcessId process, ros2::Handle handle, SubscriptionObject object) {
  const ObjectId id = append(subscription_objects_, object);
  subscription_object_index_[{process, handle}] = id;
  return id;
}

}  // namespace tracing
