// SPDX-License-Identifier: Apache-2.0
// The states and transitions of rcl_lifecycle.
#include <gmock/gmock.h>
#include <lifecycle_msgs/msg/transition_event.h>
#include <rcl/error_handling.h>
#include <rcl_lifecycle/rcl_lifecycle.h>

#include <lifecycle_msgs/msg/transition.hpp>
#include <lifecycle_msgs/msg/transition_event.hpp>
#include <lifecycle_msgs/srv/change_state.hpp>
#include <lifecycle_msgs/srv/get_available_states.hpp>
#include <lifecycle_msgs/srv/get_available_transitions.hpp>
#include <lifecycle_msgs/srv/get_state.hpp>
#include <rclcpp_lifecycle/lifecycle_node.hpp>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

using lifecycle_msgs::msg::Transition;
using lifecycle_msgs::msg::TransitionEvent;
using testing::ElementsAre;

std::string to_string(const rcl_lifecycle_transition_t& transition) {
  return std::to_string(transition.id) + " " + transition.label + ": " + transition.start->label + " > " +
         transition.goal->label;
}

// Owned by a transition.
rcl_lifecycle_state_t* make_state(unsigned int id, const char* label, const rcl_allocator_t& allocator) {
  auto* const state = static_cast<rcl_lifecycle_state_t*>(allocator.allocate(sizeof(rcl_lifecycle_state_t), nullptr));
  *state = rcl_lifecycle_get_zero_initialized_state();
  EXPECT_EQ(rcl_lifecycle_state_init(state, id, label, &allocator), RCL_RET_OK);
  return state;
}

TEST(OwnStates, BelongToTheirTransition) {
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_lifecycle_transition_t transition = rcl_lifecycle_get_zero_initialized_transition();
  ASSERT_EQ(rcl_lifecycle_transition_init(&transition, 12, "go", make_state(1, "here", allocator),
                                          make_state(2, "there", allocator), &allocator),
            RCL_RET_OK);
  EXPECT_EQ(to_string(transition), "12 go: here > there");
  EXPECT_EQ(rcl_lifecycle_transition_fini(&transition, &allocator), RCL_RET_OK);
  EXPECT_EQ(transition.label, nullptr);
  EXPECT_EQ(transition.start, nullptr);
  EXPECT_EQ(transition.goal, nullptr);
  EXPECT_EQ(rcl_lifecycle_transition_fini(&transition, &allocator), RCL_RET_OK) << "once more";

  rcl_lifecycle_state_t* const loop = make_state(3, "loop", allocator);
  ASSERT_EQ(rcl_lifecycle_transition_init(&transition, 13, "stay", loop, loop, &allocator), RCL_RET_OK);
  EXPECT_EQ(rcl_lifecycle_transition_fini(&transition, &allocator), RCL_RET_OK);
}

TEST(OwnStates, SayWhatIsWrong) {
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  const rcl_allocator_t none{};
  rcl_lifecycle_state_t state = rcl_lifecycle_get_zero_initialized_state();
  rcl_lifecycle_transition_t transition = rcl_lifecycle_get_zero_initialized_transition();
  for (const rcl_ret_t ret :
       {rcl_lifecycle_state_init(nullptr, 1, "a", &allocator), rcl_lifecycle_state_init(&state, 1, nullptr, &allocator),
        rcl_lifecycle_state_init(&state, 1, "a", &none), rcl_lifecycle_state_fini(&state, nullptr),
        rcl_lifecycle_transition_init(nullptr, 1, "a", nullptr, nullptr, &allocator),
        rcl_lifecycle_transition_init(&transition, 1, nullptr, nullptr, nullptr, &allocator),
        rcl_lifecycle_transition_init(&transition, 1, "a", nullptr, nullptr, &none),
        rcl_lifecycle_transition_fini(&transition, nullptr)}) {
    EXPECT_EQ(ret, RCL_RET_INVALID_ARGUMENT);
  }
  EXPECT_EQ(rcl_lifecycle_state_fini(nullptr, &allocator), RCL_RET_OK);
  EXPECT_EQ(rcl_lifecycle_transition_fini(nullptr, &allocator), RCL_RET_OK);
  rcl_reset_error();
}

