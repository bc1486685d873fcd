// SPDX-License-Identifier: Apache-2.0
// Whether the tests are built with a sanitizer, which replaces malloc(3).
#pragma once

namespace test_support {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

// ThreadSanitizer gives each process a thread of its own.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool kThreadSanitized = true;
#else
inline constexpr bool kThreadSanitized = false;
#endif

// Why a test is skipped that needs a process with one thread, or counts threads.
inline constexpr const char* kHasOneMoreThread = "skipped, because ThreadSanitizer gives each process one more thread";

// Why a test is skipped that traces malloc(3) with LTTng's library, or one like it.
inline constexpr const char* kMallocIsTaken = "skipped, because sanitizers and a preloaded malloc exclude each other";

}  // namespace test_support
