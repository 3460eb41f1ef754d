// SPDX-License-Identifier: MIT
// Paired tests against SciPy 1.10.1 (numbers quoted with their command), against the enumeration of all signs and all
// Walsh averages, and against what must hold for any input.
#include "banyan/study/paired.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "banyan/world/random.hpp"

namespace banyan::study {
namespace {

using Differences = std::vector<double>;
using Strata = std::vector<Differences>;

constexpr double infinite = std::numeric_limits<double>::infinity();

double draw(std::uint64_t seed, std::uint64_t i) { return world::to_uniform(world::mix(world::mix(~seed) + i)); }

PairedValues pairs_of(const Strata& strata) {
  PairedValues pairs;
  for (std::size_t s = 0; s < strata.size(); ++s) {
    for (const double d : strata[s]) {
      pairs.first.push_back(d);
      pairs.second.push_back(0.0);
      pairs.stratum.push_back(7 * s + 3);
    }
  }
  return pairs;
}

SignedRank ranks_of(const Strata& strata) { return SignedRank(pairs_of(strata)); }
SignedRank ranks_of(const Differences& differences) { return ranks_of(Strata{differences}); }

// Random differences around `middle`: coarse ones have ties and zeros, and are exact in binary.
Differences some(std::uint64_t seed, std::size_t n, double middle, bool coarse) {
  Differences d(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double value = draw(seed, i) + draw(seed + 77777, i) - 1.0 + middle;
    d[i] = coarse ? std::floor(8.0 * value) / 8.0 : value;
  }
  return d;
}

// The test by its definition ----------------------------------------------------------------------

// Rank sum of the positive differences, each rank weighted; ties and zeros broken in their favour.
double favoured(const Strata& strata, bool positive) {
  double sum = 0.0;
  for (Differences d : strata) {
    if (!positive)
      for (double& value : d) value = -value;
    std::sort(d.begin(), d.end(), [](double a, double b) {
      return std::abs(a) != std::abs(b) ? std::abs(a) < std::abs(b) : a < b;  // the negative of one size first
    });
    for (std::size_t i = 0; i < d.size(); ++i)
      if (d[i] >= 0.0) sum += static_cast<double>(i + 1) / static_cast<double>(d.size() + 1);
  }
  return sum;
}

// The share of all signings of the ranks 1 to n_s with a sum up to this.
double enumerated(const Strata& strata, double sum) {
  Differences ranks;
  for (const auto& d : strata)
    for (std::size_t i = 1; i <= d.size(); ++i)
      ranks.push_back(static_cast<double>(i) / static_cast<double>(d.size() + 1));
  std::size_t upto = 0;
  for (std::size_t signs = 0; signs < std::size_t{1} << ranks.size(); ++signs) {
    double positive = 0.0;
    for (std::size_t i = 0; i < ranks.size(); ++i) positive += signs >> i & 1 ? ranks[i] : 0.0;
    upto += positive <= sum + 1e-9 ? 1 : 0;
  }
  return std::ldexp(static_cast<double>(upto), -static_cast<int>(ranks.size()));
}

double enumerated_p(const Strata& strata) {
  const double sum = std::min(favoured(strata, true), favoured(strata, false));
  return std::min(1.0, 2.0 * enumerated(strata, sum));
}

TEST(PairedSignedRank, AgreesWithAllSignings) {
  std::size_t significant = 0;
  for (std::uint64_t seed = 0; seed < 240; ++seed) {
    const auto d = some(seed, 1 + seed % 12, 0.1 * static_cast<double>(seed % 7), seed % 2 == 1);
    EXPECT_EQ(ranks_of(d).p(), enumerated_p({d})) << seed;
    significant += ranks_of(d).p() < 0.05 ? 1 : 0;
  }
  EXPECT_GT(significant, 20U);
}

TEST(PairedSignedRank, AgreesWithAllSigningsOfStrata) {
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    const bool coarse = seed % 2 == 1;
    const double middle = 0.1 * static_cast<double>(seed % 9);
    const Strata strata{some(seed, 1 + seed % 5, middle, coarse), some(seed + 1000, 1 + seed / 5 % 4, middle, coarse),
                        some(seed + 2000, 1 + seed / 20 % 3, middle, coarse)};
    EXPECT_NEAR(ranks_of(strata).p(), enumerated_p(strata), 1e-15) << seed;
  }
}

// Without ties it is the test that everybody has.
//   d = a - b; scipy.stats.wilcoxon(d, correction=True, mode='exact' if n <= 50 else 'approx').pvalue
//   r = scipy.stats.rankdata(abs(d)); (r[d > 0].sum() - r[d < 0].sum()) / r.sum()
TEST(PairedSignedRank, AgreesWithScipyOnBothSidesOfTheExactLimit) {
  struct Case {
    std::uint64_t n;
    double p, effect;
  };
  for (const Case& c :
       {Case{50, 0.5786292137562761, -0.09176470588235294}, Case{51, 0.5770347251282728, -0.09049773755656108},
        Case{200, 0.7654500810141874, 0.02437810945273632}}) {
    PairedValues pairs;
    for (std::uint64_t i = 1; i <= c.n; ++i) {
      pairs.first.push_back(static_cast<double>(i * 37 * 7919 % 1009) / 8.0);
      pairs.second.push_back(static_cast<double>(i * i * 31 % 997) / 8.0 + static_cast<double>(i) / 1024.0);
    }
    const SignedRank test(pairs);
    EXPECT_NEAR(test.p(), c.p, 1e-12) << c.n;
    EXPECT_NEAR(test.effect(), c.effect, 1e-14) << c.n;
  }
  Differences one_side(60);
  std::iota(one_side.begin(), one_side.end(), 1.0);
  // scipy.stats.wilcoxon(numpy.arange(1, 61) * 1.0, correction=True, mode='approx').pvalue
  EXPECT_NEAR(ranks_of(one_side).p(), 1.6713285696526423e-11, 1e-22);
  one_side.resize(50);
  EXPECT_EQ(ranks_of(one_side).p(), std::ldexp(1.0, -49));
  EXPECT_EQ(ranks_of(one_side).effect(), 1.0);
}

// Hollander, Wolfe: Nonparametric Statistical Methods (1973), ch. 3, depression scores before and after a tranquilizer:
// p = 0.039, the estimate is 0.46 and the interval from 0.010 to 0.786 (of confidence 0.961).
TEST(PairedSignedRank, AgreesWithTheTextbook) {
  const SignedRank test({{1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30},
                         {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29},
                         {}});
  EXPECT_EQ(test.pairs(), 9U);
  EXPECT_EQ(test.first_larger(), 7U);
  EXPECT_EQ(test.second_larger(), 2U);
  EXPECT_EQ(test.p(), 0.0390625);
  EXPECT_NEAR(test.effect(), 35.0 / 45.0, 1e-15);
  EXPECT_NEAR(test.shift(), 0.46, 1e-14);
  EXPECT_NEAR(test.interval(0.05).low, 0.010, 1e-14);
  EXPECT_NEAR(test.interval(0.05).high, 0.786, 1e-14);
}

// Estimate and interval ---------------------------------------------------------------------------

struct Weighted {
  double value, weight;
};

std::vector<Weighted> walsh(const Strata& strata) {
  std::vector<Weighted> list;
  for (const auto& d : strata)
    for (std::size_t i = 0; i < d.size(); ++i)
      for (std::size_t j = i; j < d.size(); ++j)
        list.push_back({0.5 * (d[i] + d[j]), 1.0 / static_cast<double>(d.size() + 1)});
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  return list;
}

// Where as much weight lies above as below: the mean of the two middle ones if the weight is halved between them.
double weighted_median(const std::vector<Weighted>& list) {
  double all = 0.0, upto = 0.0;
  for (const auto& w : list) all += w.weight;
  for (std::size_t i = 0; i < list.size(); ++i) {
    upto += list[i].weight;
    if (std::abs(upto - 0.5 * all) < 1e-9) return 0.5 * (list[i].value + list[i + 1].value);
    if (upto > 0.5 * all) return list[i].value;
  }
  return std::nan("");
}

TEST(PairedSignedRank, ShiftIsTheMedianOfTheWalshAverages) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const bool coarse = seed % 2 == 1;
    const auto one = some(seed, 1 + seed % 30, 0.3, coarse);
    EXPECT_NEAR(ranks_of(one).shift(), weighted_median(walsh({one})), 1e-13) << seed;
    const Strata strata{one, some(seed + 500, 1 + seed % 7, 0.1, coarse), some(seed + 900, 4, -0.2, coarse)};
    EXPECT_NEAR(ranks_of(strata).shift(), weighted_median(walsh(strata)), 1e-13) << seed;
  }
}

