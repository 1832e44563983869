// Sorting by vertex and loops over blocks, against the standard library.
#include "meshprep/base/bucket_sort.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace malus {
namespace {

using Item = std::pair<std::uint32_t, std::uint32_t>;  // number, and value

// Random items; some numbers have none, and one has many.
std::vector<Item> randomItems(std::size_t count, std::uint32_t numbers) {
  std::mt19937 random(7);
  std::vector<Item> items;
  for (std::size_t i = 0; i < count; ++i)
    items.emplace_back(i % 5 == 0 ? numbers / 2 : static_cast<std::uint32_t>(random() % numbers),
                       static_cast<std::uint32_t>(random()));
  return items;
}

TEST(BucketSort, SortsAsTheStandardLibrary) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{1000}, 5 * kParallelBlock + 3}) {
    constexpr std::uint32_t kNumbers = 40000;
    std::vector<Item> items = randomItems(count, kNumbers);
    const auto forEach = [&](auto visit) {
      for (const Item& item : items) visit(item.first, item);
    };
    const auto sorted = sortInBuckets<Item>(kNumbers, forEach, std::less<>());
    std::sort(items.begin(), items.end());
    EXPECT_EQ(sorted.items, items);
    ASSERT_EQ(sorted.first.size(), kNumbers + 1u);
    for (std::uint32_t number = 0; number <= kNumbers; ++number) {
      const auto first = std::lower_bound(items.begin(), items.end(), Item{number, 0});
      ASSERT_EQ(sorted.first[number], static_cast<std::uint32_t>(first - items.begin()));
    }
  }
}

TEST(ParallelBlocks, CollectInOrder) {
  const std::size_t count = 3 * kParallelBlock + 7;
  const auto thirds =
      collectBlocks<std::size_t>(count, [](std::size_t first, std::size_t last, std::vector<std::size_t>& list) {
        for (std::size_t i = first; i < last; ++i)
          if (i % 3 == 0) list.push_back(i);
      });
  ASSERT_EQ(thirds.size(), (count + 2) / 3);
  for (std::size_t i = 0; i < thirds.size(); ++i) ASSERT_EQ(thirds[i], 3 * i);
}

TEST(ParallelBlocks, TestEveryNumberOnce) {
  const std::size_t count = 2 * kParallelBlock + 1;
  std::vector<int> visits(count, 0);
  forNumbers(count, [&](std::size_t i) { ++visits[i]; });
  EXPECT_EQ(visits, std::vector<int>(count, 1));
  EXPECT_TRUE(allNumbers(count, [](std::size_t) { return true; }));
  EXPECT_TRUE(allNumbers(0, [](std::size_t) { return false; }));
  for (const std::size_t wrong : {std::size_t{0}, kParallelBlock, count - 1})
    EXPECT_FALSE(allNumbers(count, [&](std::size_t i) { return i != wrong; })) << wrong;
}

}  // namespace
}  // namespace malus
