// How each word of --accuracy decides a pair. Private to the accuracy stage.
#pragma once
#include "accuracy/shared/accuracy.hpp"
#include "deck/contact/scene.hpp"

namespace deck::accuracy {

struct Word {
  Accuracy accuracy;
  bool (*closer)(const PairSample&);      // the distance is below the gap
  double (*distance)(const PairSample&);  // by its formula
};

const Word& word(Accuracy accuracy);

}  // namespace deck::accuracy
