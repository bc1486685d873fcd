// SPDX-License-Identifier: Apache-2.0
// std::unique_lock with annotations for Clang's analysis of threads.
#pragma once

#include <mutex>

#include "rcpputils/thread_safety_annotations.hpp"

namespace rcpputils {

template <typename MutexT>
class RCPPUTILS_TSA_SCOPED_CAPABILITY unique_lock : public std::unique_lock<MutexT> {
 public:
  explicit unique_lock(MutexT& mutex) RCPPUTILS_TSA_ACQUIRE(mutex) : std::unique_lock<MutexT>(mutex) {}
  ~unique_lock() RCPPUTILS_TSA_RELEASE() {}
};

}  // namespace rcpputils