// The promise of the class: whoever looks at the interval and whoever looks at p see the same.
void expect_consistent(const Strata& strata, double alpha) {
  const auto test = ranks_of(strata);
  const Interval interval = test.interval(alpha);
  EXPECT_EQ(interval.low > 0.0 || interval.high < 0.0, test.p() < alpha);
  EXPECT_LE(interval.low, test.shift());
  EXPECT_GE(interval.high, test.shift());
}

TEST(PairedSignedRank, TheIntervalExcludesZeroIfAndOnlyIfTheTestRejectsIt) {
  std::size_t rejected = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const bool coarse = seed % 3 != 0;
    const double middle = 0.02 * static_cast<double>(seed % 11);
    Strata strata{some(seed, 1 + seed % 40, middle, coarse)};
    if (seed % 5 == 0) strata.push_back(some(seed + 10000, 1 + seed % 37, middle, coarse));
    for (const double alpha : {0.05, 0.01, 0.05 / 24.0, 0.3}) {
      expect_consistent(strata, alpha);
      rejected += ranks_of(strata).p() < alpha ? 1 : 0;
    }
  }
  EXPECT_GT(rejected, 1000U);
  EXPECT_LT(rejected, 9000U);
}

TEST(PairedSignedRank, TheIntervalHoldsTheShiftsThatAreNotRejected) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Strata strata{some(seed, 3 + seed % 20, 0.2, true), some(seed + 99, 2 + seed % 30, 0.1, true)};
    const auto test = ranks_of(strata);
    const double alpha = seed % 2 == 0 ? 0.05 : 0.2;
    const Interval interval = test.interval(alpha);
    for (double x = -1.5; x <= 1.5; x += 1.0 / 64.0)  // on Walsh averages, of sixteenths, and between them
      EXPECT_EQ(interval.low <= x && x <= interval.high, test.p(x) >= alpha) << seed << " at " << x;
  }
}

