// SPDX-License-Identifier: Apache-2.0
// With programs named dot of the test's own, because Graphviz may not be installed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/emulated.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/traced_example/traced_example.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"

namespace tracing {
namespace {

namespace fs = std::filesystem;

class SvgExport : public ::testing::Test {
 protected:
  void SetUp() override { setenv("PATH", (directory_.path().string() + ":/usr/bin:/bin").c_str(), 1); }
  void TearDown() override { setenv("PATH", path_.c_str(), 1); }

  void install_dot(const std::string& script) {
    std::ofstream(directory_.path() / "dot") << "#!/bin/sh\n" << script;
    fs::permissions(directory_.path() / "dot", fs::perms::owner_all);
  }
  std::string error() {
    try {
      export_svg(testing::traced_example(1), file_);
    } catch (const OutputError& error) {
      return error.what();
    }
    return "none";
  }

  testing::TemporaryDirectory directory_;
  fs::path file_ = directory_.path() / "graph.svg";
  std::string path_ = std::getenv("PATH");
};

TEST_F(SvgExport, IsWhatDotDraws) {
  install_dot("echo \"<svg $*>\"; cat\n");
  export_svg(testing::traced_example(1), file_);
  std::ifstream file(file_);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_THAT(text, ::testing::StartsWith("<svg -Tsvg>\n// Nodes are ellipses"));
  EXPECT_THAT(text, ::testing::EndsWith("}\n"));
}

TEST_F(SvgExport, SaysThatGraphvizIsMissing) {
  NEEDS_VFORK();
  setenv("PATH", directory_.path().c_str(), 1);
  EXPECT_EQ(error(), "cannot write " + file_.string() +
                         ": Graphviz draws it, and there is no program dot in PATH; install the package graphviz, or "
                         "use --dot and draw the graph elsewhere");
  EXPECT_FALSE(fs::exists(file_));
}

TEST_F(SvgExport, SaysWhyDotFailed) {
  install_dot("echo 'Error: no memory' >&2; echo more >&2; exit 1\n");
  EXPECT_EQ(error(), "cannot write " + file_.string() + ": dot could not draw the graph: Error: no memory");
  install_dot("kill -9 $$\n");
  EXPECT_EQ(error(), "cannot write " + file_.string() + ": dot could not draw the graph");
  EXPECT_FALSE(fs::exists(file_));
}

}  // namespace
}  // namespace tracing