TEST(LifecycleTransitionMap, HasTheStatesAndTransitionsOfRos2) {
  const rcl_lifecycle_transition_map_t map = rcl_lifecycle_get_default_transition_map();
  std::vector<std::string> states;
  for (unsigned int i = 0; i < map.states_size; ++i) {
    states.push_back(std::to_string(map.states[i].id) + " " + map.states[i].label);
  }
  EXPECT_THAT(states, ElementsAre("0 unknown", "1 unconfigured", "2 inactive", "3 active", "4 finalized",
                                  "10 configuring", "11 cleaningup", "12 shuttingdown", "13 activating",
                                  "14 deactivating", "15 errorprocessing"));
  std::vector<std::string> transitions;
  for (unsigned int i = 0; i < map.transitions_size; ++i) {
    transitions.push_back(to_string(map.transitions[i]));
  }
  EXPECT_THAT(
      transitions,
      ElementsAre(
          "1 configure: unconfigured > configuring", "10 transition_success: configuring > inactive",
          "11 transition_failure: configuring > unconfigured", "12 transition_error: configuring > errorprocessing",
          "2 cleanup: inactive > cleaningup", "20 transition_success: cleaningup > unconfigured",
          "21 transition_failure: cleaningup > inactive", "22 transition_error: cleaningup > errorprocessing",
          "3 activate: inactive > activating", "30 transition_success: activating > active",
          "31 transition_failure: activating > inactive", "32 transition_error: activating > errorprocessing",
          "4 deactivate: active > deactivating", "40 transition_success: deactivating > inactive",
          "41 transition_failure: deactivating > active", "42 transition_error: deactivating > errorprocessing",
          "5 shutdown: unconfigured > shuttingdown", "6 shutdown: inactive > shuttingdown",
          "7 shutdown: active > shuttingdown", "50 transition_success: shuttingdown > finalized",
          "51 transition_failure: shuttingdown > finalized", "52 transition_error: shuttingdown > errorprocessing",
          "60 transition_success: errorprocessing > unconfigured", "61 transition_failure: errorprocessing > finalized",
          "62 transition_error: errorprocessing > finalized"));
}

TEST(LifecycleTransitionMap, StatesKnowTheTransitionsThatBeginInThem) {
  const rcl_lifecycle_transition_map_t map = rcl_lifecycle_get_default_transition_map();
  const rcl_lifecycle_state_t* inactive = rcl_lifecycle_get_state(&map, 2);
  std::vector<std::string> labels;
  for (unsigned int i = 0; i < inactive->valid_transition_size; ++i) {
    labels.emplace_back(inactive->valid_transitions[i].label);
  }
  EXPECT_THAT(labels, ElementsAre("cleanup", "activate", "shutdown"));
  EXPECT_EQ(rcl_lifecycle_get_transition_by_label(inactive, "shutdown")->id,
            Transition::TRANSITION_INACTIVE_SHUTDOWN + 0u);
  EXPECT_EQ(rcl_lifecycle_get_transition_by_label(inactive, "configure"), nullptr);
  EXPECT_STREQ(rcl_lifecycle_get_transition_label_by_id(
                   inactive, rcl_lifecycle_get_transition_by_label(inactive, "shutdown")->id),
               "shutdown");
  EXPECT_EQ(rcl_lifecycle_get_transition_label_by_id(inactive, 255), nullptr);
  EXPECT_EQ(rcl_lifecycle_get_transition_by_id(inactive, Transition::TRANSITION_ACTIVATE)->goal,
            rcl_lifecycle_get_state(&map, 13));
  EXPECT_EQ(rcl_lifecycle_get_state(&map, 4)->valid_transition_size, 0u);
  EXPECT_EQ(rcl_lifecycle_get_state(&map, 99), nullptr);
}

