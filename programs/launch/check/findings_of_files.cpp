// SPDX-License-Identifier: Apache-2.0
// Findings of what launch files say, and of what that comes to: LF00xx to LF02xx.
#include "programs/launch/check/finding_table.hpp"

namespace launch {

namespace {

constexpr FindingInfo kRowsOfFiles[] = {
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
    {Finding::kUselessIgnore, "Comment that ignores nothing", Severity::kWarning,
     "A comment `launch: ignore LF0501: REASON` leaves findings with this id out, on its own line, and on the next one "
     "if "
     "it has its line for itself. This one names no finding, gives no reason, or there is nothing to ignore any more.",
     R"x(<launch>
  <!-- launch: ignore LF0501: the robot's operator gives it -->
  <arg name="site" default="hall"/>
  <log message="$(var site)"/>
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
};

}  // namespace

std::span<const FindingInfo> findings_of_files() {
  return kRowsOfFiles;
}

}  // namespace launch
