// What the parts of the Python module share: a deck that arrays can keep alive, and errors.
#pragma once
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "deck/loaded_deck.hpp"

namespace deck {
class EditSet;
}

namespace deck::python {

namespace py = pybind11;

/// A deck in Python. Arrays over it have it as their base, so that it lives as long as they do.
struct PyDeck {
  /// Reads what Python asks for without the mutex: all but contacts.
  PyDeck(std::string deck_path, LoadedDeck&& read)
      : path(std::move(deck_path)), loaded(std::move(read)), files(loaded.deck().sources.size()) {
    loaded.interfaces();
    loaded.engine_files();
    SceneOptions contacts = loaded.scene_options();
    contacts.candidates = false;  // scenes that count them are made by the way
    contacts.ties = true;
    loaded.set_scene_options(contacts);
  }
  std::string path;
  LoadedDeck loaded;
  std::uint32_t files;        ///< how many sources are the deck's own
  bool errors_known = false;  ///< report_solver_errors() was called
  /// Groups are resolved on demand, by one thread at a time. Locked without the interpreter's lock.
  std::mutex mutex;
};
using DeckPointer = std::shared_ptr<PyDeck>;

/// What `make` returns, without the interpreter's lock and with the deck for itself.
template <class Make>
auto alone_with(PyDeck& d, const Make& make) {
  const py::gil_scoped_release free;
  const std::lock_guard one(d.mutex);
  return make();
}

/// Raises libdeck.DeckError(message, findings as a list of dictionaries).
[[noreturn]] void raise_error(const std::string& message, const Deck* deck = nullptr,
                              const std::vector<Finding>* findings = nullptr);
/// A finding as a dictionary with the keys of `deck lint --format json`.
py::dict make_finding(const Deck& deck, const Finding& finding);
/// {"file", "line", "column", "end_column"} of a span, or None.
py::object python_place(const Deck& deck, const Span& span);

/// A read-only NumPy array over memory that `owner` keeps: nothing is copied.
template <class T>
py::array view_of(const T* data, std::vector<py::ssize_t> shape, std::vector<py::ssize_t> strides,
                  const py::object& owner) {
  py::array out(py::dtype::of<T>(), std::move(shape), std::move(strides), data, owner);
  out.attr("flags").attr("writeable") = false;
  return out;
}
template <class T>
py::array view_of(const std::vector<T>& values, const py::object& owner) {
  return view_of(values.data(), {static_cast<py::ssize_t>(values.size())},
                 {static_cast<py::ssize_t>(sizeof(T))}, owner);
}
/// A view of one member of every element of `rows`; an array member gives a second axis.
template <class Row, class T>
py::array member_view(const std::vector<Row>& rows, T Row::*member, const py::object& owner) {
  const auto n = static_cast<py::ssize_t>(rows.size());
  const auto step = static_cast<py::ssize_t>(sizeof(Row));
  const Row* const first = rows.data();
  if constexpr (requires { typename T::value_type; }) {
    using V = typename T::value_type;
    return view_of<V>(rows.empty() ? nullptr : (first->*member).data(),
                      {n, static_cast<py::ssize_t>(std::tuple_size_v<T>)},
                      {step, static_cast<py::ssize_t>(sizeof(V))}, owner);
  } else {
    return view_of<T>(rows.empty() ? nullptr : &(first->*member), {n}, {step}, owner);
  }
}

/// Writes the include tree of `before` as the set has it below a directory; FileExistsError where a
/// file is there and `overwrite` is false, DeckError where it is one of the deck itself.
std::vector<std::string> write_tree(const EditSet& set, const Deck& before,
                                    const std::string& directory, bool overwrite);

void bind_results(py::module_& m);
void bind_changes(py::module_& m);
void bind_edits(py::module_& m);
void bind_answers(py::module_& m);

/// ValueError where it is not so.
inline void must_be(bool so, const char* what) {
  if (!so) throw py::value_error(what);
}

}  // namespace deck::python
