// SPDX-License-Identifier: Apache-2.0
// Checks that throw: require_true for arguments, check_true for states, and assert_true for what a programmer is sure
// of. NDEBUG removes assert_true.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace rcpputils {

class AssertionException : public std::exception {
 public:
  explicit AssertionException(const char* message) : message_(message) {}
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

class IllegalStateException : public std::exception {
 public:
  explicit IllegalStateException(const char* message) : message_(message) {}
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

// Throws std::invalid_argument.
inline void require_true(bool condition, const std::string& message = "invalid argument passed") {
  if (!condition) {
    throw std::invalid_argument(message);
  }
}

// Throws IllegalStateException.
inline void check_true(bool condition, const std::string& message = "check reported invalid state") {
  if (!condition) {
    throw IllegalStateException(message.c_str());
  }
}

// Throws AssertionException.
inline void assert_true([[maybe_unused]] bool condition,
                        [[maybe_unused]] const std::string& message = "assertion failed") {
#ifndef NDEBUG
  if (!condition) {
    throw AssertionException(message.c_str());
  }
#endif
}

}  // namespace rcpputils
