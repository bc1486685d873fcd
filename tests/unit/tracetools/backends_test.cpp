// SPDX-License-Identifier: Apache-2.0
// Libraries that replace one another: only the library itself is built again.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/command.hpp"
#include "tests/support/emulated.hpp"
#include "tracetools/tracetools.h"

namespace {

using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using Names = std::set<std::string>;

#define EVENT_NAME(name, ...) #name,
const Names kEvents = {TRACETOOLS_EVENTS(EVENT_NAME)};
const Names kExtEvents = {TRACETOOLS_EXT_EVENTS(EVENT_NAME)};
#undef EVENT_NAME

// The functions of an event: to record if wanted, to ask, to record.
Names functions() {
  Names names = {"ros_trace_compile_status", "ros_trace_runtime_status"};
  for (const char* infix : {"", "do_", "enabled_"}) {
    for (const std::string& event : kEvents) {
      names.insert("ros_trace_" + (infix + event));
    }
    for (const std::string& event : kExtEvents) {
      names.insert("ros_trace_ext_" + (infix + event));
    }
  }
  return names;
}

// The functions of tracetools that a library or object file defines (T) or needs (U).
Names symbols(const std::string& file, const std::string& kind, const std::vector<std::string>& options = {}) {
  std::vector<std::string> argv = {"nm", "--format=posix"};
  argv.insert(argv.end(), options.begin(), options.end());
  argv.push_back(file);
  const CommandResult result = run_command(argv);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  Names names;
  const std::regex line("(ros_trace_\\w+) " + kind + "\\b");
  for (std::sregex_iterator match(result.out.begin(), result.out.end(), line), end; match != end; ++match) {
    names.insert((*match)[1]);
  }
  return names;
}

// A program that was built with the library of LTTng runs with another library in its place.
CommandResult run_with(const std::string& library, const std::string& program) {
  return run_command(Command{{program}, {{"LD_PRELOAD", library}}});
}

void expect_status(const CommandResult& result, int exit_code, const std::string& out) {
  EXPECT_EQ(result.exit_code, exit_code);
  EXPECT_EQ(result.out, out);
  EXPECT_EQ(result.err, "");
}

// The program prints how many threads it has: lttng-ust would bring two more.
void expect_no_lttng(const std::string& library) {
  const CommandResult untraced = run_command(Command{{FIRE_ALL_EVENTS}, {{"TRACETOOLS_RUNTIME_DISABLE", "1"}}});
  const CommandResult result = run_with(library, FIRE_ALL_EVENTS);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, untraced.out);
}

TEST(Backends, LttngHasAllFunctions) {
  EXPECT_EQ(symbols(TRACETOOLS_LIBRARY, "T", {"--dynamic"}), functions());
}

TEST(Backends, NoneHasAllFunctionsAndTakesTheLibrarysPlace) {
  EXPECT_EQ(symbols(NONE_LIBRARY, "T", {"--dynamic"}), functions());
  expect_status(run_with(NONE_LIBRARY, STATUS), 1, "Tracing disabled through configuration\n");
  expect_no_lttng(NONE_LIBRARY);
}

TEST(Backends, NoneNeverWantsAnEvent) {
  void* library = dlopen(NONE_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << dlerror();
  for (const std::string& name : functions()) {
    if (name.find("_enabled_") == std::string::npos && name.find("_status") == std::string::npos) {
      continue;
    }
    EXPECT_FALSE(reinterpret_cast<bool (*)()>(dlsym(library, name.c_str()))()) << name;
  }
  dlclose(library);
}

#ifdef USDT_LIBRARY

TEST(Backends, UsdtHasAllFunctionsAndTakesTheLibrarysPlace) {
  NEEDS_WHAT_QEMU_LACKS("a process has a thread more here, as under QEMU");
  EXPECT_EQ(symbols(USDT_LIBRARY, "T", {"--dynamic"}), functions());
  expect_status(run_with(USDT_LIBRARY, STATUS), 0, "Tracing enabled\n");
  expect_no_lttng(USDT_LIBRARY);
}

TEST(Backends, UsdtHasAProbeForEachEvent) {
  const CommandResult notes = run_command({"readelf", "--notes", USDT_LIBRARY});
  ASSERT_EQ(notes.exit_code, 0) << notes.err;
  Names probes;
  const std::regex note("Provider: (\\w+)\\s+Name: (\\w+)");
  for (std::sregex_iterator match(notes.out.begin(), notes.out.end(), note), end; match != end; ++match) {
    probes.insert((*match)[1].str() + ":" + (*match)[2].str());
  }
  Names expected;
  for (const std::string& event : kEvents) {
    expected.insert("ros2:" + event);
  }
  for (const std::string& event : kExtEvents) {
    expected.insert("ros2_ext:" + event);
  }
  EXPECT_EQ(probes, expected);
}

#endif

// rcl's publisher, compiled for this test.
TEST(DisabledTracepoints, LeaveNoCallInTheObjectCode) {
  EXPECT_EQ(symbols(INSTRUMENTED_OBJECT, "U"),
            (Names{"ros_trace_ext_rcl_publisher_fini", "ros_trace_rcl_publish", "ros_trace_rcl_publisher_init"}));
  EXPECT_EQ(symbols(UNINSTRUMENTED_OBJECT, "U"), Names{});
}

}  // namespace
