// SPDX-License-Identifier: Apache-2.0
// The ROS 2 objects of a trace, built from its initialisation events as they come by.
//
// Handles are addresses: two processes may use the same one, and one process may use it again for another object. An
// object is therefore found by process, handle and time. The model gets events in the order of time, answers with the
// newest object that had the handle, and keeps the results of older objects. ROS 2 records no end of objects. Where a
// trace has the ends (`ros2_ext`), a handle has no object from an end to the next init event.
//
// The init events of living objects come again when another session starts (a state dump). Repeated events change
// nothing. An endpoint is recognised by its gid. Any other object is recognised by its address and the facts in its
// init event, unless its end was recorded.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tracing/decode/reader/ext_events.hpp"
#include "tracing/decode/reader/ros2_events.hpp"
#include "tracing/model/objects/callback_table.hpp"
#include "tracing/model/objects/handle_index.hpp"
#include "tracing/model/objects/objects.hpp"
#include "tracing/model/objects/process_table.hpp"

namespace tracing {

// What is known about a handle of the rmw layer.
enum class RmwHandle {
  kKnown,     // it belongs to an rcl object
  kInternal,  // it is the middleware's own, such as the endpoints of ros_discovery_info
  kUnknown,   // it was created before the trace started, or its event was lost
};

struct RmwLookup {
  RmwHandle kind = RmwHandle::kUnknown;
  ObjectId id = kNoObject;
};

class ObjectModel {
 public:
  // To be called before the events of new processes; takes a comparison. An object that a process does not have is
  // looked for in the process that had its id before (ProcessObject::earlier).
  void learn(const ProcessTable& processes) {
    earlier_.learn(processes);
    while (hosts_.size() < processes.processes().size()) {
      hosts_.push_back(processes.processes()[hosts_.size()].host);
    }
  }
  // Whether they run on one machine, as far as the trace tells.
  bool are_on_one_host(ProcessId process, ProcessId other) const {
    return process >= hosts_.size() || other >= hosts_.size() || hosts_[process] == hosts_[other];
  }

  // Takes the initialisation events; other events are ignored.
  void on(const Origin&, const ros2::RclNodeInit&);
  void on(const Origin&, const ros2::RmwPublisherInit&);
  void on(const Origin&, const ros2::RclPublisherInit&);
  void on(const Origin&, const ros2::RmwSubscriptionInit&);
  void on(const Origin&, const ros2::RclSubscriptionInit&);
  void on(const Origin&, const ros2::RclcppSubscriptionInit&);
  void on(const Origin&, const ros2::RclcppSubscriptionCallbackAdded&);
  void on(const Origin&, const ros2::RclServiceInit&);
  void on(const Origin&, const ros2::RclcppServiceCallbackAdded&);
  void on(const Origin&, const ros2::RmwClientInit&);
  void on(const Origin&, const ros2::RclClientInit&);
  void on(const Origin&, const ros2::RclTimerInit&);
  void on(const Origin&, const ros2::RclcppTimerCallbackAdded&);
  void on(const Origin&, const ros2::RclcppTimerLinkNode&);
  void on(const Origin&, const ros2::RclcppCallbackRegister&);
  void on(const Origin&, const ros2::RclLifecycleStateMachineInit&);

  void on(const Origin&, const ros2::ObjectEnd&);
  void on(const Origin&, const ros2::EndpointQosEvent&, const ros2::EndpointQos&);

  // The newest object with the handle, or kNoObject.
  ObjectId node(ProcessId process, ros2::Handle handle) const;
  ObjectId publisher(ProcessId process, ros2::Handle rcl_handle) const;
  ObjectId subscription(ProcessId process, ros2::Handle rcl_handle) const;
  // Of rclcpp's object around a subscription.
  ObjectId subscription_of_object(ProcessId process, ros2::Handle object) const;
  // How many objects rclcpp has around a subscription: none if a waitable takes its messages, such as a client of an
  // action; two with intra-process communication.
  std::uint32_t rclcpp_objects(ObjectId subscription) const {
    return subscription < rclcpp_objects_.size() ? rclcpp_objects_[subscription] : 0;
  }
  RmwLookup rmw_publisher(ProcessId process, ros2::Handle handle) const;
  RmwLookup rmw_subscription(ProcessId process, ros2::Handle handle) const;
  ObjectId timer(ProcessId process, ros2::Handle handle) const;
  ObjectId service(ProcessId process, ros2::Handle rcl_handle) const;
  ObjectId client(ProcessId process, ros2::Handle rcl_handle) const;
  ObjectId rmw_service(ProcessId process, ros2::Handle handle) const;
  ObjectId rmw_client(ProcessId process, ros2::Handle handle) const;
  // The callback at the address. Makes one when none is known: a callback can run whose initialisation is not in the
  // trace.
  ObjectId callback(ProcessId process, ros2::Handle address);
  // The callback of a client for responses.
  ObjectId client_callback(ProcessId process, ros2::Handle rcl_handle);

