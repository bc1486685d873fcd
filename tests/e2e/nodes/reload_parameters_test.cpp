// SPDX-License-Identifier: Apache-2.0
// Parameters that have changed in the launch file are set in nodes that run, unless a node refuses them.
#include <gmock/gmock.h>
#include <signal.h>

#include <string>

#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;

TEST(ReloadParameters, AreSetInTheNodeAndANodeThatRefusesThemStartsAgain) {
  const Sandbox sandbox;
  const std::filesystem::path file = sandbox.directory() / "system.launch.xml";
  const auto write = [&](const std::string& value, const std::string& more = "") {
    write_file(file, R"xml(<launch><node pkg="demo_nodes_cpp" exec="even_parameters_node" name="even" output="screen">
  <param name="x" value=")xml" +
                         value + R"xml("/></node>
<executable name="up" cmd="echo the node is up" output="screen">
  <depends_on service="/even/set_parameters_atomically"/></executable>)xml" +
                         more + "</launch>");
  };
  write("2");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, "--reload-on-hup", file.string()}});
  ASSERT_TRUE(run.wait_for_output("[up-2] the node is up")) << run.err();

  write("4");
  run.send_signal(SIGHUP);
  ASSERT_TRUE(run.wait_for_output("parameter 'x' has changed and is now: 4")) << run.out() << run.err();
  EXPECT_THAT(run.out(), HasSubstr("reload: 1 gets parameters (even_parameters_node-1)"));

  write("5", R"xml(<on_process_start process="even"><executable cmd="echo it has started" output="screen"/>
</on_process_start>)xml");
  run.send_signal(SIGHUP);
  ASSERT_TRUE(
      run.wait_for_output("its parameters can't be set while it runs: only even integers can be set; it is "
                          "started again"))
      << run.out() << run.err();
  ASSERT_TRUE(run.wait_for_output("[echo-3] it has started")) << run.out() << run.err();
  run.send_signal(SIGINT);
  EXPECT_EQ(run.wait().exit_code, 0);
}

}  // namespace
