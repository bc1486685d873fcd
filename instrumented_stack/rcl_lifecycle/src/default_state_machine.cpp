// SPDX-License-Identifier: Apache-2.0
#include "rcl_lifecycle/default_state_machine.h"

#include <algorithm>
#include <array>
#include <lifecycle_msgs/msg/state.hpp>
#include <lifecycle_msgs/msg/transition.hpp>

const char* const rcl_lifecycle_configure_label = "configure";
const char* const rcl_lifecycle_cleanup_label = "cleanup";
const char* const rcl_lifecycle_activate_label = "activate";
const char* const rcl_lifecycle_deactivate_label = "deactivate";
const char* const rcl_lifecycle_shutdown_label = "shutdown";
const char* const rcl_lifecycle_transition_success_label = "transition_success";
const char* const rcl_lifecycle_transition_failure_label = "transition_failure";
const char* const rcl_lifecycle_transition_error_label = "transition_error";

namespace {

using lifecycle_msgs::msg::State;
using lifecycle_msgs::msg::Transition;

// Both tables are in the order of ROS 2. The transitions of a state follow each other.
struct DefaultMap {
  DefaultMap() {
    // Each transition state ends in one of three ways, depending on the result of its callback.
    const auto add_ends = [&](unsigned int start, unsigned int success_id, unsigned int success,
                              unsigned int failure_id, unsigned int failure, unsigned int error_id,
                              unsigned int error) {
      add(start, rcl_lifecycle_transition_success_label, success_id, success);
      add(start, rcl_lifecycle_transition_failure_label, failure_id, failure);
      add(start, rcl_lifecycle_transition_error_label, error_id, error);
    };
    add(State::PRIMARY_STATE_UNCONFIGURED, rcl_lifecycle_configure_label, Transition::TRANSITION_CONFIGURE,
        State::TRANSITION_STATE_CONFIGURING);
    add_ends(State::TRANSITION_STATE_CONFIGURING, Transition::TRANSITION_ON_CONFIGURE_SUCCESS,
             State::PRIMARY_STATE_INACTIVE, Transition::TRANSITION_ON_CONFIGURE_FAILURE,
             State::PRIMARY_STATE_UNCONFIGURED, Transition::TRANSITION_ON_CONFIGURE_ERROR,
             State::TRANSITION_STATE_ERRORPROCESSING);
    add(State::PRIMARY_STATE_INACTIVE, rcl_lifecycle_cleanup_label, Transition::TRANSITION_CLEANUP,
        State::TRANSITION_STATE_CLEANINGUP);
    add_ends(State::TRANSITION_STATE_CLEANINGUP, Transition::TRANSITION_ON_CLEANUP_SUCCESS,
             State::PRIMARY_STATE_UNCONFIGURED, Transition::TRANSITION_ON_CLEANUP_FAILURE,
             State::PRIMARY_STATE_INACTIVE, Transition::TRANSITION_ON_CLEANUP_ERROR,
             State::TRANSITION_STATE_ERRORPROCESSING);
    add(State::PRIMARY_STATE_INACTIVE, rcl_lifecycle_activate_label, Transition::TRANSITION_ACTIVATE,
        State::TRANSITION_STATE_ACTIVATING);
    add_ends(State::TRANSITION_STATE_ACTIVATING, Transition::TRANSITION_ON_ACTIVATE_SUCCESS,
             State::PRIMARY_STATE_ACTIVE, Transition::TRANSITION_ON_ACTIVATE_FAILURE, State::PRIMARY_STATE_INACTIVE,
             Transition::TRANSITION_ON_ACTIVATE_ERROR, State::TRANSITION_STATE_ERRORPROCESSING);
    add(State::PRIMARY_STATE_ACTIVE, rcl_lifecycle_deactivate_label, Transition::TRANSITION_DEACTIVATE,
        State::TRANSITION_STATE_DEACTIVATING);
    add_ends(State::TRANSITION_STATE_DEACTIVATING, Transition::TRANSITION_ON_DEACTIVATE_SUCCESS,
             State::PRIMARY_STATE_INACTIVE, Transition::TRANSITION_ON_DEACTIVATE_FAILURE, State::PRIMARY_STATE_ACTIVE,
             Transition::TRANSITION_ON_DEACTIVATE_ERROR, State::TRANSITION_STATE_ERRORPROCESSING);
    add(State::PRIMARY_STATE_UNCONFIGURED, rcl_lifecycle_shutdown_label, Transition::TRANSITION_UNCONFIGURED_SHUTDOWN,
        State::TRANSITION_STATE_SHUTTINGDOWN);
    add(State::PRIMARY_STATE_INACTIVE, rcl_lifecycle_shutdown_label, Transition::TRANSITION_INACTIVE_SHUTDOWN,
        State::TRANSITION_STATE_SHUTTINGDOWN);
    add(State::PRIMARY_STATE_ACTIVE, rcl_lifecycle_shutdown_label, Transition::TRANSITION_ACTIVE_SHUTDOWN,
        State::TRANSITION_STATE_SHUTTINGDOWN);
    // A failed shutdown still ends in `finalized`.
    add_ends(State::TRANSITION_STATE_SHUTTINGDOWN, Transition::TRANSITION_ON_SHUTDOWN_SUCCESS,
             State::PRIMARY_STATE_FINALIZED, Transition::TRANSITION_ON_SHUTDOWN_FAILURE, State::PRIMARY_STATE_FINALIZED,
             Transition::TRANSITION_ON_SHUTDOWN_ERROR, State::TRANSITION_STATE_ERRORPROCESSING);
    add_ends(State::TRANSITION_STATE_ERRORPROCESSING, Transition::TRANSITION_ON_ERROR_SUCCESS,
             State::PRIMARY_STATE_UNCONFIGURED, Transition::TRANSITION_ON_ERROR_FAILURE, State::PRIMARY_STATE_FINALIZED,
             Transition::TRANSITION_ON_ERROR_ERROR, State::PRIMARY_STATE_FINALIZED);

    // The transitions of one state must be adjacent; a state's transitions keep that order.
    by_state = transitions;
    std::stable_sort(by_state.begin(), by_state.end(), [](const auto& a, const auto& b) { return a.start < b.start; });
    for (rcl_lifecycle_state_t& state : states) {
      const auto starts_here = [&](const auto& transition) { return transition.start == &state; };
      const auto first = std::find_if(by_state.begin(), by_state.end(), starts_here);
      const auto count = std::count_if(by_state.begin(), by_state.end(), starts_here);
      state.valid_transitions = count == 0 ? nullptr : &*first;
      state.valid_transition_size = static_cast<unsigned int>(count);
    }
  }

