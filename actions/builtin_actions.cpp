#include "actions/builtin_actions.hpp"

namespace launch {

// The list. Each name stands for a function NAME_action() that returns the declaration, in the file of its tag or family.
#define LAUNCH_BUILTIN_ACTIONS(ACTION) \
  ACTION(arg)                          \
  ACTION(executable)                   \
  ACTION(group)                        \
  ACTION(include)                      \
  ACTION(let)                          \
  ACTION(log)                          \
  ACTION(node)                         \
  ACTION(set_env)                      \
  ACTION(shutdown)                     \
  ACTION(timer)                        \
  ACTION(trace)                        \
  ACTION(unset_env)

#define LAUNCH_DECLARE_ACTION(name) ActionType name##_action();
LAUNCH_BUILTIN_ACTIONS(LAUNCH_DECLARE_ACTION)

Registry builtin_actions() {
  Registry registry;
#define LAUNCH_ADD_ACTION(name) registry.add(name##_action());
  LAUNCH_BUILTIN_ACTIONS(LAUNCH_ADD_ACTION)
  return registry;
}

}  // namespace launch
