// SPDX-License-Identifier: Apache-2.0
// A DDS DataReader that rmw_wait() can wait for.
#pragma once

#include <atomic>
#include <cstdint>
#include <fastdds/dds/core/LoanableCollection.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <optional>

#include "fastdds_versions/names.hpp"
#include "process/end_of_process.hpp"
#include "wait/ready_callback.hpp"
#include "wait/waitable.hpp"

namespace rmw_fastrtps {

// The listener of `reader`, for data_available at least.
class DataReaderWaitable : public eprosima::fastdds::dds::DataReaderListener, public Waitable {
 public:
  [[gnu::hot]] void on_data_available(eprosima::fastdds::dds::DataReader* from) override {
    arrivals_.fetch_add(1, std::memory_order_release);
    notify();
    if (on_new_data_.is_set()) {
      on_new_data_.tell_available(from->get_unread_count());
    }
  }

  // `callback` is called for samples that come, and for those that are waiting and that no callback was told of. Null
  // ends the calls.
  void set_on_new_data(rmw_event_callback_t callback, const void* user_data) {
    if (on_new_data_.is_set()) {
      heard_ = arrivals_.load(std::memory_order_acquire);
    }
    on_new_data_.set(callback, user_data);
    if (callback != nullptr) {
      on_new_data_.tell_available(reader->get_unread_count(), arrivals_.load(std::memory_order_acquire) - heard_);
    }
  }

  // Asks the reader only after something has arrived, so that waiting for many idle readers is cheap. Does not ask for
  // the first sample after the reader was empty: that sample is on its way to a callback. At worst one take is in vain.
  bool is_ready() override {
    const std::uint64_t arrivals = arrivals_.load(std::memory_order_acquire);
    if (const auto known = is_known_to_be_ready(arrivals)) {
      return *known;
    }
    if (process_ends()) {
      return false;
    }
    eprosima::fastdds::dds::SampleInfo info;
    if (reader->get_first_untaken_info(&info) == return_code::kOk) {
      return true;
    }
    settle(arrivals);
    return false;
  }

  // Takes the next sample. False if there is none to take; then the reader is not ready until something arrives. The
  // reader may hold a sample behind another one that is missing. That sample counts as arriving when its writer has
  // resent the missing one, or given it up.
  bool take_next(void* data, eprosima::fastdds::dds::SampleInfo& info) {
    return take([&] { return reader->take_next_sample(data, &info); });
  }
  // Like take_next(), but the sample stays in the memory of the reader.
  bool take_next_loan(eprosima::fastdds::dds::LoanableCollection& samples,
                      eprosima::fastdds::dds::SampleInfoSeq& infos) {
    return take([&] { return reader->take(samples, infos, 1); });
  }

  // A message that the reader does not hold can be taken.
  void announce_other_message() {
    count_arrival();
    notify();
    on_new_data_.tell(1);
  }

  eprosima::fastdds::dds::DataReader* reader = nullptr;

 protected:
  // Whether a message that the reader does not hold `is_there`. The reader, which knows nothing of it, may have
  // settled.
  bool stays_ready(bool is_there) {
    if (is_there) {
      count_arrival();
    }
    return is_there;
  }

  // What is known without asking the reader.
  std::optional<bool> is_known_to_be_ready() const {
    return is_known_to_be_ready(arrivals_.load(std::memory_order_acquire));
  }

 private:
  void count_arrival() { arrivals_.fetch_add(1, std::memory_order_release); }

  std::optional<bool> is_known_to_be_ready(std::uint64_t arrivals) const {
    if (settled_.load(std::memory_order_acquire) == arrivals) {
      return false;
    }
    if (!is_taken_from_.load(std::memory_order_acquire)) {
      return true;
    }
    return std::nullopt;
  }

  template <typename TakeT>
  bool take(TakeT take_from_reader) {
    if (process_ends()) {
      return false;
    }
    on_new_data_.about_to_take();
    const std::uint64_t arrivals = arrivals_.load(std::memory_order_acquire);
    const ReturnCode result = take_from_reader();
    if (result == return_code::kNoData) {
      settle(arrivals);
    } else {
      is_taken_from_.store(true, std::memory_order_release);
    }
    return result == return_code::kOk;
  }

  // Nothing can be taken of what had arrived.
  void settle(std::uint64_t arrivals) {
    settled_.store(arrivals, std::memory_order_release);
    is_taken_from_.store(false, std::memory_order_release);
  }

  std::atomic<std::uint64_t> arrivals_{0};
  std::atomic<std::uint64_t> settled_{0};   // arrivals that are known to have left nothing to take
  std::atomic<bool> is_taken_from_{false};  // since it was settled
  std::atomic<std::uint64_t> heard_{0};     // arrivals until the last callback was taken away
  ReadyCallback on_new_data_;
};

}  // namespace rmw_fastrtps
