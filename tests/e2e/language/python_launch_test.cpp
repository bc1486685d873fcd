// SPDX-License-Identifier: Apache-2.0
// Python launch files, with real processes and real traces.
#include <gmock/gmock.h>
#include <signal.h>

#include <set>

#include "tests/support/command.hpp"
#include "tests/support/recorded_trace.hpp"
#include "tests/support/sandbox.hpp"
#include "tests/support/sanitized.hpp"

namespace {

namespace fs = std::filesystem;
using namespace test_support;
using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

class PythonLaunch : public testing::Test {
 protected:
  CommandResult launch(std::vector<std::string> arguments, std::map<std::string, std::string> environment = {}) {
    arguments.insert(arguments.begin(), LAUNCH_PROGRAM);
    return run_command({arguments, std::move(environment)});
  }

  std::string write(const std::string& name, const std::string& text) {
    const fs::path path = sandbox_.directory() / name;
    write_file(path, text);
    return path.string();
  }

  // The names of the nodes' events, each once, and their processes, in the one trace whose directory begins with this
  // name.
  struct Found {
    std::set<std::string> events;
    std::set<std::string> processes;
  };
  Found trace_of(const std::string& session) {
    Found found;
    for (const auto& entry : fs::directory_iterator(sandbox_.trace_directory())) {
      if (entry.path().filename().string().starts_with(session)) {
        const RecordedTrace trace = read_trace(entry.path());
        EXPECT_EQ(trace.losses, 0U);
        for (const RecordedEvent& event : trace.events) {
          if (!event.name.starts_with("launch:")) {
            found.events.insert(event.name);
            found.processes.insert(event.procname);
          }
        }
      }
    }
    return found;
  }

