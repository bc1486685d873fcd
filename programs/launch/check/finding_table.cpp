// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/check/finding_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace launch {

namespace {

constexpr FindingInfo kTable[] = {
    {Finding::kUnreadableFile, "Launch file can't be read", Severity::kError,
     "The launch file, or a file that it includes, does not exist or may not be read. The check goes on behind the "
     "include. A relative path of an include is relative to the working directory of the launcher, not to the file.",
     R"x(<launch>
  <include file="$(dirname)/no_such_file.launch.xml"/>
</launch>
)x"},
    {Finding::kMalformedXml, "Malformed XML", Severity::kError,
     "The file is no XML, or its root is not launch. Nothing of the file is checked until it can be read.",
     R"x(<launch>
  <group>
</launch>
)x"},
    {Finding::kMalformedYaml, "Malformed YAML", Severity::kError,
     "The file is no YAML, or it is not a launch file: a mapping with the key launch, which has a list of actions. "
     "Nothing of the file is checked until it can be read.",
     R"x(launch:
- log: {message: "hello"
)x"},
    {Finding::kMalformedSubstitution, "Malformed substitution or command line", Severity::kError,
     "Brackets, quotes, spaces or the number of arguments of a substitution are wrong, or a quote of a command line is "
     "not closed. One space separates the arguments; an argument with spaces is quoted.",
     R"x(<launch>
  <log message="$(var a"/>
</launch>
)x"},
    {Finding::kPython, "Python launch file fails", Severity::kError,
     "The Python code of a launch file has a syntax error, raises an exception, or gives something that is no launch "
     "description.",
     R"x(from launch import LaunchDescription

def generate_launch_description():
    return LaunchDescription([Nod()])
)x"},

    {Finding::kUnknownName, "Unknown name", Severity::kError,
     "No action, attribute, item or substitution has this name. `launch reference` lists all of them.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker" nmae="talker"/>
</launch>
)x"},
    {Finding::kWrongPlace, "Wrong place", Severity::kError, "The name exists, but it can't stand inside this element.",
     R"x(<launch>
  <param name="rate" value="10"/>
</launch>
)x"},
    {Finding::kMissingAttribute, "Something required is missing", Severity::kError,
     "An attribute, an item or a value that the action needs is not given.",
     R"x(<launch>
  <let name="a"/>
</launch>
)x"},
    {Finding::kExclusive, "Two things exclude each other", Severity::kError,
     "The attributes are correct each by itself, but not together.",
     R"x(<launch>
  <log message="hello" if="true" unless="false"/>
</launch>
)x"},
    {Finding::kWrongType, "Wrong type", Severity::kError,
     "A value is not of the type that the attribute takes, such as a number or a boolean. In YAML a text that looks "
     "like a number or a boolean needs quotes.",
     R"x(launch:
- let: {name: a, value: 1}
)x"},
    {Finding::kWrongValue, "Value that is not allowed", Severity::kError,
     "The attribute takes only certain values, or values of a certain form. `launch reference` tells them.",
     R"x(<launch>
  <executable cmd="true" output="scren"/>
</launch>
)x"},
    {Finding::kExtension, "Not known to ros2 launch", Severity::kError,
     "The tag or attribute is an extension of this launcher. It is a finding with --strict-ros2 only.",
     R"x(<launch>
  <executable cmd="true" required="true"/>
</launch>
)x"},
    {Finding::kStrayText, "Text between elements", Severity::kWarning,
     "The elements of a launch file hold no text. ROS 2 and this launcher ignore it: what looks like a setting has no "
     "effect. Put it into an attribute, or into a comment.",
     R"x(<launch>
  <set_env name="LANG" value="C"/> only for the talker
</launch>
)x"},

    {Finding::kUndefined, "Nothing has this name", Severity::kError,
     "A configuration, an environment variable, a parameter or a loop variable that a substitution reads is not set "
     "where the substitution is performed. A default may be given: $(var NAME DEFAULT), $(env NAME DEFAULT).",
     R"x(<launch>
  <let name="rate" value="1"/>
  <log message="$(var rat)"/>
</launch>
)x"},
    {Finding::kArgument, "Argument missing or not allowed", Severity::kError,
     "An include does not give an argument that the included file needs, or the value of an argument is none of its "
     "choices.",
     R"x(<launch>
  <arg name="mode" default="fast">
    <choice value="slow"/>
    <choice value="safe"/>
  </arg>
  <log message="$(var mode)"/>
</launch>
)x"},
    {Finding::kExpression, "Expression or command that fails", Severity::kError,
     "An expression of $(eval) raises an exception, or the program of a $(command) does not exist. A check runs no "
     "command, "
     "so a command that ends with an error is found by a run only.",
     R"x(<launch>
  <log message="$(eval '1 / 0')"/>
</launch>
)x"},
    {Finding::kStartOrder, "No start order is possible", Severity::kError, "Processes wait for each other in a circle.",
     R"x(<launch>
  <executable cmd="true" name="a"><depends_on process="b"/></executable>
  <executable cmd="true" name="b"><depends_on process="a"/></executable>
</launch>
)x"},
    {Finding::kUnknownProcess, "No process has this name", Severity::kError,
     "A command, a start order or an event handler names a process that the launch does not have, or that several "
     "processes have. The names of a process are its label, the name of its node and the full name of its node. For an "
     "event handler it is a warning: the handler waits for something that never happens.",
     R"x(<launch>
  <executable cmd="sleep 1" name="server"/>
  <executable cmd="true"><depends_on process="sever"/></executable>
</launch>
)x"},
    {Finding::kEndless, "No end", Severity::kError,
     "A file includes itself, directly or through others, or actions hold each other without end.",
     R"x(<launch>
  <include file="$(filename)"/>
</launch>
)x"},
    {Finding::kRemark, "Something is suspicious", Severity::kWarning,
     "A run prints this warning, too: a loop has no turns, or a package has no share directory.",
     R"x(<launch>
  <for name="i" len="0"><log message="hello"/></for>
</launch>
)x"},
    {Finding::kOneWord, "Variable with blanks is one word", Severity::kWarning,
     "A command line (args, ros_args, cmd, and arguments in Python) is split into words before its variables are "
     "replaced, so a variable is never more than one word, whatever blanks it has. In ROS 1 it was split. Write the "
     "words into the command line, each with a variable of its own.",
     R"x(<launch>
  <arg name="pose" default="-x 0.0 -y 0.5"/>
  <node pkg="demo_nodes" exec="talker" args="--name robot $(var pose)"/>
</launch>
)x"},
    {Finding::kLeak, "Included file leaves something behind", Severity::kWarning,
     "An include is no scope: configurations, environment, namespace, parameters and remaps that the included file "
     "sets "
     "hold for everything behind it. This is a finding with --enable LF0209 only, because files that set things for "
     "others are usual. scoped=\"true\", or a group around the include, keeps it inside.",
     R"x(<launch>
  <arg name="inner" default="false"/>
  <include file="$(filename)" unless="$(var inner)">
    <arg name="inner" value="true"/>
  </include>
</launch>
)x"},
    {Finding::kLostBackslash, "Backslash that goes", Severity::kWarning,
     "The text of a parameter file with allow_substs is read as a substitution as a whole, and there a backslash "
     "stands "
     "for the character behind it: regular expressions and paths of Windows lose theirs. Write two backslashes for "
     "one.",
     R"x(<launch>
  <node pkg="demo_nodes" exec="talker">
    <param from="$(dirname)/params.yaml" allow_substs="true"/>
  </node>
</launch>
)x",
     R"x(/**:
  ros__parameters:
    digits: '^\d+$'
)x"},
    {Finding::kUselessSeparator, "value-sep that splits nothing", Severity::kWarning,
     "The text of a parameter does not hold its value-sep, so it is a list of one item. It is split before its "
     "variables are replaced: a variable is never split. Write a list, [$(var a), $(var b)].",
     R"x(<launch>
  <arg name="rates" default="1,2,3"/>
  <node pkg="demo_nodes" exec="talker">
    <param name="rates" value="$(var rates)" value-sep=","/>
  </node>
</launch>
)x"},

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
     "A container can't load the component: the package registers no components, none of its libraries has a plugin of "
     "this name, or the library does not exist.",
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
     "warning.",
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

std::span<const FindingInfo> finding_table() {
  return kTable;
}

std::string finding_id(Finding finding) {
  return fmt::format("LF{:04}", static_cast<int>(finding));
}

std::optional<Finding> find_finding(std::string_view id) {
  const auto same = [&](const FindingInfo& info) {
    const std::string own = finding_id(info.finding);
    return std::equal(own.begin(), own.end(), id.begin(), id.end(),
                      [](char a, char b) { return a == (b >= 'a' && b <= 'z' ? b - 'a' + 'A' : b); });
  };
  const auto* const found = std::find_if(std::begin(kTable), std::end(kTable), same);
  return found == std::end(kTable) ? std::nullopt : std::optional(found->finding);
}

LaunchError unknown_finding(const std::string& id) {
  std::vector<std::string> ids;
  for (const FindingInfo& info : kTable) {
    ids.push_back(finding_id(info.finding));
  }
  std::string help = did_you_mean(id, ids);
  return {fmt::format("no finding has the id '{}'", id),
          {},
          help.empty() ? "`launch explain` lists all findings" : std::move(help)};
}

const FindingInfo& finding_info(Finding finding) {
  const auto* const found = std::find_if(std::begin(kTable), std::end(kTable),
                                         [&](const FindingInfo& info) { return info.finding == finding; });
  if (found == std::end(kTable)) {
    throw std::logic_error(fmt::format("finding {} has no row in the table", static_cast<int>(finding)));
  }
  return *found;
}

}  // namespace launch
