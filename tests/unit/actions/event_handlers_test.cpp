// SPDX-License-Identifier: Apache-2.0
// The syntax of event handlers, commands and dependencies: both formats, and the errors at load.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/unit/actions/launch_text.hpp"

namespace {

using test_support::plan_actions;
using test_support::plan_text;
using testing::ElementsAre;

// The handlers, commands and dependencies of a plan, a line each.
std::vector<std::string> lines_of(const launch::LaunchPlan& plan) {
  std::vector<std::string> lines;
  for (const launch::Dependency& dependency : plan.dependencies) {
    const double timeout = std::chrono::duration<double>(dependency.timeout.value_or(launch::Duration(0))).count();
    lines.push_back(fmt::format("{} until {}, {} s, else {}", plan.processes[dependency.process].name,
                                describe(dependency), timeout, to_string(dependency.on_failure)));
  }
  for (std::size_t i = 0; i < plan.handlers.size(); ++i) {
    const launch::LaunchPlan& reaction = plan.reactions.at(i);
    lines.push_back(describe(plan.handlers[i]) + (plan.handlers[i].once ? " once:" : ":"));
    for (const std::string& line : lines_of(reaction)) {
      lines.push_back("  " + line);
    }
    for (const launch::ProcessCommand& command : reaction.commands) {
      lines.push_back(fmt::format("  {} {} {}", name_of(command.kind), command.process, command.signal));
    }
    for (const std::string& log : reaction.logs) {
      lines.push_back("  log " + log);
    }
  }
  return lines;
}

TEST(EventHandlersText, MeansTheSameInBothFormats) {
  const char* const xml = R"xml(<launch>
  <executable cmd="a"/>
  <executable cmd="b">
    <depends_on process="a" condition="exited" exit_code="nonzero" timeout="2.5" on_failure="skip"/>
    <depends_on process="a" condition="output" pattern="rea+dy" stream="stderr"/>
    <depends_on process="a" if="false"/>
  </executable>
  <on_process_start process="a"><restart process="b"/></on_process_start>
  <on_process_exit exit_code="SIGKILL,3" once="true">
    <signal process="a" signal="HUP"/>
    <log message="code $(var event.exit_code)"/>
    <on_process_io pattern="x" stream="stdout"><stop process="b"/></on_process_io>
  </on_process_exit>
  <on_shutdown timeout="1"/>
</launch>
)xml";
  const char* const yaml = R"(launch:
- executable: {cmd: a}
- executable:
    cmd: b
    depends_on:
    - {process: a, condition: exited, exit_code: nonzero, timeout: 2.5, on_failure: skip}
    - {process: a, condition: output, pattern: rea+dy, stream: stderr}
    - {process: a, if: "false"}
- on_process_start:
    process: a
    children:
    - restart: {process: b}
- on_process_exit:
    exit_code: SIGKILL,3
    once: true
    children:
    - signal: {process: a, signal: HUP}
    - log: {message: code $(var event.exit_code)}
    - on_process_io:
        pattern: x
        stream: stdout
        children:
        - stop: {process: b}
- on_shutdown:
    timeout: 1.0
    children: []
)";
  for (const char* const text : {xml, yaml}) {
    const auto planned = plan_text(text);
    EXPECT_EQ(planned.error, "");
    EXPECT_THAT(lines_of(planned.plan),
                ElementsAre("b until 'a' has exited with exit code nonzero, 2.5 s, else skip",
                            "b until 'a' has written a line that matches 'rea+dy' on stderr, 0 s, else shutdown",
                            "on_process_start of 'a':", "  restart b 0",
                            "on_process_exit of any process with exit code SIGKILL,3 once:",
                            "  on_process_io of any process with a line that matches 'x' on stdout:", "    stop b 0",
                            "  signal a 1", "  log code -9", "on_shutdown:"));
  }
}

std::string plan_error(const std::string& xml) {
  return plan_actions(xml).error;
}

