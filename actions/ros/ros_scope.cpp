// SPDX-License-Identifier: Apache-2.0
// <push_ros_namespace>, <set_parameter>, <set_parameters_from_file>, <set_remap>, <set_ros_log_dir> and
// <set_use_sim_time>: what later nodes of the scope get.
#include <fmt/format.h>

#include <filesystem>

#include "actions/ros/node_process.hpp"
#include "actions/row_action.hpp"
#include "actions/values/ros_names.hpp"
#include "base/environment/home_directory.hpp"
#include "launcher/language/parameter_value.hpp"
#include "launcher/substitution/boolean.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

namespace {

ActionType push_ros_namespace(std::string tag, std::string help) {
  return action_of<NoValues>({.tag = std::move(tag),
                              .help = std::move(help),
                              .attributes = {{"namespace", AttributeType::kText, true, "",
                                              "below the scope's namespace unless it starts with '/'"}}},
                             {}, [](const Fields& fields, LaunchContext& context, NoValues&) {
                               push_namespace(fields.text("namespace"), context.scope());
                             });
}

struct NewLogDirectory {
  std::string path = {};
};

struct SimulatedTime {
  bool is_used = false;
};

// A text is performed and then typed, unlike that of a `param`. YAML may have a number, a boolean or a list, too.
void perform_parameter(const Fields& fields, Scope& scope, NamedParameter& parameter) {
  const Value& value = fields.value("value");
  const Scalar* const scalar = value.scalar();
  if (scalar != nullptr &&
      (scalar->made != nullptr || scalar->type == Scalar::Type::kUntyped || scalar->type == Scalar::Type::kString)) {
    const Template text = scalar->made != nullptr ? *scalar->made : parse_template(scalar->text);
    parameter.value = typed_parameter(text.perform(scope), value.where);
  } else {
    parameter.value = ParameterValueSource(value, "", std::nullopt, value.where).perform(scope);
  }
}

// What can be told of the value before it is performed.
void check_parameter(const Fields& fields) {
  const Value& value = fields.value("value");
  const Scalar* const scalar = value.scalar();
  if (scalar == nullptr || (scalar->made == nullptr && scalar->type != Scalar::Type::kUntyped)) {
    ParameterValueSource(value, "", std::nullopt, value.where);
  } else if (scalar->made == nullptr) {
    parse_template(scalar->text);
  }
}

void perform_simulated_time(const Fields& fields, Scope& scope, SimulatedTime& time) {
  const std::string text = fields.text("value").perform(scope);
  const std::optional<bool> value = yaml_boolean(text);
  if (!value) {
    throw LaunchError(fmt::format("expected a boolean, got '{}'", text), fields.text("value").where(),
                      "write true or false");
  }
  time.is_used = *value;
}

}  // namespace

ActionType push_ros_namespace_action() {
  return push_ros_namespace("push_ros_namespace", "Puts every later node of the scope below a namespace.");
}

ActionType push_ros_namespace_alias_action() {
  return push_ros_namespace("push-ros-namespace", "The older name of push_ros_namespace.");
}

ActionType set_parameter_action() {
  return action_of<NamedParameter>(
      {.tag = "set_parameter", .help = "Gives every later node of the scope a parameter."},
      {{.attribute = {"name", AttributeType::kText, true, "", "name of the parameter"},
        .place = place_of(&NamedParameter::name)},
       {.attribute = {"value", AttributeType::kParameter, true, "", "its value, typed by YAML 1.1 rules"},
        .perform = perform_parameter}},
      [](const Fields&, LaunchContext& context, NamedParameter& parameter) {
        context.scope().global_parameters.emplace_back(std::move(parameter));
      },
      check_parameter);
}

ActionType set_parameters_from_file_action() {
  return action_of<ParameterFilePath>(
      {.tag = "set_parameters_from_file", .help = "Gives every later node of the scope a parameter file."},
      {{.attribute = {"filename", AttributeType::kText, true, "",
                      "path of the file; relative to the launcher's working directory"},
        .place = place_of(&ParameterFilePath::path)}},
      [](const Fields& fields, LaunchContext& context, ParameterFilePath& file) {
        // A missing file is an error only when a node gets it.
        const std::filesystem::path path = file.path.empty() ? "" : std::filesystem::absolute(file.path);
        context.scope().global_parameters.push_back(
            ParameterFilePath{path.lexically_normal().string(), fields.text("filename").where()});
      });
}

ActionType set_remap_action() {
  return action_of<NoValues>(
      {.tag = "set_remap",
       .help = "Renames a topic, a service or an action for every later node of the scope. It wins over a node's own "
               "remap.",
       .attributes = {{"from", AttributeType::kText, true, "", "the name in the programs"},
                      {"to", AttributeType::kText, true, "", "the name to use"}}},
      {}, [](const Fields& fields, LaunchContext& context, NoValues&) {
        context.scope().global_remaps.push_back(perform_remap(fields, context));
      });
}

ActionType set_ros_log_dir_action() {
  return action_of<NewLogDirectory>(
      {.tag = "set_ros_log_dir", .help = "Sets where later nodes write their log files (ROS_LOG_DIR)."},
      {{.attribute = {"new_log_dir", AttributeType::kText, true, "", "the directory; relative to the current one"},
        .place = place_of(&NewLogDirectory::path)}},
      [](const Fields&, LaunchContext& context, NewLogDirectory& directory) {
        Environment& environment = context.scope().environment;
        const auto joined = std::filesystem::path(ros_log_directory(environment)) / directory.path;
        environment.insert_or_assign("ROS_LOG_DIR", joined.string());
      });
}

ActionType set_use_sim_time_action() {
  return action_of<SimulatedTime>(
      {.tag = "set_use_sim_time",
       .help = "Has no effect, and warns if true: this launcher counts system time. Launched nodes are not concerned."},
      {{.attribute = {"value", AttributeType::kText, true, "", "true or false"}, .perform = perform_simulated_time}},
      [](const Fields& fields, LaunchContext& context, SimulatedTime& time) {
        if (time.is_used) {
          context.scope().warn(fields.text("value").where(),
                               "set_use_sim_time has no effect: ros_timer counts system time. For nodes, use "
                               "set_parameter with use_sim_time");
        }
      });
}

}  // namespace launch
