// SPDX-License-Identifier: Apache-2.0
// `launch graph`: the drawing of a launch file.
#include <gmock/gmock.h>

#include "tests/e2e/language/without_running.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

TEST_F(WithoutRunning, GraphHasNodesFilesNamespacesAndRemaps) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <node pkg="demo_nodes" exec="talker" name="mouth" namespace="/head"><remap from="chatter" to="/words"/></node>
  <executable cmd="sleep 1" name="nap"/>
</launch>
)xml");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "digraph launch {\n"
            "  rankdir=LR;\n"
            "  node [fontname=\"sans-serif\"];\n"
            "  edge [fontname=\"sans-serif\"];\n"
            "  \"file " +
                path +
                "\" [shape=note, color=gray, label=\"a.launch.xml\"];\n"
                "  subgraph cluster_0 {\n"
                "  label=\"/head\";\n"
                "  \"/head/mouth\" [label=\"/head/mouth\\ndemo_nodes talker\"];\n"
                "  }\n"
                "  \"process 0\" [shape=box, label=\"nap\"];\n"
                "  \"topic /words\" [shape=plaintext, label=\"/words\"];\n"
                "  \"file " +
                path +
                "\" -> \"/head/mouth\" [color=gray];\n"
                "  \"/head/mouth\" -> \"topic /words\" [dir=none, color=blue, label=\"chatter\"];\n"
                "  \"file " +
                path +
                "\" -> \"process 0\" [color=gray];\n"
                "}\n");
}

TEST_F(WithoutRunning, GraphResolvesNamesAndShowsWhatWaitsAndWhatHandlersStart) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <node pkg="demo_nodes" exec="talker" name="mouth" namespace="left"><remap from="chatter" to="said"/></node>
  <node pkg="demo_nodes" exec="talker" name="mouth" namespace="right">
    <remap from="chatter" to="said"/><remap from="own" to="~/private"/><depends_on process="nap" condition="exited"/>
  </node>
  <node pkg="demo_nodes" exec="listener"/>
  <executable cmd="sleep 1" name="nap"/>
  <on_process_exit process="nap" exit_code="0"><executable cmd="true" name="later"/></on_process_exit>
</launch>
)xml");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string from_file = "  \"file " + path + "\" -> ";
  EXPECT_EQ(result.out.substr(result.out.find("  subgraph")),
            "  subgraph cluster_0 {\n"
            "  label=\"/left\";\n"
            "  \"/left/mouth\" [label=\"/left/mouth\\ndemo_nodes talker\"];\n"
            "  }\n"
            "  subgraph cluster_1 {\n"
            "  label=\"/right\";\n"
            "  \"/right/mouth\" [label=\"/right/mouth\\ndemo_nodes talker\"];\n"
            "  }\n"
            "  \"process 0\" [shape=box, label=\"nap\"];\n"
            "  \"process 1\" [shape=box, label=\"later\"];\n"
            "  \"handler 0\" [shape=cds, color=orange, label=\"on_process_exit of 'nap' with exit code 0\"];\n"
            "  \"topic /left/said\" [shape=plaintext, label=\"/left/said\"];\n"
            "  \"topic /right/mouth/private\" [shape=plaintext, label=\"/right/mouth/private\"];\n"
            "  \"topic /right/said\" [shape=plaintext, label=\"/right/said\"];\n" +
                from_file + "\"/left/mouth\" [color=gray];\n" +
                "  \"/left/mouth\" -> \"topic /left/said\" [dir=none, color=blue, label=\"chatter\"];\n" + from_file +
                "\"/right/mouth\" [color=gray];\n" +
                "  \"/right/mouth\" -> \"topic /right/said\" [dir=none, color=blue, label=\"chatter\"];\n" +
                "  \"/right/mouth\" -> \"topic /right/mouth/private\" [dir=none, color=blue, label=\"own\"];\n" +
                from_file + "\"/listener\" [color=gray];\n" + from_file + "\"process 0\" [color=gray];\n" +
                "  \"/right/mouth\" -> \"process 0\" [style=dashed, label=\"waits until 'nap' has exited with exit "
                "code 0\"];\n" +
                from_file + "\"handler 0\" [color=gray];\n" + "  \"process 0\" -> \"handler 0\" [color=orange];\n" +
                from_file + "\"process 1\" [color=gray];\n" +
                "  \"handler 0\" -> \"process 1\" [color=orange, label=\"starts\"];\n"
                "}\n");
  EXPECT_THAT(result.out,
              HasSubstr("  \"/listener\" [label=\"/listener\\ndemo_nodes listener\\nnamed by the program\"]"));
}

TEST_F(WithoutRunning, GraphSaysWhatHandlersDoAndNamesContainersOfOthers) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <executable cmd="sleep 1" name="nap"/>
  <on_process_exit process="nap"><restart process="nap"/><shutdown/></on_process_exit>
  <load_composable_node target="/box/c"><composable_node pkg="p" plugin="p::A" name="part"/></load_composable_node>
</launch>
)xml");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("label=\"on_process_exit of 'nap' with exit code any\\nends the launch\"];\n"));
  EXPECT_THAT(result.out, HasSubstr("  \"handler 0\" -> \"process 0\" [color=orange, label=\"restarts\"];\n"));
  EXPECT_THAT(result.out, HasSubstr("  label=\"/box\";\n  \"/box/c\" [label=\"/box/c\\nnot started here\"];\n"));
  const std::string picture = launch({"graph", "--format", "svg", path}).out;
  for (const char* const text : {">not started here<", ">loads<", ">restarts<", ">ends the launch<"}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
}

