// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/isolation/namespaces.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <signal.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#if __has_include(<lttng/ust-ctl.h>)
#include <lttng/ust-ctl.h>
#endif

#include "base/environment/network_device.hpp"
#include "base/files/pipe.hpp"
#include "launcher/process/exec/launch_exec_protocol.hpp"
#include "launcher/process/isolation/packet_switch.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {

namespace {

constexpr const char* kSharedMemory = "/dev/shm";
// In /dev/shm: memory with which LTTng's session daemon wakes the traced programs that have started before it. The
// daemon of root uses the first name, those of users add their numbers. The number at its end is the version of their
// interface: 8 for LTTng 2.13, 11 for 2.16.
constexpr std::string_view kWaitFile = "lttng-ust-wait-";
#if __has_include(<lttng/ust-ctl.h>)
constexpr const char* kWaitFileOfRoot = LTTNG_UST_WAIT_FILENAME;
#else
constexpr const char* kWaitFileOfRoot = "lttng-ust-wait-8";
#endif

// Descriptors of a launcher that has just started have smaller numbers than this, and those of launch-exec, too.
constexpr int kFirstFile = 16;

// What a process that makes the namespaces reports, with the descriptor of the network of a host.
struct Report {
  std::array<char, 48> step;  // empty: all went well
  int error;
};

// A message with a descriptor, if there is one.
class Message {
 public:
  explicit Message(Report& report) : part_{&report, sizeof report} {
    header_.msg_iov = &part_;
    header_.msg_iovlen = 1;
    header_.msg_control = control_;
    header_.msg_controllen = sizeof control_;
  }

  bool send(int socket, int descriptor) {
    if (descriptor < 0) {
      header_.msg_controllen = 0;
    } else {
      cmsghdr* const rights = CMSG_FIRSTHDR(&header_);
      rights->cmsg_level = SOL_SOCKET;
      rights->cmsg_type = SCM_RIGHTS;
      rights->cmsg_len = CMSG_LEN(sizeof descriptor);
      ::memcpy(CMSG_DATA(rights), &descriptor, sizeof descriptor);
    }
    return ::sendmsg(socket, &header_, MSG_NOSIGNAL) == static_cast<ssize_t>(part_.iov_len);
  }

  bool receive(int socket, UniqueFd& descriptor) {
    if (::recvmsg(socket, &header_, MSG_CMSG_CLOEXEC) != static_cast<ssize_t>(part_.iov_len)) {
      return false;
    }
    if (const cmsghdr* const rights = CMSG_FIRSTHDR(&header_)) {
      int received = -1;
      ::memcpy(&received, CMSG_DATA(rights), sizeof received);
      descriptor.reset(received);
    }
    return true;
  }

 private:
  iovec part_;
  msghdr header_{};
  alignas(cmsghdr) char control_[CMSG_SPACE(sizeof(int))] = {};
};

class Maker {
 public:
  // Without a host, there is no network but lo.
  Maker(int reports, std::optional<unsigned> host) : reports_(reports), host_(host) {}

  void make(bool user) {
    const uid_t uid = ::geteuid();
    const gid_t gid = ::getegid();
    check("unshare", ::unshare((user ? CLONE_NEWUSER : 0) | CLONE_NEWNET | CLONE_NEWIPC | CLONE_NEWNS));
    if (user) {
      // Without privileges a process may map its own user and group only, and must give up setgroups(2) before.
      write_file("/proc/self/setgroups", "deny");
      write_file("/proc/self/uid_map", fmt::format("{0} {0} 1", uid));
      write_file("/proc/self/gid_map", fmt::format("{0} {0} 1", gid));
    }
    // Disks that are mounted later appear inside, and nothing that is mounted inside appears outside.
    check("make mounts private", ::mount(nullptr, "/", nullptr, MS_REC | MS_SLAVE, nullptr));
    mount_shared_memory();
    errno = bring_up_loopback(host_.has_value());
    check("bring up lo", errno == 0 ? 0 : -1);
    UniqueFd device;
    if (host_) {
      device = make_tap_device(*host_);
      check("make a network device with /dev/net/tun", device ? 0 : -1);
    }
    check_root();
    report("", 0, device.get());
  }

 private:
  void report(const char* step, int error, int descriptor = -1) const {
    Report report{{}, error};
    fmt::format_to_n(report.step.data(), report.step.size() - 1, "{}", step);
    Message(report).send(reports_, descriptor);
  }

  void check(const char* step, int result) const {
    if (result != 0) {
      report(step, errno);
      ::_exit(1);
    }
  }

  void write_file(const char* path, std::string_view text) const {
    const UniqueFd file(::open(path, O_WRONLY | O_CLOEXEC));
    const bool written = file && ::write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
    check(path, written ? 0 : -1);
  }

  void mount_shared_memory() const {
    std::vector<std::pair<std::string, UniqueFd>> kept;
    if (DIR* const directory = ::opendir(kSharedMemory)) {
      while (const dirent* const entry = ::readdir(directory)) {
        if (std::string_view(entry->d_name).starts_with(kWaitFile)) {
          const std::string path = fmt::format("{}/{}", kSharedMemory, entry->d_name);
          kept.emplace_back(path, UniqueFd(::open(path.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC)));
        }
      }
      ::closedir(directory);
    }
    check("mount /dev/shm", ::mount("tmpfs", kSharedMemory, "tmpfs", MS_NOSUID | MS_NODEV, "mode=1777"));
    for (const auto& [path, file] : kept) {
      // Processes that LTTng does not wake are traced all the same if a session daemon runs before them.
      const UniqueFd point(::open(path.c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0600));
      const std::string source = fmt::format("/proc/self/fd/{}", file.get());
      static_cast<void>(!::mount(source.c_str(), path.c_str(), nullptr, MS_BIND, nullptr));
    }
  }

