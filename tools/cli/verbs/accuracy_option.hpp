// The option --accuracy of the verbs that decide about contact.
#pragma once

#include <string>

#include "command_line.hpp"
#include "deck/contact/scene.hpp"

namespace deck::cli {

/// Adds --accuracy; `value` keeps the word.
inline void add_accuracy(CommandLine& line, std::string& value) {
  line.option("--accuracy", value,
              "How contact of a pair is decided: fast (plain double), reference (the solver's "
              "formula), robust (never decides wrongly, filtered), exact (rationals)")
      .one_of({"fast", "reference", "robust", "exact"})
      .show_default();
}

inline Accuracy accuracy_of(const std::string& value) {
  for (const Accuracy a : {Accuracy::fast, Accuracy::reference, Accuracy::exact})
    if (value == to_string(a)) return a;
  return Accuracy::robust;
}

}  // namespace deck::cli
