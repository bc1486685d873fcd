// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/process_messages.hpp"

#include "base/diagnostics/source.hpp"
#include "supervisor_fixture.hpp"

namespace launch {
namespace {

using namespace std::chrono_literals;

class Messages : public SupervisorFixture {
 protected:
  Messages() { supervisor->observe(process_messages(output)); }
};

TEST_F(Messages, TellOfAStartAndACleanEnd) {
  runner.script("a", {{.exits_after = 1s}});
  supervisor->start(spec("a"));
  loop.advance(1s);
  EXPECT_EQ(screen.text(),
            "[INFO] [a-1]: process started with pid [1000001]\n"
            "[INFO] [a-1]: process has finished cleanly [pid 1000001]\n");
}

TEST_F(Messages, TellOfADeath) {
  runner.script("a", {{.exits_after = 1s, .exit_code = -SIGSEGV}});
  ProcessSpec with_arguments = spec("a");
  with_arguments.argv = {"/bin/a", "-x", "two words"};
  supervisor->start(with_arguments);
  loop.advance(1s);
  EXPECT_EQ(screen.text(),
            "[INFO] [a-1]: process started with pid [1000001]\n"
            "[ERROR] [a-1]: process has died [pid 1000001, exit code -11, cmd '/bin/a -x two words'].\n");
}

TEST_F(Messages, NameThePlaceInTheLaunchFile) {
  const auto file = std::make_shared<const SourceFile>("system.launch.xml", "<launch>\n  <node/>\n</launch>\n");
  runner.script("a", {{.exits_after = 1s, .exit_code = 1}});
  runner.script("b", {{.spawn_error = EACCES}});
  for (const char* name : {"a", "b"}) {
    ProcessSpec placed = spec(name);
    placed.origin = {file, 11, 18};
    supervisor->start(placed);
  }
  loop.advance(1s);
  EXPECT_EQ(screen.text(),
            "[INFO] [a-1]: process started with pid [1000001]\n"
            "[ERROR] [b-2]: exception occurred while executing process: cannot start '/bin/b': Permission denied "
            "(system.launch.xml:2:3)\n"
            "[ERROR] [a-1]: process has died [pid 1000001, exit code 1, cmd '/bin/a']. (system.launch.xml:2:3)\n");
}

TEST_F(Messages, TellOfTheEscalationInTheWordsOfRos) {
  runner.script("a", {{.ignores = {SIGINT, SIGTERM}}});
  supervisor->start(spec("a"));
  supervisor->shutdown();
  loop.advance(10s);
  EXPECT_EQ(screen.text(),
            "[INFO] [a-1]: process started with pid [1000001]\n"
            "[INFO] [a-1]: sending signal 'SIGINT' to process[a-1]\n"
            "[ERROR] [a-1]: process[a-1] failed to terminate '5' seconds after receiving 'SIGINT', escalating to "
            "'SIGTERM'\n"
            "[INFO] [a-1]: sending signal 'SIGTERM' to process[a-1]\n"
            "[ERROR] [a-1]: process[a-1] failed to terminate '10.0' seconds after receiving 'SIGTERM', escalating to "
            "'SIGKILL'\n"
            "[INFO] [a-1]: sending signal 'SIGKILL' to process[a-1]\n"
            "[ERROR] [a-1]: process has died [pid 1000001, exit code -9, cmd '/bin/a'].\n");
}

TEST_F(Messages, TellOfSchedulingThatChangesAndOfWhatTheKernelRefuses) {
  const auto file = std::make_shared<const SourceFile>("system.launch.xml", "<launch>\n  <node/>\n</launch>\n");
  ProcessSpec placed = spec("a");
  placed.origin = {file, 11, 18};
  const auto tell = [&, observer = process_messages(output)](const SchedulingChanged& change) {
    observer(ProcessEvent{1, "a-1", placed, change});
  };
  tell({{"nice 5", "cpus 0"}, ""});
  tell({{"fifo 10"}, "cannot set the policy: Operation not permitted"});
  tell({{}, ""});
  tell({{}, "Operation not permitted"});
  EXPECT_EQ(screen.text(),
            "[INFO] [a-1]: its scheduling is nice 5, cpus 0 now\n"
            "[ERROR] [a-1]: its scheduling has not changed: cannot set the policy: Operation not permitted "
            "(system.launch.xml:2:3)\n"
            "[INFO] [a-1]: its scheduling is what it was\n"
            "[ERROR] [a-1]: its scheduling is not what it was: Operation not permitted (system.launch.xml:2:3)\n");
}

}  // namespace
}  // namespace launch
