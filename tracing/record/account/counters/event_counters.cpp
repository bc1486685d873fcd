// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/counters/event_counters.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/files/replace_file.hpp"
#include "base/files/unique_fd.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "ROS2CNT2";
constexpr std::size_t kNameSize = 64;        // bytes
constexpr std::uint64_t kMostEvents = 4096;  // a file that says more is none

// The beginning of a file; the names of the events and the blocks of their counters follow.
struct Header {
  char magic[8];
  std::uint32_t events;
  std::uint32_t blocks;
  std::uint64_t pid;
  std::uint64_t begin;
  std::uint64_t end;
  std::uint64_t cpu;
  std::uint64_t blocks_used;
  std::uint64_t reached;
  std::uint64_t missed;
  char process[kNameSize];
};

std::string text(const char* name) {
  return {name, strnlen(name, kNameSize)};
}

// The process of the file PID-BEGIN has ended. A process in a container has another number here, but it keeps its file
// locked as long as it runs.
bool has_ended(const fs::path& file) {
  const std::string name = file.filename();
  pid_t pid = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), pid);
  if (error != std::errc() || end == name.data() + name.size() || *end != '-' || pid <= 0) {
    return false;
  }
  if (kill(pid, 0) == 0 || errno != ESRCH) {
    return false;
  }
  const launch::UniqueFd opened(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  return opened && flock(opened.get(), LOCK_EX | LOCK_NB) == 0;
}

// The counts of processes that have ended, by the name of the counter file that each had, are in one file beside the
// counter files of those that run.
constexpr const char* kEndedFile = "ended.json";

// Empty if there is no such file.
std::map<std::string, EventCounts> read_ended_processes(const fs::path& directory) {
  std::map<std::string, EventCounts> ended;
  std::ifstream file(directory / kEndedFile);
  const nlohmann::json json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object()) {
    return ended;
  }
  for (const auto& [name, process] : json.items()) {
    ended.emplace(name, EventCounts{.pid = process.value("pid", std::int64_t{0}),
                                    .process = process.value("process", ""),
                                    .begin = process.value("begin", std::uint64_t{0}),
                                    .end = process.value("end", std::uint64_t{0}),
                                    .cpu = process.value("cpu", std::uint64_t{0}),
                                    .reached = process.value("reached", std::uint64_t{0}),
                                    .missed = process.value("missed", std::uint64_t{0}),
                                    .events = process.value("events", std::map<std::string, std::uint64_t>())});
  }
  return ended;
}

// Replaces the file as a whole. False if it cannot be written.
bool write_ended_processes(const fs::path& directory, const std::map<std::string, EventCounts>& ended) {
  nlohmann::json json = nlohmann::json::object();
  for (const auto& [name, process] : ended) {
    json[name] = {{"pid", process.pid},       {"process", process.process}, {"begin", process.begin},
                  {"end", process.end},       {"cpu", process.cpu},         {"reached", process.reached},
                  {"missed", process.missed}, {"events", process.events}};
  }
  try {
    launch::replace_file((directory / kEndedFile).string(),
                         json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  } catch (const std::system_error&) {
    return false;
  }
  return true;
}

}  // namespace

// Another process writes to it all the time.
class EventCounters::File {
 public:
  // Null when the file isn't complete (yet).
  static std::unique_ptr<File> open(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
      return nullptr;
    }
    struct stat status {};
    void* memory = MAP_FAILED;
    if (fstat(descriptor, &status) == 0 && static_cast<std::size_t>(status.st_size) >= sizeof(Header)) {
      memory = mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_SHARED, descriptor, 0);
    }
    close(descriptor);
    if (memory == MAP_FAILED) {
      return nullptr;
    }
    std::unique_ptr<File> file(new File(memory, static_cast<std::size_t>(status.st_size)));
    return file->is_complete() ? std::move(file) : nullptr;
  }
  ~File() { munmap(memory_, size_); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  EventCounts read() const {
    const Header& header = this->header();
    EventCounts counts{.pid = static_cast<std::int64_t>(header.pid),
                       .process = text(header.process),
                       .begin = header.begin,
                       .end = load(&header.end),
                       .cpu = load(&header.cpu),
                       .reached = load(&header.reached),
                       .missed = load(&header.missed),
                       .events = {}};
    const std::uint64_t used = std::min<std::uint64_t>(load(&header.blocks_used), header.blocks);
    for (std::uint32_t event = 0; event < header.events; ++event) {
      std::uint64_t sum = 0;
      for (std::uint64_t block = 0; block < used; ++block) {
        sum += load(counters() + block * header.events + event);
      }
      if (sum != 0) {
        counts.events.emplace(text(names() + event * kNameSize), sum);
      }
    }
    return counts;
  }

 private:
  File(void* memory, std::size_t size) : memory_(memory), size_(size) {}

  static std::uint64_t load(const std::uint64_t* value) { return __atomic_load_n(value, __ATOMIC_RELAXED); }
  const Header& header() const { return *static_cast<const Header*>(memory_); }
  const char* names() const { return static_cast<const char*>(memory_) + sizeof(Header); }
  const std::uint64_t* counters() const {
    return reinterpret_cast<const std::uint64_t*>(names() + header().events * kNameSize);
  }
  bool is_complete() const {
    return std::string_view(header().magic, kMagic.size()) == kMagic && header().events <= kMostEvents &&
           header().blocks <= kMostEvents &&
           size_ >= sizeof(Header) + header().events * (kNameSize + header().blocks * sizeof(std::uint64_t));
  }

  void* memory_;
  std::size_t size_;
};

EventCounters::EventCounters(fs::path directory) : directory_(std::move(directory)) {}

EventCounters::~EventCounters() = default;

std::vector<EventCounts> EventCounters::read() {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_, none)) {
    const std::string name = entry.path().filename();
    if (files_.contains(name)) {
      continue;
    }
    if (std::unique_ptr<File> file = File::open(entry.path())) {
      files_.emplace(name, std::move(file));
    }
  }
  // A process may be put away meanwhile. This file is therefore read last, and is right about the processes in it.
  std::vector<EventCounts> counts;
  for (auto& [name, ended] : read_ended_processes(directory_)) {
    files_.erase(name);
    counts.push_back(std::move(ended));
  }
  for (const auto& [name, file] : files_) {
    counts.push_back(file->read());
  }
  std::sort(counts.begin(), counts.end(), [](const EventCounts& a, const EventCounts& b) {
    return std::tie(a.begin, a.pid) < std::tie(b.begin, b.pid);
  });
  return counts;
}

void EventCounters::put_ended_processes_away(const fs::path& directory) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  utimensat(AT_FDCWD, directory.c_str(), nullptr, 0);
  std::map<std::string, EventCounts> ended = read_ended_processes(directory);
  std::vector<fs::path> put_away;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory, none)) {
    const std::string name = entry.path().filename();
    if (!ended.contains(name)) {  // else a launcher was killed before it removed the file
      if (!has_ended(entry.path())) {
        continue;
      }
      const std::unique_ptr<File> file = File::open(entry.path());
      if (!file) {
        continue;
      }
      ended.emplace(name, file->read());
    }
    put_away.push_back(entry.path());
  }
  if (put_away.empty() || !write_ended_processes(directory, ended)) {
    return;
  }
  for (const fs::path& file : put_away) {
    fs::remove(file, none);
  }
}

}  // namespace tracing
