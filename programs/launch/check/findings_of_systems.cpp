// SPDX-License-Identifier: Apache-2.0
// Findings of what a launch needs, of its nodes, arguments and traces: LF03xx to LF06xx.
#include "programs/launch/check/finding_table.hpp"

namespace launch {

namespace {

constexpr FindingInfo kRowsOfSystems[] = {
    {Finding::kMissingPackage, "Package not found", Severity::kError,
     "No prefix of AMENT_PREFIX_PATH and no prefix of the launcher has the package. A workspace must be built, and its "
     "setup file sourced, before its packages are found.",
     R"x(<launch>
  <node pkg="demo_nods" exec="talker"/>
</launch>
)x"},
    {Finding::kMissingProgram, "Program not found", Severity::kError,
     "The package has no executable of this name, or the program is not on the PATH, or it may not be executed.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talkr"/>
</launch>
)x"},
    {Finding::kMissingFile, "File not found", Severity::kError,
     "A file whose content is asked for with $(file-content) does not exist.",
     R"x(<launch>
  <log message="$(file-content /no/such/file)"/>
</launch>
)x"},
    {Finding::kMissingParameterFile, "Parameter file not found", Severity::kError,
     "A parameter file does not exist. A node would start without these parameters; a component would not be loaded. A "
     "relative path is relative to the working directory of the launcher.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker">
    <param from="$(dirname)/no_such_file.yaml"/>
  </node>
</launch>
)x"},

    {Finding::kWrongParameterFile, "Wrong parameter file", Severity::kError,
     "A parameter file is no YAML, or it is not made of names of nodes, each with a mapping ros__parameters; or a "
     "value "
     "in it can't be that of a parameter: a list of several types or of lists, nothing, an alias, a text that does not "
     "fit its tag. The node ends when it reads such a file.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker">
    <param from="$(dirname)/params.yaml"/>
  </node>
</launch>
)x",
     R"x(/talker:
  ros__paramters:
    rate: 10.0
)x"},
    {Finding::kMissingPlugin, "Plugin not found", Severity::kError,
     "A container can't load the component: no component of the package is installed, none of its libraries has a "
     "plugin of this name, or the library does not exist.",
     R"x(<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="parts" namespace="">
    <composable_node pkg="composition" plugin="composition::Talkr" name="talker"/>
  </node_container>
</launch>
)x"},
    {Finding::kMissingDirectory, "Working directory not found", Severity::kError,
     "The working directory of a process does not exist, so the process can't be started.",
     R"x(<launch>
  <executable cmd="true" cwd="/no/such/directory"/>
</launch>
)x"},
    {Finding::kMissingCpu, "CPU that this machine lacks", Severity::kError,
     "A process may run on certain CPUs only, and this machine has none of them. If it has some of them, this is a "
     "warning, and so are CPUs that the cpuset or the affinity of the launcher leaves out.",
     R"x(<launch>
  <executable cmd="true" cpus="1000"/>
</launch>
)x"},
    {Finding::kUnmatchedParameterFile, "Parameter file without a section for the node", Severity::kWarning,
     "A parameter file is given to a node, and none of its sections is for the full name of the node, after namespaces "
     "and remaps. The node starts without these parameters, and says nothing. A section is for one full name, /NODE or "
     "/NAMESPACE/NODE; * stands for one part of a name, ** for any number, so /** is for every node and /**/NODE for a "
     "node in any namespace. A file that is set for a scope needs a section for one of its nodes. Where the launch "
     "file "
     "leaves the namespace to the program, it is taken for /.",
     R"x(<launch>
  <push_ros_namespace namespace="robot1"/>
  <node pkg="demo_nodes" exec="talker" name="mouth">
    <param from="$(dirname)/params.yaml"/>
  </node>
</launch>
)x",
     R"x(mouth:
  ros__parameters:
    rate: 10.0
)x"},
    {Finding::kRepeatedParameter, "Parameter given twice", Severity::kWarning,
     "A parameter file gives one parameter of a node two values. The last one counts.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker">
    <param from="$(dirname)/params.yaml"/>
  </node>
</launch>
)x",
     R"x(/**:
  ros__parameters:
    rate: 10.0
    rate: 20.0
)x"},
    {Finding::kOtherInRos2, "ROS 2 reads this value in another way", Severity::kWarning,
     "ROS 2 reads the parameter file of a component with another parser than that of a node, so one file gives "
     "them different types: 5e-06, 1e3, nan, inf, y, 1_000, 1:30, dates. This launcher gives a component what a node "
     "would get. It is a finding with --strict-ros2 only, for launch files that both must read.",
     R"x(<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="parts" namespace="">
    <composable_node pkg="composition" plugin="composition::Talker" name="talker">
      <param from="$(dirname)/params.yaml"/>
    </composable_node>
  </node_container>
</launch>
)x",
     R"x(/**:
  ros__parameters:
    rate: 5e-06
)x"},

    {Finding::kInvalidName, "Invalid name of a node or namespace", Severity::kError,
     "The parts of a name are letters, digits and underscores, and do not start with a digit. The name of a node has "
     "no "
     "slash; its namespace has an attribute of its own.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker" name="left/talker"/>
</launch>
)x"},
    {Finding::kInvalidRemap, "Invalid remap", Severity::kError,
     "A node can't read the remap and ends. Both names are parts of letters, digits and underscores with single "
     "slashes "
     "between them; they may begin with / or ~/.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker">
    <remap from="chatter" to="left chatter"/>
  </node>
</launch>
)x"},
    {Finding::kUselessRemap, "Remap without effect", Severity::kWarning,
     "A remap renames something to the name that it has, or it is for a node of another name. A launch file does not "
     "tell which topics a program has, but a recorded run does: with launch check --from-trace DIR, this is also a "
     "remap "
     "of a name that the recorded node does not have.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker" name="talker">
    <remap from="chatter" to="chatter"/>
  </node>
</launch>
)x"},
    {Finding::kSameNode, "Several nodes of one name", Severity::kWarning,
     "Nodes of one name in one namespace can't be told apart: parameters, services and commands reach any of them.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker" name="mouth"/>
  <node pkg="demo_nodes" exec="talker" name="mouth"/>
</launch>
)x"},

    {Finding::kMissingContainer, "No such container", Severity::kWarning,
     "Components are loaded into a container that this launch does not start. They are loaded when another launch "
     "starts "
     "a container of this name.",
     R"x(<launch>
  <load_composable_node target="/parts">
    <composable_node pkg="composition" plugin="composition::Talker" name="talker"/>
  </load_composable_node>
</launch>
)x"},

    {Finding::kUnknownParameter, "Node without this parameter", Severity::kWarning,
     "The node did not have the parameter when its parameters were dumped (launch param dump NODE), so the value has "
     "no "
     "effect. A launch file does not tell which parameters a program declares, and a trace does not either: this is a "
     "finding with launch check --from-parameters FILE only, with such a dump below.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker" name="talker">
    <param name="raet" value="10"/>
  </node>
</launch>
)x",
     R"x(/talker:
  ros__parameters:
    rate: 5
    use_sim_time: false
)x"},

    {Finding::kUnreadArgument, "Argument is never read", Severity::kWarning,
     "No substitution reads the argument, neither in its file nor in the files that are included.",
     R"x(<launch>
  <arg name="rate" default="10"/>
</launch>
)x"},
    {Finding::kUnknownArgument, "Argument that nothing declares", Severity::kWarning,
     "An argument is given on the command line or by an include, and no launch file declares or reads it. Or it is "
     "given twice on the command line.",
     R"x(<launch>
  <arg name="rate" default="10"/>
  <log message="$(var rate)"/>
</launch>
)x"},
    {Finding::kNotGiven, "Argument without a default is not given", Severity::kWarning,
     "What depends on the value of this argument was not checked. Give it to the check as to a run: launch check FILE "
     "NAME:=VALUE.",
     R"x(<launch>
  <arg name="robot"/>
  <log message="$(var robot)"/>
</launch>
)x"},
    {Finding::kIgnoredDefault, "Default without effect", Severity::kWarning,
     "A file that was included before has an argument of this name, too, and its default was taken. An include is no "
     "scope, so the argument keeps that value here, and this default has no effect. That the default of a file which "
     "includes this one holds here is no finding, nor is a file that holds arguments alone: it is there to set them.",
     R"x(<launch>
  <include file="$(dirname)/params.yaml"/>
  <arg name="rate" default="2"/>
  <log message="$(var rate)"/>
</launch>
)x",
     R"x(launch:
