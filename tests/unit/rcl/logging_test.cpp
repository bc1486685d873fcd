// SPDX-License-Identifier: Apache-2.0
#include "rcutils/logging.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "rcl_test.hpp"

namespace {

constexpr rcutils_log_location_t kLocation{"function", "dir/file.cpp", 42};
constexpr rcutils_time_point_value_t kTime = 1700000000123456789;

// Logging that is initialised again with the environment of the test.
class Logging : public testing::Test {
 protected:
  Logging() {
    clear();
    setenv("ROS_LOG_DIR", directory_.c_str(), 1);
  }
  ~Logging() override {
    clear();
    unsetenv("ROS_LOG_DIR");
    std::filesystem::remove_all(directory_);
  }

  static void clear() {
    for (const char* variable :
         {"RCUTILS_CONSOLE_OUTPUT_FORMAT", "RCUTILS_COLORIZED_OUTPUT", "RCUTILS_LOGGING_USE_STDOUT",
          "RCUTILS_LOGGING_BUFFERED_STREAM", "RCL_LOGGING_IMPLEMENTATION", "TEST_LOG_BACKEND"}) {
      unsetenv(variable);
    }
    EXPECT_EQ(rcutils_logging_shutdown(), RCUTILS_RET_OK);
  }

  // The text that the console handler writes to stderr for a message at kTime.
  static std::string line(int severity, const char* name, const char* format, ...) {
    testing::internal::CaptureStderr();
    va_list args;
    va_start(args, format);
    rcutils_logging_console_output_handler(&kLocation, severity, name, kTime, format, &args);
    va_end(args);
    return testing::internal::GetCapturedStderr();
  }

  // Logs a warning with these ROS arguments. Returns the text on the console.
  static std::string log_with(std::vector<std::string> flags) {
    flags.insert(flags.begin(), {"program", "--ros-args"});
    const rcl_test::Arguments arguments(flags);
    const rcl_allocator_t allocator = rcl_get_default_allocator();
    EXPECT_EQ(rcl_logging_configure(&arguments.handle, &allocator), RCL_RET_OK);
    testing::internal::CaptureStderr();
    rcutils_log(&kLocation, RCUTILS_LOG_SEVERITY_WARN, "a", "line %d", 1);
    rcutils_log(&kLocation, RCUTILS_LOG_SEVERITY_WARN, "a", "line %d", 2);
    EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
    return testing::internal::GetCapturedStderr();
  }

  // The names of the files in the log directory, without the parts that differ from run to run.
  static std::vector<std::string> files_of(const std::filesystem::path& directory) {
    std::vector<std::string> names;
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(directory, absent)) {
      names.push_back(std::regex_replace(entry.path().filename().string(),
                                         std::regex("_" + std::to_string(getpid()) + "_[0-9]{13}"), "_PID_TIME"));
    }
    return names;
  }
  static std::string content_of_only_file_in(const std::filesystem::path& directory) {
    std::ostringstream text;
    text << std::ifstream(std::filesystem::directory_iterator(directory)->path()).rdbuf();
    return text.str();
  }

  const std::filesystem::path directory_ =
      std::filesystem::temp_directory_path() / ("logging_test_" + std::to_string(getpid()));
};

TEST_F(Logging, WritesSeverityTimeNameAndMessageToStderr) {
  EXPECT_EQ(line(RCUTILS_LOG_SEVERITY_INFO, "ns.talker", "Publishing: '%s %d'", "Hello", 5),
            "[INFO] [1700000000.123456789] [ns.talker]: Publishing: 'Hello 5'\n");
}

TEST_F(Logging, WritesLongMessagesWhole) {
  const std::string text(100000, 'x');
  EXPECT_EQ(line(RCUTILS_LOG_SEVERITY_WARN, "a", "%s", text.c_str()),
            "[WARN] [1700000000.123456789] [a]: " + text + "\n");
}

TEST_F(Logging, FollowsTheFormatOfTheEnvironment) {
  setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT",
         "{function_name}:{file_name}:{line_number} {time_as_nanoseconds}\\t{x} {message", 1);
  EXPECT_EQ(line(RCUTILS_LOG_SEVERITY_INFO, "a", "m"), "function:dir/file.cpp:42 1700000000123456789\t{x} {message\n");
}

TEST_F(Logging, ColorsWholeLinesWhenTold) {
  setenv("RCUTILS_COLORIZED_OUTPUT", "1", 1);
  setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "{message}", 1);
  EXPECT_EQ(line(RCUTILS_LOG_SEVERITY_ERROR, "a", "m"), "\033[31mm\033[0m\n");
}

