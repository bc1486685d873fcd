// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/session_end.hpp"

#include <fmt/core.h>
#include <lttng/destruction-handle.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

#include "tracing/record/account/loss_counters.hpp"
#include "tracing/record/lttng/answer_limit.hpp"
#include "tracing/record/lttng/lttng_ctl.hpp"
#include "tracing/record/lttng/lttng_error.hpp"
#include "tracing/record/plan/trace_error.hpp"
#include "tracing/record/session/session_listing.hpp"

namespace tracing {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// LTTng has no event for "all data is written" or "the session is gone", and its own waiting calls look only every 200
// and 500 ms. The state is therefore polled, soon at first and then less often: at most an eighth of the time that has
// passed is waited too long.
class Polling {
 public:
  void pause() {
    const auto waited = std::chrono::duration_cast<milliseconds>(steady_clock::now() - begin_);
    std::this_thread::sleep_for(std::clamp(waited / 8, kShortest, kLongest));
  }

 private:
  static constexpr milliseconds kShortest{1};
  static constexpr milliseconds kLongest{10};
  steady_clock::time_point begin_ = steady_clock::now();
};

// How often a wait for LTTng asks whether to give up, and whether LTTng still writes.
constexpr milliseconds kGiveUpInterval{50};
constexpr milliseconds kProgressInterval{500};

// The bytes of all files in the directory; 0 when they are on another machine.
std::uint64_t size_of(const std::string& directory) {
  std::uint64_t size = 0;
  std::error_code error;
  if (!directory.starts_with('/')) {
    return size;
  }
  std::filesystem::recursive_directory_iterator entry(directory, error);
  for (; !error && entry != std::filesystem::recursive_directory_iterator(); entry.increment(error)) {
    std::error_code gone;
    if (const std::uintmax_t bytes = entry->file_size(gone); !gone) {
      size += bytes;
    }
  }
  return size;
}

// Ends when LTTng has written nothing for kLongestSilence.
class Patience {
 public:
  explicit Patience(std::string directory) : directory_(std::move(directory)) {}

  bool is_over() {
    const steady_clock::time_point now = steady_clock::now();
    if (now - looked_ >= kProgressInterval) {
      looked_ = now;
      if (const std::uint64_t size = size_of(directory_); size != size_) {
        size_ = size;
        silent_since_ = now;
      }
    }
    return now - silent_since_ >= longest_silence();
  }

 private:
  std::string directory_;
  std::uint64_t size_ = 0;
  steady_clock::time_point looked_ = steady_clock::now();
  steady_clock::time_point silent_since_ = looked_;
};

void stop(const std::string& name) {
  // Takes 200 ms when applications have registered since the last stop: the consumer daemon then waits in steps of this
  // length for its own thread that writes the metadata.
  const int result = lttng_stop_tracing_no_wait(name.c_str());
  if (result != -LTTNG_ERR_TRACE_ALREADY_STOPPED) {
    check_lttng(result, fmt::format("stop trace session '{}'", name));
  }
}

}  // namespace

DataEnd wait_for_data(const std::string& name, const std::string& directory, const std::function<bool()>& give_up) {
  const std::string doing = fmt::format("write the data of trace session '{}'", name);
  Patience patience(directory);
  for (Polling data; check_lttng(lttng_data_pending(name.c_str()), doing) > 0; data.pause()) {
    if (give_up && give_up()) {
      return DataEnd::kGivenUp;
    }
    if (patience.is_over()) {
      return DataEnd::kStuck;
    }
  }
  return DataEnd::kWritten;
}

bool end_packets_again(const std::string& name, const std::string& directory, const std::function<bool()>& give_up) {
  if (lttng_start_tracing(name.c_str()) != 0) {
    return false;
  }
  stop(name);
  return wait_for_data(name, directory, give_up) == DataEnd::kWritten;
}

LossAccount stop_and_account(const std::string& name, const std::string& directory,
                             const std::function<bool()>& give_up, StepTimer& timer) {
  try {
    stop(name);
    timer.finished("stop");
    const DataEnd end = wait_for_data(name, directory, give_up);
    timer.finished("last data");
    LossAccount losses = read_losses(name);
    losses.cut_short = end == DataEnd::kGivenUp;
    losses.stuck = end == DataEnd::kStuck;
    return losses;
  } catch (const TraceError&) {
    lttng_destroy_session_no_wait(name.c_str());
    throw;
  }
}

void destroy_session(const std::string& name, const std::function<bool()>& give_up) {
  check_lttng(lttng_destroy_session_no_wait(name.c_str()), fmt::format("destroy trace session '{}'", name));
  Patience patience("");
  for (Polling gone; find_session(name).has_value(); gone.pause()) {
    if ((give_up && give_up()) || patience.is_over()) {
      break;
    }
  }
}

bool destroy_rotated_session(const std::string& name, const std::function<bool()>& give_up) {
  const std::string doing = fmt::format("destroy trace session '{}'", name);
  lttng_destruction_handle* destruction = nullptr;
  lttng_error_code result = lttng_destroy_session_ext(name.c_str(), &destruction);
  if (result != LTTNG_OK) {
    throw lttng_error(result, doing);
  }
  const std::unique_ptr<lttng_destruction_handle, void (*)(lttng_destruction_handle*)> owner(
      destruction, lttng_destruction_handle_destroy);
  lttng_destruction_handle_status status = LTTNG_DESTRUCTION_HANDLE_STATUS_TIMEOUT;
  Patience patience("");
  while (status == LTTNG_DESTRUCTION_HANDLE_STATUS_TIMEOUT && !(give_up && give_up()) && !patience.is_over()) {
    status = lttng_destruction_handle_wait_for_completion(destruction, kGiveUpInterval.count());
  }
  if (status == LTTNG_DESTRUCTION_HANDLE_STATUS_TIMEOUT) {
    return false;
  }
  result = LTTNG_ERR_NO_SESSIOND;  // the connection broke
  if (status == LTTNG_DESTRUCTION_HANDLE_STATUS_COMPLETED) {
    lttng_destruction_handle_get_result(destruction, &result);
  }
  if (result != LTTNG_OK) {
    throw lttng_error(result, doing);
  }
  return true;
}

}  // namespace tracing
