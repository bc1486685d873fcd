// SPDX-License-Identifier: Apache-2.0
// Opens the probes when libtracetools.so is loaded, or when the first session daemon starts if that is later. The
// probes are a separate library. So a process without a session daemon, and one that opts out
// (TRACETOOLS_RUNTIME_DISABLE=1), load neither lttng-ust nor its two threads.
#include "provider_loader.hpp"

#include <dlfcn.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "counters/event_counters.hpp"
#include "deadline.hpp"
#include "recording/recording.hpp"
#include "registration/daemon_arrival.hpp"
#include "registration/registration_watch.hpp"
#include "stand_in/preloaded.hpp"
#include "state/object_state.hpp"
#include "state/state_dump_request.hpp"

namespace tracetools {
namespace {

bool environment_says_yes(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && std::strcmp(value, "1") == 0;
}

// The provider is in the folder of this library. dlopen must not search the run path: under a sanitizer, the
// sanitizer's library intercepts dlopen, and its own run path would be used.
std::string provider_path() {
  Dl_info self;
  std::string folder;
  if (dladdr(reinterpret_cast<const void*>(&is_traceable), &self) != 0) {
    const std::string_view path = self.dli_fname;
    folder = path.substr(0, path.rfind('/') + 1);
  }
  return folder + "libtracetools_provider.so";
}

std::atomic<bool> traceable{false};

bool is_verbose() {
  return environment_says_yes("TRACETOOLS_VERBOSE");
}

// Sessions that start later also record the objects that live then. False if that is not possible.
bool offer_state_dumps() {
  const bool offered = on_state_dump([](Session* session, bool lives) {
    const bool first = session_reaches_process();
    const std::size_t dumped = ObjectState::instance().dump_to(session, lives);
    if (first) {
      make_good(dumped);
    }
  });
  if (!offered && is_verbose()) {
    std::fputs("tracetools: this lttng-ust cannot ask for the state of objects: start sessions before processes\n",
               stderr);
  }
  return offered;
}

// The probes are never closed: threads may fire events until the very end of the process, and closing would remove the
// code under them.
bool load_provider() {
  // RTLD_GLOBAL, because the tracepoints of this library look up the symbols of the probes.
  void* const provider = dlopen(provider_path().c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (provider == nullptr) {
    std::fprintf(stderr, "tracetools: tracing is disabled, the provider cannot be loaded: %s\n", dlerror());
    return false;
  }
  for (const char* const name : {"tracetools_probes_of_ros2", "tracetools_probes_of_ros2_ext"}) {
    add_generated_probes(*reinterpret_cast<const lttng_ust_probe_desc* (*)()>(dlsym(provider, name))());
  }
  return true;
}

void* load_provider_after(void* number) {
  static std::once_flag loaded;
  if (!wait_for_daemon(static_cast<const std::int32_t*>(number))) {
    return nullptr;
  }
  std::call_once(loaded, [] {
    if (load_provider()) {
      begin_state_dumps();
    }
  });
  return nullptr;
}

// In threads that get no signals. They keep the name of the process, which LTTng takes from them for the process.
bool load_provider_later(const AwaitedDaemons& daemons) {
  sigset_t all;
  sigset_t before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  bool started = true;
  for (const std::int32_t* const number : daemons) {
    pthread_t thread;
    if (number == nullptr) {
      continue;
    }
    started &= pthread_create(&thread, nullptr, &load_provider_after, const_cast<std::int32_t*>(number)) == 0;
    if (started) {
      pthread_detach(thread);
    }
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return started;
}

// Whether a library that the program was linked with, or that is preloaded, has brought lttng-ust. Then its threads are
// there.
bool lttng_is_loaded() {
  return dlsym(RTLD_DEFAULT, "lttng_ust_probe_register") != nullptr;
}

// There are no objects yet.
bool load_provider_now() {
  begin_state_dumps();
  const bool lttng_was_first = lttng_is_loaded();
  const RegistrationWatch watch;
  const bool loaded = load_provider();
  if (loaded && lttng_was_first) {
    dump_to_sessions_before();
  }
  return loaded;
}

// A provider that is missing is told at once.
bool can_load_later() {
  return !lttng_is_loaded() && access(provider_path().c_str(), R_OK) == 0;
}

void open_provider() {
  if (environment_says_yes("TRACETOOLS_RUNTIME_DISABLE")) {
    if (is_verbose()) {
      std::fputs("tracetools: tracing is disabled by TRACETOOLS_RUNTIME_DISABLE\n", stderr);
    }
    return;
  }
  if (!wake_memory_can_be_had()) {
    std::fputs("tracetools: tracing is disabled, because /dev/shm is full\n", stderr);
    return;
  }
  begin_counting();
  if (!offer_state_dumps()) {
    session_reaches_process();  // it is unknown when a session does
  }
  const std::optional<AwaitedDaemons> daemons = can_load_later() ? awaited_daemons() : std::nullopt;
  traceable = (daemons && load_provider_later(*daemons)) || load_provider_now();
  if (!traceable) {
    return;
  }
  count_missed_events();
  read_deadlines();
}

#ifdef TRACETOOLS_STANDS_IN

// What is preloaded is loaded by everything that the process executes, such as a shell, which must not get the threads
// of LTTng for nothing. There this waits for the first event: a Python program loads rcl later.
std::once_flag opened;

[[gnu::constructor]] void open_where_needed() {
  if (is_needed()) {
    keep_from_others();
    std::call_once(opened, &open_provider);
  }
}

#else

// Runs when the library is loaded, before main and before the static objects of libraries that link it.
[[gnu::constructor]] void open_at_load() {
  open_provider();
}

#endif

}  // namespace

bool is_traceable() noexcept {
#ifdef TRACETOOLS_STANDS_IN
  std::call_once(opened, &open_provider);
#endif
  return traceable;
}

}  // namespace tracetools
