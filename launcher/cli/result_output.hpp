// SPDX-License-Identifier: Apache-2.0
// Standard output of a command that only looks at launch files.
#pragma once

#include <cstdio>
#include <string_view>

namespace launch {

// While it lives, only print() writes to standard output. What Python code and the programs that it starts write there
// goes to standard error, so that it never gets into a result that a program reads. One at a time.
class ResultOutput {
 public:
  ResultOutput();
  ResultOutput(const ResultOutput&) = delete;
  ResultOutput& operator=(const ResultOutput&) = delete;
  ~ResultOutput();

  void print(std::string_view text);
  // False if something could not be written, which it reports. To be called behind the last print().
  bool finish();
  bool is_terminal() const;

 private:
  void note_error();

  std::FILE* file_ = nullptr;  // the former standard output; null if there was none
  int error_ = 0;              // errno of the first text that could not be written
};

}  // namespace launch
