// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/rank_test.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace tracing::compare {

namespace {

// The probability of each value of Mann and Whitney's U, from 0 to n * m, if all orders of the values are equally
// likely. The numbers of orders are the coefficients of a Gaussian binomial: the product over i of
// (1 - q^(m + i)) / (1 - q^i). The lower half is computed, where the differences lose no digits; the rest is its
// mirror.
std::vector<double> u_distribution(std::size_t n, std::size_t m) {
  const std::size_t most = n * m;
  const std::size_t half = most / 2;
  std::vector<double> orders(half + 1, 0);
  orders[0] = 1;
  for (std::size_t i = 1; i <= n; ++i) {
    for (std::size_t u = half; u >= m + i && u <= half; --u) {
      orders[u] -= orders[u - m - i];
    }
    for (std::size_t u = i; u <= half; ++u) {
      orders[u] += orders[u - i];
    }
  }
  std::vector<double> result(most + 1);
  double all = 0;
  for (std::size_t u = 0; u <= most; ++u) {
    result[u] = std::max(orders[std::min(u, most - u)], 0.0);
    all += result[u];
  }
  for (double& probability : result) {
    probability /= all;
  }
  return result;
}

// The probability of U or more, for each U.
const std::vector<double>& u_tail(std::size_t n, std::size_t m) {
  thread_local std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> known;
  const auto [found, is_new] = known.try_emplace({std::min(n, m), std::max(n, m)});
  if (is_new) {
    found->second = u_distribution(std::min(n, m), std::max(n, m));
    // From the small probabilities on, so that they keep their digits.
    for (std::size_t u = found->second.size() - 1; u > 0; --u) {
      found->second[u - 1] += found->second[u];
    }
  }
  return found->second;
}

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && values[order[last + 1]] == values[order[first]]) {
      ++last;
    }
    for (std::size_t at = first; at <= last; ++at) {
      ranks[order[at]] = static_cast<double>(first + last) / 2;
    }
    first = last + 1;
  }
  return ranks;
}

}  // namespace

double rank_probability(const std::vector<double>& before, const std::vector<double>& after) {
  std::vector<double> sorted = before;
  std::sort(sorted.begin(), sorted.end());
  double u = 0;  // pairs in which the value after is higher
  for (const double value : after) {
    const auto [equal, higher] = std::equal_range(sorted.begin(), sorted.end(), value);
    u += static_cast<double>(equal - sorted.begin()) + static_cast<double>(higher - equal) / 2;
  }
  // A half is rounded down, which makes the probability larger.
  return std::min(u_tail(before.size(), after.size())[static_cast<std::size_t>(u)], 1.0);
}

double sign_probability(std::size_t same, std::size_t all) {
  const auto coins = static_cast<double>(all);
  double tail = 0;
  for (std::size_t k = same; k <= all; ++k) {
    const auto heads = static_cast<double>(k);
    tail += std::exp(std::lgamma(coins + 1) - std::lgamma(heads + 1) - std::lgamma(coins - heads + 1) -
                     coins * std::log(2.0));
  }
  return std::min(1.0, 2 * tail);
}

Shift shift_between(const std::vector<double>& before, const std::vector<double>& after, double confidence) {
  std::vector<double> differences;
  differences.reserve(before.size() * after.size());
  for (const double earlier : before) {
    for (const double later : after) {
      differences.push_back(later - earlier);
    }
  }
  std::sort(differences.begin(), differences.end());
  const std::size_t count = differences.size();
  // So many differences at each end lie outside of the interval: the largest number that chance has seldom enough. Very
  // small samples have none.
  const std::vector<double>& tail = u_tail(before.size(), after.size());
  std::size_t outside = 0;
  while (2 * (outside + 1) < count && tail[count - outside - 1] <= (1 - confidence) / 2) {
    ++outside;
  }
  const double middle = (differences[(count - 1) / 2] + differences[count / 2]) / 2;
  return {middle, differences[outside], differences[count - 1 - outside]};
}

std::vector<double> corrected_for_many(const std::vector<double>& probabilities) {
  std::vector<std::size_t> order(probabilities.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return probabilities[a] < probabilities[b]; });
  std::vector<double> corrected(probabilities.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const double factor = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, probabilities[order[rank]] * factor));
    corrected[order[rank]] = largest;
  }
  return corrected;
}

double quantile(std::vector<double>& values, double share) {
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size()) - 1e-9));
  const std::size_t place = std::min(std::max<std::size_t>(rank, 1), values.size()) - 1;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(place), values.end());
  return values[place];
}

double rank_autocorrelation(const std::vector<double>& values) {
  const std::vector<double> ranks = ranks_of(values);
  const double mean = (static_cast<double>(ranks.size()) - 1) / 2;
  double together = 0;
  double alone = 0;
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    alone += (ranks[i] - mean) * (ranks[i] - mean);
    if (i + 1 < ranks.size()) {
      together += (ranks[i] - mean) * (ranks[i + 1] - mean);
    }
  }
  return alone == 0 ? 0 : together / alone;
}

}  // namespace tracing::compare
