// SPDX-License-Identifier: Apache-2.0
// Nodes of other ROS 2 distributions that keep the tracetools of their ROS 2, and what is said of them.
#include "tests/e2e/tracing/other_ros2_fixture.hpp"

namespace other_ros2 {
namespace {

TEST_F(OtherRos2, WhatIsLaunchedLaterIsSaidWhenItStarts) {
  RunningCommand launch(
      {.argv = {LAUNCH_PROGRAM, write("<trace session-name=\"run\" tracetools=\"own\"/>\n<timer period=\"0.1\">\n" +
                                      node(prefix_of("forked"), "1 1", "camera") + "</timer>\n" +
                                      node(prefix_of("iron"), "3000 100"))}});
  const CommandResult result = launch.wait();
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("[WARNING] [launch.trace]: these processes keep the tracetools of their ROS 2: camera "
                        "(its tracetools has ros_trace_dds_write, which ours lacks); without effect on them: "
                        "counts of events"));
  EXPECT_EQ(result.out.find("keep the tracetools"), result.out.rfind("keep the tracetools"));
}

TEST_F(OtherRos2, TheirsIsSaidOnceWithAllThatHasNoEffect) {
  RunningCommand launch(
      {.argv = {
           LAUNCH_PROGRAM,
           write("<trace session-name=\"run\" tracetools=\"theirs\" events-ust=\"ros2:* ros2_ext:rcl_node_fini\" "
                 "max-overhead=\"50%\" snapshot-on-late-callback=\"20\" snapshot-on-late-message=\"60000\"/>\n" +
                 node(prefix_of("iron"), "300 100", "talker") + node(prefix_of("jazzy"), "300 100", "listener"))}});
  const CommandResult result = launch.wait();
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string warning =
      "[WARNING] [launch.trace]: these processes keep the tracetools of their ROS 2: talker, listener "
      "(tracetools=\"theirs\"); without effect on them: max-overhead, snapshot-on-late-callback, "
      "snapshot-on-late-message, events-ust 'ros2_ext:rcl_node_fini', counts of events and of losses, "
      "recorded_after_s, "
      "a longer wait for the session daemon, names in sessions that begin later\n";
  EXPECT_THAT(result.out, HasSubstr(warning));
  EXPECT_EQ(result.out.find("keep the tracetools"), result.out.rfind("keep the tracetools"));
}

TEST_F(OtherRos2, TheirsRecordsWhatTheirsRecords) {
  const CommandResult result =
      run_command({LAUNCH_PROGRAM, write("<trace session-name=\"run\" tracetools=\"theirs\"/>\n" +
                                         node(prefix_of("iron"), "100 100"))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const json told = verdict();
  ASSERT_THAT(told["processes"], SizeIs(1));
  EXPECT_FALSE(told["processes"][0].contains("recorded_after_s"));
  EXPECT_EQ(told["tracetools"], (json::array({{{"process", "talker"},
                                               {"uses", "theirs"},
                                               {"theirs", (prefix_of("iron") / "lib/libtracetools.so").string()},
                                               {"version", "6.3.2"},
                                               {"reason", "tracetools=\"theirs\""}}})));
  std::map<std::string, RecordedEvent> events = first_of_each(trace("run"));
  EXPECT_TRUE(events.contains("ros2:rmw_publish"));
  EXPECT_FALSE(events.contains("ros2:rcl_publish")) << "theirs is a part of a tracetools";
}

TEST_F(OtherRos2, ALibraryThatDoesNotFitStays) {
  const std::string actions = "<trace session-name=\"run\" TRACETOOLS max-overhead=\"50%\"/>\n" +
                              node(prefix_of("forked"), "100 100", "camera") +
                              "<executable name=\"arm\" cmd=\"" OTHER_ROS2 "/static_node 100 100\"/>" +
                              node(prefix_of("iron"), "100 100");
  const auto with = [&](const std::string& attribute) {
    std::string text = actions;
    return text.replace(text.find("TRACETOOLS"), 10, attribute);
  };
  const CommandResult result = run_command({LAUNCH_PROGRAM, write(with(""))});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out,
              HasSubstr("[WARNING] [launch.trace]: these processes keep the tracetools of their ROS 2: camera (its "
                        "tracetools has ros_trace_dds_write, which ours lacks), arm (it is linked statically); without "
                        "effect on them: max-overhead, counts of events and of losses, recorded_after_s, a longer wait "
                        "for the session daemon, names in sessions that begin later\n"));
  const json told = verdict();
  std::vector<std::string> used;
  for (const json& use : told["tracetools"]) {
    used.push_back(use["process"].get<std::string>() + " " + use["uses"].get<std::string>());
  }
  EXPECT_THAT(used, ElementsAre("camera theirs", "arm theirs", "talker own"));

  const CommandResult refused = run_command({LAUNCH_PROGRAM, write(with("tracetools=\"own\" append-trace=\"true\""))});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err,
              HasSubstr("tracing setup failed: tracetools=\"own\" cannot be had for camera: its tracetools has "
                        "ros_trace_dds_write, which ours lacks"));
  EXPECT_THAT(refused.out, Not(HasSubstr("process started")));
}

TEST_F(OtherRos2, NothingIsSaidToBeWhereNothingWasWritten) {
  const CommandResult result = run_command(
      {LAUNCH_PROGRAM, write("<trace session-name=\"run\" launch-events=\"false\"/>\n<executable cmd=\"true\"/>")});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(fs::exists(sandbox_.trace_directory() / "run"), result.out.find("trace written to:") != std::string::npos)
      << result.out;
}

}  // namespace
}  // namespace other_ros2
