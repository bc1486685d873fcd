// SPDX-License-Identifier: Apache-2.0
#include "tracing/account/event_counters.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <numeric>
#include <string_view>
#include <tuple>

namespace tracing {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDirectory = "/dev/shm/launch-event-counters-";
constexpr std::string_view kMagic = "ROS2CNT1";
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
  char process[kNameSize];
};

std::string text(const char* name) {
  return {name, strnlen(name, kNameSize)};
}

}  // namespace

std::uint64_t EventCounts::total() const {
  return std::accumulate(events.begin(), events.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const auto& event) { return sum + event.second; });
}

// Another process writes to it all the time.
class EventCounters::File {
 public:
  // Null when the file isn't complete (yet).
  static std::unique_ptr<File> open(const fs::path& path) {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return nullptr;
    struct stat status {};
    void* memory = MAP_FAILED;
    if (fstat(descriptor, &status) == 0 && static_cast<std::size_t>(status.st_size) >= sizeof(Header)) {
      memory = mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_SHARED, descriptor, 0);
    }
    close(descriptor);
    if (memory == MAP_FAILED) return nullptr;
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
                       .events = {}};
    const std::uint64_t used = std::min<std::uint64_t>(load(&header.blocks_used), header.blocks);
    for (std::uint32_t event = 0; event < header.events; ++event) {
      std::uint64_t sum = 0;
      for (std::uint64_t block = 0; block < used; ++block) sum += load(counters() + block * header.events + event);
      if (sum != 0) counts.events.emplace(text(names() + event * kNameSize), sum);
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

std::shared_ptr<EventCounterDirectory> EventCounterDirectory::shared() {
  static std::mutex mutex;
  static std::weak_ptr<EventCounterDirectory> existing;
  const std::lock_guard lock(mutex);
  if (std::shared_ptr<EventCounterDirectory> directory = existing.lock()) return directory;
  std::string path = std::string(kDirectory) + "XXXXXX";
  if (mkdtemp(path.data()) == nullptr) return nullptr;
  auto made = std::make_shared<EventCounterDirectory>(path);
  existing = made;
  return made;
}

EventCounterDirectory::~EventCounterDirectory() {
  if (!path_.string().starts_with(kDirectory)) return;  // whatever a command line says
  std::error_code none;
  fs::remove_all(path_, none);
}

EventCounters::EventCounters(fs::path directory) : directory_(std::move(directory)) {}

EventCounters::~EventCounters() = default;

std::vector<EventCounts> EventCounters::read() {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_, none)) {
    const std::string name = entry.path().filename();
    if (files_.contains(name)) continue;
    if (std::unique_ptr<File> file = File::open(entry.path())) files_.emplace(name, std::move(file));
  }
  std::vector<EventCounts> counts;
  counts.reserve(files_.size());
  for (const auto& [name, file] : files_) counts.push_back(file->read());
  std::sort(counts.begin(), counts.end(), [](const EventCounts& a, const EventCounts& b) {
    return std::tie(a.begin, a.pid) < std::tie(b.begin, b.pid);
  });
  return counts;
}

}  // namespace tracing
