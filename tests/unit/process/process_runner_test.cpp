// SPDX-License-Identifier: Apache-2.0
// The posix runner on real processes. Each test waits for descriptors, never for time.
#include "launcher/process/process_runner.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <sstream>
#include <vector>

#include "temporary_directory.hpp"

namespace launch {
namespace {

constexpr int kPatience = 30'000;  // milliseconds, before a test fails

bool wait_for(int fd) {
  pollfd descriptor{fd, POLLIN, 0};
  return ::poll(&descriptor, 1, kPatience) == 1;
}

std::string read_line(int fd) {
  std::string line;
  char byte = 0;
  while (wait_for(fd) && ::read(fd, &byte, 1) == 1 && byte != '\n') {
    line.push_back(byte);
  }
  return line;
}

std::string read_to_end(int fd) {
  std::string text;
  std::array<char, 4096> buffer{};
  while (wait_for(fd)) {
    const ssize_t size = ::read(fd, buffer.data(), buffer.size());
    if (size <= 0) {
      break;
    }
    text.append(buffer.data(), static_cast<std::size_t>(size));
  }
  return text;
}

class Runner : public testing::Test {
 protected:
  static ProcessSpec command(std::vector<std::string> argv) {
    ProcessSpec spec;
    spec.name = "test";
    spec.argv = std::move(argv);
    spec.environment = {{"PATH", "/usr/bin:/bin"}};
    return spec;
  }
  static ProcessSpec script(const std::string& text) { return command({"/bin/sh", "-c", text}); }

  ProcessExit wait(const Process& process) const {
    EXPECT_TRUE(wait_for(process.pidfd.get()));
    return runner->reap(process);
  }
  std::string output_of(const ProcessSpec& spec) const {
    const Process process = runner->spawn(spec);
    std::string text = read_to_end(process.out.get());
    EXPECT_EQ(wait(process).code, 0);
    return text;
  }

  std::unique_ptr<ProcessRunner> runner = make_posix_process_runner();
};

TEST_F(Runner, ReportsExitCodes) {
  EXPECT_EQ(wait(runner->spawn(script("exit 0"))).code, 0);
  EXPECT_EQ(wait(runner->spawn(script("exit 42"))).code, 42);
}

TEST_F(Runner, ReportsADeathBySignalAsANegativeCode) {
  EXPECT_EQ(wait(runner->spawn(script("kill -SEGV $$"))).code, -SIGSEGV);
}

TEST_F(Runner, TellsWhetherAGroupLivesWhoseLeaderHasExited) {
  const Process with_child = runner->spawn(script("sleep 1000 & echo $!"));
  const pid_t child = std::stoi(read_line(with_child.out.get()));
  const UniqueFd end_of_child(static_cast<int>(::syscall(SYS_pidfd_open, child, 0)));
  // Its first line comes when it has left.
  const Process with_daemon = runner->spawn(script("setsid -f sh -c 'echo $$; exec sleep 1000'"));
  const pid_t daemon = std::stoi(read_line(with_daemon.out.get()));
  ASSERT_TRUE(wait_for(with_child.pidfd.get()) && wait_for(with_daemon.pidfd.get()));
  EXPECT_EQ(runner->groups_live({&with_daemon, &with_child}), (std::vector<bool>{false, true}));
  ::kill(daemon, SIGKILL);
  ::kill(child, SIGKILL);
  EXPECT_EQ(read_to_end(with_child.out.get()), "") << "the end of the child closes the pipe";
  // A process closes its files some time before it counts as ended.
  ASSERT_TRUE(wait_for(end_of_child.get()));
  EXPECT_EQ(runner->groups_live({&with_child}), (std::vector<bool>{false}));
  EXPECT_EQ(wait(with_child).code, 0);
  EXPECT_EQ(wait(with_daemon).code, 0);
}

TEST_F(Runner, ReportsResourceUsage) {
  EXPECT_GT(wait(runner->spawn(script("exit 0"))).usage.ru_maxrss, 0);
}

TEST_F(Runner, TellsTheOutcomeWithoutReaping) {
  const Process process = runner->spawn(script("exit 7"));
  ASSERT_TRUE(wait_for(process.pidfd.get()));
  EXPECT_EQ(runner->outcome(process).code, 7);
  EXPECT_EQ(::kill(process.pid, 0), 0) << "still a zombie";
  EXPECT_EQ(runner->reap(process).code, 7);
  EXPECT_EQ(::kill(process.pid, 0), -1);
}

TEST_F(Runner, GivesTheEnvironmentOfTheSpecAndNoMore) {
  ::setenv("LAUNCH_TEST_OF_LAUNCHER", "1", 1);
  ProcessSpec spec = command({"/usr/bin/env"});
  spec.environment = {{"A", "1"}, {"EMPTY", ""}, {"B", "two words=yes"}};
  EXPECT_EQ(output_of(spec), "A=1\nB=two words=yes\nEMPTY=\n");
}

TEST_F(Runner, ChangesTheWorkingDirectory) {
  const TemporaryDirectory directory;
  ProcessSpec spec = command({"/bin/pwd"});
  spec.working_directory = directory.path();
  EXPECT_EQ(output_of(spec), std::filesystem::canonical(directory.path()).string() + "\n");
}

TEST_F(Runner, SearchesThePathOfTheProcessNotOfTheLauncher) {
  const TemporaryDirectory directory;
  directory.write("only-here", "#!/bin/sh\necho found $1\n", 0755);
  ProcessSpec spec = command({"only-here", "it"});
  spec.environment["PATH"] = "/nowhere:" + directory.path();
  EXPECT_EQ(output_of(spec), "found it\n");
}

TEST_F(Runner, ResolvesRelativePathEntriesInTheWorkingDirectoryOfTheProcess) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory.path() + "/bin");
  directory.write("bin/tool", "#!/bin/sh\necho here\n", 0755);
  ProcessSpec spec = command({"tool"});
  spec.environment["PATH"] = "/nowhere:bin";
  spec.working_directory = directory.path();
  EXPECT_EQ(output_of(spec), "here\n");
}

