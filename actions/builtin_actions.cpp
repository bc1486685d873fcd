// SPDX-License-Identifier: Apache-2.0
#include "actions/builtin_actions.hpp"

#include "launcher/python/python_launch_file.hpp"

namespace launch {

// The list of all actions. For each NAME there is a function NAME_action() that returns the declaration, in the file of
// its tag or family.
#define LAUNCH_BUILTIN_ACTIONS(ACTION) \
  ACTION(append_env)                   \
  ACTION(arg)                          \
  ACTION(assign_machine)               \
  ACTION(bool_arg)                     \
  ACTION(call)                         \
  ACTION(change_parameter)             \
  ACTION(clock)                        \
  ACTION(executable)                   \
  ACTION(fault)                        \
  ACTION(for)                          \
  ACTION(for_each)                     \
  ACTION(group)                        \
  ACTION(include)                      \
  ACTION(let)                          \
  ACTION(lifecycle_node)               \
  ACTION(lifecycle_transition)         \
  ACTION(load_composable_node)         \
  ACTION(log)                          \
  ACTION(log_debug)                    \
  ACTION(log_error)                    \
  ACTION(log_info)                     \
  ACTION(log_warning)                  \
  ACTION(machine)                      \
  ACTION(node)                         \
  ACTION(node_container)               \
  ACTION(on_health_change)             \
  ACTION(on_late)                      \
  ACTION(on_loss)                      \
  ACTION(on_machine_back)              \
  ACTION(on_machine_lost)              \
  ACTION(on_memory)                    \
  ACTION(on_overload)                  \
  ACTION(on_process_exit)              \
  ACTION(on_process_io)                \
  ACTION(on_process_start)             \
  ACTION(on_rate)                      \
  ACTION(on_shutdown)                  \
  ACTION(on_silence)                   \
  ACTION(on_start_limit)               \
  ACTION(on_state_transition)          \
  ACTION(publish)                      \
  ACTION(push_ros_namespace)           \
  ACTION(push_ros_namespace_alias)     \
  ACTION(receive)                      \
  ACTION(rep_env)                      \
  ACTION(reset)                        \
  ACTION(reset_env)                    \
  ACTION(restart)                      \
  ACTION(restore_priority)             \
  ACTION(ros_timer)                    \
  ACTION(send_goal)                    \
  ACTION(set_env)                      \
  ACTION(set_parameter)                \
  ACTION(set_parameters_from_file)     \
  ACTION(set_priority)                 \
  ACTION(set_remap)                    \
  ACTION(set_ros_log_dir)              \
  ACTION(set_use_sim_time)             \
  ACTION(shutdown)                     \
  ACTION(signal)                       \
  ACTION(stop)                         \
  ACTION(test)                         \
  ACTION(timer)                        \
  ACTION(trace)                        \
  ACTION(transition)                   \
  ACTION(unregister_event_handler)     \
  ACTION(unset)                        \
  ACTION(unset_env)                    \
  ACTION(wait_for)

#define LAUNCH_DECLARE_ACTION(name) ActionType name##_action();
LAUNCH_BUILTIN_ACTIONS(LAUNCH_DECLARE_ACTION)

Registry builtin_actions() {
  Registry registry;
#define LAUNCH_ADD_ACTION(name) registry.add(name##_action());
  LAUNCH_BUILTIN_ACTIONS(LAUNCH_ADD_ACTION)
  registry.add_loader(".py", load_python_launch_file);
  registry.use_foreign_actions(exposed_actions());
  use_foreign_substitutions(exposed_substitutions());
  return registry;
}

}  // namespace launch
