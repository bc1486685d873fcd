// SPDX-License-Identifier: Apache-2.0
#include "counters/event_counters.hpp"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "counters/stack_tracepoints.hpp"

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

std::atomic<CounterFile*> file{nullptr};
// The file is made by the first event of the child of a fork, because most such children soon execute a program.
std::atomic<bool> file_is_due{false};
std::atomic<bool> taken[kCounterBlocks];
// A session has reached this process. The mutex is held while tracepoints are switched for that.
std::atomic<bool> reached{false};
std::mutex reaching;
bool counts_missed = false;

std::uint64_t nanoseconds(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::uint64_t>(time.tv_sec) * 1'000'000'000 + static_cast<std::uint64_t>(time.tv_nsec);
}

// Takes the first block that no living thread uses. If all are in use, the thread gets none.
std::size_t take_block() {
  for (std::size_t i = kSharedBlock + 1; i < kCounterBlocks; ++i) {
    if (!taken[i].exchange(true)) {
      return i;
    }
  }
  return kSharedBlock;
}

// Beyond the life of the thread's block.
thread_local constinit bool thread_has_ended = false;

// Releases the block when its thread ends. The next thread takes it and continues its counts.
class ThreadBlock {
 public:
  ThreadBlock() : block_(take_block()) { use(); }
  ~ThreadBlock() {
    detail::own_block = nullptr;  // later events of this thread go to the shared block
    if (block_ != kSharedBlock) {
      taken[block_] = false;
    }
    thread_has_ended = true;
  }
  // Counts in the file of this process, in the child of a fork in the child's.
  void use() {
    if (block_ == kSharedBlock) {
      return;
    }
    CounterFile& counters = *file.load();
    std::uint64_t used = counters.blocks_used.load();
    while (used < block_ + 1 && !counters.blocks_used.compare_exchange_weak(used, block_ + 1)) {
    }
    detail::own_block = counters.counts[block_];
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
  if (descriptor < 0) {
    return nullptr;
  }
  // Held as long as the process runs, so that the launcher knows when it has ended, in a container, too.
  flock(descriptor, LOCK_SH);
  // Allocates the file's space now. If a page were missing later, access would raise SIGBUS.
  void* memory = MAP_FAILED;
  if (posix_fallocate(descriptor, 0, sizeof(CounterFile)) == 0) {
    memory = mmap(nullptr, sizeof(CounterFile), PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
  }
  if (memory == MAP_FAILED) {
    close(descriptor);
    unlink(path);
    return nullptr;
  }
  auto* const made = static_cast<CounterFile*>(memory);
  made->events = kCountedEvents;
  made->blocks = kCounterBlocks;
  made->pid = static_cast<std::uint64_t>(getpid());
  made->begin = begin;
  std::strncpy(made->process, program_invocation_short_name, kCountedNameSize - 1);
  for (std::size_t i = 0; i < kCountedEvents; ++i) {
    std::strncpy(made->names[i], kNames[i], kCountedNameSize - 1);
  }
  std::uint64_t magic;
  std::memcpy(&magic, "ROS2CNT2", sizeof magic);
  std::atomic_ref(made->magic).store(magic, std::memory_order_release);
  return made;
}

void attach() {
  const char* const directory = std::getenv("TRACETOOLS_EVENT_COUNTERS");
  CounterFile* const made = directory != nullptr ? make_file(directory) : nullptr;
  if (made != nullptr && reached) {
    made->reached = made->begin;
  }
  file = made;
  detail::counting = made != nullptr;
}

// The child of a fork is a separate process and gets its own file.
void attach_child() {
  if (file == nullptr && !file_is_due) {
    return;
  }
  file = nullptr;
  file_is_due = true;
  detail::own_block = nullptr;
}

void make_due_file() {
  static std::mutex making;
  const std::lock_guard lock(making);
  if (!file_is_due) {
    return;
  }
  attach();
  file_is_due = false;
}

[[gnu::destructor]] void tell_end() {
  CounterFile* const counters = file;
  if (counters == nullptr) {
    return;
  }
  counters->cpu = nanoseconds(CLOCK_PROCESS_CPUTIME_ID);
  counters->end = nanoseconds(CLOCK_MONOTONIC);
}

}  // namespace

void detail::count_without_block(CountedEvent event) noexcept {
  if (file_is_due) {
    make_due_file();
  }
  CounterFile* const counters = file;
  if (counters == nullptr) {
    return;
  }
  if (!reached) {
    count_unrecorded();
    return;
  }
  static thread_local ThreadBlock block;
  if (own_block == nullptr && !thread_has_ended) {
    block.use();
  }
  if (own_block != nullptr) {
    count(event);
  } else {
    const std::atomic_ref<std::uint64_t> counter(counters->counts[kSharedBlock][static_cast<std::size_t>(event)]);
    counter.fetch_add(1, std::memory_order_relaxed);
  }
}

void begin_counting() noexcept {
  attach();
  if (file != nullptr) {
    pthread_atfork(nullptr, nullptr, &attach_child);
  }
}

// While no session has reached the process, its tracepoints are enabled without a probe: then they count.
void count_missed_events() noexcept {
  const std::lock_guard lock(reaching);
  if (file != nullptr && !reached) {
    counts_missed = true;
    enable_without_probes(true);
  }
}

bool session_reaches_process() noexcept {
  const std::lock_guard lock(reaching);
  if (reached.exchange(true)) {
    return false;
  }
  CounterFile* const counters = file;
  if (counters == nullptr) {
    return false;
  }
  if (counts_missed) {
    enable_without_probes(false);
  }
  counters->reached = nanoseconds(CLOCK_MONOTONIC);
  return true;
}

void make_good(std::uint64_t events) noexcept {
  std::atomic<std::uint64_t>& missed = file.load()->missed;
  missed -= events < missed ? events : missed.load();
}

void count_unrecorded() noexcept {
  CounterFile* const counters = file;
  if (counters != nullptr && !reached) {
    counters->missed.fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace tracetools
