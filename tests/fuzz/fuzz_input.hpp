// SPDX-License-Identifier: Apache-2.0
// The common part of the fuzz targets.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "base/diagnostics/diagnostic.hpp"
#include "base/diagnostics/source.hpp"

namespace fuzz {

inline std::shared_ptr<const launch::SourceFile> as_file(const std::uint8_t* data, std::size_t size) {
  return std::make_shared<launch::SourceFile>("/fuzz/input", std::string(reinterpret_cast<const char*>(data), size));
}

// Runs a step that may refuse its input with a LaunchError. It must then be possible to show the error. Any other
// exception is a finding.
template <typename Step>
void try_step(Step step) {
  try {
    step();
  } catch (const launch::LaunchError& error) {
    static_cast<void>(launch::render(error.diagnostics(), true));
  }
}

}  // namespace fuzz