TEST(PairedSignedRank, NoBoundsWhereNothingCanBeRejected) {
  for (std::size_t n = 1; n <= 8; ++n) {
    const auto interval = ranks_of(Differences(n, 1.0)).interval(0.05);  // the least p is 2^(1 - n)
    EXPECT_EQ(std::isinf(interval.low), n <= 5) << n;
    EXPECT_EQ(std::isinf(interval.high), n <= 5) << n;
  }
}

TEST(PairedSignedRank, AConstantMovesTheEstimateByIt) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Strata strata{some(seed, 6 + seed % 60, 0.0, true), some(seed + 300, 5 + seed % 9, 0.0, true)};
    const auto before = ranks_of(strata);
    for (auto& d : strata)
      for (double& value : d) value += 4.375;
    const auto after = ranks_of(strata);
    EXPECT_EQ(after.shift(), before.shift() + 4.375);
    EXPECT_EQ(after.interval(0.05).low, before.interval(0.05).low + 4.375);
    EXPECT_EQ(after.interval(0.05).high, before.interval(0.05).high + 4.375);
    EXPECT_EQ(after.p(4.375), before.p());
    EXPECT_LT(after.p(), 0.05);
  }
}

TEST(PairedSignedRank, SwapNegatesAndOrderDoesNothing) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    PairedValues pairs = pairs_of({some(seed, 20, 0.1, true), some(seed + 40, 35, 0.1, seed % 2 == 0)});
    const SignedRank test(pairs);
    const SignedRank swapped({pairs.second, pairs.first, pairs.stratum});
    EXPECT_EQ(swapped.p(), test.p());
    EXPECT_EQ(swapped.effect(), -test.effect());
    EXPECT_EQ(swapped.shift(), -test.shift());
    EXPECT_EQ(swapped.interval(0.05).low, -test.interval(0.05).high);
    EXPECT_EQ(swapped.first_larger(), test.second_larger());
    std::reverse(pairs.first.begin(), pairs.first.end());
    std::reverse(pairs.second.begin(), pairs.second.end());
    std::reverse(pairs.stratum.begin(), pairs.stratum.end());
    const SignedRank reversed(pairs);
    EXPECT_EQ(reversed.p(), test.p());
    EXPECT_EQ(reversed.shift(), test.shift());
    EXPECT_EQ(reversed.interval(0.05).low, test.interval(0.05).low);
  }
}

