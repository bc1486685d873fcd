// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>
#include <semaphore.h>

namespace tracetools {

// While one exists, liblttng-ust.so is loaded, and waits until the session daemon has registered this process. On a
// busy machine that takes longer than LTTng's three seconds, and the first events would be in no trace.
//
// With TRACETOOLS_REGISTER_TIMEOUT=MILLISECONDS in the environment LTTng waits so long. A thread watches the session
// daemon meanwhile. If the daemon is stopped, or neither works nor waits for a processor, the process goes on within a
// second, unregistered. LTTNG_UST_REGISTER_TIMEOUT in the environment takes precedence: then nothing is watched.
class RegistrationWatch {
 public:
  RegistrationWatch();
  ~RegistrationWatch();
  RegistrationWatch(const RegistrationWatch&) = delete;
  RegistrationWatch& operator=(const RegistrationWatch&) = delete;

 private:
  static void* watch(void* self);
  bool is_over(int milliseconds);

  bool watching_ = false;
  sem_t over_;
  pthread_t thread_;
};

}  // namespace tracetools