class StateMachineTest : public RosTest {
 protected:
  StateMachineTest() { options_.enable_com_interface = false; }
  ~StateMachineTest() override { rcl_reset_error(); }

  rcl_ret_t init() {
    using rosidl_typesupport_cpp::get_service_type_support_handle;
    return rcl_lifecycle_state_machine_init(
        &machine_, node_->get_node_base_interface()->get_rcl_node_handle(), event_type_,
        get_service_type_support_handle<lifecycle_msgs::srv::ChangeState>(),
        get_service_type_support_handle<lifecycle_msgs::srv::GetState>(),
        get_service_type_support_handle<lifecycle_msgs::srv::GetAvailableStates>(),
        get_service_type_support_handle<lifecycle_msgs::srv::GetAvailableTransitions>(),
        get_service_type_support_handle<lifecycle_msgs::srv::GetAvailableTransitions>(), &options_);
  }
  rcl_ret_t fini() {
    return rcl_lifecycle_state_machine_fini(&machine_, node_->get_node_base_interface()->get_rcl_node_handle());
  }
  static std::string error() {
    const std::string text = rcl_get_error_string().str;
    rcl_reset_error();
    return text.substr(0, text.find(", at "));
  }

  const rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("node");
  const rosidl_message_type_support_t* event_type_ =
      rosidl_typesupport_cpp::get_message_type_support_handle<TransitionEvent>();
  rcl_lifecycle_state_machine_t machine_ = rcl_lifecycle_get_zero_initialized_state_machine();
  rcl_lifecycle_state_machine_options_t options_ = rcl_lifecycle_get_default_state_machine_options();
};

TEST_F(StateMachineTest, GoesOnlyWhereTheCurrentStateLeads) {
  EXPECT_EQ(rcl_lifecycle_state_machine_is_initialized(&machine_), RCL_RET_INVALID_ARGUMENT);
  EXPECT_EQ(error(), "State machine not initialized");
  ASSERT_EQ(init(), RCL_RET_OK);
  EXPECT_EQ(init(), RCL_RET_ALREADY_INIT);
  EXPECT_EQ(error(), "the state machine is initialized already");
  EXPECT_STREQ(machine_.current_state->label, "unconfigured");

  EXPECT_EQ(rcl_lifecycle_trigger_transition_by_id(&machine_, Transition::TRANSITION_ACTIVATE, true), RCL_RET_ERROR);
  EXPECT_EQ(error(), "Transition is not registered.");
  EXPECT_STREQ(machine_.current_state->label, "unconfigured");
  EXPECT_EQ(rcl_lifecycle_trigger_transition_by_id(&machine_, Transition::TRANSITION_CONFIGURE, true), RCL_RET_OK);
  EXPECT_STREQ(machine_.current_state->label, "configuring");
  EXPECT_EQ(rcl_lifecycle_trigger_transition_by_label(&machine_, "transition_success", true), RCL_RET_OK);
  EXPECT_STREQ(machine_.current_state->label, "inactive");
  EXPECT_EQ(fini(), RCL_RET_OK);
  EXPECT_EQ(rcl_lifecycle_trigger_transition_by_label(&machine_, "activate", true), RCL_RET_INVALID_ARGUMENT);
}

TEST_F(StateMachineTest, HasItsTopicAndServicesWhileItIsInitialized) {
  options_ = rcl_lifecycle_get_default_state_machine_options();
  EXPECT_EQ(init(), RCL_RET_OK);
  EXPECT_EQ(node_->count_publishers("/node/transition_event"), 1u);
  EXPECT_STREQ(rcl_service_get_service_name(&machine_.com_interface.srv_get_transition_graph),
               "/node/get_transition_graph");
  EXPECT_EQ(node_->count_services("/node/change_state"), 1u);
  EXPECT_EQ(fini(), RCL_RET_OK);
  EXPECT_EQ(node_->count_services("/node/change_state"), 0u);
}