TEST(EventHandlersText, SaysWhatIsWrongAtItsPlace) {
  EXPECT_EQ(
      plan_error("<on_process_exit exit_code=\"-0x1\"/>"),
      "/test/system.launch.xml:2:29: error: '-0x1' is no exit code\n"
      "    2 | <on_process_exit exit_code=\"-0x1\"/>\n"
      "      |                             ^~~~\n"
      "      = help: write any, nonzero, or numbers from 0 to 255 and signals such as SIGSEGV, separated by commas");
  EXPECT_EQ(plan_error("<on_process_io stream=\"out\"/>"),
            "/test/system.launch.xml:2:24: error: 'out' is no stream of a process, expected stdout, stderr or both\n"
            "    2 | <on_process_io stream=\"out\"/>\n"
            "      |                        ^~~");
  EXPECT_EQ(plan_error("<on_process_start proces=\"a\"/>"),
            "/test/system.launch.xml:2:19: error: unexpected attribute 'proces' in 'on_process_start'\n"
            "    2 | <on_process_start proces=\"a\"/>\n"
            "      |                   ^~~~~~\n"
            "      = help: did you mean 'process'?");
  EXPECT_EQ(plan_error("<signal process=\"a\" signal=\"SIGUSER1\"/>"),
            "/test/system.launch.xml:2:29: error: 'SIGUSER1' is no signal\n"
            "    2 | <signal process=\"a\" signal=\"SIGUSER1\"/>\n"
            "      |                             ^~~~~~~~\n"
            "      = help: did you mean 'SIGUSR1'?");
  EXPECT_EQ(plan_error("<on_shutdown timeout=\"-1\"/>"),
            "/test/system.launch.xml:2:23: error: expected a number that is not negative, got '-1'\n"
            "    2 | <on_shutdown timeout=\"-1\"/>\n"
            "      |                       ^~\n"
            "      = help: write 0 or more");
  EXPECT_EQ(plan_error("<executable cmd=\"a\"><depends_on process=\"b\" condition=\"exite\"/></executable>"),
            "/test/system.launch.xml:2:56: error: condition can be started, exited, output or healthy, got 'exite'\n"
            "    2 | <executable cmd=\"a\"><depends_on process=\"b\" condition=\"exite\"/></executable>\n"
            "      |                                                        ^~~~~\n"
            "      = help: did you mean 'exited'?");
  EXPECT_EQ(plan_error("<executable cmd=\"a\"><depends_on process=\"b\" pattern=\"x\"/></executable>"),
            "/test/system.launch.xml:2:54: error: pattern goes with condition=\"output\" only\n"
            "    2 | <executable cmd=\"a\"><depends_on process=\"b\" pattern=\"x\"/></executable>\n"
            "      |                                                      ^");
  EXPECT_EQ(plan_error("<executable cmd=\"a\" respawn=\"true\" respawn_backoff=\"2\"/>"),
            "/test/system.launch.xml:2:53: error: respawn_backoff can't make a respawn_delay of 0 longer\n"
            "    2 | <executable cmd=\"a\" respawn=\"true\" respawn_backoff=\"2\"/>\n"
            "      |                                                     ^\n"
            "      = help: add respawn_delay, the first delay in seconds");
}

TEST(EventHandlersText, AMachineThatCanBeLostIsDeclared) {
  EXPECT_EQ(plan_error("<on_machine_lost machine=\"\"/>"),
            "/test/system.launch.xml:2:27: error: the name of the machine is empty\n"
            "    2 | <on_machine_lost machine=\"\"/>\n"
            "      |                           ^\n"
            "      = help: leave the attribute out to mean every other machine");
  EXPECT_EQ(plan_error("<on_machine_lost machine=\"local\"/>"),
            "/test/system.launch.xml:2:27: error: there is no connection to this machine\n"
            "    2 | <on_machine_lost machine=\"local\"/>\n"
            "      |                           ^~~~~\n"
            "      = help: leave the attribute out to mean every other machine");
  EXPECT_EQ(plan_error("<machine name=\"arm\" connect=\"ssh arm\"/><on_machine_lost machine=\"amr\"/>"),
            "/test/system.launch.xml:2:66: error: there is no machine 'amr'\n"
            "    2 | <machine name=\"arm\" connect=\"ssh arm\"/><on_machine_lost machine=\"amr\"/>\n"
            "      |                                                                  ^~~\n"
            "      = help: did you mean 'arm'?");
}

TEST(EventHandlersText, NumbersNeedNoQuotesInYaml) {
  const auto planned = plan_text(R"(launch:
- executable: {cmd: a, cpus: 0, memory_limit: 4096}
- on_process_exit:
    exit_code: -9
    children:
    - signal: {process: a, signal: 10}
)");
  EXPECT_EQ(planned.error, "");
  EXPECT_THAT(lines_of(planned.plan),
              ElementsAre("on_process_exit of any process with exit code -9:", "  signal a 10"));
  EXPECT_THAT(describe(planned.plan.processes.at(0).limits), ElementsAre("cpus 0", "memory 4096 bytes"));
}

TEST(EventHandlersText, EndsAtShutdownWithoutTraces) {
  EXPECT_EQ(plan_error("<on_shutdown><trace session-name=\"late\"/></on_shutdown>"),
            "/test/system.launch.xml:2:15: error: a trace can't begin when the system ends\n"
            "    2 | <on_shutdown><trace session-name=\"late\"/></on_shutdown>\n"
            "      |               ^~~~~\n"
            "      = help: put it outside of on_shutdown");
}

}  // namespace