  // The subscription that a callback serves, or kNoObject.
  ObjectId subscription_of(const CallbackObject& callback) const;
  // The node of a callback, or kNoObject.
  ObjectId node_of(const CallbackObject& callback) const;

  const std::vector<NodeObject>& nodes() const { return nodes_; }
  const std::vector<TopicObject>& topics() const { return topics_; }
  const std::vector<EndpointObject>& publishers() const { return publishers_; }
  const std::vector<EndpointObject>& subscriptions() const { return subscriptions_; }
  const std::vector<TimerObject>& timers() const { return timers_; }
  const std::vector<ServiceObject>& services() const { return services_; }
  const std::vector<ClientObject>& clients() const { return clients_; }
  const std::vector<CallbackObject>& callbacks() const { return callbacks_.all(); }

 private:
  using Index = HandleIndex<ObjectId>;
  struct RmwEndpoint {
    ros2::Gid gid;
    ObjectId endpoint = kNoObject;  // kNoObject until an rcl object has the handle
    std::optional<ros2::EndpointQos> qos = std::nullopt;
  };
  using RmwIndex = HandleIndex<RmwEndpoint>;

  ObjectId find(const Index& index, ProcessId process, ros2::Handle handle) const;
  RmwLookup find_rmw(const RmwIndex& index, ProcessId process, ros2::Handle handle) const;
  static void add_rmw(RmwIndex& index, ProcessId process, ros2::Handle handle, const ros2::Gid& gid);
  static std::optional<ros2::EndpointQos> qos_of(const RmwIndex& index, const HandleKey& key);
  // Whether the handle, and the rmw handle that `rmw` was looked up with, already belong to this very endpoint.
  bool is_endpoint(const Index& index, const std::vector<EndpointObject>& endpoints, ProcessId process,
                   ros2::Handle handle, const RmwLookup& rmw, const EndpointObject& endpoint) const;
  ObjectId topic(std::string_view name);
  void count_rclcpp_object(ObjectId subscription);
  ObjectId next_lifecycle_service(const Origin& origin, ros2::Handle service_handle);
  ObjectId add_subscription_object(ProcessId process, ros2::Handle handle, SubscriptionObject object);

  std::vector<NodeObject> nodes_;
  std::vector<TopicObject> topics_;
  std::vector<EndpointObject> publishers_;
  std::vector<EndpointObject> subscriptions_;
  std::vector<std::uint32_t> rclcpp_objects_;  // by subscription, as far as there are some
  std::vector<SubscriptionObject> subscription_objects_;
  std::vector<TimerObject> timers_;
  std::vector<ServiceObject> services_;
  std::vector<ClientObject> clients_;

  EarlierProcesses earlier_;
  std::vector<std::string> hosts_;  // by process
  CallbackTable callbacks_{earlier_};

  Index node_index_;
  Index publisher_index_;
  RmwIndex rmw_publisher_index_;  // to publishers_
  Index subscription_index_;
  RmwIndex rmw_subscription_index_;  // to subscriptions_
  Index subscription_object_index_;
  Index timer_index_;
  Index service_index_;
  Index rmw_service_index_;
  Index client_index_;
  RmwIndex rmw_client_index_;  // to clients_
  std::unordered_map<std::string, ObjectId> topic_index_;

  // The last services of each thread, and those of a state machine that rclcpp is about to give callbacks.
  struct ThreadServices {
    std::vector<ObjectId> made;  // by rcl, for one node, and without a callback yet
    std::deque<ObjectId> expected;
  };
  std::map<std::pair<ProcessId, std::int64_t>, ThreadServices> thread_services_;
};

}  // namespace tracing
