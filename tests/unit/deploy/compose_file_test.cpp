// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/unit/deploy/deployment_text.hpp"

namespace {

using launch::as_compose_file;
using test_support::exported;
using test_support::left_out;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ComposeFile, HasAServiceForEachProcess) {
  EXPECT_EQ(exported(as_compose_file, R"(
<set_env name="MODE" value="$price"/>
<executable cmd="/bin/echo $HOME" name="says" cwd="/srv" sigterm_timeout="2.5"/>
<executable cmd="run" name="again" respawn="true">
  <depends_on process="says" condition="exited" exit_code="0" on_failure="start"/>
</executable>)"),
            R"(== compose.yaml
services:
  says:
    image: "robot:1"
    command:
      - "/bin/echo"
      - "$$HOME"
    working_dir: "/srv"
    environment:
      MODE: "$$price"
    network_mode: "host"
    ipc: "host"
    restart: "no"
    stop_signal: "SIGINT"
    stop_grace_period: "7.5s"
  again:
    image: "robot:1"
    command:
      - "run"
    environment:
      MODE: "$$price"
    network_mode: "host"
    ipc: "host"
    restart: "always"
    stop_signal: "SIGINT"
    stop_grace_period: "10s"
    depends_on:
      says:
        condition: "service_completed_successfully"
        required: false
)");
}

TEST(ComposeFile, HasTheLimits) {
  EXPECT_THAT(
      exported(
          as_compose_file,
          R"(<executable cmd="true" name="a" cpus="0,2" memory_max="100M" cpu_quota="150%" cpu_weight="200" pids_max="9" open_files_limit="64" locked_memory_limit="unlimited"/>)"),
      HasSubstr("    mem_limit: 104857600\n    cpus: 1.5\n    cpu_shares: 2048\n    pids_limit: 9\n"
                "    cpuset: \"0,2\"\n    ulimits:\n      nofile: 64\n      memlock: -1\n"));
}

TEST(ComposeFile, TextsAndNamesStayWhatTheyAre) {
  const std::string text = exported(as_compose_file, R"(
<executable cmd="true" name="sp ace"><env name="V" value="  a&#10; b"/></executable>
<executable cmd="true" name="sp/ace"/>)");
  EXPECT_THAT(text, HasSubstr("\n  sp-ace:\n"));
  EXPECT_THAT(text, HasSubstr("\n  sp-ace-2:\n"));
  EXPECT_THAT(text, HasSubstr("      V: \"  a\\n b\"\n"));
}

TEST(ComposeFile, HasAHealthCheckForAWatchWithACommand) {
  const std::string xml = R"(
<executable cmd="true" name="a">
  <watch kind="command" cmd="test -e $HOME" interval="2.5" timeout="1" failures="4" start_period="3" on_unhealthy="restart"/>
</executable>
<executable cmd="true" name="b"><depends_on process="a" condition="healthy" on_failure="start"/></executable>)";
  const std::string text = exported(as_compose_file, xml);
  EXPECT_THAT(text,
              HasSubstr("    healthcheck:\n      test:\n        - \"CMD\"\n        - \"test\"\n        - \"-e\"\n"
                        "        - \"$$HOME\"\n      interval: \"2.5s\"\n      timeout: \"1s\"\n      retries: 4\n"
                        "      start_period: \"3s\"\n"));
  EXPECT_THAT(text, HasSubstr("      a:\n        condition: \"service_healthy\"\n"));
  EXPECT_THAT(left_out(as_compose_file, xml), ElementsAre("the restart when 'a' gets unhealthy"));
}

TEST(ComposeFile, NamesThatYamlTakesForOtherValuesAreInQuotes) {
  const std::string text =
      exported(as_compose_file, R"(<executable cmd="true" name="on"><env name="No" value="1"/></executable>)");
  EXPECT_THAT(text, HasSubstr("\n  \"on\":\n"));
  EXPECT_THAT(text, HasSubstr("\n      \"No\": \"1\"\n"));
}

TEST(ComposeFile, WhatItCantSayIsListed) {
  EXPECT_THAT(left_out(as_compose_file, R"(
<executable cmd="true" name="a"/>
<executable cmd="true" name="b" required="true" nice="3"/>
<executable cmd="true" name="c" respawn="true" respawn_delay="1" respawn_max_retries="2"/>
<timer period="5"><executable cmd="true" name="late"/></timer>
<executable cmd="true" name="z"><depends_on process="a" condition="exited" exit_code="any"/></executable>)"),
              ElementsAre("the end of all with the end of 'b'", "the niceness of 'b'", "the respawn delay of 'c'",
                          "a respawn after exit code 0 of 'c'", "'z' waits until 'a' has exited with exit code any",
                          "the timer before the start of 'late'"));
}

}  // namespace
