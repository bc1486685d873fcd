// SPDX-License-Identifier: Apache-2.0
#include "event_counters.hpp"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace tracetools {
namespace detail {

std::atomic<bool> counting{false};
thread_local constinit std::uint64_t* own_block [[gnu::tls_model("initial-exec")]] = nullptr;

}  // namespace detail

namespace {

constexpr std::size_t kSharedBlock = 0;

constexpr const char* kNames[] = {
#define TRACETOOLS_NAME(name, ...) "ros2:" #name,
#define TRACETOOLS_EXT_NAME(name, ...) "ros2_ext:" #name,
    TRACETOOLS_EVENTS(TRACETOOLS_NAME) TRACETOOLS_EXT_EVENTS(TRACETOOLS_EXT_NAME)
#undef TRACETOOLS_NAME
#undef TRACETOOLS_EXT_NAME
};

CounterFile* file = nullptr;
std::atomic<bool> taken[kCounterBlocks];

std::uint64_t nanoseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(time.tv_nsec);
}

// Takes the first block that no living thread uses. If all are in use, the thread gets none.
std::size_t take_block() {
  for (std::size_t i = kSharedBlock + 1; i < kCounterBlocks; ++i) {
    if (!taken[i].exchange(true)) return i;
  }
  return kSharedBlock;
}

// Releases the block when its thread ends. The next thread takes it and continues its counts.
class ThreadBlock {
 public:
  ThreadBlock() : block_(take_block()) {
    std::uint64_t used = file->blocks_used.load();
    while (used < block_ + 1 && !file->blocks_used.compare_exchange_weak(used, block_ + 1)) {
    }
    if (block_ != kSharedBlock) detail::own_block = file->counts[block_];
  }
  ~ThreadBlock() {
    detail::own_block = nullptr;  // later events of this thread go to the shared block
    if (block_ != kSharedBlock) taken[block_] = false;
  }

 private:
  std::size_t block_;
};

// Null if the file cannot be created: counting must not disturb a node.
CounterFile* make_file(const char* directory) {
  const std::uint64_t begin = nanoseconds(CLOCK_MONOTONIC);
  char path[4096];
  if (std::snprintf(path, sizeof path, "%s/%d-%llu", directory, getpid(), static_cast<unsigned long long>(begin)) >=
      static_cast<int>(sizeof path)) {
    return nullptr;
  }
  const int descriptor = open(path, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return nullptr;
  // Allocates the file's space now. If a page were missing later, access would raise SIGBUS.
  void* memory = MAP_FAILED;
  if (posix_fallocate(descriptor, 0, sizeof(CounterFile)) == 0) {
    memory = mmap(nullptr, sizeof(CounterFile), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  close(descriptor);
  if (memory == MAP_FAILED) {
    unlink(path);
    return nullptr;
  }
  auto* const made = static_cast<CounterFile*>(memory);
  made->events = kCountedEvents;
  made->blocks = kCounterBlocks;
  made->pid = static_cast<std::uint64_t>(getpid());
  made->begin = begin;
  std::strncpy(made->process, program_invocation_short_name, kCountedNameSize - 1);
  for (std::size_t i = 0; i < kCountedEvents; ++i) std::strncpy(made->names[i], kNames[i], kCountedNameSize - 1);
  std::uint64_t magic;
  std::memcpy(&magic, "ROS2CNT1", sizeof magic);
  std::atomic_ref(made->magic).store(magic, std::memory_order_release);
  return made;
}

void attach() {
  const char* const directory = std::getenv("TRACETOOLS_EVENT_COUNTERS");
  file = directory != nullptr ? make_file(directory) : nullptr;
  detail::counting = file != nullptr;
}

// The child of a fork is a separate process and gets its own file. Its only thread keeps the number of its block.
void attach_child() {
  const CounterFile* const of_parent = file;
  if (of_parent == nullptr) return;
  attach();
  if (file == nullptr || detail::own_block == nullptr) return;
  const auto block = static_cast<std::size_t>(detail::own_block - of_parent->counts[0]) / kCountedEvents;
  file->blocks_used = block + 1;
  detail::own_block = file->counts[block];
}

[[gnu::destructor]] void tell_end() {
  if (file == nullptr) return;
  file->cpu = nanoseconds(CLOCK_PROCESS_CPUTIME_ID);
  file->end = nanoseconds(CLOCK_MONOTONIC);
}

}  // namespace

void detail::count_without_block(CountedEvent event) noexcept {
  static thread_local ThreadBlock block;
  if (own_block != nullptr) {
    count(event);
  } else {
    const std::atomic_ref<std::uint64_t> counter(file->counts[kSharedBlock][static_cast<std::size_t>(event)]);
    counter.fetch_add(1, std::memory_order_relaxed);
  }
}

void begin_counting() noexcept {
  attach();
  if (file != nullptr) pthread_atfork(nullptr, nullptr, &attach_child);
}

}  // namespace tracetools
