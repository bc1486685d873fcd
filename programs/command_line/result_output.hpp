// SPDX-License-Identifier: Apache-2.0
// Standard output of a command whose result a program may read.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace launch {

// While it lives, only print() writes to standard output. What Python code and the programs that it starts write there
// goes to standard error, so that it never gets into a result that a program reads. One at a time.
class ResultOutput {
 public:
  // `command` is "launch check", for the error when the output can't be written.
  explicit ResultOutput(std::string command);
  ResultOutput(const ResultOutput&) = delete;
  ResultOutput& operator=(const ResultOutput&) = delete;
  ~ResultOutput();

  void print(std::string_view text);
  // False if something could not be written, which it reports. To be called behind the last print().
  bool finish();
  bool has_colour() const;

 private:
  void note_error();

  std::string command_;
  std::FILE* file_ = nullptr;  // the former standard output; null if there was none
  int error_ = 0;              // errno of the first text that could not be written
};

}  // namespace launch