TEST_F(Runner, SkipsFilesOnThePathThatAreNotExecutable) {
  const TemporaryDirectory first;
  const TemporaryDirectory second;
  first.write("tool", "not a program", 0644);
  std::filesystem::create_directory(second.path() + "/tool");
  const TemporaryDirectory third;
  third.write("tool", "#!/bin/sh\necho third\n", 0755);
  ProcessSpec spec = command({"tool"});
  spec.environment["PATH"] = first.path() + ":" + second.path() + ":" + third.path();
  EXPECT_EQ(output_of(spec), "third\n");
}

TEST_F(Runner, FindsStandardProgramsWithoutAPath) {
  ProcessSpec spec = command({"echo", "hello"});
  spec.environment = {};
  EXPECT_EQ(output_of(spec), "hello\n");
}

TEST_F(Runner, JoinsArgumentsForTheShell) {
  ProcessSpec spec = command({"for", "i", "in", "1", "2;", "do", "echo", "$i;", "done"});
  spec.shell = true;
  EXPECT_EQ(output_of(spec), "1\n2\n");
}

TEST_F(Runner, KeepsStreamsApart) {
  const Process process = runner->spawn(script("echo out; echo err >&2"));
  EXPECT_EQ(read_to_end(process.out.get()), "out\n");
  EXPECT_EQ(read_to_end(process.err.get()), "err\n");
  EXPECT_EQ(wait(process).code, 0);
}

TEST_F(Runner, GivesAStandardInputThatStaysOpenAndEmpty) {
  // cat would end at the end of its input, but it only ends when it gets a signal.
  const Process process = runner->spawn(script("echo ready; exec cat"));
  EXPECT_EQ(read_line(process.out.get()), "ready");
  pollfd exited{process.pidfd.get(), POLLIN, 0};
  EXPECT_EQ(::poll(&exited, 1, 0), 0);
  runner->signal_group(process, SIGTERM);
  EXPECT_EQ(wait(process).code, -SIGTERM);
}

TEST_F(Runner, GivesAPseudoTerminalForEachStream) {
  ProcessSpec spec = script("test -t 1 && test -t 2 && test ! -t 0 && echo terminal && echo error >&2");
  spec.emulate_tty = true;
  const Process process = runner->spawn(spec);
  EXPECT_EQ(read_line(process.out.get()), "terminal\r");
  EXPECT_EQ(read_line(process.err.get()), "error\r");
  EXPECT_EQ(wait(process).code, 0);
  // Linux reports the end of a pseudo-terminal as an error.
  char byte = 0;
  EXPECT_EQ(::read(process.out.get(), &byte, 1), -1);
  EXPECT_EQ(errno, EIO);
}

