// SPDX-License-Identifier: Apache-2.0
// The reader of traces as its users have it: installed, moved, and found by a project of their own.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/trace_writer/temporary_directory.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace {

namespace fs = std::filesystem;
namespace ros2 = tracing::ros2;
using test_support::Command;
using test_support::CommandResult;
using test_support::run_command;
using tracing::testing::TemporaryDirectory;
using tracing::testing::Thread;
using tracing::testing::TraceWriter;

constexpr std::chrono::seconds kBuildTimeout{300};
constexpr Thread kThread{71, 72, "ping"};

CommandResult run(std::vector<std::string> argv) {
  const CommandResult result = run_command(Command{std::move(argv)}, kBuildTimeout);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  return result;
}

// Two traces of one machine, with a loss.
void write_traces(const fs::path& directory) {
  TraceWriter writer(directory / "ros", {.identity = 1, .vppid = 70});
  writer.write(0, 100, kThread, ros2::RclNodeInit{0xabc, 2, "talker", "/ns"});
  writer.end_packet(0);
  writer.discard_events(0, 3);
  writer.write(0, 300, kThread, ros2::RmwPublisherInit{0x10, {{1, 2, 3}, 16}});
  writer.write(0, 500, kThread, launch_trace::ros2_ext::RclNodeFini{0xabc});
  writer.finish();
  TraceWriter launcher(directory / "launcher", {.contexts = false, .identity = 2});
  launcher.write(1, 400, kThread, launch_trace::launch::Cut{400, "layers", "ros2:rcl_publish", 1000, 0.25});
  launcher.write(1, 600, kThread, launch_trace::launch::Exit{600, "talker-1", 72, -9, "a.launch.xml", 4});
  launcher.finish();
}

TEST(InstalledReader, ServesAProjectThatFindsIt) {
  const TemporaryDirectory directory;
  const fs::path& path = directory.path();
  run({CMAKE, "--install", READER_BUILD, "--prefix", (path / "first").string()});
  const fs::path prefix = path / "moved";
  fs::rename(path / "first", prefix);
  const std::string build_root = fs::path(READER_BUILD).parent_path().parent_path().string();
  int headers = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(prefix)) {
    if (!entry.is_regular_file() || entry.path().string().find(".so") != std::string::npos) {
      continue;
    }
    const std::string text = test_support::read_file(entry.path());
    EXPECT_EQ(text.find(build_root), std::string::npos) << entry.path() << " holds a path of the build";
    if (entry.path().extension() == ".hpp") {
      ++headers;
      EXPECT_EQ(text.find("#include \"tracing/"), std::string::npos) << entry.path() << " needs a private header";
    }
  }
  EXPECT_EQ(headers, 4);

  const fs::path build = path / "build";
  run({CMAKE, "-S", OUTSIDE_PROJECT, "-B", build.string(), "-G", GENERATOR, "-DCMAKE_PREFIX_PATH=" + prefix.string(),
       "-DCMAKE_CXX_COMPILER=" COMPILER, "-DCMAKE_CXX_COMPILER_LAUNCHER=" COMPILER_LAUNCHER});
  run({CMAKE, "--build", build.string()});
  const std::string program = (build / "print_trace").string();

  write_traces(path / "traces");
  EXPECT_EQ(run({program, (path / "traces/ros").string(), (path / "traces/launcher").string()}).out,
            "100 ros2:rcl_node_init host=box cpu=0 vpid=71 vtid=72 procname=ping node_handle=0xabc rmw_handle=0x2 "
            "node_name=\"talker\" namespace=\"/ns\" vppid=70\n"
            "  node talker\n"
            "100 lost 3 of ros2_0\n"
            "300 ros2:rmw_publisher_init host=box cpu=0 vpid=71 vtid=72 procname=ping rmw_publisher_handle=0x10 "
            "gid=(1 2 3 0 0 0 0 0 0 0 0 0 0 0 0 0) vppid=70\n"
            "400 launch:cut host=box cpu=1 vpid=-1 vtid=-1 procname=- time=400 event_class=\"layers\" "
            "events=\"ros2:rcl_publish\" rate=1000 share=0.25\n"
            "  cut at a share of 0.25\n"
            "500 ros2_ext:rcl_node_fini host=box cpu=0 vpid=71 vtid=72 procname=ping node_handle=0xabc vppid=70\n"
            "  end of 2748\n"
            "600 launch:exit host=box cpu=1 vpid=-1 vtid=-1 procname=- time=600 process=\"talker-1\" pid=72 "
            "exit_code=-9 file=\"a.launch.xml\" line=4\n"
            "  talker-1 -> -9\n");

  const CommandResult nothing = run_command({program, (path / "nothing").string()});
  EXPECT_EQ(nothing.exit_code, 1);
  EXPECT_EQ(nothing.out, "error: cannot read the trace '" + (path / "nothing").string() +
                             "': no such directory\nhelp: give the directory that the launcher printed when it ended "
                             "the session\n");

  // What is whole is given before the error.
  const fs::path stream = path / "traces/launcher/ros2_1";
  fs::resize_file(stream, fs::file_size(stream) - 1);
  const CommandResult damaged = run_command({program, (path / "traces/launcher").string()});
  EXPECT_EQ(damaged.exit_code, 1);
  EXPECT_TRUE(damaged.out.starts_with("400 launch:cut ")) << damaged.out;
  EXPECT_TRUE(damaged.out.ends_with("error: the trace '" + (path / "traces/launcher").string() +
                                    "' is damaged or ends early: '" + stream.string() +
                                    "', the packet at byte 0 ends behind the end of the file\n"
                                    "help: what can be read beside the damage was read\n"))
      << damaged.out;

  std::ofstream writing(stream, std::ios::binary | std::ios::app);
  EXPECT_EQ(run({program, (path / "traces/launcher").string()}).out, "open: \"launcher\"\n");
}

}  // namespace
