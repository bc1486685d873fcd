// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/unit/deploy/deployment_text.hpp"

namespace {

using launch::as_systemd_units;
using test_support::exported;
using test_support::left_out;
using test_support::robot_options;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST(SystemdUnits, AreAServiceForEachProcessAndATargetForAll) {
  EXPECT_EQ(exported(as_systemd_units, R"(
<set_env name="MODE" value="50 %"/>
<executable cmd="/bin/echo $HOME 100% &quot;two words&quot;" name="says" cwd="/srv"/>)"),
            R"(== robot.target
[Unit]
Description=robot
Wants=robot-says.service

[Install]
WantedBy=multi-user.target
== robot-says.service
# /test/system.launch.xml:4:2
[Unit]
Description=says
PartOf=robot.target
StartLimitIntervalSec=0

[Service]
Type=exec
ExecStart="/bin/echo" "$$HOME" "100%%" "two words"
WorkingDirectory=/srv
Environment="MODE=50 %%"
Environment="PATH=/usr/bin:/bin"
KillSignal=SIGINT
TimeoutStopSec=10
)");
}

TEST(SystemdUnits, AProgramIsWhereThePathHasIt) {
  EXPECT_THAT(exported(as_systemd_units, R"(<executable cmd="env" name="a"/>)"),
              HasSubstr("\nExecStart=\"/usr/bin/env\"\n"));
  EXPECT_THAT(exported(as_systemd_units, R"(<executable cmd="no-such-program" name="a"/>)"),
              HasSubstr("\nExecStart=\"no-such-program\"\n"));
  EXPECT_THAT(exported(as_systemd_units, R"(<executable cmd="a | b" name="a" shell="true"/>)"),
              HasSubstr("\nExecStart=\"/bin/sh\" \"-c\" \"a | b\"\n"));
}

TEST(SystemdUnits, RestartAsTheProcessRespawns) {
  EXPECT_THAT(exported(as_systemd_units, R"(<executable cmd="true" name="a" respawn="true" respawn_delay="1.5"/>)"),
              HasSubstr("\nRestart=always\nRestartSec=1.5\n"));
  const std::string limited =
      exported(as_systemd_units, R"(<executable cmd="true" name="a" respawn="true" respawn_max_retries="3"/>)");
  EXPECT_THAT(limited, HasSubstr("\nStartLimitIntervalSec=infinity\nStartLimitBurst=4\n"));
  EXPECT_THAT(exported(as_systemd_units, R"(<executable cmd="true" name="a" allowed-exit-codes="3,SIGTERM"/>)"),
              HasSubstr("\nSuccessExitStatus=3 SIGTERM\n"));
}

TEST(SystemdUnits, HaveTheOrderOfTheProcesses) {
  const std::string text = exported(as_systemd_units, R"(
<executable cmd="true" name="first"/>
<executable cmd="true" name="base"/>
<executable cmd="true" name="last">
  <depends_on process="first" condition="exited" exit_code="0"/>
  <depends_on process="base" on_failure="start"/>
</executable>
<timer period="2.5"><executable cmd="true" name="late"/></timer>)");
  EXPECT_THAT(
      text, HasSubstr("Description=last\nPartOf=robot.target\nAfter=robot-first.service\nRequires=robot-first.service\n"
                      "After=robot-base.service\nWants=robot-base.service\n"));
  EXPECT_THAT(text, HasSubstr("Description=first\nPartOf=robot.target\nStartLimitIntervalSec=0\n\n[Service]\n"
                              "Type=oneshot\nRemainAfterExit=yes\n"));
  EXPECT_THAT(text, HasSubstr("\nWants=robot-late.timer\n"));
  EXPECT_THAT(text, Not(HasSubstr("Wants=robot-late.service")));
  EXPECT_THAT(text, HasSubstr("== robot-late.timer\n[Unit]\nDescription=starts late\nPartOf=robot.target\n\n[Timer]\n"
                              "OnActiveSec=2.5\n"));
}

TEST(SystemdUnits, HaveTheLimitsOfProcessesAndGroups) {
  const std::string text = exported(as_systemd_units, R"(
<group memory_max="1G"><group cpu_quota="150%">
  <executable cmd="true" name="a" nice="5" cpus="0,2-3" sched_policy="fifo" sched_priority="80" memory_max="100M" pids_max="9"/>
</group></group>)");
  EXPECT_THAT(text, HasSubstr("\nNice=5\nCPUSchedulingPolicy=fifo\nCPUSchedulingPriority=80\nCPUAffinity=0,2-3\n"
                              "Slice=robot-1-2.slice\nMemoryMax=104857600\nTasksMax=9\n"));
  EXPECT_THAT(text, HasSubstr("== robot-1.slice\n# /test/system.launch.xml:3:2\n[Slice]\nMemoryMax=1073741824\n"));
  EXPECT_THAT(text, HasSubstr("== robot-1-2.slice\n# /test/system.launch.xml:3:25\n[Slice]\nCPUQuota=150%\n"));
}

TEST(SystemdUnits, EndAllWithARequiredProcess) {
  const std::string xml = R"(<executable cmd="true" name="a" required="true"/>)";
  EXPECT_THAT(exported(as_systemd_units, xml), HasSubstr("\nExecStopPost=+systemctl --no-block stop robot.target\n"));
  launch::DeploymentOptions options = robot_options();
  options.of_user = true;
  const std::string of_user = exported(as_systemd_units, xml, options);
  EXPECT_THAT(of_user, HasSubstr("\nExecStopPost=systemctl --user --no-block stop robot.target\n"));
  EXPECT_THAT(of_user, HasSubstr("\nWantedBy=default.target\n"));
  options.of_user = false;
  options.user = "ada";
  EXPECT_THAT(exported(as_systemd_units, xml, options), HasSubstr("\nUser=ada\n"));
}

TEST(SystemdUnits, OddNamesAndPlaces) {
  const std::string text = exported(as_systemd_units, R"(
<executable cmd="./prog a" name="ü"/>
<executable cmd="./prog b" name="é" cwd="/srv/x"/>)");
  EXPECT_THAT(text, HasSubstr("== robot---.service\n"));
  EXPECT_THAT(text, HasSubstr("== robot----2.service\n"));
  EXPECT_THAT(text, HasSubstr("\nExecStart=\"/home/user/prog\" \"a\"\nWorkingDirectory=/home/user\n"));
  EXPECT_THAT(text, HasSubstr("\nExecStart=\"/srv/x/prog\" \"b\"\nWorkingDirectory=/srv/x\n"));
}

TEST(SystemdUnits, EndAllIfWhatIsWaitedForFails) {
  const std::string text = exported(as_systemd_units, R"(
<executable cmd="true" name="first"/>
<executable cmd="true" name="base"/>
<executable cmd="true" name="last">
  <depends_on process="first" condition="exited"/>
  <depends_on process="base"/>
</executable>)");
  EXPECT_THAT(text, HasSubstr("\nExecStopPost=+/bin/sh -c 'test \"$$SERVICE_RESULT\" = success || systemctl --no-block "
                              "stop robot.target'\n"));
  EXPECT_THAT(text, HasSubstr("\nExecStopPost=+/bin/sh -c 'test \"$$EXIT_STATUS\" != 203 || systemctl --no-block "
                              "stop robot.target'\n"));
}

TEST(SystemdUnits, HaveAWatchdogForAProcessThatNotifies) {
  const std::string text = exported(as_systemd_units, R"(
<executable cmd="true" name="a" respawn="true" sigterm_timeout="1" sigkill_timeout="2">
  <watch kind="notify" watchdog="true" timeout="3" on_unhealthy="restart"/>
</executable>
<executable cmd="true" name="b"><watch kind="notify" watchdog="true" timeout="0.5" on_unhealthy="shutdown"/></executable>
<executable cmd="true" name="c"><depends_on process="a" condition="healthy"/></executable>)");
  EXPECT_THAT(text,
              HasSubstr("\nNotifyAccess=all\nTimeoutStartSec=3\nWatchdogSec=3\nWatchdogSignal=SIGINT\n"
                        "TimeoutAbortSec=3\nKillSignal=SIGINT\nTimeoutStopSec=3\nRestart=always\nRestartSec=0\n"));
  EXPECT_THAT(text, HasSubstr("\nWatchdogSec=0.5\n"));
  EXPECT_THAT(text, HasSubstr("\nExecStopPost=+/bin/sh -c 'case \"$$SERVICE_RESULT\" in watchdog|timeout) systemctl "
                              "--no-block stop robot.target;; esac'\n"));
  EXPECT_THAT(text, HasSubstr("Description=c\nPartOf=robot.target\nAfter=robot-a.service\nRequires=robot-a.service\n"));
}

TEST(SystemdUnits, WatchesThatSystemdDoesNotHaveAreListed) {
  EXPECT_THAT(
      left_out(as_systemd_units, R"(
<executable cmd="true" name="a"><watch kind="notify" watchdog="true" timeout="3" on_unhealthy="restart"/></executable>
<executable cmd="true" name="b"><watch kind="notify" watchdog="true" timeout="3"/></executable>
<executable cmd="true" name="c"><watch kind="memory" max_memory="1M"/></executable>
<executable cmd="true" name="d"><depends_on process="c" condition="healthy"/></executable>)"),
      ElementsAre("'a' gets unhealthy if it is not ready in time", "'b' gets unhealthy if it is not ready in time",
                  "the watchdog of 'b', on which no restart and no end of all follows",
                  "'c' is healthy while it does not have more than 1.0 MiB of memory for 5 s",
                  "'d' waits until 'c' is healthy; the start is what is waited for"));
}

TEST(SystemdUnits, AShellStandsBeforeWhatSystemdTakesAsNoPath) {
  const std::string text = exported(as_systemd_units, R"(
<executable cmd="/opt/$$x/prog a" name="a"/>
<executable cmd="/bin/echo b" name="b" cwd="/srv/../x"/>
<executable cmd="/bin/echo c" name="c" cwd="/srv/100% a"/>)");
  EXPECT_THAT(text, HasSubstr("\nExecStart=\"/bin/sh\" \"-c\" \"cd -- \\\"$$0\\\" && exec \\\"$$@\\\"\" \"/srv/../x\" "
                              "\"/bin/echo\" \"b\"\n"));
  EXPECT_THAT(text,
              HasSubstr("\nExecStart=\"/bin/sh\" \"-c\" \"exec \\\"$$0\\\" \\\"$$@\\\"\" \"/opt/$$$$x/prog\" \"a\"\n"));
  EXPECT_THAT(text, HasSubstr("\nWorkingDirectory=/srv/100%% a\n"));
}

TEST(SystemdUnits, NoTimeoutIsNotAnEndlessOne) {
  EXPECT_THAT(
      exported(as_systemd_units, R"(<executable cmd="true" name="a" sigterm_timeout="0" sigkill_timeout="0"/>)"),
      HasSubstr("\nTimeoutStopSec=0.001\n"));
}

TEST(SystemdUnits, WhatTheyCantSayIsListed) {
  EXPECT_THAT(
      left_out(as_systemd_units, R"(
<executable cmd="true" name="a" tty="true" sched_policy="deadline" sched_runtime="0.001" sched_deadline="0.01"/>
<executable cmd="true" name="b" respawn="true" respawn_delay="1" respawn_backoff="2" allowed-exit-codes="any"/>
<executable cmd="true" name="c" leave-running="true"><env name="E V" value="x"/><depends_on topic="/map"/></executable>
<executable cmd="true" name="d"><depends_on process="b" condition="exited" timeout="5"/></executable>
<on_process_exit process="a"><log message="gone"/></on_process_exit>)"),
      ElementsAre("the terminal of 'a'", "what 'c' leaves running", "the variable 'E V' of 'c'",
                  "'c' waits until topic '/map' is published",
                  "'d' waits until 'b' has exited with exit code 0: it starts again when it has ended",
                  "on_process_exit of 'a' with exit code any", "the scheduling policy deadline of 'a'",
                  "the growing delay of the respawns of 'b'", "the permission to end with any exit code of 'b'"));
}

}  // namespace