// Worlds may differ much in what they cost: what differs between them must not hide what differs within them.
TEST(PairedSignedRank, RanksAreGivenWithinAStratum) {
  Strata strata;
  for (std::uint64_t s = 0; s < 3; ++s) strata.push_back(some(s, 15, 0.0, false));
  for (double& value : strata[2]) value = 100.0 * value + 90.0;  // a world with large differences above 0
  for (double& value : strata[0]) value -= 0.9;                  // two with small ones below
  for (double& value : strata[1]) value -= 0.9;
  Differences pooled;
  for (const auto& d : strata) pooled.insert(pooled.end(), d.begin(), d.end());
  EXPECT_LT(ranks_of(strata).effect(), -0.25);
  EXPECT_GT(ranks_of(pooled).effect(), 0.02);
  EXPECT_EQ(SignedRank({pooled, Differences(45, 0.0), {}}).p(), ranks_of(pooled).p());
}

// Worlds of so many sizes that their weights have no common denominator within bounds, by the formulas.
TEST(PairedSignedRank, AgreesWithTheFormulasForManyWorldsOfManySizes) {
  Strata strata;
  double variance = 0.0;
  for (std::uint64_t n = 11; n <= 47; n += 2) {
    strata.push_back(some(n, n, 0.05, false));
    const auto size = static_cast<double>(n);
    variance += size * (2.0 * size + 1.0) / (24.0 * (size + 1.0));
  }
  double above = 0.0, below = 0.0;
  for (const auto& average : walsh(strata)) (average.value > 0.0 ? above : below) += average.weight;
  const double distance = 0.5 * std::abs(above - below) - 0.5 / 48.0;  // half a rank of the largest world
  const auto test = ranks_of(strata);
  EXPECT_NEAR(test.p(), std::erfc(distance / std::sqrt(2.0 * variance)), 1e-6);
  EXPECT_NEAR(test.shift(), weighted_median(walsh(strata)), 1e-9);
  EXPECT_NEAR(test.effect(), (above - below) / (above + below), 1e-6);
  EXPECT_LT(test.p(), 0.2);
}

// Logistic differences, a true shift of 0.25 in each of three worlds of 7, 9 and 11 pairs, and 60 in one: four
// standard deviations of a share of 0.95 in 2,000 are 0.02.
TEST(PairedSignedRank, CoversTheTruthAsOftenAsPromised) {
  constexpr std::size_t samples = 2000;
  std::size_t small = 0, large = 0;
  const auto logistic = [](std::uint64_t seed, std::size_t n) {
    Differences d(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double u = draw(seed, i);
      d[i] = 0.25 + std::log((u + 1e-9) / (1.0 - u + 1e-9));
    }
    return d;
  };
  const auto covers = [](const Interval& interval) { return interval.low <= 0.25 && 0.25 <= interval.high; };
  for (std::uint64_t seed = 0; seed < samples; ++seed) {
    const Strata worlds{logistic(3 * seed, 7), logistic(3 * seed + 1, 9), logistic(3 * seed + 2, 11)};
    small += covers(ranks_of(worlds).interval(0.05)) ? 1 : 0;
    large += covers(ranks_of(logistic(seed + 1000000, 60)).interval(0.05)) ? 1 : 0;
  }
  for (const std::size_t covered : {small, large}) {
    EXPECT_GT(covered, 0.93 * samples);
    EXPECT_LT(covered, 0.97 * samples);
  }
}

// Tenths and whole numbers must tell the same story, though 0.3 - 0.2 < 0.2 - 0.1 in binary.
TEST(PairedSignedRank, RoundingBreaksNoTies) {
  PairedValues whole, tenths;
  for (std::uint64_t i = 0; i < 40; ++i) {
    whole.first.push_back(std::floor(3000.0 * draw(1, i)));
    whole.second.push_back(whole.first.back() + std::floor(9.0 * draw(2, i)) - 3.0);
    tenths.first.push_back(whole.first.back() * 0.1);
    tenths.second.push_back(whole.second.back() / 10.0);
  }
  const SignedRank a(whole), b(tenths);
  ASSERT_LT(a.first_larger() + a.second_larger(), 40U);  // there are zeros
  EXPECT_EQ(b.first_larger(), a.first_larger());
  EXPECT_EQ(b.second_larger(), a.second_larger());
  EXPECT_EQ(b.effect(), a.effect());
  EXPECT_EQ(b.p(), a.p());
  EXPECT_EQ(b.shift(), a.shift() / 10.0);
}

