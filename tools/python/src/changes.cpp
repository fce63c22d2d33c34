// libdeck._native: values of a deck set by name, and blocks that come and go, kept until somebody
// writes them.
#include "deck/edit.hpp"

#include <utility>

#include "edit/shared/edit_set.hpp"
#include "native.hpp"

namespace deck::python {
namespace {

/// The changes of one deck, which they keep alive.
struct PyChanges {
  explicit PyChanges(DeckPointer deck) : before(std::move(deck)), edit(before->loaded) {}
  DeckPointer before;
  Edit edit;
};

/// KeyError where the deck has no such block.
const Block* block_of(Edit& edit, const std::string& keyword, std::int64_t id) {
  const auto block = edit.find(keyword, id);
  if (!block) throw py::key_error(block.error().message);
  return *block;
}

void must_have_worked(const Edit& edit) {
  if (const auto status = edit.status(); !status) throw py::value_error(status.error().message);
}

/// What an edit gives, or DeckError.
template <class Make>
auto value_of(PyChanges& c, const Make& make) {
  auto made = alone_with(*c.before, [&] { return make(c.edit); });
  if (!made) raise_error(made.error().message);
  return std::move(*made);
}

}  // namespace

void bind_changes(py::module_& m) {
  py::class_<PyChanges, std::shared_ptr<PyChanges>>(m, "Changes")
      .def("set_interface",
           [](PyChanges& c, std::size_t at, const std::string& field, const CellValue& value) {
             c.edit.set(c.before->loaded.interfaces().all.at(at), field, value);
             must_have_worked(c.edit);
           })
      .def("set_block",
           [](PyChanges& c, const std::string& keyword, std::int64_t id, const std::string& field,
              const CellValue& value, int occurrence) {
             c.edit.set(block_of(c.edit, keyword, id), field, value, occurrence);
             must_have_worked(c.edit);
           })
      .def("insert",
           [](PyChanges& c, const std::string& blocks) {
             c.edit.insert(blocks);
             must_have_worked(c.edit);
           })
      .def("erase",
           [](PyChanges& c, const std::string& keyword, std::int64_t id) {
             c.edit.erase(block_of(c.edit, keyword, id));
             must_have_worked(c.edit);
           })
      .def("move_node",
           [](PyChanges& c, std::int64_t id, double x, double y, double z) {
             c.edit.move_node(id, {x, y, z});
             must_have_worked(c.edit);
           })
      .def("notes", [](const PyChanges& c) { return c.edit.notes(); })
      .def("deck",
           [](PyChanges& c) {
             LoadedDeck now = value_of(c, [](Edit& e) { return e.read(); });
             return std::make_shared<PyDeck>(c.before->path, std::move(now));
           })
      .def("diff",
           [](PyChanges& c) { return py::bytes(value_of(c, [](Edit& e) { return e.diff(); })); })
      .def("save",
           [](PyChanges& c, const std::string& backup_suffix) {
             return value_of(c, [&](Edit& e) { return e.save({backup_suffix, {}}); });
           })
      .def("write", [](PyChanges& c, const std::string& directory, bool overwrite) {
        const EditSet set = value_of(c, [](Edit& e) { return e.files(); });
        return write_tree(set, c.before->loaded.deck(), directory, overwrite);
      });
  m.def("change", [](DeckPointer deck) { return std::make_shared<PyChanges>(std::move(deck)); });
}

}  // namespace deck::python
