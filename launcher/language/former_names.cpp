// SPDX-License-Identifier: Apache-2.0
#include "launcher/language/former_names.hpp"

namespace launch {

namespace {

struct FormerTag {
  std::string_view tag;
  std::string_view help;
};

constexpr FormerTag kFormerTags[] = {
    {"declare_argument", "in XML and YAML it is 'arg'"},
    {"declare_launch_argument", "in XML and YAML it is 'arg'"},
    {"env", "an action that sets a variable is 'set_env'; 'env' stands inside of a node or an executable"},
    {"param",
     "an action that gives all nodes of the scope a parameter is 'set_parameter'; 'param' stands inside of a node"},
    {"pop_ros_namespace", "a namespace ends with the group that it was pushed in"},
    {"pop-ros-namespace", "a namespace ends with the group that it was pushed in"},
    {"remap", "an action that renames for all nodes of the scope is 'set_remap'; 'remap' stands inside of a node"},
    {"rosparam", "write <param from=\"FILE\"/> inside of a node, or 'set_parameters_from_file'"},
    {"test", "tests are programs of their own in ROS 2"},
};

struct FormerAttribute {
  std::string_view tag;  // empty: any
  std::string_view attribute;
  std::string_view help;
};

constexpr FormerAttribute kFormerAttributes[] = {
    {"arg", "value", "'arg' declares an argument; for a constant write 'let'"},
    {"arg", "doc", "it is 'description' in ROS 2"},
    {"arg", "desc", "it is 'description'"},
    {"arg", "default_value", "that is its name in Python; here it is 'default'"},
    {"", "package", "that is its name in Python; did you mean 'pkg'?"},
    {"", "executable", "that is its name in Python; did you mean 'exec'?"},
    {"", "arguments", "that is its name in Python; did you mean 'args'?"},
    {"", "ros_arguments", "that is its name in Python; did you mean 'ros_args'?"},
    {"", "prefix", "that is its name in Python; did you mean 'launch-prefix'?"},
    {"", "target_container", "that is its name in Python; did you mean 'target'?"},
    {"", "msg", "that is its name in Python; did you mean 'message'?"},
    {"", "machine", "it is an attribute of processes, 'group' and 'include'"},
    {"", "clear_params", "parameters belong to nodes in ROS 2, nothing is left of earlier runs"},
    {"", "pass_all_args", "an include sees all configurations in ROS 2, too"},
    {"", "node-name", "it is 'name'"},
    {"node", "type", "it is 'exec' in ROS 2"},
    {"node", "ns", "it is 'namespace' in ROS 2"},
    {"group", "namespace", "it is 'ns' here, and not known to ros2 launch; or write 'push_ros_namespace' inside"},
    {"include", "namespace",
     "it is 'ns' here, and not known to ros2 launch; or write it in a group with 'push_ros_namespace'"},
    {"param", "command", "write value=\"$(command '...')\""},
    {"param", "textfile", "write value=\"$(file-content PATH)\""},
    {"param", "if", "put the condition on the node, or choose the value: $(if CONDITION THEN ELSE)"},
    {"remap", "if", "put the condition on the node, or on a 'set_remap' in a group"},
};

}  // namespace

std::string help_for_former_tag(std::string_view tag) {
  for (const FormerTag& former : kFormerTags) {
    if (former.tag == tag) {
      return std::string(former.help);
    }
  }
  return {};
}

std::string help_for_former_attribute(std::string_view tag, std::string_view attribute) {
  if (attribute == "unless") {
    attribute = "if";
  }
  for (const FormerAttribute& former : kFormerAttributes) {
    if ((former.tag.empty() || former.tag == tag) && former.attribute == attribute) {
      return std::string(former.help);
    }
  }
  return {};
}

}  // namespace launch
