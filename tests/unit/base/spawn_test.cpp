// SPDX-License-Identifier: Apache-2.0
#include "base/processes/spawn.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "base/files/pipe.hpp"
#include "tests/support/emulated.hpp"

namespace launch {
namespace {

struct Ended {
  std::string output;
  int status = 0;
};

// Starts a program with its standard output in a pipe of ours.
Ended run(ChildProgram child) {
  Pipe pipe = make_pipe();
  child.descriptors.push_back({STDOUT_FILENO, pipe.write.get()});
  const pid_t pid = spawn(child);
  pipe.write.reset();
  std::string output = read_to_end(pipe.read);
  return {std::move(output), wait_for(pid)};
}

ChildProgram shell(const std::string& command) {
  return {.program = "/bin/sh", .argv = {"sh", "-c", command}};
}

// A mask of signals in hexadecimal, as proc(5) shows it: "SigBlk", "SigIgn".
unsigned long long signals_of_child(const ChildProgram& child, const std::string& name) {
  const Ended ended = run(child);
  const std::size_t found = ended.output.find(name + ":");
  return found == std::string::npos ? 0 : std::stoull(ended.output.substr(found + name.size() + 1), nullptr, 16);
}

constexpr unsigned long long bit(int signal) {
  return 1ULL << (signal - 1);
}

TEST(Spawn, GivesArgumentsAndTellsTheExitCode) {
  const Ended ended = run({.program = "/bin/sh", .argv = {"sh", "-c", "echo $0 $1; exit 3", "name", "one two"}});
  EXPECT_EQ(ended.output, "name one two\n");
  EXPECT_TRUE(WIFEXITED(ended.status));
  EXPECT_EQ(WEXITSTATUS(ended.status), 3);
}

TEST(Spawn, GivesTheEnvironmentOrThatOfThisProcess) {
  ASSERT_EQ(::setenv("OF_THE_TEST", "ours", 1), 0);
  ChildProgram child = shell("echo $OF_THE_TEST $OTHER");
  EXPECT_EQ(run(child).output, "ours\n");
  const std::map<std::string, std::string> variables = {{"OF_THE_TEST", "theirs"}, {"OTHER", "a=b"}};
  child.environment = &variables;
  EXPECT_EQ(run(child).output, "theirs a=b\n");
  const std::map<std::string, std::string> none;
  child.environment = &none;
  EXPECT_EQ(run(child).output, "\n");
}

TEST(Spawn, ChangesTheDirectoryOfTheChildAlone) {
  ChildProgram child = shell("pwd");
  child.directory = "/proc";
  EXPECT_EQ(run(child).output, "/proc\n");
}

TEST(Spawn, OpensTheNullDeviceForReadingOrWriting) {
  ChildProgram child = shell("cat; echo lost >&2; echo end");
  child.descriptors = {{STDIN_FILENO, kDevNull}, {STDERR_FILENO, kDevNull}};
  EXPECT_EQ(run(child).output, "end\n");
}

TEST(Spawn, GivesADescriptorAnyNumber) {
  Pipe extra = make_pipe();
  ChildProgram child = shell("echo extra >&7");
  child.descriptors = {{7, extra.write.get()}};
  run(child);
  extra.write.reset();
  EXPECT_EQ(read_to_end(extra.read), "extra\n");
}

TEST(Spawn, ClosesAllOthersOnRequest) {
  NEEDS_VFORK();
  const UniqueFd inherited(::dup(STDIN_FILENO));  // not close-on-exec
  ChildProgram child = shell("ls /proc/self/fd | wc -l");
  child.descriptors = {{STDIN_FILENO, kDevNull}};
  const int with_others = std::stoi(run(child).output);
  child.only_given_descriptors = true;
  // ls opens one itself for the listing.
  EXPECT_EQ(run(child).output, "4\n");
  EXPECT_GT(with_others, 4);
}

TEST(Spawn, KeepsGivenDescriptorsAmongThoseThatItCloses) {
  NEEDS_VFORK();
  Pipe extra = make_pipe();
  const UniqueFd far(::fcntl(extra.write.get(), F_DUPFD, 700));  // not close-on-exec
  ChildProgram child = shell("echo seven >&7; echo nine >&9; ls /proc/self/fd | tr '\\n' ' '; echo");
  child.descriptors = {{9, far.get()}, {7, far.get()}, {STDIN_FILENO, kDevNull}};
  child.only_given_descriptors = true;
  EXPECT_EQ(run(child).output, "0 1 2 3 7 9 \n") << "3 is the directory that ls reads";
  extra.write.reset();
  EXPECT_EQ(::fcntl(far.get(), F_GETFD), 0) << "the descriptors of this process are as they were";
}

TEST(Spawn, GivesALimitOfOpenFilesFromTheFirstInstructionOn) {
  ChildProgram child{.program = "/bin/sh", .argv = {"sh", "-c", "ulimit -n"}};
  child.open_files = rlimit{77, 99};
  EXPECT_EQ(run(child).output, "77\n");
}

TEST(Spawn, FailsInTheChildWithoutATrace) {
  NEEDS_VFORK();
  EXPECT_THROW(spawn({.program = "/bin/true", .argv = {"true"}, .directory = "/nowhere"}), SpawnError);
  EXPECT_THROW(
      spawn({.program = "/bin/true", .argv = {"true"}, .descriptors = {{1, 77777}}, .only_given_descriptors = true}),
      SpawnError);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
  EXPECT_EQ(run(shell("echo goes on")).output, "goes on\n");
}

TEST(Spawn, RunsNoHandlerOfThisProcessInTheChild) {
  const auto before = ::signal(SIGUSR1, [](int) { ::_exit(99); });
  EXPECT_FALSE(signals_of_child({.program = "/bin/cat", .argv = {"cat", "/proc/self/status"}}, "SigCgt") &
               bit(SIGUSR1));
  ::signal(SIGUSR1, before);
}

TEST(Spawn, PutsTheChildIntoAGroupOrSessionOfItsOwn) {
  const std::string numbers =
      "read -r pid name state parent group session rest </proc/self/stat; "
      "echo $((pid == group)) $((pid == session))";
  ChildProgram child = shell(numbers);
  EXPECT_EQ(run(child).output, "0 0\n");
  child.group = ChildGroup::kOwn;
  EXPECT_EQ(run(child).output, "1 0\n");
  child.group = ChildGroup::kOwnSession;
  EXPECT_EQ(run(child).output, "1 1\n");
}

TEST(Spawn, GivesSignalsAsAsked) {
  sigset_t blocked;
  sigset_t before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGUSR1);
  ASSERT_EQ(::pthread_sigmask(SIG_BLOCK, &blocked, &before), 0);
  const auto handler = ::signal(SIGUSR2, SIG_IGN);
  ChildProgram child{.program = "/bin/cat", .argv = {"cat", "/proc/self/status"}};

