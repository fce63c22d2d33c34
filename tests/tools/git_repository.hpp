// A git work tree with a deck in it, for tests of what the program asks git.
#pragma once
#include <cstdlib>

#include "tools/command_line.hpp"

namespace deck::testing_support {

/// models/car_0000.rad, with its nodes in models/inc/nodes.inc, committed and tagged v1.
class GitRepository : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    if (IsSkipped()) return;
    if (std::system("git --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no git";
    const std::string text = read(deck::test::source_dir() / "samples" / "too_close_0000.rad");
    const auto nodes = text.find("/NODE");
    const auto next = text.find("\n/", nodes);
    write(dir_ / "models/inc/nodes.inc", text.substr(nodes, next + 1 - nodes));
    write(dir_ / "models/car_0000.rad",
          text.substr(0, nodes) + "#include inc/nodes.inc\n" + text.substr(next + 1));
    git("init -q -b main");
    commit("first");
    git("tag v1");
  }
  void git(const std::string& words) const {
    const std::string command = "cd '" + dir_.string() +
                                "' && git -c user.name=a -c user.email=a@b " + words +
                                " > /dev/null 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << words;
  }
  void commit(const std::string& message) const {
    git("add models");
    git("commit -q -m '" + message + "'");
  }
  /// Replaces a text of a file where it stands last.
  void replace(const char* file, const std::string& old, const std::string& now) const {
    std::string text = read(dir_ / file);
    const auto at = text.rfind(old);
    ASSERT_NE(at, std::string::npos) << old;
    write(dir_ / file, text.replace(at, old.size(), now));
  }
  /// Another height of the line that begins with a node.
  void lift(const char* node, const char* height) const {
    std::string text = read(dir_ / "models/inc/nodes.inc");
    const auto at = text.find("\n" + std::string(10 - std::string(node).size(), ' ') + node);
    ASSERT_NE(at, std::string::npos) << node;
    const std::string z = std::string(20 - std::string(height).size(), ' ') + height;
    write(dir_ / "models/inc/nodes.inc", text.replace(at + 1 + 50, 20, z));
  }
  bool has(const std::string& text) const { return out().find(text) != std::string::npos; }
  bool complains(const std::string& text) const { return err().find(text) != std::string::npos; }
};

}  // namespace deck::testing_support
