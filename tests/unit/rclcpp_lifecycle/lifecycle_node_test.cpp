// SPDX-License-Identifier: Apache-2.0
// Transitions that a program triggers itself, their callbacks and their results.
#include <gmock/gmock.h>

#include <lifecycle_msgs/msg/state.hpp>
#include <lifecycle_msgs/msg/transition.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>
#include <std_msgs/msg/string.hpp>
#include <stdexcept>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using lifecycle_msgs::msg::Transition;
using rclcpp_lifecycle::LifecycleNode;
using rclcpp_lifecycle::State;
using CallbackReturn = LifecycleNode::CallbackReturn;
using StateId = lifecycle_msgs::msg::State;
using std_msgs::msg::String;
using testing::ElementsAre;

// Notes its callbacks. The test sets the result of each.
class Recorder : public LifecycleNode {
 public:
  explicit Recorder(const std::string& name, bool enable_communication_interface = true)
      : LifecycleNode(name, rclcpp::NodeOptions(), enable_communication_interface) {}

  CallbackReturn on_configure(const State& state) override { return record("configure", state); }
  CallbackReturn on_cleanup(const State& state) override { return record("cleanup", state); }
  CallbackReturn on_shutdown(const State& state) override { return record("shutdown", state); }
  CallbackReturn on_activate(const State& state) override {
    LifecycleNode::on_activate(state);
    return record("activate", state);
  }
  CallbackReturn on_deactivate(const State& state) override {
    LifecycleNode::on_deactivate(state);
    return record("deactivate", state);
  }
  CallbackReturn on_error(const State& state) override { return record("error", state); }

  CallbackReturn record(const std::string& callback, const State& state) {
    calls.push_back(callback + " from " + state.label() + " in " + get_current_state().label());
    const auto found = results.find(callback);
    return found == results.end() ? CallbackReturn::SUCCESS : found->second;
  }

  std::vector<std::string> calls;
  std::map<std::string, CallbackReturn> results;
};

class LifecycleNodeTest : public RosTest {
 protected:
  const std::shared_ptr<Recorder> node_ = std::make_shared<Recorder>("managed");
};

TEST_F(LifecycleNodeTest, GoesThroughItsLife) {
  EXPECT_EQ(node_->get_current_state().id(), StateId::PRIMARY_STATE_UNCONFIGURED);
  EXPECT_EQ(node_->configure().label(), "inactive");
  EXPECT_EQ(node_->activate().label(), "active");
  EXPECT_EQ(node_->deactivate().label(), "inactive");
  EXPECT_EQ(node_->cleanup().label(), "unconfigured");
  EXPECT_EQ(node_->shutdown().label(), "finalized");
  EXPECT_THAT(node_->calls,
              ElementsAre("configure from unconfigured in configuring", "activate from inactive in activating",
                          "deactivate from active in deactivating", "cleanup from inactive in cleaningup",
                          "shutdown from unconfigured in shuttingdown"));
}

TEST_F(LifecycleNodeTest, FailureLeadsBackAndErrorToErrorProcessing) {
  CallbackReturn result = CallbackReturn::SUCCESS;
  node_->results = {{"configure", CallbackReturn::FAILURE}};
  EXPECT_EQ(node_->configure(result).label(), "unconfigured");
  EXPECT_EQ(result, CallbackReturn::FAILURE);

  // Error processing that succeeds makes the node as good as new.
  node_->results = {{"configure", CallbackReturn::ERROR}};
  EXPECT_EQ(node_->configure(result).label(), "unconfigured");
  EXPECT_EQ(result, CallbackReturn::ERROR);
  EXPECT_EQ(node_->calls.back(), "error from unconfigured in errorprocessing");

  // Error processing that fails ends the node.
  node_->results = {{"activate", CallbackReturn::ERROR}, {"error", CallbackReturn::FAILURE}};
  EXPECT_EQ(node_->configure().label(), "inactive");
  EXPECT_EQ(node_->activate(result).label(), "finalized");
  EXPECT_EQ(result, CallbackReturn::ERROR);

  node_->calls.clear();
  EXPECT_EQ(node_->configure(result).label(), "finalized");
  EXPECT_EQ(result, CallbackReturn::ERROR);
  EXPECT_THAT(node_->calls, ElementsAre());
}