  // A process that enters a mount namespace is in the root of it, even if it was in another one (chroot).
  void check_root() const {
    struct stat before {};
    struct stat after {};
    const UniqueFd own(::open("/proc/self/ns/mnt", O_RDONLY | O_CLOEXEC));
    check("look at /", ::stat("/", &before));
    check("enter the mount namespace", ::setns(own.get(), CLONE_NEWNS));
    check("look at /", ::stat("/", &after));
    errno = EPERM;
    check("keep the root directory", before.st_dev == after.st_dev && before.st_ino == after.st_ino ? 0 : -1);
  }

  int reports_;
  std::optional<unsigned> host_;
};

// As a traced program makes the file that is missing when it starts: the session daemon will open it. Inside, a file
// that is made later would be another one than that of the daemon.
void make_wait_file(const std::string& name, mode_t mode) {
  const std::string path = fmt::format("{}/{}", kSharedMemory, name);
  const UniqueFd file(::open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, mode));
  if (file) {
    static_cast<void>(::fchmod(file.get(), mode));  // whatever the umask says
    // A page that gets no memory later, because /dev/shm is full then, ends the program that reads it by SIGBUS.
    if (::posix_fallocate(file.get(), 0, ::sysconf(_SC_PAGESIZE)) != 0) {
      ::unlink(path.c_str());
    }
  }
}

void make_wait_files() {
  make_wait_file(kWaitFileOfRoot, 0644);
  make_wait_file(fmt::format("{}-{}", kWaitFileOfRoot, ::getuid()), 0640);
}

// Throws std::system_error.
std::vector<UniqueFd> open_namespaces(pid_t process, bool user) {
  std::vector<UniqueFd> files;
  for (const char* const name : {"user", "net", "ipc", "mnt"}) {
    if (!user && std::string_view(name) == "user") {
      continue;
    }
    const std::string path = fmt::format("/proc/{}/ns/{}", process, name);
    const UniqueFd file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    files.emplace_back(file ? ::fcntl(file.get(), F_DUPFD_CLOEXEC, kFirstFile) : -1);
    if (!files.back()) {
      throw std::system_error(errno, std::system_category(), path);
    }
  }
  return files;
}

// A process makes the namespaces and waits until they have been opened. Throws std::system_error.
std::vector<UniqueFd> make_namespaces(bool user, std::optional<unsigned> host, UniqueFd& device) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) {
    throw std::system_error(errno, std::system_category(), "socketpair");
  }
  Pipe reports{UniqueFd(ends[0]), UniqueFd(ends[1])};
  Pipe end = make_pipe();
  const pid_t maker = ::fork();
  if (maker < 0) {
    throw std::system_error(errno, std::system_category(), "fork");
  }
  if (maker == 0) {
    end.write.reset();
    Maker(reports.write.get(), host).make(user);
    char nothing = 0;
    static_cast<void>(!::read(end.read.get(), &nothing, 1));
    ::_exit(0);
  }
  struct Reaper {
    Pipe& end;
    pid_t pid;
    ~Reaper() {
      end.write.reset();
      wait_for(pid);
    }
  } reaper{end, maker};
  reports.write.reset();
  Report report{};
  if (!Message(report).receive(reports.read.get(), device)) {
    throw std::system_error(ECHILD, std::system_category(), "the process that makes namespaces");
  }
  if (report.step[0] != '\0') {
    throw std::system_error(report.error, std::system_category(), report.step.data());
  }
  return open_namespaces(maker, user);
}

std::vector<UniqueFd> make_namespaces(std::optional<unsigned> host, UniqueFd& device) {
  make_wait_files();
  try {
    return make_namespaces(false, host, device);
  } catch (const std::system_error&) {
    return make_namespaces(true, host, device);  // its error tells more: this is what a user without privileges may do
  }
}

}  // namespace

Namespaces Namespaces::make() {
  UniqueFd none;
  return Namespaces(make_namespaces(std::nullopt, none));
}

Namespaces::Host Namespaces::make_host(unsigned host) {
  UniqueFd device;
  Namespaces namespaces(make_namespaces(host, device));
  return {std::move(namespaces), std::move(device)};
}

std::string Namespaces::step() const {
  return fmt::format("{}{}", kStepNamespaces, files_.size());
}

std::vector<ChildDescriptor> Namespaces::descriptors() const {
  std::vector<ChildDescriptor> all;
  for (const UniqueFd& file : files_) {
    all.push_back({kLaunchExecNamespaces + static_cast<int>(all.size()), file.get()});
  }
  return all;
}

void Namespaces::put_in(ChildProgram& child) const {
  const std::string exec_program = default_exec_program();
  child.argv.insert(child.argv.begin(), {exec_program, step(), std::string(1, kStepExec), child.program});
  child.program = exec_program;
  child.descriptors.push_back({kLaunchExecError, kDevNull});
  for (const ChildDescriptor& descriptor : descriptors()) {
    child.descriptors.push_back(descriptor);
  }
}

Isolation make_isolation() {
  Isolation isolation;
  try {
    isolation.namespaces.emplace(Namespaces::make());
  } catch (const std::system_error& error) {
    isolation.refused = error.what();
    isolation.domain.emplace();
  }
  return isolation;
}

}  // namespace launch
