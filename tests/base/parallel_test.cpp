// One place starts threads: exceptions come out of the call, every item runs once, order holds.
#include "base/shared/parallel.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

#include "base/shared/side_by_side.hpp"

namespace deck {
namespace {

TEST(ParallelItems, EveryItemRunsOnceOnAnyNumberOfThreads) {
  for (const int threads : {1, 2, 7, 64}) {
    std::vector<std::atomic<int>> ran(1000);
    parallel_items(threads, ran.size(), [&](std::size_t i) { ++ran[i]; });
    for (const auto& count : ran) EXPECT_EQ(count.load(), 1) << threads;
  }
}

TEST(ParallelItems, AnExceptionOfAnyThreadComesOutOfTheCallAndNoFurtherItemBegins) {
  for (const int threads : {1, 2, 8})
    for (const std::size_t bad : {std::size_t{0}, std::size_t{5}, std::size_t{99}}) {
      std::atomic<int> after{0};
      EXPECT_THROW(parallel_items(threads, 1'000'000,
                                  [&](std::size_t i) {
                                    if (i > bad) ++after;
                                    if (i >= bad) throw std::bad_alloc();
                                  }),
                   std::bad_alloc)
          << threads << " " << bad;
      EXPECT_LE(after.load(), threads);
    }
}

TEST(SideBySide, EveryItemRunsOnceAndLargeOnesHaveAllThreads) {
  for (const int threads : {1, 2, 3, 16}) {
    std::vector<std::atomic<int>> ran(100);
    SideBySide<std::size_t> work(threads, [&](std::size_t i, std::size_t worker, int for_it) {
      ++ran[i];
      EXPECT_EQ(for_it, i == 7 ? threads : 1) << threads << " " << i;
      EXPECT_LT(worker, static_cast<std::size_t>(threads));
    });
    work.run([&] {
      for (std::size_t i = 0; i < ran.size(); ++i) work.add(i, i == 7 ? 100'000 : 10);
    });
    for (const auto& count : ran) EXPECT_EQ(count.load(), 1) << threads;
  }
}

TEST(SideBySide, AnExceptionOfFindingOrOfTheWorkComesOut) {
  for (const int found : {100, 50}) {
    SideBySide<int> work(2, [](int i, std::size_t, int) { i == 55 ? throw std::bad_alloc() : 0; });
    const auto find = [&] {
      for (int i = 0; i < found; ++i) work.add(i, 1);
      if (found == 50) throw std::bad_alloc();
    };
    EXPECT_THROW(work.run(find), std::bad_alloc) << found;
  }
}

TEST(RunWorkers, EveryNumberBelowTheCountRunsOnce) {
  for (const int count : {1, 2, 5}) {
    CancelFlag cancel;
    std::vector<std::atomic<int>> ran(8);
    std::atomic<int> ready{0};
    run_workers(count, cancel, [&](std::size_t worker) {
      ++ran.at(worker);
      for (++ready; ready.load() < count;) std::this_thread::yield();
    });
    for (std::size_t k = 0; k < ran.size(); ++k)
      EXPECT_EQ(ran[k].load(), k < static_cast<std::size_t>(count) ? 1 : 0) << count << " " << k;
  }
}

TEST(RunWorkers, NobodyIsAtWorkAfterTheCall) {
  for (int round = 0; round < 200; ++round) {
    CancelFlag cancel;
    std::atomic<int> begun{0}, ended{0};
    run_workers(4, cancel, [&](std::size_t) {
      ++begun;
      std::this_thread::yield();
      ++ended;
    });
    EXPECT_EQ(begun.load(), ended.load());  // who comes later finds the gate closed
  }
}

TEST(RunWorkers, OfSeveralExceptionsThatOfTheLowestWorkerIsThrownOn) {
  CancelFlag cancel;
  std::atomic<int> ready{0};
  try {
    run_workers(4, cancel, [&](std::size_t worker) {
      ++ready;
      while (ready.load() < 4) std::this_thread::yield();
      throw std::runtime_error(std::to_string(worker));
    });
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "0");
  }
  EXPECT_TRUE(cancel.is_set());
}

TEST(ParallelPieces, EveryItemIsInOnePieceAndPiecesHaveTheirOrder) {
  for (const int threads : {1, 2, 3, 64})
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{10}, std::size_t{4096}, std::size_t{100'001}}) {
      std::vector<std::pair<std::size_t, std::size_t>> bounds(pieces_of(threads, count));
      std::vector<std::atomic<int>> ran(bounds.size());
      parallel_pieces(threads, count, [&](std::size_t piece, std::size_t begin, std::size_t end) {
        bounds.at(piece) = {begin, end};
        ++ran[piece];
      });
      std::size_t next = 0;
      for (const auto& [begin, end] : bounds) {
        EXPECT_EQ(begin, next);
        next = end;
      }
      EXPECT_EQ(next, count);
      for (const auto& times : ran) EXPECT_EQ(times.load(), 1);
    }
}

TEST(ParallelPieces, WhatAThreadDoesNotGetToIsDoneByTheOther) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::seconds(60);
  const std::size_t count = 100'000, pieces = pieces_of(2, count);
  ASSERT_GT(pieces, 4U);
  std::atomic<std::size_t> done{0};
  parallel_pieces(2, count, [&](std::size_t piece, std::size_t, std::size_t) {
    // Whoever has the first piece is held up until all others are done.
    while (piece == 0 && done.load() + 1 < pieces && Clock::now() < deadline)
      std::this_thread::yield();
    ++done;
  });
  EXPECT_EQ(done.load(), pieces);
  EXPECT_LT(Clock::now(), deadline);
}

TEST(RunInOrder, ResultsAreTakenInOrder) {
  std::vector<std::size_t> taken;
  run_in_order<std::size_t>(
      500, 4, [](std::size_t k, std::size_t& out) { out = 2 * k; },
      [&](std::size_t k, const std::size_t& out) {
        EXPECT_EQ(out, 2 * k);
        taken.push_back(k);
      });
  std::vector<std::size_t> expected(500);
  std::iota(expected.begin(), expected.end(), std::size_t{0});
  EXPECT_EQ(taken, expected);
}

TEST(RunInOrder, AnExceptionOfWorkOrTakeEndsTheOthersToo) {
  for (const int threads : {1, 2, 8})
    for (const bool in_work : {true, false})
      EXPECT_THROW(run_in_order<int>(
                       10'000, threads,
                       [&](std::size_t k, int&) {
                         if (in_work && k == 40) throw std::bad_alloc();
                       },
                       [&](std::size_t k, int&) {
                         if (!in_work && k == 40) throw std::bad_alloc();
                       }),
                   std::bad_alloc)
          << threads << " " << in_work;
}

}  // namespace
}  // namespace deck
