// SPDX-License-Identifier: Apache-2.0
// The common part of the tests of substitutions: a scope with known content, and templates parsed from a string.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/substitution/package_index.hpp"
#include "launcher/substitution/template_parser.hpp"

namespace launch {

// Text that is alone in a file "t", so that errors can show their place.
inline LocatedText located(const std::string& text) {
  const auto file = std::make_shared<const SourceFile>("t", text);
  return LocatedText(text, {file, 0, static_cast<std::uint32_t>(text.size())});
}

// x=7, sp="a b", empty="", true="true", which="x"; variables HOME and EMPTY.
inline Scope test_scope() {
  Scope scope;
  scope.configurations = {{"x", "7"}, {"sp", "a b"}, {"empty", ""}, {"true", "true"}, {"which", "x"}};
  scope.environment = {{"HOME", "/home/me"}, {"EMPTY", ""}};
  scope.packages = std::make_shared<PackageIndex>();
  return scope;
}

inline std::string perform(const std::string& text) {
  Scope scope = test_scope();
  return parse_template(located(text)).perform(scope);
}

// The rendered errors of parsing; empty when it parses.
inline std::string parse_error(const std::string& text) {
  try {
    parse_template(located(text));
  } catch (const LaunchError& error) {
    return render(error.diagnostics());
  }
  return {};
}

// The rendered errors of performing a template that parses.
inline std::string perform_error(const std::string& text, Scope scope = test_scope()) {
  const Template parsed = parse_template(located(text));
  try {
    parsed.perform(scope);
  } catch (const LaunchError& error) {
    return render(error.diagnostics());
  }
  return {};
}

}  // namespace launch
