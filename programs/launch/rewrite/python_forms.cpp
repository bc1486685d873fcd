// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/rewrite/python_forms.hpp"

namespace launch {

namespace {

using Arguments = std::vector<PythonArgument>;

Arguments joined(Arguments first, const Arguments& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

const std::map<std::string_view, PythonForm>& python_forms() {
  using enum PythonKind;
  static const std::string_view actions = "launch.actions";
  static const std::string_view ros_actions = "launch_ros.actions";
  static const Arguments process = {{"cwd", "cwd"},
                                    {"launch-prefix", "prefix"},
                                    {"output", "output"},
                                    {"respawn", "respawn", kBool},
                                    {"respawn_delay", "respawn_delay", kNumber},
                                    {"respawn_max_retries", "respawn_max_retries", kNumber},
                                    {"shell", "shell", kBool},
                                    {"emulate_tty", "emulate_tty", kBool},
                                    {"sigterm_timeout", "sigterm_timeout", kNumber},
                                    {"sigkill_timeout", "sigkill_timeout", kNumber}};
  static const Arguments node = joined({{"pkg", "package"},
                                        {"exec", "executable"},
                                        {"name", "name"},
                                        {"namespace", "namespace"},
                                        {"exec_name", "exec_name"},
                                        {"args", "arguments", kWords},
                                        {"ros_args", "ros_arguments", kWords}},
                                       process);
  static const Arguments composable = {
      {"pkg", "package"}, {"plugin", "plugin"}, {"name", "name"}, {"namespace", "namespace"}};
  static const Arguments pair = {{"name", "name"}, {"value", "value"}};
  static const std::map<std::string_view, PythonForm> forms = {
      {"append_env",
       {actions,
        "AppendEnvironmentVariable",
        {{"name", "name"}, {"value", "value"}, {"prepend", "prepend", kBool}, {"separator", "separator"}}}},
      {"arg",
       {actions,
        "DeclareLaunchArgument",
        {{"name", "name", kLiteral}, {"default", "default_value"}, {"description", "description", kLiteral}}}},
      {"composable_node", {"launch_ros.descriptions", "ComposableNode", composable}},
      {"executable", {actions, "ExecuteProcess", joined({{"cmd", "cmd", kWords}, {"name", "name"}}, process)}},
      {"group", {actions, "GroupAction", {{"scoped", "scoped", kBool}, {"forwarding", "forwarding", kBool}}}},
      {"include", {actions, "IncludeLaunchDescription", {}}},
      {"let", {actions, "SetLaunchConfiguration", pair}},
      {"lifecycle_node", {ros_actions, "LifecycleNode", joined(node, {{"autostart", "autostart", kBool}})}},
      {"load_composable_node", {ros_actions, "LoadComposableNodes", {{"target", "target_container"}}}},
      {"log", {actions, "Log", {{"message", "msg"}, {"level", "level"}}}},
      {"log_debug", {actions, "LogDebug", {{"message", "msg"}}}},
      {"log_error", {actions, "LogError", {{"message", "msg"}}}},
      {"log_info", {actions, "LogInfo", {{"message", "msg"}}}},
      {"log_warning", {actions, "LogWarning", {{"message", "msg"}}}},
      {"node", {ros_actions, "Node", node}},
      {"node_container", {ros_actions, "ComposableNodeContainer", node}},
      {"push-ros-namespace", {ros_actions, "PushROSNamespace", {{"namespace", "namespace"}}}},
      {"push_ros_namespace", {ros_actions, "PushROSNamespace", {{"namespace", "namespace"}}}},
      {"set_env", {actions, "SetEnvironmentVariable", pair}},
      {"set_parameter", {ros_actions, "SetParameter", {{"name", "name"}, {"value", "value", kTyped}}}},
      {"set_parameters_from_file", {ros_actions, "SetParametersFromFile", {{"filename", "filename"}}}},
      {"set_remap", {ros_actions, "SetRemap", {{"from", "src"}, {"to", "dst"}}}},
      {"set_use_sim_time", {ros_actions, "SetUseSimTime", {{"value", "value", kBool}}}},
      {"shutdown", {actions, "Shutdown", {{"reason", "reason"}}}},
      {"timer", {actions, "TimerAction", {{"period", "period", kNumber}}}},
      {"trace",
       {"tracetools_launch.action",
        "Trace",
        {{"session-name", "session_name"},
         {"append-timestamp", "append_timestamp", kBool},
         {"base-path", "base_path"},
         {"append-trace", "append_trace", kBool},
         {"events-ust", "events_ust", kWords},
         {"events-kernel", "events_kernel", kWords},
         {"syscalls", "syscalls", kWords},
         {"context-fields", "context_fields", kWords},
         {"subbuffer-size-ust", "subbuffer_size_ust", kNumber},
         {"subbuffer-size-kernel", "subbuffer_size_kernel", kNumber},
         {"snapshot-mode", "snapshot_mode", kBool},
         {"dual-session", "dual_session", kBool}}}},
      {"unset", {actions, "UnsetLaunchConfiguration", {{"name", "name"}}}},
      {"unset_env", {actions, "UnsetEnvironmentVariable", {{"name", "name"}}}},
  };
  return forms;
}

const std::map<std::string_view, PythonSubstitution>& python_substitutions() {
  static const std::string_view launch = "launch.substitutions";
  static const std::string_view ros = "launch_ros.substitutions";
  static const std::map<std::string_view, PythonSubstitution> substitutions = {
      {"and", {launch, "AndSubstitution", {"", ""}}},
      {"anon", {launch, "AnonName", {""}}},
      {"command", {launch, "Command", {"", "on_stderr"}}},
      {"dirname", {launch, "ThisLaunchFileDir", {}}},
      {"env", {launch, "EnvironmentVariable", {"", "default_value"}}},
      {"equals", {launch, "EqualsSubstitution", {"", ""}}},
      {"eval", {launch, "PythonExpression", {""}}},
      {"exec-in-pkg", {ros, "ExecutableInPackage", {"executable", "package"}}},
      {"file-content", {launch, "FileContent", {""}}},
      {"filename", {launch, "ThisLaunchFile", {}}},
      {"find-exec", {launch, "FindExecutable", {"name"}}},
      {"find-pkg-prefix", {ros, "FindPackagePrefix", {""}}},
      {"find-pkg-share", {ros, "FindPackageShare", {""}}},
      {"if", {launch, "IfElseSubstitution", {"", "if_value", "else_value"}}},
      {"launch_log_dir", {launch, "LaunchLogDir", {}}},
      {"log_dir", {launch, "LaunchLogDir", {}}},
      {"not", {launch, "NotSubstitution", {""}}},
      {"not-equals", {launch, "NotEqualsSubstitution", {"", ""}}},
      {"or", {launch, "OrSubstitution", {"", ""}}},
      {"param", {ros, "Parameter", {""}}},
      {"var", {launch, "LaunchConfiguration", {"", "default"}}},
  };
  return substitutions;
}

}  // namespace launch
