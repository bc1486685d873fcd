// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/launch_load/corpus_tree.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace bench {

namespace fs = std::filesystem;

namespace {

// A program that the files call, and that few machines have.
void write_xacro(const fs::path& path) {
  std::ofstream(path) << "#!/bin/sh\necho '<robot/>'\n";
  fs::permissions(path, fs::perms::owner_all);
}

}  // namespace

CorpusTree prepare_corpus_tree(const std::string& directory) {
  const fs::path root = CORPUS
      "/launch_files/autowarefoundation+autoware_launch/autoware_launch/launch/"
      "planning_simulator.launch.xml";
  const fs::path prefix = fs::path(directory) / "prefix";
  const std::string make = fmt::format("/usr/bin/python3 '" MAKE_PREFIX "' '" CORPUS "' '{}'", prefix.string());
  if (!fs::exists(root) || std::system(make.c_str()) != 0) {
    return {};
  }
  write_xacro(prefix / "bin/xacro");
  return {root.string(),
          {{"map_path", (prefix / "sample.param.yaml").string()}},
          {{"AMENT_PREFIX_PATH", prefix.string()},
           {"HOME", directory},
           {"LANG", "C.UTF-8"},
           {"PATH", (prefix / "bin").string() + ":/usr/bin:/bin"}}};
}

}  // namespace bench
