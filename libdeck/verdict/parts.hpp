// The sentences of a verdict while they are made. Private to the stage.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "deck/verdict.hpp"

namespace deck::detail {

struct Sentences {
  std::vector<VerdictSentence> all;
  void add(const char* what, std::string text, VerdictCounts counts) {
    all.push_back({what, std::move(text), std::move(counts)});
  }
};

/// Forces, what leaves its interface, accelerations and the time step of the first cycle.
void say_forces(const VerdictInput& input, Sentences& out);

}  // namespace deck::detail