TEST_F(Logging, WritesToStdoutWhenTold) {
  setenv("RCUTILS_LOGGING_USE_STDOUT", "1", 1);
  testing::internal::CaptureStdout();
  EXPECT_EQ(line(RCUTILS_LOG_SEVERITY_INFO, "a", "m"), "");
  std::fflush(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "[INFO] [1700000000.123456789] [a]: m\n");
}

TEST_F(Logging, RefusesAWrongSwitch) {
  setenv("RCUTILS_COLORIZED_OUTPUT", "yes", 1);
  EXPECT_EQ(rcutils_logging_initialize(), RCUTILS_RET_INVALID_ARGUMENT);
  EXPECT_EQ(rcl_test::take_error(), "RCUTILS_COLORIZED_OUTPUT is 'yes', but must be 0 or 1");
}

TEST_F(Logging, WithoutALevelTheRootLetsEveryMessagePass) {
  ASSERT_EQ(rcutils_logging_set_logger_level("", RCUTILS_LOG_SEVERITY_UNSET), RCUTILS_RET_OK);
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("a"), RCUTILS_LOG_SEVERITY_UNSET);
  EXPECT_TRUE(rcutils_logging_logger_is_enabled_for("a", RCUTILS_LOG_SEVERITY_DEBUG));
  rcutils_logging_set_default_logger_level(RCUTILS_LOG_SEVERITY_UNSET);
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("a"), RCUTILS_LOG_SEVERITY_INFO);
}

TEST_F(Logging, LevelsAreInheritedAlongTheName) {
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("a.b.c"), RCUTILS_LOG_SEVERITY_INFO);
  ASSERT_EQ(rcutils_logging_set_logger_level("a", RCUTILS_LOG_SEVERITY_ERROR), RCUTILS_RET_OK);
  ASSERT_EQ(rcutils_logging_set_logger_level("a.b.c", RCUTILS_LOG_SEVERITY_DEBUG), RCUTILS_RET_OK);
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("a.b"), RCUTILS_LOG_SEVERITY_ERROR);
  EXPECT_EQ(rcutils_logging_get_logger_level("a.b"), RCUTILS_LOG_SEVERITY_UNSET);
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("a.b.c.d"), RCUTILS_LOG_SEVERITY_DEBUG);
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("ab"), RCUTILS_LOG_SEVERITY_INFO);
  EXPECT_FALSE(rcutils_logging_logger_is_enabled_for("a.b", RCUTILS_LOG_SEVERITY_WARN));
  EXPECT_TRUE(rcutils_logging_logger_is_enabled_for("a.b.c", RCUTILS_LOG_SEVERITY_DEBUG));
  ASSERT_EQ(rcutils_logging_set_logger_level("a", RCUTILS_LOG_SEVERITY_UNSET), RCUTILS_RET_OK);
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("a.b"), RCUTILS_LOG_SEVERITY_INFO);
}

TEST_F(Logging, IsConfiguredByArguments) {
  const rcl_test::Arguments arguments(
      {"program", "--ros-args", "--log-level", "warn", "--log-level", "a.b:=debug", "--disable-rosout-logs"});
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_logging_configure(&arguments.handle, &allocator), RCL_RET_OK);
  EXPECT_EQ(rcutils_logging_get_default_logger_level(), RCUTILS_LOG_SEVERITY_WARN);
  EXPECT_EQ(rcutils_logging_get_logger_effective_level("a.b.c"), RCUTILS_LOG_SEVERITY_DEBUG);
  EXPECT_FALSE(rcl_logging_rosout_enabled());
  EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
}

TEST_F(Logging, IsSilentOnTheConsoleWhenTold) {
  const rcl_test::Arguments arguments({"program", "--ros-args", "--disable-stdout-logs"});
  const rcl_allocator_t allocator = rcl_get_default_allocator();
  ASSERT_EQ(rcl_logging_configure(&arguments.handle, &allocator), RCL_RET_OK);
  testing::internal::CaptureStderr();
  rcutils_log(&kLocation, RCUTILS_LOG_SEVERITY_FATAL, "a", "nothing");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
}

TEST_F(Logging, KeepsTheLinesOfTheConsoleInAFile) {
  setenv("RCUTILS_COLORIZED_OUTPUT", "0", 1);
  const std::string lines = log_with({});
  EXPECT_EQ(files_of(directory_), std::vector<std::string>{"rcl_values_test_PID_TIME.log"});
  EXPECT_EQ(content_of_only_file_in(directory_), lines);
}