- arg: {name: rate, default: "1"}
- log: {message: "rate $(var rate)"}
)x"},

    {Finding::kUnknownContextField, "Unknown context field", Severity::kError,
     "LTTng has no context field of this name, so the trace can't begin. lttng-add-context(1) lists the fields.",
     R"x(<launch>
  <trace session-name="run" context-fields="vpid vtdi"/>
</launch>
)x"},
    {Finding::kUnknownEvent, "Unknown event", Severity::kWarning,
     "No event of ROS 2 has this name, so nothing of it will be recorded. The names have their provider in front: "
     "ros2:callback_start. Events of other providers are not judged.",
     R"x(<launch>
  <trace session-name="run" events-ust="ros2:callback_strat"/>
</launch>
)x"},
    {Finding::kSameSession, "Several traces of one session", Severity::kError,
     "Each trace needs a session name of its own. The second one can't begin.",
     R"x(<launch>
  <trace session-name="run"/>
  <trace session-name="run" events-ust="ros2:rcl_init"/>
</launch>
)x"},
    {Finding::kUnknownChainNode, "Chain passes a node that is not there", Severity::kWarning,
     "The report will not find the chain, because no node of the launch has this name. Names are fully qualified, and "
     "* "
     "matches any text. Where a program gives its node a name by itself, only names that are nearly those of other "
     "nodes "
     "are found.",
     R"x(<launch>
  <trace session-name="run">
    <chain name="hello" nodes="/talker /listner"/>
  </trace>
  <node pkg="demo_nodes" exec="talker" name="talker"/>
  <node pkg="demo_nodes" exec="talker" name="listener"/>
</launch>
)x"},
};

}  // namespace

std::span<const FindingInfo> findings_of_systems() {
  return kRowsOfSystems;
}

}  // namespace launch