  void add(unsigned int start, const char* label, unsigned int id, unsigned int goal) {
    transitions.at(size++) = {label, id, find(start), find(goal)};
  }

  const rcl_lifecycle_state_t* find(unsigned int id) const {
    const auto found = std::find_if(states.begin(), states.end(), [&](const auto& state) { return state.id == id; });
    return found == states.end() ? nullptr : &*found;
  }

  std::array<rcl_lifecycle_state_t, 11> states = {{
      {"unknown", State::PRIMARY_STATE_UNKNOWN, nullptr, 0},
      {"unconfigured", State::PRIMARY_STATE_UNCONFIGURED, nullptr, 0},
      {"inactive", State::PRIMARY_STATE_INACTIVE, nullptr, 0},
      {"active", State::PRIMARY_STATE_ACTIVE, nullptr, 0},
      {"finalized", State::PRIMARY_STATE_FINALIZED, nullptr, 0},
      {"configuring", State::TRANSITION_STATE_CONFIGURING, nullptr, 0},
      {"cleaningup", State::TRANSITION_STATE_CLEANINGUP, nullptr, 0},
      {"shuttingdown", State::TRANSITION_STATE_SHUTTINGDOWN, nullptr, 0},
      {"activating", State::TRANSITION_STATE_ACTIVATING, nullptr, 0},
      {"deactivating", State::TRANSITION_STATE_DEACTIVATING, nullptr, 0},
      {"errorprocessing", State::TRANSITION_STATE_ERRORPROCESSING, nullptr, 0},
  }};
  std::array<rcl_lifecycle_transition_t, 25> transitions{};
  std::array<rcl_lifecycle_transition_t, 25> by_state{};
  unsigned int size = 0;
};

const DefaultMap& default_map() {
  static const DefaultMap map;
  return map;
}

}  // namespace

rcl_lifecycle_transition_map_t rcl_lifecycle_get_default_transition_map(void) {
  const DefaultMap& map = default_map();
  return {map.states.data(), static_cast<unsigned int>(map.states.size()), map.transitions.data(), map.size};
}

const rcl_lifecycle_state_t* rcl_lifecycle_get_state(const rcl_lifecycle_transition_map_t* transition_map,
                                                     unsigned int state_id) {
  const rcl_lifecycle_state_t* end = transition_map->states + transition_map->states_size;
  const rcl_lifecycle_state_t* found =
      std::find_if(transition_map->states, end, [&](const auto& state) { return state.id == state_id; });
  return found == end ? nullptr : found;
}
