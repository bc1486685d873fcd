// SPDX-License-Identifier: Apache-2.0
// `launch graph --live`: the drawing of a system that runs.
#include <gmock/gmock.h>

#include <chrono>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace std::chrono_literals;
using namespace test_support;
using testing::HasSubstr;
using testing::StartsWith;

TEST(LiveGraph, DrawsTheNodesThatRun) {
  const Sandbox sandbox;
  const auto file = sandbox.directory() / "talker.launch.xml";
  write_file(file, "<launch><node pkg=\"demo_nodes\" exec=\"talker\" name=\"drawn\" output=\"screen\"/></launch>\n");
  RunningCommand nodes({.argv = {LAUNCH_PROGRAM, file.string()}});
  ASSERT_TRUE(nodes.wait_for_output("Publishing: 'Hello World: 2'", 60s)) << nodes.out() << nodes.err();
  // A busy machine may take longer than the recording to tell of the node.
  CommandResult graph;
  for (const auto end = std::chrono::steady_clock::now() + 60s;
       graph.out.find("label=\"/drawn\"") == std::string::npos && std::chrono::steady_clock::now() < end;) {
    graph = run_command(Command{.argv = {LAUNCH_PROGRAM, "graph", "--live"}}, 120s);
  }
  EXPECT_EQ(graph.exit_code, 0) << graph.err;
  EXPECT_THAT(graph.out, StartsWith("//"));
  EXPECT_THAT(graph.out, HasSubstr("label=\"/drawn\"")) << graph.err;
  EXPECT_THAT(graph.out, HasSubstr("label=\"/chatter\""));
  EXPECT_EQ(nodes.end_gently().exit_code, 0);
}

}  // namespace
