// SPDX-License-Identifier: Apache-2.0
// <node>, <lifecycle_node> and <node_container> run ROS nodes, <load_composable_node> and <lifecycle_transition> ask
// nodes that run.
#include "actions/process/machine_settings.hpp"
#include "actions/ros/composable_nodes.hpp"
#include "actions/ros/node_process.hpp"
#include "actions/row_action.hpp"
#include "actions/values/ros_names.hpp"

namespace launch {

namespace {

// Runs a node. As its tag has it, a container loads its components, and a managed node is made active.
class Node : public Action {
 public:
  explicit Node(const Fields& fields)
      : Action(fields.where(), fields.condition()),
        fields_(fields),
        node_(fields),
        components_(fields),
        autostart_(fields.boolean("autostart", false)) {}

 protected:
  void execute(LaunchContext& context) const override {
    const AtMachine there(
        context, machine_of_process(fields_, context, [this](Scope& scope) { return node_.assignable(scope); }));
    const bool autostart = autostart_.perform(context.scope());
    const std::string name = node_.request(context);
    Requests& requests = context.requests();
    const Environment environment = graph_environment(context.scope(), requests.processes.back().environment);
    if (autostart) {
      requests.transitions.push_back({name, {"configure", "activate"}, true, environment, where()});
    }
    if (!components_.empty()) {
      components_.request(context, name, environment, where());
    }
  }

 private:
  Fields fields_;
  NodeProcess node_;
  ComposableNodes components_;
  BooleanField autostart_;
};

ActionPtr make_node(const Fields& fields) {
  return std::make_shared<Node>(fields);
}

class LoadComposableNodes : public Action {
 public:
  explicit LoadComposableNodes(const Fields& fields)
      : Action(fields.where(), fields.condition()), target_(fields.text("target")), nodes_(fields) {
    if (nodes_.empty()) {
      throw LaunchError("load_composable_node needs a composable_node", fields.where(),
                        "write <composable_node pkg=\"…\" plugin=\"…\" name=\"…\"/> inside",
                        Finding::kMissingAttribute);
    }
  }

 protected:
  void execute(LaunchContext& context) const override {
    Scope& scope = context.scope();
    nodes_.request(context, target_.perform(scope), graph_environment(scope, scope.environment), where());
  }

 private:
  Template target_;
  ComposableNodes nodes_;
};

void perform_transitions(const Fields& fields, Scope& scope, TransitionRequest& request) {
  for (const Template& word : fields.words("transitions")) {
    request.transitions.push_back(word.perform(scope));
    require_transition(request.transitions.back(), word.where());
  }
}

}  // namespace

ActionType node_action() {
  return {.tag = "node",
          .help = "Runs a ROS node.",
          .attributes = NodeProcess::attributes(false),
          .items = NodeProcess::items(),
          .make = make_node};
}

ActionType lifecycle_node_action() {
  std::vector<AttributeSpec> attributes = NodeProcess::attributes(true);
  attributes.push_back({"autostart", AttributeType::kBoolean, false, "false", "configure and activate the node"});
  return {.tag = "lifecycle_node",
          .help = "Runs a ROS node with a managed life cycle.",
          .attributes = std::move(attributes),
          .items = NodeProcess::items(),
          .make = make_node};
}

ActionType node_container_action() {
  std::vector<ItemSpec> items = NodeProcess::items();
  for (ItemSpec& item : ComposableNodes::items()) {
    items.push_back(std::move(item));
  }
  return {.tag = "node_container",
          .help = "Runs a component container and loads nodes into it.",
          .attributes = NodeProcess::attributes(true),
          .items = std::move(items),
          .make = make_node};
}

ActionType load_composable_node_action() {
  return {.tag = "load_composable_node",
          .help = "Loads nodes into a component container that runs already.",
          .attributes = {{"target", AttributeType::kText, true, "",
                          "node name of the container; the scope's namespace is not put before it"}},
          .items = ComposableNodes::items(),
          .make = [](const Fields& fields) { return std::make_shared<LoadComposableNodes>(fields); }};
}

ActionType lifecycle_transition_action() {
  return action_of<TransitionRequest>(
      {.tag = "lifecycle_transition",
       .help = "Changes the state of a node with a managed life cycle, one transition after another until one fails.",
       .extension = true},
      {{.attribute = {"node", AttributeType::kText, true, "",
                      "the node; a relative name is below the namespace of the scope"},
        .perform = [](const Fields& fields, Scope& scope,
                      TransitionRequest& request) { request.node = resolve_name(fields.text("node"), scope); }},
       {.attribute = {"transitions", AttributeType::kCommandLine, true, "",
                      "configure, activate, deactivate, cleanup, shutdown, separated by spaces"},
        .perform = perform_transitions}},
      [](const Fields& fields, LaunchContext& context, TransitionRequest& request) {
        request.environment = graph_environment(context.scope(), context.scope().environment);
        request.origin = fields.where();
        context.requests().transitions.push_back(std::move(request));
      },
      [](const Fields& fields) {
        if (fields.words("transitions").empty()) {
          throw LaunchError("transitions names none", fields.where("transitions"),
                            "configure, activate, deactivate, cleanup or shutdown, separated by spaces");
        }
      });
}

}  // namespace launch