  EXPECT_TRUE(signals_of_child(child, "SigBlk") & bit(SIGUSR1));
  EXPECT_TRUE(signals_of_child(child, "SigIgn") & bit(SIGUSR2));
  child.signals = ChildSignals::kNoneBlocked;
  EXPECT_EQ(signals_of_child(child, "SigBlk"), 0U);
  EXPECT_TRUE(signals_of_child(child, "SigIgn") & bit(SIGUSR2));
  child.signals = ChildSignals::kFresh;
  EXPECT_EQ(signals_of_child(child, "SigBlk"), 0U);
  EXPECT_FALSE(signals_of_child(child, "SigIgn") & bit(SIGUSR2));
  child.signals = ChildSignals::kAllBlocked;
  EXPECT_TRUE(signals_of_child(child, "SigBlk") & bit(SIGTERM));

  ::signal(SIGUSR2, handler);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST(Spawn, LooksInPathOnlyOnRequest) {
  NEEDS_VFORK();
  ChildProgram child{.program = "sh", .argv = {"sh", "-c", "echo found"}};
  EXPECT_THROW(run(child), SpawnError);
  child.search_path = true;
  EXPECT_EQ(run(child).output, "found\n");
}

TEST(Spawn, TellsWhyAProgramCannotBeStarted) {
  NEEDS_VFORK();
  try {
    spawn({.program = "/no/such/program", .argv = {"program"}});
    FAIL() << "it was started";
  } catch (const SpawnError& error) {
    EXPECT_EQ(error.code().value(), ENOENT);
    EXPECT_STREQ(error.what(), "cannot start '/no/such/program': No such file or directory");
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "no child is left";
}

TEST(Spawn, WaitsForTheEndAsLongAsTold) {
  const pid_t pid = spawn({.program = "/bin/sleep", .argv = {"sleep", "1000"}});
  EXPECT_FALSE(ends_within(pid, std::chrono::milliseconds(1)));
  ::kill(pid, SIGKILL);
  EXPECT_TRUE(ends_within(pid, std::chrono::seconds(60)));
  EXPECT_TRUE(WIFSIGNALED(wait_for(pid))) << "it was not reaped before";
  EXPECT_TRUE(ends_within(pid, std::chrono::seconds(60))) << "there is no such process any more";
}

TEST(Pipe, IsClosedInChildrenThatGetNoCopy) {
  Pipe pipe = make_pipe();
  const pid_t pid = spawn({.program = "/bin/sh", .argv = {"sh", "-c", "kill -STOP $$"}});
  siginfo_t info{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(pid), &info, WSTOPPED), 0);
  pipe.write.reset();
  EXPECT_EQ(read_to_end(pipe.read), "") << "ends although the child runs";
  ::kill(pid, SIGKILL);
  EXPECT_TRUE(WIFSIGNALED(wait_for(pid)));
}

}  // namespace
}  // namespace launch
