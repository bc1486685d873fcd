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
  bool is_terminal() const;

 private:
  std::FILE* file_ = nullptr;  // the former standard output; null if there was none
};

}  // namespace launch
