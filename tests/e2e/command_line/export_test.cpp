// SPDX-License-Identifier: Apache-2.0
// launch export: the units run in a real systemd without the launcher; an export knows its own files again.
#include <gmock/gmock.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/e2e/command_line/booted_systemd.hpp"

namespace {

using namespace test_support;
using testing::HasSubstr;
namespace fs = std::filesystem;

class Export : public BootedSystemd {
 protected:
  CommandResult export_launch(std::vector<std::string> words) const {
    words.insert(words.begin(), {LAUNCH_PROGRAM, "export"});
    Command command{.argv = std::move(words)};
    command.directory = sandbox_.directory();
    return run_command(command);
  }

  std::string path(const std::string& name) const { return (sandbox_.directory() / name).string(); }
};

TEST_F(Export, UnitsRunInTheirOrderAndEndTogether) {
  if (const std::string why = boot(); !why.empty()) {
    GTEST_SKIP() << why;
  }
  write_file(path("node.sh"),
             "trap 'echo gentle > end; exit 0' INT\ntest -e calibrated || exit 1\necho > begun\nwhile :; do sleep "
             "0.01; done\n");
  const std::string file = write(R"xml(
<executable name="calibrate" cmd="touch calibrated" shell="true"/>
<executable name="node" cmd="sh node.sh" cpu_weight="50">
  <depends_on process="calibrate" condition="exited"/>
</executable>
<executable name="again" cmd="sleep 1000" respawn="true" respawn_delay="0.1"/>)xml");
  const CommandResult exported = export_launch({"--systemd", "units", "--as", "root", file});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_EQ(exported.out, path("units/robot.target") + "\n" + path("units/robot-calibrate.service") + "\n" +
                              path("units/robot-node.service") + "\n" + path("units/robot-again.service") +
                              "\nnext: systemctl link " + path("units") + "/*.service " + path("units") +
                              "/*.target, then systemctl enable --now robot.target\n");
  ASSERT_EQ(inside({"sh", "-c",
                    "sed -i s:^WorkingDirectory=.*:WorkingDirectory=" + sandbox_.directory().string() +
                        ": units/*.service && cp units/* /etc/systemd/system && systemctl daemon-reload"})
                .exit_code,
            0);
  ASSERT_EQ(inside({"systemctl", "enable", "--now", "robot.target"}).exit_code, 0);
  EXPECT_TRUE(becomes("robot-node.service", "ActiveState", "active"));
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!fs::exists(path("begun"))) {
    ASSERT_LT(std::chrono::steady_clock::now(), end) << inside({"journalctl", "--unit=robot-node"}).out;
  }
  EXPECT_EQ(property("robot-node.service", "CPUWeight"), "50");
  const std::string first = property("robot-again.service", "MainPID");
  ASSERT_EQ(inside({"kill", first}).exit_code, 0);
  EXPECT_TRUE(becomes("robot-again.service", "NRestarts", "1"));

  EXPECT_EQ(inside({"systemctl", "stop", "robot.target"}).exit_code, 0);
  EXPECT_TRUE(becomes("robot-node.service", "ActiveState", "inactive"));
  EXPECT_TRUE(becomes("robot-again.service", "ActiveState", "inactive"));
  EXPECT_EQ(read_file(path("end")), "gentle\n");
}

TEST_F(Export, LeavesNothingOfATraceInTheEnvironment) {
  const std::string file = write(R"xml(
<trace session-name="run"/>
<executable name="node" cmd="sleep 1000"/>)xml");
  const CommandResult exported = export_launch({"--systemd", "units", file});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_THAT(exported.out, HasSubstr("not exported: the trace"));
  const std::string unit = read_file(path("units/robot-node.service"));
  EXPECT_THAT(unit, HasSubstr("ExecStart="));
  for (const char* const variable : {"LTTNG_UST_", "TRACETOOLS_", "LD_PRELOAD"}) {
    EXPECT_THAT(unit, testing::Not(HasSubstr(variable)));
  }
}