TEST_F(Logging, FileHasTheNameThatIsAskedFor) {
  log_with({"--log-file-name", "run"});
  EXPECT_EQ(files_of(directory_), std::vector<std::string>{"run_PID_TIME.log"});
}

TEST_F(Logging, FileIsWrittenWhenTheConsoleIsSilent) {
  EXPECT_EQ(log_with({"--disable-stdout-logs"}), "");
  EXPECT_NE(content_of_only_file_in(directory_).find("[a]: line 1\n"), std::string::npos);
}

TEST_F(Logging, HasNoFileWhenTold) {
  log_with({"--disable-external-lib-logs"});
  EXPECT_EQ(files_of(directory_), std::vector<std::string>{});
}

TEST_F(Logging, HasNoFileWithTheBackendThatDoesNothing) {
  setenv("RCL_LOGGING_IMPLEMENTATION", "rcl_logging_noop", 1);
  EXPECT_NE(log_with({}), "");
  EXPECT_EQ(files_of(directory_), std::vector<std::string>());
}

TEST_F(Logging, HasAFileWithTheBackendOfRos) {
  setenv("RCL_LOGGING_IMPLEMENTATION", "rcl_logging_spdlog", 1);
  log_with({"--log-file-name", "mine"});
  EXPECT_EQ(files_of(directory_), std::vector<std::string>({"mine_PID_TIME.log"}));
}

TEST_F(Logging, GoesToABackendOfOnesOwn) {
  std::filesystem::create_directories(directory_);
  setenv("RCL_LOGGING_IMPLEMENTATION", "test_log_backend", 1);
  setenv("TEST_LOG_BACKEND", (directory_ / "calls").c_str(), 1);
  setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "{severity} {message}", 1);
  log_with({"--log-file-name", "mine", "--log-level", "warn"});
  EXPECT_EQ(content_of_only_file_in(directory_),
            "initialize mine\nlevel null 30\nlog 30 a 'WARN line 1'\nlog 30 a 'WARN line 2'\nshutdown\n");
}

TEST_F(Logging, IsRefusedWithABackendThatIsMissingOrRefuses) {
  const auto error_with = [](const std::vector<std::string>& flags) {
    const rcl_test::Arguments arguments(flags);
    const rcl_allocator_t allocator = rcl_get_default_allocator();
    EXPECT_EQ(rcl_logging_configure(&arguments.handle, &allocator), RCL_RET_ERROR);
    EXPECT_EQ(rcl_logging_fini(), RCL_RET_OK);
    return rcl_test::take_error();
  };
  setenv("RCL_LOGGING_IMPLEMENTATION", "no_such_backend", 1);
  EXPECT_EQ(
      error_with({"program"}),
      "no library for RCL_LOGGING_IMPLEMENTATION=no_such_backend: libno_such_backend.so: cannot open shared object "
      "file: No such file or directory");
  setenv("RCL_LOGGING_IMPLEMENTATION", "rcutils", 1);
  EXPECT_EQ(error_with({"program"}),
            "librcutils.so is no logging backend: it has no function rcl_logging_external_initialize()");
  setenv("RCL_LOGGING_IMPLEMENTATION", "test_log_backend", 1);
  EXPECT_EQ(error_with({"program", "--ros-args", "--log-config-file", "wrong"}),
            "the logging backend libtest_log_backend.so could not begin: 'wrong' is no file");
}

TEST_F(Logging, FileIsBelowTheHomeOfRosWithoutADirectoryOfItsOwn) {
  unsetenv("ROS_LOG_DIR");
  setenv("ROS_HOME", directory_.c_str(), 1);
  log_with({});
  unsetenv("ROS_HOME");
  EXPECT_EQ(files_of(directory_ / "log"), std::vector<std::string>{"rcl_values_test_PID_TIME.log"});
}

TEST_F(Logging, GoesOnWithoutAFileAndSaysSoOnce) {
  std::ofstream(directory_) << "in the way";
  setenv("RCUTILS_CONSOLE_OUTPUT_FORMAT", "{severity} {name} {message}", 1);
  EXPECT_EQ(log_with({}), "WARN a line 1\nWARN rcl no log file: cannot create '" + directory_.string() +
                              "': Not a directory\nWARN a line 2\n");
}

}  // namespace