TEST_F(Runner, GivesATerminalOfItsOwnForAllStreams) {
  ProcessSpec spec = script(
      "test -t 0 && test -t 1 && test -t 2 && stty size && echo error >&2 && read word </dev/tty && echo got $word;"
      "read -r pid name state parent group session rest </proc/$$/stat; test $$ = $session && exec sleep 1000");
  spec.tty = true;
  const Process process = runner->spawn(spec);
  EXPECT_FALSE(process.err);
  EXPECT_EQ(read_line(process.out.get()), "24 80\r");
  EXPECT_EQ(read_line(process.out.get()), "error\r");
  ASSERT_EQ(::write(process.in.get(), "key\r", 4), 4);
  EXPECT_EQ(read_line(process.out.get()), "key\r") << "the echo";
  EXPECT_EQ(read_line(process.out.get()), "got key\r");
  ASSERT_EQ(::write(process.in.get(), "\003", 1), 1);
  EXPECT_EQ(wait(process).code, -SIGINT) << "Ctrl-C is a signal for it";
}

TEST_F(Runner, WithoutEmulatedTerminalNothingIsATerminal) {
  EXPECT_EQ(output_of(script("test -t 0 || test -t 1 || test -t 2 || echo none")), "none\n");
}

TEST_F(Runner, LeaksNoDescriptorIntoChildren) {
  const Process neighbour = runner->spawn(command({"sleep", "1000"}));
  const int inherited = ::open("/dev/null", O_RDONLY);  // a library without O_CLOEXEC leaves such a descriptor
  ASSERT_GT(inherited, 2);
  const std::string list = output_of(script("ls /proc/$$/fd"));
  std::istringstream words(list);
  EXPECT_THAT((std::vector<std::string>{std::istream_iterator<std::string>(words), {}}),
              testing::ElementsAre("0", "1", "2"));
  ::close(inherited);
  runner->signal_group(neighbour, SIGKILL);
  wait(neighbour);
}

TEST_F(Runner, StartsChildrenWithDefaultSignalsUnblocked) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, &before);
  const auto old = ::signal(SIGUSR1, SIG_IGN);
  const std::string status = output_of(command({"/bin/grep", "-E", "^Sig(Blk|Ign):", "/proc/self/status"}));
  ::signal(SIGUSR1, old);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  // Signals 32 and 33 belong to the C library.
  EXPECT_THAT(status, testing::AnyOf("SigBlk:\t0000000000000000\nSigIgn:\t0000000000000000\n",
                                     "SigBlk:\t0000000000000000\nSigIgn:\t0000000180000000\n"));
}

TEST_F(Runner, PutsEachProcessIntoAGroupOfItsOwn) {
  const Process process = runner->spawn(command({"sleep", "1000"}));
  EXPECT_EQ(::getpgid(process.pid), process.pid);
  runner->signal_group(process, SIGKILL);
  EXPECT_EQ(wait(process).code, -SIGKILL);
}

TEST_F(Runner, SignalsTheWholeGroup) {
  const Process process = runner->spawn(script("sleep 1000 & echo $!; wait"));
  const pid_t grandchild = std::stoi(read_line(process.out.get()));
  EXPECT_EQ(::getpgid(grandchild), process.pid);
  runner->signal_group(process, SIGTERM);
  EXPECT_EQ(wait(process).code, -SIGTERM);
  EXPECT_EQ(read_to_end(process.out.get()), "") << "its end: the grandchild has gone, too";
}

TEST_F(Runner, SignalsAGroupThatHasGoneWithoutAnError) {
  const Process process = runner->spawn(script("exit 0"));
  ASSERT_TRUE(wait_for(process.pidfd.get()));
  EXPECT_NO_THROW(runner->signal_group(process, SIGKILL));
  EXPECT_EQ(runner->reap(process).code, 0) << "signals come too late for a zombie";
}

TEST_F(Runner, WakesAStoppedGroupForSigterm) {
  const Process process = runner->spawn(command({"sleep", "1000"}));
  runner->signal_group(process, SIGSTOP);
  runner->signal_group(process, SIGTERM);
  EXPECT_EQ(wait(process).code, -SIGTERM);
}

TEST_F(Runner, RaisesItsOwnLimitOfDescriptorsButNotThatOfChildren) {
  rlimit original{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &original), 0);
  const rlimit low{100, original.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &low), 0);
  runner = make_posix_process_runner();
  rlimit raised{};
  ::getrlimit(RLIMIT_NOFILE, &raised);
  EXPECT_EQ(raised.rlim_cur, original.rlim_max);

  // The limit is set right after the start, so the test reads it when the process has certainly been started.
  const Process process = runner->spawn(command({"sleep", "1000"}));
  rlimit of_child{};
  ASSERT_EQ(::prlimit(process.pid, RLIMIT_NOFILE, nullptr, &of_child), 0);
  EXPECT_EQ(of_child.rlim_cur, 100U);
  runner->signal_group(process, SIGKILL);
  wait(process);
  ::setrlimit(RLIMIT_NOFILE, &original);
}

}  // namespace
}  // namespace launch
