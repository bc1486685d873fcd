// SPDX-License-Identifier: Apache-2.0
// The statistics of a comparison: a rank test, the shift between two samples, and a correction for many tests.
#pragma once

#include <cstddef>
#include <vector>

namespace tracing::compare {

// The probability that chance alone gives the values of `after` at least as high ranks among all values as they have
// (Mann and Whitney 1947, one-sided, exact, without an assumption about the distribution). Values are independent;
// equal ones count half. Both samples have at least one value, and at most a few hundred.
double rank_probability(const std::vector<double>& before, const std::vector<double>& after);

// The probability that at least `same` of `all` coins, or at most all others of them, fall on one side: the sign test,
// for both directions.
double sign_probability(std::size_t same, std::size_t all);

// How much higher the values of a sample are.
struct Shift {
  double estimate = 0;  // Hodges and Lehmann 1963: the median of all differences of a value after and a value before
  double low = 0;       // the interval that belongs to the rank test, which holds with the given confidence
  double high = 0;
};
Shift shift_between(const std::vector<double>& before, const std::vector<double>& after, double confidence);

// Probabilities of many tests, corrected so that 0.01 means: with a probability of at most 1 %, any of the tests below
// it is there by chance (Holm 1979). In the order of the arguments.
std::vector<double> corrected_for_many(const std::vector<double>& probabilities);

// By nearest rank; `share` is 0 to 1. Changes the order of the values, of which there is at least one.
double quantile(std::vector<double>& values, double share);

// How much neighbours resemble: the correlation of the ranks of values with those of the next values, -1 to 1; 0 if all
// values are equal.
double rank_autocorrelation(const std::vector<double>& values);

}  // namespace tracing::compare
