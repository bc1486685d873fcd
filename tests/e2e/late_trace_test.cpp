// Tracing that starts when the system runs already: the trace is as readable as one from the beginning.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/e2e/recorded_trace.hpp"
#include "tests/support/command.hpp"
#include "tests/support/sandbox.hpp"

namespace {

using namespace test_support;
using nlohmann::json;
using testing::IsEmpty;

std::string line_with(const std::string& text, const std::string& part) {
  const std::size_t found = text.find(part);
  if (found == std::string::npos) return "";
  const std::size_t begin = text.rfind('\n', found) + 1;
  return text.substr(begin, text.find('\n', found) - begin);
}

TEST(LateTrace, NamesNodesTopicsAndCallbacks) {
  Sandbox sandbox;
  const std::string nodes = std::string(BUILD_DIRECTORY) + "/prefix/lib/demo_nodes/";
  RunningCommand talker({.argv = {nodes + "talker"}});
  RunningCommand listener({.argv = {nodes + "listener"}});
  ASSERT_TRUE(listener.wait_for_output("I heard")) << listener.out() << listener.err();

  RunningCommand trace({.argv = {LAUNCH_PROGRAM, "trace", "-s", "late", "-u", "ros2:*", "ros2_ext:*"}});
  ASSERT_TRUE(trace.wait_for_output("press enter to start..."));
  trace.write("\n");
  ASSERT_TRUE(trace.wait_for_output("press enter to stop...")) << trace.out() << trace.err();
  ASSERT_TRUE(listener.wait_for_output("I heard"));
  ASSERT_TRUE(listener.wait_for_output("I heard"));
  trace.write("\n");
  const CommandResult traced = trace.wait();
  ASSERT_EQ(traced.exit_code, 0) << traced.out << traced.err;

  const CommandResult report = run_command({LAUNCH_PROGRAM, "report", (sandbox.trace_directory() / "late").string()});
  std::cout << report.out << report.err;
}

}  // namespace
