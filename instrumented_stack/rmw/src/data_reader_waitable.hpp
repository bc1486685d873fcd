// A DDS DataReader that rmw_wait() can wait for.
#pragma once

#include <atomic>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include "waitable.hpp"

namespace rmw_fastrtps {

// The listener of `reader`, for data_available at least.
class DataReaderWaitable : public eprosima::fastdds::dds::DataReaderListener, public Waitable {
 public:
  void on_data_available(eprosima::fastdds::dds::DataReader*) override {
    may_have_data_.store(true, std::memory_order_release);
    notify();
  }

  // Asks the reader only after something has arrived, so that waiting for many idle readers is cheap.
  bool is_ready() override {
    if (!may_have_data_.load(std::memory_order_acquire)) {
      return false;
    }
    if (has_data()) {
      return true;
    }
    may_have_data_.store(false, std::memory_order_release);
    // Data that came between the two lines above must not be forgotten.
    if (has_data()) {
      may_have_data_.store(true, std::memory_order_release);
      return true;
    }
    return false;
  }

  eprosima::fastdds::dds::DataReader* reader = nullptr;

 private:
  bool has_data() const {
    eprosima::fastdds::dds::SampleInfo info;
    return reader->get_first_untaken_info(&info) == ReturnCode_t::RETCODE_OK;
  }

  std::atomic<bool> may_have_data_{false};
};

}  // namespace rmw_fastrtps
