// What substitutions can see: the plain state of a launch at one moment.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "launcher/base/source.hpp"

namespace launch {

class PackageIndex;

using Environment = std::map<std::string, std::string>;

// Copied when a scoped group begins and put back when it ends (launcher/core/launch_context.hpp).
struct Scope {
  // Launch configurations: what $(var x) reads.
  std::map<std::string, std::string> configurations;
  // The launch environment: what $(env X) reads and what children inherit.
  Environment environment;
  // The launch file being visited: what $(dirname) and $(filename) give. Null outside any file.
  std::shared_ptr<const SourceFile> current_file;
  // This run's log directory.
  std::string log_directory;
  // Finds packages by AMENT_PREFIX_PATH of `environment`, never null while visiting.
  std::shared_ptr<PackageIndex> packages;
};

}  // namespace launch
