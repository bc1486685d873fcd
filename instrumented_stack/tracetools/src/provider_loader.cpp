/// Opens the probes when libtracetools.so is loaded. They are a library of their own so that a process that opts out
/// (TRACETOOLS_RUNTIME_DISABLE=1) gets neither lttng-ust nor its two threads.
#include "provider_loader.hpp"

#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace tracetools {
namespace {

bool environment_says_yes(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && std::strcmp(value, "1") == 0;
}

void* provider = nullptr;

// A constructor of the library and not a C++ static: the tracepoints of this library were registered by constructors of
// LTTng's macros, and destructors of static objects elsewhere may still fire events after ours would have run.
[[gnu::constructor]] void open_provider() {
  if (environment_says_yes("TRACETOOLS_RUNTIME_DISABLE")) {
    if (environment_says_yes("TRACETOOLS_VERBOSE")) {
      std::fputs("tracetools: tracing is disabled by TRACETOOLS_RUNTIME_DISABLE\n", stderr);
    }
    return;
  }
  // Found next to this library by its run path. Global, for the tracepoints here look the probes' symbols up.
  provider = dlopen("libtracetools_provider.so", RTLD_NOW | RTLD_GLOBAL);
  if (provider == nullptr) {
    std::fprintf(stderr, "tracetools: tracing is disabled, the provider cannot be loaded: %s\n", dlerror());
  }
}

[[gnu::destructor]] void close_provider() {
  if (provider != nullptr) {
    dlclose(provider);
    provider = nullptr;
  }
}

}  // namespace

bool provider_is_loaded() noexcept { return provider != nullptr; }

}  // namespace tracetools
