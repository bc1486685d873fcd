// SPDX-License-Identifier: Apache-2.0
// Processes that have the terminal of the launch, and those that would like to have it.
#include <gmock/gmock.h>

#include "base/diagnostics/source.hpp"
#include "launcher/process/process_messages.hpp"
#include "supervisor_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class TerminalInput : public SupervisorFixture {
 protected:
  static ProcessSpec with_terminal(const std::string& name) {
    ProcessSpec result = spec(name);
    result.terminal_input = true;
    return result;
  }
};

TEST_F(TerminalInput, ASignalOfTheTerminalIsNotSentAgain) {
  runner.script("a", {{.exits_after = 2s}});
  supervisor->start(with_terminal("a"));
  supervisor->start(spec("b"));
  loop.advance(1s);
  supervisor->note_signal_of_terminal();
  supervisor->shutdown();
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 b-2 started", "1.0 b-2 SIGINT", "1.0 b-2 exited -2, expected",
                          "1.0 b-2 done", "2.0 a-1 exited 0, expected", "2.0 a-1 done"}));
}

TEST_F(TerminalInput, SigtermFollowsASignalOfTheTerminalThatWasIgnored) {
  supervisor->start(with_terminal("a"));
  supervisor->note_signal_of_terminal();
  supervisor->shutdown();
  loop.advance(5s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "5.0 a-1 SIGTERM after SIGINT and 5 s", "5.0 a-1 exited -15, expected",
                          "5.0 a-1 done"}));
}

TEST_F(TerminalInput, AProcessThatEndsByASignalOfTheTerminalIsNotStartedAgain) {
  runner.script("a", {{.exits_after = 1s, .exit_code = -SIGINT}});
  ProcessSpec again = with_terminal("a");
  again.respawn.enabled = true;
  supervisor->start(again);
  supervisor->note_signal_of_terminal();
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "1.0 a-1 exited -2, expected", "1.0 a-1 done"}));
}

TEST_F(TerminalInput, WithoutATerminalTheLaunchSignalsTheProcessItself) {
  runner.script("a", {{.lacks_terminal = true}});
  supervisor->start(with_terminal("a"));
  supervisor->note_signal_of_terminal();
  supervisor->shutdown();
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 a-1 SIGINT"}));
}

TEST_F(TerminalInput, AProcessThatReadsFromTheBackgroundIsToldOf) {
  supervisor->watch_terminal();
  supervisor->start(spec("a"));
  supervisor->start(with_terminal("b"));
  supervisor->start(spec("c"));
  runner.stop(pid_of_start(0), SIGTTIN);
  runner.stop(pid_of_start(1), SIGTTOU);
  runner.stop(pid_of_start(2), SIGSTOP);
  runner.stop(4711, SIGTTIN);  // none of ours
  loop.deliver_signal(SIGCHLD);
  loop.deliver_signal(SIGCHLD);
  loop.advance(1s);
  EXPECT_EQ(lines, (Lines{"0.0 a-1 started", "0.0 b-2 started", "0.0 c-3 started", "0.1 a-1 waits for the terminal",
                          "0.1 b-2 waits for the terminal, which it has"}));
}

TEST_F(TerminalInput, AProcessThatWaitsGoesOnInTheForeground) {
  supervisor->watch_terminal();
  runner.put_into_background(true);
  supervisor->start(with_terminal("a"));
  runner.stop(pid_of_start(0), SIGTTIN);
  loop.deliver_signal(SIGCHLD);
  loop.advance(10s);
  EXPECT_THAT(runner.signals(), testing::IsEmpty());
  runner.put_into_background(false);
  loop.advance(1s);
  EXPECT_EQ(runner.signals_of(pid_of_start(0)), std::vector<int>{SIGCONT});
}

TEST_F(TerminalInput, ASuspendedLaunchWaitsUntilNobodyReadsTheTerminal) {
  runner.script("c", {{.lacks_terminal = true}});
  for (const ProcessSpec& each : {spec("a"), with_terminal("b"), with_terminal("c")}) {
    supervisor->start(each);
  }
  supervisor->suspend();
  EXPECT_EQ(runner.awaited_stops(), std::vector<pid_t>{pid_of_start(1)});
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(runner.signals_of(pid_of_start(i)), std::vector<int>{SIGSTOP});
  }
}

TEST_F(TerminalInput, MessagesSayWhatToDo) {
  supervisor->observe(process_messages(output));
  supervisor->watch_terminal();
  const auto file = std::make_shared<const SourceFile>("system.launch.xml", "<launch>\n  <node/>\n</launch>\n");
  runner.script("c", {{.lacks_terminal = true}});
  for (ProcessSpec placed : {spec("a"), with_terminal("b"), with_terminal("c")}) {
    placed.origin = {file, 11, 18};
    supervisor->start(placed);
  }
  runner.put_into_background(true);
  runner.stop(pid_of_start(0), SIGTTIN);
  runner.stop(pid_of_start(1), SIGTTOU);
  loop.deliver_signal(SIGCHLD);
  loop.advance(1s);
  EXPECT_EQ(screen.text(),
            "[INFO] [a-1]: process started with pid [1000001]\n"
            "[INFO] [b-2]: process started with pid [1000002]\n"
            "[INFO] [c-3]: process started with pid [1000003]\n"
            "[WARNING] [c-3]: process has nothing to read, because standard input of the launch is no terminal "
            "(system.launch.xml:2:3)\n"
            "[WARNING] [a-1]: process waits for terminal input; stdin=\"terminal\" lets it have the terminal "
            "(system.launch.xml:2:3)\n"
            "[WARNING] [b-2]: process waits for the terminal, to set its modes; it goes on when the launch is in the "
            "foreground again (system.launch.xml:2:3)\n");
}

}  // namespace
}  // namespace launch
