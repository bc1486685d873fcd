// SPDX-License-Identifier: Apache-2.0
// The message for the user when a process cannot be started.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>

#include "launcher/process/process_runner.hpp"
#include "launcher/process/spawn/program_search.hpp"
#include "temporary_directory.hpp"

namespace launch {
namespace {

class SpawnFailure : public testing::Test {
 protected:
  // The message of the failed start of argv[0], which must fail with `error`.
  std::string failure(const std::string& program, int error) const {
    ProcessSpec spec;
    spec.name = "test";
    spec.argv = {program};
    spec.environment = {{"PATH", directory.path()}};
    spec.working_directory = working_directory;
    try {
      runner->spawn(spec);
    } catch (const std::system_error& exception) {
      EXPECT_EQ(exception.code().value(), error);
      return exception.what();
    }
    ADD_FAILURE() << program << " was started";
    return {};
  }

  TemporaryDirectory directory;
  std::string working_directory;
  std::unique_ptr<ProcessRunner> runner = make_posix_process_runner();
};

TEST_F(SpawnFailure, OfAProgramThatIsNotOnThePath) {
  EXPECT_EQ(failure("talkr", ENOENT), "no program 'talkr' in the PATH of the process: No such file or directory");
}

TEST_F(SpawnFailure, OfAProgramThatIsOnThePathButNotExecutable) {
  const std::string file = directory.write("talker", "");
  EXPECT_EQ(failure("talker", EACCES), fmt::format("'{}' is not executable: Permission denied", file));
}

TEST_F(SpawnFailure, OfAMissingFile) {
  const std::string file = directory.path() + "/talker";
  EXPECT_EQ(failure(file, ENOENT), fmt::format("cannot find the program '{}': No such file or directory", file));
}

TEST_F(SpawnFailure, OfAFileThatIsNotExecutable) {
  const std::string file = directory.write("talker", "#!/bin/sh\n", 0644);
  EXPECT_EQ(failure(file, EACCES),
            fmt::format("'{}' is not executable (chmod +x makes it so): Permission denied", file));
}

TEST_F(SpawnFailure, OfADirectory) {
  EXPECT_EQ(failure(directory.path(), EACCES),
            fmt::format("the program '{}' is a directory: Permission denied", directory.path()));
}

TEST_F(SpawnFailure, OfAScriptWithoutItsInterpreter) {
  const std::string file = directory.write("talker.py", "#! /nowhere/python9 -u\n", 0755);
  EXPECT_EQ(failure(file, ENOENT),
            fmt::format("cannot run '/nowhere/python9', the interpreter of the script '{}': No such file or directory",
                        file));
}

TEST_F(SpawnFailure, OfATextFileWithoutAnInterpreterLine) {
  const std::string file = directory.write("talker", "echo hello\n", 0755);
  EXPECT_EQ(
      failure(file, ENOEXEC),
      fmt::format("'{}' is neither a program for this machine nor a script with a #! line: Exec format error", file));
}

TEST_F(SpawnFailure, InAMissingWorkingDirectory) {
  working_directory = "/nowhere/at/all";
  EXPECT_EQ(failure("/bin/true", ENOENT),
            "cannot enter the working directory '/nowhere/at/all': No such file or directory");
}

TEST_F(SpawnFailure, InAWorkingDirectoryThatIsAFile) {
  working_directory = directory.write("file", "");
  EXPECT_EQ(failure("/bin/true", ENOTDIR),
            fmt::format("the working directory '{}' is not a directory: Not a directory", working_directory));
}

TEST_F(SpawnFailure, OfARelativeProgramIsSearchedInTheWorkingDirectory) {
  working_directory = directory.path();
  directory.write("talker", "", 0644);
  EXPECT_EQ(failure("./talker", EACCES), "'./talker' is not executable (chmod +x makes it so): Permission denied");
}

TEST_F(SpawnFailure, OfALinkToItself) {
  const std::string link = directory.path() + "/talker";
  std::filesystem::create_symlink(link, link);
  EXPECT_EQ(failure(link, ELOOP), fmt::format("cannot find the program '{}': Too many levels of symbolic links", link));
}

TEST_F(SpawnFailure, OfANameThatIsTooLong) {
  const std::string name = "/" + std::string(300, 'x');
  EXPECT_EQ(failure(name, ENAMETOOLONG), fmt::format("cannot find the program '{}': File name too long", name));
}

TEST_F(SpawnFailure, BelowAFile) {
  const std::string file = directory.write("file", "", 0755);
  EXPECT_EQ(failure(file + "/talker", ENOTDIR),
            fmt::format("cannot find the program '{}/talker': Not a directory", file));
}

TEST_F(SpawnFailure, OfAProgramThatIsBeingWritten) {
  const std::string file = directory.path() + "/talker";
  std::filesystem::copy_file("/bin/true", file);
  const std::ofstream writer(file, std::ios::app);
  EXPECT_EQ(failure(file, ETXTBSY), fmt::format("cannot run the program '{}': Text file busy", file));
}

TEST_F(SpawnFailure, WithTooManyArguments) {
  ProcessSpec spec;
  spec.argv = {"/bin/true", std::string(8 * 1024 * 1024, 'x')};
  EXPECT_EQ(std::string(spawn_failure(E2BIG, spec, "/bin/true").what()),
            "the arguments and the environment of '/bin/true' are too long: Argument list too long");
}

TEST_F(SpawnFailure, LeavesNoDescriptorOpen) {
  const auto count = [] {
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator());
  };
  const auto before = count();
  failure(directory.path() + "/missing", ENOENT);
  EXPECT_EQ(count(), before);
}

}  // namespace
}  // namespace launch