TEST_F(WithoutRunning, GraphHasABoxForEachMachine) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <machine name="arm" connect="ssh arm"/>
  <machine name="unused" connect="ssh unused"/>
  <node pkg="demo_nodes" exec="talker" name="mouth" namespace="/head" machine="arm"/>
  <node pkg="demo_nodes" exec="listener" name="ear" namespace="/head"/>
  <node pkg="demo_nodes" exec="listener" name="hand" machine="arm"/>
  <node_container pkg="rclcpp_components" exec="component_container" name="box" namespace="" machine="arm">
    <composable_node pkg="p" plugin="p::A" name="part"/>
  </node_container>
  <executable cmd="sleep 1" name="nap" machine="arm"/>
  <executable cmd="sleep 1" name="rest"/>
</launch>
)xml");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::size_t begin = result.out.find("  subgraph");
  EXPECT_EQ(result.out.substr(begin, result.out.find("  \"file", begin) - begin),
            "  subgraph cluster_1 {\n"
            "  label=\"this machine\";\n"
            "  style=rounded;\n"
            "  subgraph cluster_0 {\n"
            "  label=\"/head\";\n"
            "  \"/head/ear\" [label=\"/head/ear\\ndemo_nodes listener\"];\n"
            "  }\n"
            "  \"process 1\" [shape=box, label=\"rest\"];\n"
            "  }\n"
            "  subgraph cluster_3 {\n"
            "  label=\"machine arm\";\n"
            "  style=rounded;\n"
            "  \"/hand\" [label=\"/hand\\ndemo_nodes listener\"];\n"
            "  \"/box\" [label=\"/box\\nrclcpp_components component_container\"];\n"
            "  \"/part\" [label=\"/part\\np::A in /box\"];\n"
            "  subgraph cluster_2 {\n"
            "  label=\"/head\";\n"
            "  \"/head/mouth\" [label=\"/head/mouth\\ndemo_nodes talker\"];\n"
            "  }\n"
            "  \"process 0\" [shape=box, label=\"nap\"];\n"
            "  }\n");
  const std::string picture = launch({"graph", "--format", "svg", path}).out;
  EXPECT_THAT(picture, HasSubstr("<rect class=\"machine\""));
  // A frame is drawn before what stands in it.
  EXPECT_LT(picture.find(">machine arm<"), picture.find(">/head/mouth<"));
  EXPECT_LT(picture.find(">this machine<"), picture.find(">/head/ear<"));
}

TEST_F(WithoutRunning, GraphOfALaunchOnOneOtherMachineSaysSo) {
  const std::string path = file("a.launch.xml", R"xml(<launch>
  <machine name="arm" connect="ssh arm"/>
  <executable cmd="sleep 1" name="nap" machine="arm"/>
</launch>
)xml");
  EXPECT_THAT(launch({"graph", path}).out,
              HasSubstr("  subgraph cluster_0 {\n  label=\"machine arm\";\n  style=rounded;\n"
                        "  \"process 0\" [shape=box, label=\"nap\"];\n  }\n"));
}

TEST_F(WithoutRunning, GraphOfAnEventHandlerOfPythonIsOneBox) {
  const std::string path = file("a.launch.py", R"py(from launch import EventHandler, LaunchDescription
from launch.actions import LogInfo, RegisterEventHandler

def generate_launch_description():
    return LaunchDescription([
        RegisterEventHandler(EventHandler(matcher=lambda event: False, entities=[LogInfo(msg='x')]))])
)py");
  const CommandResult result = launch({"graph", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("  \"handler 0\" [shape=cds, color=orange, label=\"event handler in line 6\\n"));
  EXPECT_THAT(result.out, testing::Not(HasSubstr("handler 1")));
}

TEST_F(WithoutRunning, GraphIsAPictureToo) {
  const std::string inner = file("inner.launch.xml",
                                 "<launch><node pkg=\"demo_nodes\" exec=\"talker\" name=\"mouth\" namespace=\"head\">"
                                 "<remap from=\"chatter\" to=\"/a&lt;b\"/></node></launch>\n");
  const std::string path = file("a.launch.xml",
                                "<launch><executable cmd=\"sleep 1\"/><include file=\"$(dirname)/inner.launch.xml\"/>"
                                "<node_container pkg=\"rclcpp_components\" exec=\"component_container\" name=\"c\" "
                                "namespace=\"\"><composable_node pkg=\"p\" plugin=\"p::A\" name=\"part\"/>"
                                "</node_container></launch>\n");
  const CommandResult result = launch({"graph", "--format", "svg", "-o", "a.svg", path});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  const std::string picture = read_file(sandbox_.directory() / "a.svg");
  for (const char* const text :
       {">a.launch.xml<", ">inner.launch.xml<", ">/head<", ">/head/mouth<", ">demo_nodes talker<", ">/a&lt;b<",
        ">chatter<", ">sleep<", ">/c<", ">/part<", ">p::A in /c<", "class=\"loads\"", "class=\"remaps\""}) {
    EXPECT_THAT(picture, HasSubstr(text));
  }
  const CommandResult valid = run_command(Command{{"xmllint", "--noout", "a.svg"}, {}, sandbox_.directory()});
  EXPECT_EQ(valid.exit_code, 0) << valid.err;
}

}  // namespace
