// SPDX-License-Identifier: Apache-2.0
#include "process/end_of_process.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <utility>
#include <vector>

namespace rmw_fastrtps {
namespace {

// Never destroyed, because a context may outlive the static objects of this library.
struct Living {
  std::mutex mutex;
  std::vector<const EndedWithProcess*> objects;
};

Living& living() {
  static auto* living = new Living;
  return *living;
}

void end_all() {
  const std::lock_guard lock(living().mutex);
  if (detail::process_ends.exchange(true)) {
    return;
  }
  const auto& objects = living().objects;
  std::for_each(objects.rbegin(), objects.rend(), [](const EndedWithProcess* object) { object->end(); });
}

}  // namespace

std::atomic<bool> detail::process_ends{false};

void prepare_end_of_process() {
  std::atexit(&end_all);
}

EndedWithProcess::EndedWithProcess(std::function<void()> end) : end_(std::move(end)), process_(getpid()) {
  const std::lock_guard lock(living().mutex);
  living().objects.push_back(this);
}

void EndedWithProcess::end() const {
  if (getpid() == process_) {
    end_();
  }
}

EndedWithProcess::~EndedWithProcess() {
  const std::lock_guard lock(living().mutex);
  std::erase(living().objects, this);
}

}  // namespace rmw_fastrtps