TEST(PairedSignedRank, NothingToCompare) {
  const SignedRank none({});
  EXPECT_TRUE(std::isnan(none.shift()) && std::isnan(none.interval(0.05).low));
  EXPECT_EQ(none.p(), 1.0);
  EXPECT_EQ(none.effect(), 0.0);
  const auto same = ranks_of(Differences(20, 0.0));
  EXPECT_EQ(same.shift(), 0.0);
  EXPECT_EQ(same.p(), 1.0);
  EXPECT_EQ(same.effect(), 0.0);
  EXPECT_EQ(same.interval(0.05).low, 0.0);
  EXPECT_EQ(same.interval(0.05).high, 0.0);
  EXPECT_EQ(ranks_of({2.0, -2.0, 2.0, -2.0}).p(), 1.0);
  EXPECT_EQ(ranks_of(Differences{-3.0}).p(), 1.0);
  EXPECT_EQ(ranks_of(Differences{-3.0}).effect(), -1.0);
}

TEST(PairedSignedRank, SizesBeyondMeasure) {
  for (const double size : {1e-300, 1e-12, 1e13, 1e300}) {
    const auto test = ranks_of(Differences{size, 2 * size, 3 * size, 4 * size, 5 * size, 6 * size});
    EXPECT_EQ(test.p(), 0.03125) << size;
    EXPECT_NEAR(test.shift() / size, 3.5, 1e-12) << size;
  }
  Differences many(20000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = draw(9, i) - 0.48;
  EXPECT_NEAR(ranks_of(many).shift(), 0.02, 0.01);
  EXPECT_LT(ranks_of(many).p(), 1e-6);
}

TEST(PairedSignedRank, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(SignedRank({{1, 2}, {1}, {}}), std::invalid_argument);
  EXPECT_THROW(SignedRank({{1, 2}, {1, 2}, {1}}), std::invalid_argument);
  for (const double bad : {std::nan(""), infinite})
    EXPECT_THROW(SignedRank({{1, bad}, {1, bad}, {}}), std::invalid_argument);
  EXPECT_THROW(SignedRank({{1e308}, {-1e308}, {}}), std::invalid_argument);
  for (const double bad : {0.0, 1.0, std::nan("")}) {
    EXPECT_THROW((void)ranks_of(Differences{1.0}).interval(bad), std::invalid_argument);
    EXPECT_THROW((void)PairedShares{}.interval(bad), std::invalid_argument);
  }
}

// Recorded here with gcc 12 on x86-64: another machine, library or build type must not differ.
TEST(PairedSignedRank, BitsAreTheSameEverywhere) {
  Differences d;
  for (int i = 1; i <= 60; ++i) d.push_back(0.1 * (i * i % 17) - 0.1 * (i * 3 % 19));
  EXPECT_EQ(ranks_of(d).p(), 0x1.555c57657fbecp-1);
  EXPECT_EQ(ranks_of(d).interval(0.05).low, -0.25);
  EXPECT_EQ((PairedShares{400, 230, 170}.interval(0.05).low), 0x1.94140815d1174p-5);
}

// McNemar's test ----------------------------------------------------------------------------------

double mcnemar_p(std::size_t first_only, std::size_t second_only) {
  return PairedShares{first_only + second_only, first_only, second_only}.p();
}

TEST(PairedMcNemar, AgreesWithScipy) {  // scipy.stats.binomtest(fewer, n).pvalue
  struct Case {
    std::size_t fewer, n;
    double p;
  };
  for (const Case& c : {Case{0, 1, 1.0}, Case{1, 5, 0.375}, Case{3, 12, 0.14599609375}, Case{6, 13, 1.0},
                        Case{400, 1000, 2.728464156065976e-10}, Case{100, 1000, 1.3403435580012363e-161},
                        Case{2400, 5000, 0.00488364973751758}, Case{1900, 5000, 4.210554001517878e-65},
                        Case{499, 1000, 0.9747749818216398}, Case{500, 1000, 1.0}}) {
    EXPECT_NEAR(mcnemar_p(c.fewer, c.n - c.fewer), c.p, 1e-10 * c.p) << c.fewer;
    EXPECT_NEAR(mcnemar_p(c.n - c.fewer, c.fewer), c.p, 1e-10 * c.p) << c.fewer;
  }
}

TEST(PairedMcNemar, AgreesWithPascalsTriangle) {
  std::vector<std::uint64_t> row{1};
  for (std::size_t n = 1; n <= 40; ++n) {
    std::vector<std::uint64_t> next(n + 1, 1);
    for (std::size_t k = 1; k < n; ++k) next[k] = row[k - 1] + row[k];
    row = next;
    for (std::size_t k = 0; k <= n; ++k) {
      std::uint64_t as_rare = 0;  // outcomes no likelier than k
      for (const std::uint64_t ways : row) as_rare += ways <= row[k] ? ways : 0;
      const double p = std::ldexp(static_cast<double>(as_rare), -static_cast<int>(n));
      EXPECT_NEAR(mcnemar_p(k, n - k), p, 1e-13 * p) << k << " of " << n;
    }
  }
}

TEST(PairedMcNemar, NeitherOverflowsNorUnderflowsTooEarly) {
  EXPECT_EQ(mcnemar_p(0, 1000), std::ldexp(1.0, -999));
  EXPECT_EQ(mcnemar_p(1060, 0), std::ldexp(1.0, -1059));
  EXPECT_EQ(mcnemar_p(0, 20000), 0.0);
  // float(Fraction(2 * sum(math.comb(20000, k) for k in range(9801)), 2**20000)), in Python
  EXPECT_NEAR(mcnemar_p(9800, 10200), 0.004780889455902644, 1e-14);
}

TEST(PairedMcNemar, CountsAndEffect) {
  const PairedShares test{20, 9, 3};
  EXPECT_EQ(test.effect(), 0.5);
  EXPECT_EQ(test.difference(), 0.3);
  EXPECT_EQ((PairedShares{5, 0, 0}).p(), 1.0);
  EXPECT_EQ((PairedShares{5, 0, 0}).effect(), 0.0);
  EXPECT_TRUE(std::isnan(PairedShares{}.difference()) && std::isnan(PairedShares{}.interval(0.05).low));
}

// scipy.stats.binomtest(7, 10).proportion_ci(0.95, method='exact') is 0.34754715, 0.93326051; all pairs differ, and
// Wilson's interval of that ends at 1.
TEST(PairedMcNemar, IntervalAgreesWithClopperAndPearson) {
  const Interval interval = PairedShares{10, 7, 3}.interval(0.05);
  EXPECT_NEAR(interval.low, 2 * 0.34754715 - 1, 1e-7);
  EXPECT_NEAR(interval.high, 2 * 0.93326051 - 1, 1e-7);
  // None of 50 pairs differs: as many as Wilson allows may do so, on either side.
  const Interval none = PairedShares{50, 0, 0}.interval(0.05);
  EXPECT_NEAR(none.high, wilson(0, 50, 0.95).high, 1e-12);
  EXPECT_EQ(none.low, -none.high);
}

TEST(PairedMcNemar, TheIntervalExcludesZeroIfAndOnlyIfTheTestRejectsIt) {
  std::size_t rejected = 0;
  for (std::size_t first = 0; first <= 30; ++first) {
    for (std::size_t second = 0; second <= 30; ++second) {
      const PairedShares test{80, first, second};
      for (const double alpha : {0.05, 0.05 / 12.0, 0.3}) {
        const Interval interval = test.interval(alpha);
        EXPECT_EQ(interval.low > 0.0 || interval.high < 0.0, test.p() < alpha) << first << " " << second;
        EXPECT_LE(interval.low, test.difference());
        EXPECT_GE(interval.high, test.difference());
        rejected += test.p() < alpha ? 1 : 0;
      }
    }
  }
  EXPECT_GT(rejected, 500U);
  EXPECT_GT(PairedShares({20000, 4000, 3000}).interval(0.05).low, 0.0) << "terms too small for a double";
}

// Verdicts ----------------------------------------------------------------------------------------

TEST(PairedVerdict, ByIntervalAndMargin) {
  EXPECT_EQ(judge({-2, 1}, 0.5), Verdict::undecided);
  EXPECT_EQ(judge({-0.4, 0.5}, 0.5), Verdict::no_difference);
  EXPECT_EQ(judge({0, 0}, 0), Verdict::undecided) << "without a margin nothing is the same";
  EXPECT_EQ(judge({0, 2}, 0.5), Verdict::undecided) << "an end at 0 is not beyond it";
  EXPECT_EQ(judge({-2, -0.1}, 0.5), Verdict::lower);
  EXPECT_EQ(judge({-0.3, -0.1}, 0.5), Verdict::lower_within);
  EXPECT_EQ(judge({0.1, 2}, 0.5), Verdict::higher);
  EXPECT_EQ(judge({0.1, 0.5}, 0.5), Verdict::higher_within);
  EXPECT_EQ(judge({-infinite, infinite}, 0.5), Verdict::undecided);
  EXPECT_EQ(judge({std::nan(""), std::nan("")}, 0.5), Verdict::undecided);
}

}  // namespace
}  // namespace banyan::study
