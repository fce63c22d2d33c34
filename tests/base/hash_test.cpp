// The hash of contents against values of another implementation of XXH64.
#include "base/shared/hash.hpp"

#include <gtest/gtest.h>

namespace deck {
namespace {

TEST(ContentHash, IsXXH64ForEveryKindOfTail) {
  const std::string text = "/INTER/TYPE7/1 nodes against a surface, gaps and all";
  const std::pair<std::size_t, std::uint64_t> known[] = {
      {0, 0xef46db3751d8e999},  {1, 0xe89cd67289eddaea},  {3, 0x1afa81d58d9f89d0},
      {4, 0xc00ed26f44c7cd9f},  {7, 0x2ea02c9f8416c08d},  {8, 0x2f3ecc9e159c8a62},
      {13, 0xc054e9d23e85f346}, {31, 0x1a11fe6b14cdbfa5}, {32, 0x4fe47eeb3071fc60},
      {33, 0x98f92a7dde330ca3}, {47, 0x07ed2cc6a2e42cd2}, {52, 0x246126293abbb746}};
  for (const auto& [length, hash] : known)
    EXPECT_EQ(content_hash(text.substr(0, length)), hash) << length;
  EXPECT_EQ(content_hash("abc"), 0x44bc2cf5ad770999u) << "as published";
  EXPECT_EQ(content_hash(std::string("\xff\x80\0", 3)), 0x6845c593ffaafa54u)
      << "bytes count without a sign";
}

}  // namespace
}  // namespace deck