TEST_F(StateMachineTest, LeavesNothingWhenItCannotHaveItsServices) {
  options_ = rcl_lifecycle_get_default_state_machine_options();
  event_type_ = nullptr;
  EXPECT_EQ(init(), RCL_RET_INVALID_ARGUMENT);
  EXPECT_EQ(error(), "event_type argument is null");
  EXPECT_EQ(machine_.current_state, nullptr);
  EXPECT_EQ(node_->count_services("/node/change_state"), 0u);
}

TEST_F(StateMachineTest, PublishesMessagesOfCAsItDoesThoseOfCpp) {
  options_ = rcl_lifecycle_get_default_state_machine_options();
  event_type_ = ROSIDL_GET_MSG_TYPE_SUPPORT(lifecycle_msgs, msg, TransitionEvent);
  ASSERT_EQ(init(), RCL_RET_OK);
  std::vector<std::string> events;
  const auto subscription =
      node_->create_subscription<TransitionEvent>("~/transition_event", 10, [&](const TransitionEvent& event) {
        EXPECT_GT(event.timestamp, 0u);
        events.push_back(event.transition.label + ": " + event.start_state.label + " > " + event.goal_state.label);
      });
  EXPECT_EQ(rcl_lifecycle_trigger_transition_by_label(&machine_, "configure", true), RCL_RET_OK);
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node_);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (events.empty() && std::chrono::steady_clock::now() < end) {
    executor.spin_once(kPatience);
  }
  EXPECT_THAT(events, ElementsAre("configure: unconfigured > configuring"));
  EXPECT_EQ(fini(), RCL_RET_OK);
}

TEST_F(StateMachineTest, PrintsItsStates) {
  ASSERT_EQ(init(), RCL_RET_OK);
  testing::internal::CaptureStderr();
  rcl_print_state_machine(&machine_);
  const std::string printed = testing::internal::GetCapturedStderr();
  EXPECT_NE(printed.find("[rcl_lifecycle]: state inactive(2), 3 transitions: cleanup, activate, shutdown\n"),
            std::string::npos)
      << printed;
  EXPECT_EQ(fini(), RCL_RET_OK);
}

TEST(LifecycleValues, StatesAndTransitionsAreValues) {
  const rclcpp_lifecycle::State unknown;
  EXPECT_EQ(unknown.id(), 0);
  EXPECT_EQ(unknown.label(), "unknown");
  EXPECT_EQ(rclcpp_lifecycle::State(3, "active").label(), "active");
  EXPECT_THROW(rclcpp_lifecycle::State(3, ""), std::runtime_error);
  EXPECT_THROW(rclcpp_lifecycle::State(nullptr), std::runtime_error);
  const rclcpp_lifecycle::Transition transition(3, "activate", rclcpp_lifecycle::State(2, "inactive"),
                                                rclcpp_lifecycle::State(13, "activating"));
  EXPECT_EQ(transition.start_state().label(), "inactive");
  EXPECT_EQ(transition.goal_state().id(), 13);
  EXPECT_THROW(rclcpp_lifecycle::Transition(nullptr), std::runtime_error);

  struct Taken : rclcpp_lifecycle::Transition {
    Taken() : Transition(3, "activate") { reset(); }
  };
  EXPECT_THROW(Taken().id(), std::runtime_error);
  struct TakenState : rclcpp_lifecycle::State {
    TakenState() : State(3, "active") { reset(); }
  };
  EXPECT_THROW(TakenState().label(), std::runtime_error);
  EXPECT_THROW(rclcpp_lifecycle::State(TakenState()).id(), std::runtime_error);
}

}  // namespace
