// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "base/processes/spawn.hpp"
#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"

namespace tracing {

namespace {

// A file without a name.
class UnnamedFile {
 public:
  UnnamedFile() : stream_(std::tmpfile()) {
    if (stream_ == nullptr) {
      throw OutputError("a temporary file", std::strerror(errno));
    }
  }
  ~UnnamedFile() { std::fclose(stream_); }
  UnnamedFile(const UnnamedFile&) = delete;
  UnnamedFile& operator=(const UnnamedFile&) = delete;

  int descriptor() const { return fileno(stream_); }
  void write(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stream_) == text.size() && std::fflush(stream_) == 0) {
      return;
    }
    throw OutputError("a temporary file", std::strerror(errno));
  }
  void rewind() { lseek(descriptor(), 0, SEEK_SET); }
  std::string content() {
    std::string text;
    char bytes[1 << 14];
    std::rewind(stream_);
    for (std::size_t count = 0; (count = std::fread(bytes, 1, sizeof bytes, stream_)) > 0;) {
      text.append(bytes, count);
    }
    return text;
  }

 private:
  std::FILE* stream_;
};

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

void export_svg(const TracedSystem& system, const std::filesystem::path& path) {
  UnnamedFile graph;
  UnnamedFile picture;
  UnnamedFile messages;
  graph.write(dot_text(system));
  graph.rewind();
  int status = 0;
  try {
    status = launch::wait_for(launch::spawn({.program = "dot",
                                             .argv = {"dot", "-Tsvg"},
                                             .search_path = true,
                                             .descriptors = {{STDIN_FILENO, graph.descriptor()},
                                                             {STDOUT_FILENO, picture.descriptor()},
                                                             {STDERR_FILENO, messages.descriptor()}}}));
  } catch (const launch::SpawnError& error) {
    if (error.code().value() != ENOENT) {
      throw OutputError(path, error.what());
    }
    throw OutputError(path,
                      "Graphviz draws it, and there is no program dot in PATH; install the package graphviz, or "
                      "use --dot and draw the graph elsewhere");
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const std::string why = first_line(messages.content());
    throw OutputError(path, why.empty() ? "dot could not draw the graph" : "dot could not draw the graph: " + why);
  }
  OutputFile file(path);
  file.write(picture.content());
  file.finish();
}

}  // namespace tracing