  Sandbox sandbox_;
};

TEST_F(PythonLaunch, TheTraceActionRecordsTheRun) {
  if (test_support::kSanitized) {
    GTEST_SKIP() << test_support::kMallocIsTaken;
  }
  const CommandResult result = launch({EXAMPLES_DIRECTORY "/26_trace_action.launch.py"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_THAT(result.out, HasSubstr("trace is complete: no events lost"));
  const Found found = trace_of("trace_action-");
  EXPECT_THAT(found.events, testing::IsSupersetOf({"ros2:rcl_init", "ros2:rcl_node_init", "lttng_ust_libc:malloc"}));
  EXPECT_THAT(found.processes, testing::IsSupersetOf({"ping", "pong"}));
}

// From the documentation of ros2_tracing, except the first word of the command.
TEST_F(PythonLaunch, TheExampleOfRos2TracingRunsUnderItsNames) {
  const CommandResult result = launch({"tracetools_launch", "example.launch.py"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  const Found found = trace_of("my-tracing-session");
  EXPECT_EQ(found.processes, (std::set<std::string>{"test_ping", "test_pong"}));
  EXPECT_THAT(found.events, testing::IsSupersetOf({"ros2:rcl_node_init", "ros2:rmw_take", "ros2:callback_end"}));
}

TEST_F(PythonLaunch, DomainsOfContextFieldsMustBeKnown) {
  const std::string file = write("bad.launch.py", R"(from launch import LaunchDescription
from tracetools_launch.action import Trace


def generate_launch_description():
    return LaunchDescription([Trace(session_name='run', context_fields={'kernel': [], 'user': ['vpid']})])
)");
  const CommandResult result = launch({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_THAT(result.err, HasSubstr("context_fields has a domain 'user': there are userspace and kernel"));
}

TEST_F(PythonLaunch, IncludesXmlWhichIncludesYamlAndEachRecordsATrace) {
  const CommandResult result =
      launch({EXAMPLES_DIRECTORY "/13_python.launch.py", "pairs:=2", "count:=5", "-a"}, {{"OTHER", "x"}});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_THAT(result.out, HasSubstr("pairs: 2"));
  EXPECT_THAT(result.out, HasSubstr("[ping-4]"));

  const Found python = trace_of("from_python");
  EXPECT_THAT(python.events, testing::IsSupersetOf({"ros2:rcl_init", "ros2:rclcpp_publish", "ros2:callback_start"}));
  EXPECT_EQ(python.processes, (std::set<std::string>{"ping", "pong"}));
  const Found xml = trace_of("from_xml");
  EXPECT_THAT(xml.events, AllOf(testing::Contains("ros2:rmw_publish"), Each(StartsWith("ros2:rmw_"))));
  const Found yaml = trace_of("from_yaml");
  EXPECT_EQ(yaml.events, (std::set<std::string>{"ros2:callback_start", "ros2:callback_end"}));
}

TEST_F(PythonLaunch, HandlersAreCalledWithTheEventsOfTheirProcess) {
  const CommandResult result = launch({write("events.launch.py", R"py(
from launch import LaunchDescription
from launch.actions import EmitEvent, ExecuteProcess, LogInfo, RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown
from launch.events import matches_action
from launch.events.process import SignalProcess
from launch.substitutions import LocalSubstitution


def generate_launch_description():
    ended = []
    # Two of the same name: only the process of the action is meant.
    worker = ExecuteProcess(cmd=['sh', '-c', 'echo trouble >&2; echo ready; exec sleep 1000'], name='worker')
    other = ExecuteProcess(cmd=['sh', '-c', 'echo other; exit 3'], name='worker',
                           on_exit=[LogInfo(msg=['other: ', LocalSubstitution('event.returncode')])])

    def on_line(event):
        if event.text == b'ready\n':
            return [LogInfo(msg=f'{event.process_name} said {event.text.decode().strip()}'),
                    EmitEvent(event=SignalProcess(signal_number='SIGTERM', process_matcher=matches_action(worker)))]
        return None

    def on_exit(event, context):
        assert event.action is worker
        return [LogInfo(msg=f'{event.process_name} ended with {event.returncode}')]

    def on_any_exit(event, context):
        ended.append(event.process_name)
        return Shutdown(reason='done') if len(ended) == 2 else None

    return LaunchDescription([
        RegisterEventHandler(OnProcessStart(
            target_action=worker, on_start=lambda event, context: LogInfo(msg=f'started {event.pid > 0}'))),
        RegisterEventHandler(OnProcessIO(
            target_action=worker, on_stdout=on_line,
            on_stderr=lambda event: LogInfo(msg='on stderr: ' + event.text.decode().strip()))),
        RegisterEventHandler(OnProcessExit(target_action=worker, on_exit=on_exit)),
        RegisterEventHandler(OnProcessExit(on_exit=on_any_exit)),
        RegisterEventHandler(OnShutdown(on_shutdown=lambda event, context: LogInfo(msg='why: ' + event.reason))),
        worker,
        other,
    ])
)py")});
  EXPECT_EQ(result.exit_code, 3) << result.out << result.err;
  for (const char* const line :
       {"[launch.user]: started True\n", "[launch.user]: worker-1 said ready\n", "[launch.user]: on stderr: trouble\n",
        "[launch.user]: worker-1 ended with -15\n", "[launch.user]: other: 3\n", "[launch.user]: why: done\n"}) {
    EXPECT_THAT(result.out, HasSubstr(line));
  }
  EXPECT_THAT(result.out, Not(HasSubstr("said other")));
}

TEST_F(PythonLaunch, AnErrorInAHandlerEndsTheLaunchAtItsPlace) {
  const std::string path = write("late.launch.py", R"py(from launch import LaunchDescription
from launch.actions import ExecuteProcess


def on_exit(event, context):
    return [event.return_code]


def generate_launch_description():
    return LaunchDescription([
        ExecuteProcess(cmd=['true'], on_exit=on_exit),
        ExecuteProcess(cmd=['sleep', '1000']),
    ])
)py");
  const CommandResult result = launch({path});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, path +
                            ":6:13: error: AttributeError: 'ProcessExited' object has no attribute 'return_code'\n"
                            "    6 |     return [event.return_code]\n"
                            "      |             ^~~~~~~~~~~~~~~~~\n"
                            "      = help: did you mean 'returncode'?\n");
}

TEST_F(PythonLaunch, TracebacksAreForDebug) {
  const std::string path = write("bad.launch.py", "def generate_launch_description():\n    return {}['missing']\n");
  EXPECT_EQ(launch({path}).err, path +
                                    ":2:12: error: KeyError: 'missing'\n"
                                    "    2 |     return {}['missing']\n"
                                    "      |            ^~~~~~~~~~~~~\n");
  EXPECT_THAT(launch({"--debug", path}).err, HasSubstr("Traceback (most recent call last):"));
}

// The cost that a launch without Python must not have.
TEST_F(PythonLaunch, NoPythonIsLoadedForOtherFiles) {
  const std::map<std::string, std::string> show_libraries = {{"LD_DEBUG", "files"}};
  const std::string xml = write("a.launch.xml", "<launch><log message=\"x\"/></launch>");
  EXPECT_THAT(launch({"--dry-run", xml}, show_libraries).err, AllOf(HasSubstr("libc.so"), Not(HasSubstr("libpython"))));
  const std::string python = write("a.launch.py", R"py(
from launch import LaunchDescription


def generate_launch_description():
    return LaunchDescription()
)py");
  EXPECT_THAT(launch({"--dry-run", python}, show_libraries).err, HasSubstr("libpython"));
}

TEST_F(PythonLaunch, ABuildWithoutPythonSaysWhatToInstall) {
  const fs::path program = sandbox_.directory() / "bin" / "launch";
  fs::create_directories(program.parent_path());
  fs::copy_file(LAUNCH_PROGRAM, program);
  const std::string path = write("a.launch.py", "import launch\n");
  const CommandResult result = run_command({program.string(), "--dry-run", path});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, path + ":1:1: error: this build has no Python: '" +
                            (sandbox_.directory() / "lib/launch/liblaunch_python.so").string() +
                            "' does not exist; install python3-dev and pybind11-dev and build again\n"
                            "    1 | import launch\n"
                            "      | ^\n");

  // Where the library of the interpreter is missing, its version is the one of the build.
  fs::create_directories(sandbox_.directory() / "lib" / "launch");
  write("lib/launch/liblaunch_python.so", "damaged");
  EXPECT_THAT(run_command({program.string(), "--dry-run", path}).err,
              AllOf(HasSubstr(": error: can't load Python: "), HasSubstr("; install libpython" PYTHON_VERSION "\n")));
}

TEST_F(PythonLaunch, AnInstalledRos2IsNotInTheWay) {
  fs::create_directories(sandbox_.directory() / "site" / "launch");
  write("site/launch/__init__.py", "raise RuntimeError('the other launch')\n");
  const std::string path = write("a.launch.py", R"py(
from launch import LaunchDescription


def generate_launch_description():
    return LaunchDescription()
)py");
  const CommandResult result = launch({"--dry-run", path}, {{"PYTHONPATH", (sandbox_.directory() / "site").string()}});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(PythonLaunch, ArgumentsAreShownAndChecked) {
  const CommandResult shown = launch({"--show-args", EXAMPLES_DIRECTORY "/13_python.launch.py"});
  EXPECT_THAT(shown.out, HasSubstr("    'pairs':\n        how many pairs of ping and pong\n        (default: '1')\n"));
  const CommandResult wrong =
      launch({"--dry-run", "--strict-args", EXAMPLES_DIRECTORY "/13_python.launch.py", "pair:=2"});
  EXPECT_EQ(wrong.exit_code, 1);
  EXPECT_THAT(wrong.err, HasSubstr("did you mean 'pairs'?"));
}

TEST_F(PythonLaunch, ThePackagesThatALoadAsksForAreLookedUpForTestsToo) {
  const std::string path =
      write("asks.launch.py", R"(from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import LogInfo

def generate_launch_description():
    return LaunchDescription([LogInfo(msg=get_package_share_directory('no_such_package'))])
)");
  const CommandResult listed = launch({"test", "--list", path});
  EXPECT_EQ(listed.exit_code, 1) << listed.err;
  EXPECT_THAT(listed.err, HasSubstr("no_such_package"));
}

TEST_F(PythonLaunch, CoroutinesRunBesideTheProcesses) {
  const CommandResult result = launch({write("coroutine.launch.py", R"py(
import asyncio
from launch import LaunchDescription
from launch.actions import ExecuteProcess, LogInfo, OpaqueCoroutine, RegisterEventHandler
from launch.event_handlers import OnProcessIO
from launch.events import Shutdown
from launch.logging import get_logger


def generate_launch_description():
    heard = {'event': asyncio.Event()}

    async def watch(context, name, end=False):
        log = get_logger('coroutine')
        log.info(f'{name} {context.launch_configurations["x"]} begins')
        await heard['event'].wait()
        process = await asyncio.create_subprocess_exec('echo', 'from a child', stdout=asyncio.subprocess.PIPE)
        text = (await process.communicate())[0].decode().strip()
        number = await asyncio.get_running_loop().run_in_executor(None, lambda: 6 * 7)
        log.info(f'{text}, {number}')
        if end:
            await context.emit_event(Shutdown(reason='all is heard'))

    def on_line(event):
        heard['event'].set()

    from launch.actions import SetLaunchConfiguration
    return LaunchDescription([
        SetLaunchConfiguration('x', 'here'),
        ExecuteProcess(cmd=['sh', '-c', 'sleep 0.2; echo ready; exec sleep 1000'], name='worker'),
        RegisterEventHandler(OnProcessIO(on_stdout=on_line)),
        OpaqueCoroutine(coroutine=watch, args=['it'], kwargs={'end': True}),
        LogInfo(msg='visited'),
    ])
)py")});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_LT(result.out.find("visited"), result.out.find("[coroutine]: it here begins"));
  EXPECT_LT(result.out.find("it here begins"), result.out.find("[coroutine]: from a child, 42"));
}

TEST_F(PythonLaunch, ACoroutineThatFailsEndsTheSystemAtItsLine) {
  const std::string file = write("fails.launch.py", R"py(
from launch import LaunchDescription
from launch.actions import ExecuteProcess, OpaqueCoroutine


async def work():
    raise ValueError('no map')


def generate_launch_description():
    return LaunchDescription([
        ExecuteProcess(cmd=['sleep', '1000']),
        OpaqueCoroutine(coroutine=work, ignore_context=True),
    ])
)py");
  const CommandResult result = launch({file});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.err, file +
                            ":7:5: error: ValueError: no map\n"
                            "    7 |     raise ValueError('no map')\n"
                            "      |     ^~~~~~~~~~~~~~~~~~~~~~~~~~\n");
}

TEST_F(PythonLaunch, AShutdownCancelsCoroutines) {
  RunningCommand run({.argv = {LAUNCH_PROGRAM, write("waits.launch.py", R"py(
import asyncio
from launch import LaunchDescription
from launch.actions import OpaqueCoroutine


async def work(context):
    try:
        print('waiting')
        await asyncio.Event().wait()
    finally:
        print('cancelled')


def generate_launch_description():
    return LaunchDescription([OpaqueCoroutine(coroutine=work)])
)py")}});
  ASSERT_TRUE(run.wait_for_output("waiting"));
  run.send_signal(SIGINT);
  const CommandResult result = run.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("cancelled"));
}

TEST_F(PythonLaunch, AFileKnowsTheLogDirectoryOfItsLaunch) {
  const CommandResult result = launch({write("t.launch.py", R"py(
import launch.logging.handlers
from launch import LaunchDescription
from launch.actions import LogInfo
from launch.logging import launch_config
from launch.substitutions.for_loop_var import ForLoopIndex


def generate_launch_description():
    assert issubclass(launch.logging.handlers.WatchedFileHandler, launch.logging.FileHandler)
    return LaunchDescription([LogInfo(msg='it is ' + launch_config.log_dir)])
)py")});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  constexpr std::string_view kFound = "All log files can be found below ";
  const std::size_t begin = result.out.find(kFound) + kFound.size();
  const std::string directory = result.out.substr(begin, result.out.find('\n', begin) - begin);
  EXPECT_TRUE(fs::is_directory(directory)) << directory;
  EXPECT_THAT(result.out, HasSubstr("it is " + directory + "\n"));
}

}  // namespace
