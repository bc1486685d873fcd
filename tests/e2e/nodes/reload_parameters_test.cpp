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
  const auto write = [&](const std::string& value) {
    write_file(file, R"xml(<launch><node pkg="demo_nodes_cpp" exec="even_parameters_node" name="even" output="screen">
  <param name="x" value=")xml" +
                         value + R"xml("/></node></launch>)xml");
  };
  write("2");
  RunningCommand run({.argv = {LAUNCH_PROGRAM, "--reload-on-hup", file.string()}});
  ASSERT_TRUE(run.wait_for_output("[even_parameters_node-1]: process started")) << run.err();

  write("4");
  run.send_signal(SIGHUP);
  ASSERT_TRUE(run.wait_for_output("parameter 'x' has changed and is now: 4")) << run.out() << run.err();
  EXPECT_THAT(run.out(), HasSubstr("reload: 1 gets parameters (even_parameters_node-1)"));

  write("5");
  run.send_signal(SIGHUP);
  ASSERT_TRUE(run.wait_for_output("its parameters can't be set while it runs: only even integers can be set; it is "
                                  "started again"))
      << run.out() << run.err();
  const std::size_t refused = run.out().size();
  ASSERT_TRUE(run.wait_for_output("[even_parameters_node-1]: process has finished cleanly")) << run.out() << run.err();
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out.substr(refused), HasSubstr("[even_parameters_node-1]: process started with pid"));
}

}  // namespace
