// The ROS 2 objects of a trace, built from its initialisation events as they come by.
//
// Handles are addresses: two processes may use the same one, and one process may use it again for another object
// (there are no destruction events). An object is therefore found by process, handle and time: fed in the order of
// time, the model answers with the newest object that had the handle, and never forgets an older one's results.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracing/reader/ros2_events.hpp"

namespace tracing {

using Vpid = std::int64_t;
using ObjectId = std::uint32_t;  // index in the vectors below
inline constexpr ObjectId kNoObject = 0xffffffff;

// Where and when an event was recorded.
struct Origin {
  std::int64_t time_ns = 0;
  Vpid vpid = 0;
  std::int64_t vtid = 0;
};

struct NodeObject {
  Vpid vpid = 0;
  std::string name;  // fully qualified: "/ns/ping"
};

struct TopicObject {
  std::string name;
  std::uint32_t publishers = 0;
  std::uint32_t subscriptions = 0;
};

struct EndpointObject {  // publisher or subscription
  ObjectId node = kNoObject;
  ObjectId topic = kNoObject;
};

// rclcpp's object around a subscription: one, or two with intra-process communication.
struct SubscriptionObject {
  ObjectId subscription = kNoObject;
  bool has_callback = false;
};

struct TimerObject {
  ObjectId node = kNoObject;
  std::int64_t period_ns = 0;
};

struct ServiceObject {
  ObjectId node = kNoObject;
  std::string name;
};

struct CallbackObject {
  enum class Owner { kUnknown, kSubscription, kTimer, kService };
  Vpid vpid = 0;
  ros2::Handle address = 0;
  Owner owner = Owner::kUnknown;
  ObjectId owner_id = kNoObject;  // of a subscription object, timer or service
  std::string symbol;             // as recorded, may be empty
};

// What is known about a handle of the rmw layer.
enum class RmwHandle {
  kKnown,     // belongs to an rcl object
  kInternal,  // the middleware's own, such as the endpoints of ros_discovery_info
  kUnknown,   // created before the trace started, or its event was lost
};

struct RmwLookup {
  RmwHandle kind = RmwHandle::kUnknown;
  ObjectId id = kNoObject;
};

class ObjectModel {
 public:
  // Initialisation events; others are ignored.
  void on(const Origin&, const ros2::RclNodeInit&);
  void on(const Origin&, const ros2::RmwPublisherInit&);
  void on(const Origin&, const ros2::RclPublisherInit&);
  void on(const Origin&, const ros2::RmwSubscriptionInit&);
  void on(const Origin&, const ros2::RclSubscriptionInit&);
  void on(const Origin&, const ros2::RclcppSubscriptionInit&);
  void on(const Origin&, const ros2::RclcppSubscriptionCallbackAdded&);
  void on(const Origin&, const ros2::RclServiceInit&);
  void on(const Origin&, const ros2::RclcppServiceCallbackAdded&);
  void on(const Origin&, const ros2::RclTimerInit&);
  void on(const Origin&, const ros2::RclcppTimerCallbackAdded&);
  void on(const Origin&, const ros2::RclcppTimerLinkNode&);
  void on(const Origin&, const ros2::RclcppCallbackRegister&);

  // The newest object with the handle, or kNoObject.
  ObjectId publisher(Vpid vpid, ros2::Handle rcl_handle) const;
  RmwLookup rmw_publisher(Vpid vpid, ros2::Handle handle) const;
  RmwLookup rmw_subscription(Vpid vpid, ros2::Handle handle) const;
  // Makes one when none is known: a callback can run whose initialisation is not in the trace.
  ObjectId callback(Vpid vpid, ros2::Handle address);

  // The subscription that a callback serves, or kNoObject.
  ObjectId subscription_of(const CallbackObject& callback) const;

  const std::vector<NodeObject>& nodes() const { return nodes_; }
  const std::vector<TopicObject>& topics() const { return topics_; }
  const std::vector<EndpointObject>& publishers() const { return publishers_; }
  const std::vector<EndpointObject>& subscriptions() const { return subscriptions_; }
  const std::vector<TimerObject>& timers() const { return timers_; }
  const std::vector<ServiceObject>& services() const { return services_; }
  const std::vector<CallbackObject>& callbacks() const { return callbacks_; }

 private:
  struct Key {
    Vpid vpid;
    ros2::Handle handle;
    bool operator==(const Key&) const = default;
  };
  struct HashKey {
    std::size_t operator()(const Key& key) const;
  };
  using Index = std::unordered_map<Key, ObjectId, HashKey>;

  static ObjectId find(const Index& index, Vpid vpid, ros2::Handle handle);
  static RmwLookup find_rmw(const Index& index, Vpid vpid, ros2::Handle handle);
  ObjectId topic(std::string_view name);
  ObjectId add_callback(Vpid vpid, ros2::Handle address, CallbackObject::Owner owner, ObjectId owner_id);
  ObjectId add_subscription_object(Vpid vpid, ros2::Handle handle, SubscriptionObject object);

  std::vector<NodeObject> nodes_;
  std::vector<TopicObject> topics_;
  std::vector<EndpointObject> publishers_;
  std::vector<EndpointObject> subscriptions_;
  std::vector<SubscriptionObject> subscription_objects_;
  std::vector<TimerObject> timers_;
  std::vector<ServiceObject> services_;
  std::vector<CallbackObject> callbacks_;

  Index node_index_;
  Index publisher_index_;
  Index rmw_publisher_index_;  // to publishers_; kNoObject while no rcl publisher claimed the handle
  Index subscription_index_;
  Index rmw_subscription_index_;
  Index subscription_object_index_;
  Index timer_index_;
  Index service_index_;
  Index callback_index_;
  std::unordered_map<std::string, ObjectId> topic_index_;
};

}  // namespace tracing