TEST_F(LifecycleNodeTest, ShutdownEndsInFinalizedAlsoWhenItFails) {
  node_->results = {{"shutdown", CallbackReturn::FAILURE}};
  CallbackReturn result = CallbackReturn::SUCCESS;
  EXPECT_EQ(node_->configure().label(), "inactive");
  EXPECT_EQ(node_->activate().label(), "active");
  EXPECT_EQ(node_->shutdown(result).label(), "finalized");
  EXPECT_EQ(result, CallbackReturn::FAILURE);
}

TEST_F(LifecycleNodeTest, ExceptionIsAnErrorAndErrorProcessingFailsUnlessOverridden) {
  LifecycleNode node("throwing");
  EXPECT_TRUE(node.register_on_configure([](const State&) -> CallbackReturn { throw std::runtime_error("no disk"); }));
  testing::internal::CaptureStderr();
  CallbackReturn result = CallbackReturn::SUCCESS;
  EXPECT_EQ(node.configure(result).label(), "finalized");
  EXPECT_EQ(result, CallbackReturn::ERROR);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, testing::HasSubstr("[throwing]: Caught exception in callback for transition 10\n"));
  EXPECT_THAT(log, testing::HasSubstr("[throwing]: Original error: no disk\n"));
  EXPECT_THAT(log, testing::HasSubstr("[throwing]: Error occurred while doing error handling.\n"));
}

TEST_F(LifecycleNodeTest, TransitionThatTheStateDoesNotHaveIsRefused) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(node_->trigger_transition(Transition::TRANSITION_ACTIVATE).label(), "unconfigured");
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::HasSubstr("[managed]: Unable to start transition 3 from current state unconfigured: "
                                 "Transition is not registered.\n"));
  EXPECT_EQ(node_->trigger_transition(rclcpp_lifecycle::Transition(Transition::TRANSITION_CONFIGURE)).label(),
            "inactive");
}

TEST_F(LifecycleNodeTest, TransitionUnderWayRefusesOthers) {
  CallbackReturn inner = CallbackReturn::SUCCESS;
  node_->register_on_configure([&](const State&) {
    // The transitions that end this one are refused, too, when somebody else triggers them.
    node_->trigger_transition(Transition::TRANSITION_ON_CONFIGURE_FAILURE, inner);
    EXPECT_EQ(inner, CallbackReturn::ERROR);
    std::thread([&] { node_->shutdown(inner); }).join();
    EXPECT_EQ(inner, CallbackReturn::ERROR);
    return CallbackReturn::SUCCESS;
  });
  EXPECT_EQ(node_->configure().label(), "inactive");
}

TEST_F(LifecycleNodeTest, ReferenceToAStateStaysGood) {
  const State& first = node_->get_current_state();
  const State& second = node_->configure();
  EXPECT_EQ(first.label(), "unconfigured");
  EXPECT_EQ(second.label(), "inactive");
}

TEST_F(LifecycleNodeTest, TellsItsStatesAndTransitions) {
  EXPECT_EQ(node_->get_available_states().size(), 11u);
  EXPECT_EQ(node_->get_transition_graph().size(), 25u);
  const auto transitions = node_->get_available_transitions();
  ASSERT_EQ(transitions.size(), 2u);
  EXPECT_EQ(transitions[0].label(), "configure");
  EXPECT_EQ(transitions[0].goal_state().label(), "configuring");
  EXPECT_EQ(transitions[1].label(), "shutdown");
}

