#include "tracing/analysis/object_model.hpp"

namespace tracing {

namespace {

template <class Object>
ObjectId append(std::vector<Object>& objects, Object object) {
  objects.push_back(std::move(object));
  return static_cast<ObjectId>(objects.size() - 1);
}

std::string qualified_name(std::string_view name_space, std::string_view name) {
  std::string result(name_space);
  if (!result.ends_with('/')) result += '/';
  return result.append(name);
}

// NULL is recorded by LTTng-UST as this text.
constexpr std::string_view kNullString = "(null)";

}  // namespace

std::size_t ObjectModel::HashKey::operator()(const Key& key) const {
  // Handles differ in their middle bits, processes in the low ones: multiplication spreads both over the word.
  const std::uint64_t mixed = (key.handle ^ (static_cast<std::uint64_t>(key.vpid) << 48)) * 0x9e3779b97f4a7c15;
  return mixed ^ (mixed >> 32);
}

ObjectId ObjectModel::find(const Index& index, Vpid vpid, ros2::Handle handle) {
  const auto found = index.find({vpid, handle});
  return found == index.end() ? kNoObject : found->second;
}

RmwLookup ObjectModel::find_rmw(const Index& index, Vpid vpid, ros2::Handle handle) {
  const auto found = index.find({vpid, handle});
  if (found == index.end()) return {RmwHandle::kUnknown, kNoObject};
  if (found->second == kNoObject) return {RmwHandle::kInternal, kNoObject};
  return {RmwHandle::kKnown, found->second};
}

ObjectId ObjectModel::topic(std::string_view name) {
  const auto [found, is_new] = topic_index_.try_emplace(std::string(name), kNoObject);
  if (is_new) found->second = append(topics_, TopicObject{std::string(name), 0, 0});
  return found->second;
}

void ObjectModel::on(const Origin& origin, const ros2::RclNodeInit& event) {
  node_index_[{origin.vpid, event.node_handle}] =
      append(nodes_, NodeObject{origin.vpid, qualified_name(event.namespace_, event.node_name)});
}

void ObjectModel::on(const Origin& origin, const ros2::RmwPublisherInit& event) {
  rmw_publisher_index_[{origin.vpid, event.rmw_publisher_handle}] = kNoObject;
}

void ObjectModel::on(const Origin& origin, const ros2::RclPublisherInit& event) {
  const ObjectId topic_id = topic(event.topic_name);
  ++topics_[topic_id].publishers;
  const ObjectId id = append(publishers_, EndpointObject{find(node_index_, origin.vpid, event.node_handle), topic_id});
  publisher_index_[{origin.vpid, event.publisher_handle}] = id;
  rmw_publisher_index_[{origin.vpid, event.rmw_publisher_handle}] = id;
}

void ObjectModel::on(const Origin& origin, const ros2::RmwSubscriptionInit& event) {
  rmw_subscription_index_[{origin.vpid, event.rmw_subscription_handle}] = kNoObject;
}

void ObjectModel::on(const Origin& origin, const ros2::RclSubscriptionInit& event) {
  const ObjectId topic_id = topic(event.topic_name);
  ++topics_[topic_id].subscriptions;
  const ObjectId id =
      append(subscriptions_, EndpointObject{find(node_index_, origin.vpid, event.node_handle), topic_id});
  subscription_index_[{origin.vpid, event.subscription_handle}] = id;
  rmw_subscription_index_[{origin.vpid, event.rmw_subscription_handle}] = id;
}

// The two events of a subscription object come in either order: with intra-process communication its callback is
// announced first. An object that has already had the event is an older one at the same address.
void ObjectModel::on(const Origin& origin, const ros2::RclcppSubscriptionInit& event) {
  const ObjectId subscription = find(subscription_index_, origin.vpid, event.subscription_handle);
  const ObjectId object = find(subscription_object_index_, origin.vpid, event.subscription);
  if (object != kNoObject && subscription_objects_[object].subscription == kNoObject) {
    subscription_objects_[object].subscription = subscription;
  } else {
    add_subscription_object(origin.vpid, event.subscription, {subscription, false});
  }
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppSubscriptionCallbackAdded& event) {
  ObjectId object = find(subscription_object_index_, origin.vpid, event.subscription);
  if (object != kNoObject && !subscription_objects_[object].has_callback) {
    subscription_objects_[object].has_callback = true;
  } else {
    object = add_subscription_object(origin.vpid, event.subscription, {kNoObject, true});
  }
  add_callback(origin.vpid, event.callback, CallbackObject::Owner::kSubscription, object);
}

void ObjectModel::on(const Origin& origin, const ros2::RclServiceInit& event) {
  service_index_[{origin.vpid, event.service_handle}] = append(
      services_, ServiceObject{find(node_index_, origin.vpid, event.node_handle), std::string(event.service_name)});
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppServiceCallbackAdded& event) {
  add_callback(origin.vpid, event.callback, CallbackObject::Owner::kService,
               find(service_index_, origin.vpid, event.service_handle));
}

void ObjectModel::on(const Origin& origin, const ros2::RclTimerInit& event) {
  timer_index_[{origin.vpid, event.timer_handle}] = append(timers_, TimerObject{kNoObject, event.period});
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppTimerCallbackAdded& event) {
  add_callback(origin.vpid, event.callback, CallbackObject::Owner::kTimer,
               find(timer_index_, origin.vpid, event.timer_handle));
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppTimerLinkNode& event) {
  const ObjectId timer = find(timer_index_, origin.vpid, event.timer_handle);
  if (timer != kNoObject) timers_[timer].node = find(node_index_, origin.vpid, event.node_handle);
}

void ObjectModel::on(const Origin& origin, const ros2::RclcppCallbackRegister& event) {
  ObjectId id = find(callback_index_, origin.vpid, event.callback);
  if (id == kNoObject || !callbacks_[id].symbol.empty()) {  // its *_callback_added is not in the trace
    id = add_callback(origin.vpid, event.callback, CallbackObject::Owner::kUnknown, kNoObject);
  }
  if (event.symbol != kNullString) callbacks_[id].symbol = event.symbol;
}

ObjectId ObjectModel::publisher(Vpid vpid, ros2::Handle rcl_handle) const {
  return find(publisher_index_, vpid, rcl_handle);
}

RmwLookup ObjectModel::rmw_publisher(Vpid vpid, ros2::Handle handle) const {
  return find_rmw(rmw_publisher_index_, vpid, handle);
}

RmwLookup ObjectModel::rmw_subscription(Vpid vpid, ros2::Handle handle) const {
  return find_rmw(rmw_subscription_index_, vpid, handle);
}

ObjectId ObjectModel::callback(Vpid vpid, ros2::Handle address) {
  const ObjectId id = find(callback_index_, vpid, address);
  return id != kNoObject ? id : add_callback(vpid, address, CallbackObject::Owner::kUnknown, kNoObject);
}

ObjectId ObjectModel::subscription_of(const CallbackObject& callback) const {
  if (callback.owner != CallbackObject::Owner::kSubscription || callback.owner_id == kNoObject) return kNoObject;
  return subscription_objects_[callback.owner_id].subscription;
}

ObjectId ObjectModel::add_callback(Vpid vpid, ros2::Handle address, CallbackObject::Owner owner, ObjectId owner_id) {
  const ObjectId id = append(callbacks_, CallbackObject{vpid, address, owner, owner_id, ""});
  callback_index_[{vpid, address}] = id;
  return id;
}

ObjectId ObjectModel::add_subscription_object(Vpid vpid, ros2::Handle handle, SubscriptionObject object) {
  const ObjectId id = append(subscription_objects_, object);
  subscription_object_index_[{vpid, handle}] = id;
  return id;
}

}  // namespace tracing
