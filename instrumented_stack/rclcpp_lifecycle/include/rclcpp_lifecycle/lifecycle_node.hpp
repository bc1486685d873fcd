// SPDX-License-Identifier: Apache-2.0
// A managed node: its states are `unconfigured`, `inactive`, `active` and `finalized`. Callers of its services, or its
// own program, trigger the transitions between them.
//
//   class Camera : public rclcpp_lifecycle::LifecycleNode {
//     CallbackReturn on_configure(const rclcpp_lifecycle::State &) override;
//     ...
//   };
//
// It publishes its transitions on ~/transition_event and has the services ~/change_state, ~/get_state,
// ~/get_available_states, ~/get_available_transitions and ~/get_transition_graph of lifecycle_msgs.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "rclcpp/rclcpp.hpp"
#include "rclcpp_lifecycle/lifecycle_publisher.hpp"
#include "rclcpp_lifecycle/managed_entity.hpp"
#include "rclcpp_lifecycle/node_interfaces/lifecycle_node_interface.hpp"
#include "rclcpp_lifecycle/state.hpp"
#include "rclcpp_lifecycle/transition.hpp"

namespace rclcpp_lifecycle {

class LifecycleServices;
class StateManager;

// Any thread may trigger transitions, one at a time. A second transition meanwhile is refused, because the transition
// state does not have it. It is no rclcpp::Node, but has its functions (rclcpp/detail/any_node.hpp). Executors take it
// by its get_node_base_interface().
class LifecycleNode : public rclcpp::detail::AnyNode,
                      public node_interfaces::LifecycleNodeInterface,
                      public std::enable_shared_from_this<LifecycleNode> {
 public:
  RCLCPP_SMART_PTR_DEFINITIONS(LifecycleNode)
  using CallbackReturn = node_interfaces::LifecycleNodeInterface::CallbackReturn;

  // Throw what the constructors of rclcpp::Node throw. Without the communication interface there are no topic and no
  // services: only the program triggers transitions.
  explicit LifecycleNode(const std::string& node_name, const rclcpp::NodeOptions& options = rclcpp::NodeOptions(),
                         bool enable_communication_interface = true);
  LifecycleNode(const std::string& node_name, const std::string& node_namespace,
                const rclcpp::NodeOptions& options = rclcpp::NodeOptions(), bool enable_communication_interface = true);
  ~LifecycleNode() override;

  // Creates a publisher that publishes only while the node is active.
  template <typename MessageT, typename AllocatorT = std::allocator<void>>
  std::shared_ptr<LifecyclePublisher<MessageT, AllocatorT>> create_publisher(
      const std::string& topic_name, const rclcpp::QoS& qos,
      const rclcpp::PublisherOptionsWithAllocator<AllocatorT>& options =
          rclcpp::PublisherOptionsWithAllocator<AllocatorT>()) {
    auto publisher = rclcpp::create_publisher<MessageT, AllocatorT, LifecyclePublisher<MessageT, AllocatorT>>(
        *this, topic_name, qos, options);
    add_managed_entity(publisher);
    return publisher;
  }

  const State& get_current_state() const;
  // All states and transitions, and the transitions of the current state.
  std::vector<State> get_available_states() const;
  std::vector<Transition> get_available_transitions() const;
  std::vector<Transition> get_transition_graph() const;

  // Run the callback in this thread and return the node's state afterwards. The state does not change if it has no such
  // transition. `cb_return_code` is the result of the callback, ERROR if there was no transition.
  const State& trigger_transition(const Transition& transition) { return trigger_transition(transition.id()); }
  const State& trigger_transition(const Transition& transition, CallbackReturn& cb_return_code) {
    return trigger_transition(transition.id(), cb_return_code);
  }
  const State& trigger_transition(uint8_t transition_id);
  const State& trigger_transition(uint8_t transition_id, CallbackReturn& cb_return_code);
  const State& configure();
  const State& configure(CallbackReturn& cb_return_code);
  const State& cleanup();
  const State& cleanup(CallbackReturn& cb_return_code);
  const State& activate();
  const State& activate(CallbackReturn& cb_return_code);
  const State& deactivate();
  const State& deactivate(CallbackReturn& cb_return_code);
  const State& shutdown();
  const State& shutdown(CallbackReturn& cb_return_code);

  // Replace the virtual functions. Always return true.
  bool register_on_configure(std::function<CallbackReturn(const State&)> callback);
  bool register_on_cleanup(std::function<CallbackReturn(const State&)> callback);
  bool register_on_shutdown(std::function<CallbackReturn(const State&)> callback);
  bool register_on_activate(std::function<CallbackReturn(const State&)> callback);
  bool register_on_deactivate(std::function<CallbackReturn(const State&)> callback);
  bool register_on_error(std::function<CallbackReturn(const State&)> callback);

  // These activate and deactivate the managed entities, so call them when you override them.
  CallbackReturn on_activate(const State& previous_state) override;
  CallbackReturn on_deactivate(const State& previous_state) override;

  // The entity is held weakly.
  void add_managed_entity(std::weak_ptr<ManagedEntityInterface> managed_entity);
  // Timers run in every state, as in ROS 2.
  void add_timer_handle(std::shared_ptr<rclcpp::TimerBase>) {}

 private:
  const State& trigger_label(const char* label, CallbackReturn& cb_return_code);
  std::vector<std::shared_ptr<ManagedEntityInterface>> managed_entities() const;

  std::shared_ptr<StateManager> states_;
  std::unique_ptr<LifecycleServices> services_;  // null without the communication interface
  mutable std::mutex managed_entities_mutex_;
  std::vector<std::weak_ptr<ManagedEntityInterface>> managed_entities_;
};

}  // namespace rclcpp_lifecycle