TEST_F(LifecycleNodeTest, PublisherIsSilentUnlessTheNodeIsActive) {
  const auto publisher = node_->create_publisher<String>("chatter", 10);
  std::vector<std::string> heard;
  const auto subscription =
      node_->create_subscription<String>("chatter", 10, [&](const String& message) { heard.push_back(message.data); });
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node_->get_node_base_interface());
  ASSERT_TRUE(spin_until(executor, [&] { return publisher->get_subscription_count() == 1; }));
  const auto say = [&](const std::string& text) {
    String message;
    message.data = text;
    publisher->publish(message);
    message.data += ", owned";
    publisher->publish(std::make_unique<String>(message));
  };

  testing::internal::CaptureStderr();
  say("unconfigured");
  const std::string warning =
      "[LifecyclePublisher]: Trying to publish message on the topic '/chatter', but the publisher is not activated\n";
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, testing::EndsWith(warning));
  EXPECT_EQ(std::count(log.begin(), log.end(), '\n'), 1) << log;
  node_->configure();
  say("inactive");
  EXPECT_FALSE(publisher->is_activated());
  node_->activate();
  EXPECT_TRUE(publisher->is_activated());
  say("active");
  EXPECT_TRUE(spin_until(executor, [&] { return heard.size() == 2; }));
  EXPECT_THAT(heard, ElementsAre("active", "active, owned"));
  node_->deactivate();
  EXPECT_FALSE(publisher->is_activated());
}

TEST_F(LifecycleNodeTest, ManagedEntitiesAreSwitchedAsLongAsTheyLive) {
  auto entity = std::make_shared<rclcpp_lifecycle::SimpleManagedEntity>();
  node_->add_managed_entity(entity);
  node_->configure();
  node_->activate();
  EXPECT_TRUE(entity->is_activated());
  entity.reset();
  EXPECT_EQ(node_->deactivate().label(), "inactive");
}

// What a library offers for nodes of both kinds: as ROS 2, neither is a base of the other.
static_assert(!std::is_base_of_v<rclcpp::Node, LifecycleNode>);
[[maybe_unused]] std::string kind_of(const rclcpp::Node&) {
  return "node";
}
std::string kind_of(const LifecycleNode&) {
  return "managed node";
}
std::string kind_of(const rclcpp::Node::SharedPtr& node) {
  return kind_of(*node);
}
std::string kind_of(const LifecycleNode::SharedPtr& node) {
  return kind_of(*node);
}

TEST_F(LifecycleNodeTest, OverloadsForBothKindsOfNodesAreNotAmbiguous) {
  EXPECT_EQ(kind_of(node_), "managed node");
  EXPECT_EQ(kind_of(std::make_shared<rclcpp::Node>("other")), "node");
  using namespace rclcpp::node_interfaces;
  NodeInterfaces<NodeBaseInterface, NodeClockInterface, NodeGraphInterface, NodeLoggingInterface,
                 NodeParametersInterface, NodeServicesInterface, NodeTimeSourceInterface, NodeTimersInterface,
                 NodeTopicsInterface, NodeTypeDescriptionsInterface, NodeWaitablesInterface>
      all(*node_);
  EXPECT_STREQ(all.get_node_base_interface()->get_name(), "managed");
  EXPECT_NE(all.get_node_time_source_interface(), nullptr);
}

TEST_F(LifecycleNodeTest, IsWhatItIsAlsoAsASharedPointer) {
  const std::shared_ptr<LifecycleNode> node = node_->shared_from_this();
  EXPECT_EQ(node, node_);
  EXPECT_EQ(node->weak_from_this().lock(), node_);
}

TEST_F(LifecycleNodeTest, WithoutCommunicationInterfaceThereAreNoServices) {
  const auto quiet = std::make_shared<Recorder>("quiet", false);
  EXPECT_EQ(quiet->count_services("/quiet/get_state"), 0u);
  EXPECT_EQ(quiet->count_publishers("/quiet/transition_event"), 0u);
  EXPECT_EQ(quiet->count_services("/managed/get_state"), 1u);
  EXPECT_EQ(quiet->count_publishers("/managed/transition_event"), 1u);
  EXPECT_EQ(quiet->configure().label(), "inactive");
}

TEST_F(LifecycleNodeTest, StateChangesAlsoWhenNobodyCanBeTold) {
  rclcpp::shutdown();
  EXPECT_EQ(node_->shutdown().label(), "finalized");
}

}  // namespace
