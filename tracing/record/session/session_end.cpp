// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/session_end.hpp"

#include <fmt/core.h>
#include <lttng/destruction-handle.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "tracing/record/account/loss_counters.hpp"
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

// How often a wait for LTTng asks whether to give up.
constexpr milliseconds kGiveUpInterval{50};

void stop(const std::string& name) {
  // Takes 200 ms when applications have registered since the last stop: the consumer daemon then waits in steps of this
  // length for its own thread that writes the metadata.
  const int result = lttng_stop_tracing_no_wait(name.c_str());
  if (result != -LTTNG_ERR_TRACE_ALREADY_STOPPED) {
    check_lttng(result, fmt::format("stop trace session '{}'", name));
  }
}

}  // namespace

bool wait_for_data(const std::string& name, const std::function<bool()>& give_up) {
  const std::string doing = fmt::format("write the data of trace session '{}'", name);
  for (Polling data; check_lttng(lttng_data_pending(name.c_str()), doing) > 0; data.pause()) {
    if (give_up && give_up()) {
      return false;
    }
  }
  return true;
}

LossAccount stop_and_account(const std::string& name, const std::function<bool()>& give_up, StepTimer& timer) {
  try {
    stop(name);
    timer.finished("stop");
    const bool complete = wait_for_data(name, give_up);
    timer.finished("last data");
    LossAccount losses = read_losses(name);
    losses.cut_short = !complete;
    return losses;
  } catch (const TraceError&) {
    lttng_destroy_session_no_wait(name.c_str());
    throw;
  }
}

void destroy_session(const std::string& name, const std::function<bool()>& give_up) {
  check_lttng(lttng_destroy_session_no_wait(name.c_str()), fmt::format("destroy trace session '{}'", name));
  for (Polling gone; find_session(name).has_value(); gone.pause()) {
    if (give_up && give_up()) {
      break;
    }
  }
}

void destroy_rotated_session(const std::string& name, const std::function<bool()>& give_up) {
  const std::string doing = fmt::format("destroy trace session '{}'", name);
  lttng_destruction_handle* destruction = nullptr;
  lttng_error_code result = lttng_destroy_session_ext(name.c_str(), &destruction);
  if (result != LTTNG_OK) {
    throw lttng_error(result, doing);
  }
  const std::unique_ptr<lttng_destruction_handle, void (*)(lttng_destruction_handle*)> owner(
      destruction, lttng_destruction_handle_destroy);
  lttng_destruction_handle_status status = LTTNG_DESTRUCTION_HANDLE_STATUS_TIMEOUT;
  while (status == LTTNG_DESTRUCTION_HANDLE_STATUS_TIMEOUT && !(give_up && give_up())) {
    status = lttng_destruction_handle_wait_for_completion(destruction, kGiveUpInterval.count());
  }
  if (status == LTTNG_DESTRUCTION_HANDLE_STATUS_TIMEOUT) {
    return;
  }
  result = LTTNG_ERR_NO_SESSIOND;  // the connection broke
  if (status == LTTNG_DESTRUCTION_HANDLE_STATUS_COMPLETED) {
    lttng_destruction_handle_get_result(destruction, &result);
  }
  if (result != LTTNG_OK) {
    throw lttng_error(result, doing);
  }
}

}  // namespace tracing
