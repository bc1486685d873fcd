// SPDX-License-Identifier: Apache-2.0
#include "tracing/decode/reader/trace_reader.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <iterator>

#include "tracing/decode/ctf/trace_class.hpp"
#include "tracing/decode/reader/babeltrace_reader.hpp"
#include "tracing/decode/reader/direct_reader.hpp"
#include "tracing/decode/reader/trace_discovery.hpp"

namespace tracing {

namespace {

namespace fs = std::filesystem;

// The kernel grants a lease for reading only if nobody has the file open for writing. This holds for programs of other
// users, too, whose descriptors can't be looked at. The lease is given back at once. A program that opens the file
// meanwhile has to wait for it, and we would get a signal, which is ignored by default.
bool has_writer(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    return false;
  }
  bool has_writer = false;
  struct statfs system {};
  // NFS gives no lease without a delegation from the server.
  if (fstatfs(file, &system) == 0 && system.f_type != NFS_SUPER_MAGIC && fcntl(file, F_SETSIG, SIGURG) == 0) {
    if (fcntl(file, F_SETLEASE, F_RDLCK) == 0) {
      fcntl(file, F_SETLEASE, F_UNLCK);
    } else {
      has_writer = errno == EAGAIN;
    }
  }
  close(file);
  return has_writer;
}

// A program has a file of the directory open for writing. False when the system can't tell, as with files of another
// user.
bool is_being_written(const fs::path& directory) {
  std::error_code error;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;
    if (entry->is_regular_file(gone) && has_writer(entry->path())) {
      return true;
    }
  }
  return false;
}

}  // namespace

struct TraceReader::Implementation {
  std::vector<std::filesystem::path> open_directories;
  std::unique_ptr<DirectReader> direct;
  std::unique_ptr<BabeltraceReader> babeltrace;
};

TraceReader::TraceReader(const std::filesystem::path& directory, Decoder decoder)
    : TraceReader(std::vector{directory}, decoder) {}

TraceReader::TraceReader(const std::vector<std::filesystem::path>& directories, Decoder decoder)
    : implementation_(std::make_unique<Implementation>()) {
  std::vector<std::filesystem::path> traces;
  std::string names;  // for messages
  for (const std::filesystem::path& directory : directories) {
    const std::vector<std::filesystem::path> found = find_traces(directory);
    traces.insert(traces.end(), found.begin(), found.end());
    names += (names.empty() ? "" : "', '") + directory.string();
  }
  std::vector<std::filesystem::path>& open = implementation_->open_directories;
  std::copy_if(traces.begin(), traces.end(), std::back_inserter(open), is_being_written);
  if (decoder != Decoder::kBabeltrace) {
    try {
      implementation_->direct = std::make_unique<DirectReader>(names, traces, open);
      return;
    } catch (const ctf::UnsupportedTrace& unsupported) {
      if (decoder == Decoder::kDirect) {
        throw TraceReadError(unsupported.what(), "");
      }
    }
  }
  implementation_->babeltrace = std::make_unique<BabeltraceReader>(names, traces);
}

TraceReader::~TraceReader() = default;

void TraceReader::read(TraceSink& sink) {
  try {
    if (implementation_->direct) {
      implementation_->direct->read(sink);
    } else {
      while (const TraceItem item = next()) {
        if (item.event != nullptr) {
          sink.on_event(*item.event);
        } else {
          sink.on_loss(*item.loss);
        }
      }
    }
  } catch (const EndOfReading&) {
    // The sink needs no more.
  }
  throw_damage();
}

TraceItem TraceReader::next() {
  return implementation_->direct ? implementation_->direct->next() : implementation_->babeltrace->next();
}

void TraceReader::throw_damage() const {
  if (implementation_->direct) {
    implementation_->direct->throw_damage();
  } else {
    implementation_->babeltrace->throw_damage();
  }
}

const std::vector<std::string>& TraceReader::damage() const {
  return implementation_->direct ? implementation_->direct->damage() : implementation_->babeltrace->damage();
}

const std::vector<std::filesystem::path>& TraceReader::open_directories() const {
  return implementation_->open_directories;
}

bool TraceReader::lacks_descriptions() const {
  return implementation_->direct && implementation_->direct->lacks_descriptions();
}

const std::deque<TraceDescription>& TraceReader::traces() const {
  return implementation_->direct ? implementation_->direct->traces() : implementation_->babeltrace->traces();
}

}  // namespace tracing
