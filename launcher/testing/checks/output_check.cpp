// SPDX-License-Identifier: Apache-2.0
// <output …/> and <in_order>
#include <fmt/format.h>

#include "launcher/testing/checks/check.hpp"

namespace launch {

namespace {

// "3 lines", "1 line", "no line"
std::string lines_text(std::uint64_t count) {
  return count == 0 ? "no line" : count == 1 ? "1 line" : fmt::format("{} lines", count);
}

// What both have in common: the lines of the processes that are meant.
class LineCheck : public Check {
 public:
  using Check::Check;

  void on_process(const ProcessEvent& event) override {
    if (std::holds_alternative<ProcessStarted>(event.what) && concerns(event.spec, event.label)) {
      labels_.push_back(event.label);
    }
  }

  void on_line(const ProcessSpec& spec, const std::string& label, OutputStream stream, std::string_view line) override {
    if (is_open() && concerns(spec, label)) {
      ++lines_;
      on_own_line(stream, line);
    }
  }

 protected:
  virtual void on_own_line(OutputStream stream, std::string_view line) = 0;

  std::string from() const {
    return expectation().process.empty() ? std::string() : fmt::format(" from {}", subject_of(expectation()));
  }
  Failure with_lines(Failure failure) const {
    if (!expectation().process.empty() && labels_.empty()) {
      failure.seen += "; the process was never started";
    } else {
      tail().show(failure, expectation().process.empty() ? std::vector<std::string>() : labels_);
    }
    return failure;
  }
  std::uint64_t lines() const { return lines_; }

 private:
  std::uint64_t lines_ = 0;
};

class OutputCheck final : public LineCheck {
 public:
  explicit OutputCheck(const Expectation& expectation)
      : LineCheck(expectation), expected_(std::get<ExpectedOutput>(expectation.what)) {}

  // An upper limit alone holds until the end.
  bool is_waited_for() const override {
    return !expected_.after_shutdown && (found_ < expected_.least || !expected_.most);
  }

 protected:
  void on_own_line(OutputStream stream, std::string_view line) override {
    if (!expected_.line.matches(stream, line) || (expected_.after_shutdown && !in_shutdown())) {
      return;
    }
    ++found_;
    if (expected_.most && found_ > *expected_.most) {
      const std::string what = *expected_.most == 0
                                   ? fmt::format("there is {}{}", expected_.line.describe(), from())
                                   : fmt::format("there are more than {} of {}{}", lines_text(*expected_.most),
                                                 expected_.line.describe(), from());
      Failure failure{what, expectation().where, count_text(), fmt::format("\"{}\"", line.substr(0, 200))};
      fail(with_lines(std::move(failure)));
    } else if (!expected_.most && found_ >= expected_.least) {
      meet();
    } else if (found_ == expected_.least) {
      reconsider();
    }
  }

  std::optional<Failure> verdict(const std::string& when) override {
    if (found_ >= expected_.least) {
      return std::nullopt;
    }
    return with_lines({fmt::format("there was not {}{} {}", enough_text(), from(),
                                   expected_.after_shutdown ? "at the shutdown" : when),
                       expectation().where, count_text(),
                       found_ == 0 ? fmt::format("none in {}", lines_text(lines()))
                                   : fmt::format("{} in {}", found_, lines_text(lines()))});
  }

 private:
  std::string enough_text() const {
    return expected_.least == 1 ? expected_.line.describe()
                                : fmt::format("{} times {}", expected_.least, expected_.line.describe());
  }
  std::string count_text() const {
    const std::string what = expected_.line.describe();
    if (expected_.most && *expected_.most == 0) {
      return fmt::format("never {}", what);
    }
    if (expected_.most) {
      return expected_.least == 0 ? fmt::format("at most {} times {}", *expected_.most, what)
                                  : fmt::format("{} to {} times {}", expected_.least, *expected_.most, what);
    }
    return expected_.least == 1 ? what : fmt::format("at least {} times {}", expected_.least, what);
  }

  ExpectedOutput expected_;
  std::uint64_t found_ = 0;
};

class SequenceCheck final : public LineCheck {
 public:
  explicit SequenceCheck(const Expectation& expectation)
      : LineCheck(expectation), expected_(std::get<ExpectedSequence>(expectation.what)) {}

 protected:
  void on_own_line(OutputStream stream, std::string_view line) override {
    if (expected_.lines[found_].matches(stream, line) && ++found_ == expected_.lines.size()) {
      meet();
    }
  }

  std::optional<Failure> verdict(const std::string& when) override {
    return with_lines({fmt::format("line {} of {} did not come{} {}", found_ + 1, expected_.lines.size(), from(), when),
                       expectation().where,
                       found_ == 0 ? expected_.lines[found_].describe()
                                   : fmt::format("{}, after {}", expected_.lines[found_].describe(),
                                                 expected_.lines[found_ - 1].describe()),
                       fmt::format("{} of the sequence, in {}", lines_text(found_), lines_text(lines()))});
  }

 private:
  ExpectedSequence expected_;
  std::size_t found_ = 0;
};

}  // namespace

std::unique_ptr<Check> make_output_check(const Expectation& expectation) {
  return std::make_unique<OutputCheck>(expectation);
}

std::unique_ptr<Check> make_sequence_check(const Expectation& expectation) {
  return std::make_unique<SequenceCheck>(expectation);
}

}  // namespace launch