TEST_F(Export, AnalysisOfSystemdFindsNothingWrong) {
  if (run_command({"sh", "-c", "command -v systemd-analyze"}).exit_code != 0) {
    GTEST_SKIP() << "skipped, because systemd-analyze is not installed";
  }
  const std::string file = write(R"xml(
<group memory_max="1G"><executable name="a" cmd="sleep 1" nice="5" cpus="0" sched_policy="idle" timer_slack="0.001" oom_score_adj="5"
  memory_limit="1G" open_files_limit="64" locked_memory_limit="unlimited" memory_high="50M" cpu_quota="50%" io_weight="10" pids_max="5"
  start_limit="3" allowed-exit-codes="3,SIGTERM" on_exit="shutdown"/></group>
<timer period="2"><executable name="b" cmd="echo $HOME 100% &quot;a b&quot;" shell="true"/></timer>)xml");
  ASSERT_EQ(export_launch({"--systemd", "units", "--as", "root", file}).exit_code, 0);
  const CommandResult verified = run_command({"sh", "-c",
                                              "cd " + path("units") +
                                                  " && SYSTEMD_UNIT_PATH=$PWD:/lib/systemd/system "
                                                  "systemd-analyze verify --man=no robot.target robot-*"});
  EXPECT_EQ(verified.exit_code, 0);
  EXPECT_EQ(verified.err, "");
}

TEST_F(Export, MakesItsOwnFilesAnewAndNoOthers) {
  ASSERT_EQ(export_launch({"--systemd", "units", write(R"xml(<executable name="a" cmd="true"/>)xml")}).exit_code, 0);
  write_file(path("units/other.service"), "[Unit]\n");
  ASSERT_EQ(export_launch({"--systemd", "units", write(R"xml(<executable name="b" cmd="true"/>)xml")}).exit_code, 0);
  EXPECT_FALSE(fs::exists(path("units/robot-a.service"))) << "it is of the earlier export";
  EXPECT_TRUE(fs::exists(path("units/other.service")));
  write_file(path("units/robot-c.service"), "[Unit]\n");
  const CommandResult refused =
      export_launch({"--systemd", "units", write(R"xml(<executable name="c" cmd="true"/>)xml")});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(
      refused.err,
      "launch export: error: '" + path("units/robot-c.service") +
          "' is there, and no export with the name 'robot' has made it; choose another --name or another place\n");
  EXPECT_TRUE(fs::exists(path("units/robot-b.service")));
}

TEST_F(Export, WhatCantBeSaidIsListedAndStrictRefusesIt) {
  const std::string file = write(R"xml(<executable name="a" cmd="true" tty="true"/>)xml");
  const CommandResult listed = export_launch({"--compose", "deploy/compose.yaml", "--image", "robot:1", file});
  EXPECT_EQ(listed.exit_code, 0) << listed.err;
  EXPECT_EQ(listed.out, path("deploy/compose.yaml") +
                            "\nnot exported: the terminal of 'a' (robot.launch.xml:2:2)\nnext: docker compose -f "
                            "deploy/compose.yaml up\n");
  const CommandResult strict = export_launch({"--kubernetes", "objects", "--image", "robot:1", "--strict", file});
  EXPECT_EQ(strict.exit_code, 1);
  EXPECT_EQ(strict.out,
            "not exported: the terminal of 'a' (robot.launch.xml:2:2)\nnothing is written, because of --strict\n");
  EXPECT_FALSE(fs::exists(path("objects")));
}

TEST_F(Export, WrongWordsAreNamed) {
  const std::string file = write(R"xml(<executable name="a" cmd="true"/>)xml");
  const auto error_of = [&](std::vector<std::string> words) {
    words.push_back(file);
    const CommandResult refused = export_launch(words);
    EXPECT_EQ(refused.exit_code, 2);
    return refused.err.substr(0, refused.err.find('\n'));
  };
  EXPECT_EQ(error_of({}), "launch export: error: one of --systemd DIR, --compose FILE and --kubernetes DIR is needed");
  EXPECT_EQ(
      error_of({"--compose", "compose.yaml"}),
      "launch export: error: containers need --image IMAGE, which has the programs of the launch file at their places");
  EXPECT_EQ(error_of({"--systemd", "units", "--image", "a"}),
            "launch export: error: --image is for --compose and --kubernetes");
  EXPECT_EQ(error_of({"--systemd", "units", "--user", "--as", "root"}),
            "launch export: error: --as needs units of the system, which --user excludes");
}

}  // namespace
