// SPDX-License-Identifier: Apache-2.0
// Runs a function when a scope is left.
//
//   auto close = rcpputils::make_scope_exit([&] { file.close(); });
//   …
// close.cancel();  // close() will not run
#pragma once

#include <utility>

namespace rcpputils {

template <typename CallableT>
class scope_exit final {
 public:
  explicit scope_exit(CallableT callable) : callable_(std::move(callable)) {}
  scope_exit(scope_exit&& other) noexcept
      : callable_(std::move(other.callable_)), cancelled_(std::exchange(other.cancelled_, true)) {}
  scope_exit(const scope_exit&) = delete;
  scope_exit& operator=(const scope_exit&) = delete;
  scope_exit& operator=(scope_exit&&) = delete;
  ~scope_exit() {
    if (!cancelled_) {
      callable_();
    }
  }

  void cancel() { cancelled_ = true; }

 private:
  CallableT callable_;
  bool cancelled_ = false;
};

template <typename CallableT>
scope_exit<CallableT> make_scope_exit(CallableT&& callable) {
  return scope_exit<CallableT>(std::forward<CallableT>(callable));
}

}  // namespace rcpputils

#define RCPPUTILS_SCOPE_EXIT_JOIN_(a, b) a##b
#define RCPPUTILS_SCOPE_EXIT_NAME_(line) RCPPUTILS_SCOPE_EXIT_JOIN_(scope_exit_, line)
#define RCPPUTILS_SCOPE_EXIT(code) \
  const auto RCPPUTILS_SCOPE_EXIT_NAME_(__LINE__) = ::rcpputils::make_scope_exit([&]() { code; })
