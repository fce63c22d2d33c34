// Atomic writing: what is in place before, after and when something goes wrong.
#include "edit/shared/write.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <array>

#include <cstring>
#include <filesystem>
#include <string_view>
#include <thread>

#include "base/shared/hash.hpp"
#include "folder.hpp"

namespace deck {
namespace {

namespace fs = std::filesystem;

class AtomicWriting : public testing::Test {
 protected:
  std::string at(const std::string& name) const { return (dir_ / name).string(); }
  void put(const std::string& name, const std::string& text) const { folder_.write(name, text); }
  std::string get(const std::string& name) const { return folder_.read(name); }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::recursive_directory_iterator(dir_), fs::recursive_directory_iterator()));
  }
  mode_t mode(const std::string& name) const {
    struct stat status {};
    return stat(at(name).c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
  }
  const test::Folder folder_;
  const fs::path dir_ = folder_.path();
};

TEST_F(AtomicWriting, NewFilesFollowUmaskReplacedOnesKeepTheirMode) {
  const mode_t old = umask(027);
  const auto written = write_file_atomic(at("a.rad"), "new");
  umask(old);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(mode("a.rad"), 0640u);
  EXPECT_EQ(entries(), 1u);
  chmod(at("a.rad").c_str(), 0751);
  fs::create_hard_link(dir_ / "a.rad", dir_ / "b.rad");
  ASSERT_TRUE(write_file_atomic(at("a.rad"), "newer"));
  EXPECT_EQ(get("a.rad"), "newer");
  EXPECT_EQ(mode("a.rad"), 0751u);
  EXPECT_EQ(get("b.rad"), "new") << "another name of a hard link keeps the old bytes";
}

TEST_F(AtomicWriting, LinksStayAndTheirTargetIsReplacedOrMade) {
  fs::create_directories(dir_ / "real");
  put("real/a.rad", "old");
  fs::create_symlink("real/a.rad", dir_ / "link.rad");
  fs::create_symlink("link.rad", dir_ / "link of link.rad");
  fs::create_symlink("later.rad", dir_ / "early.rad");
  ASSERT_TRUE(write_file_atomic(at("link of link.rad"), "new"));
  ASSERT_TRUE(write_file_atomic(at("early.rad"), "new"));
  for (const char* link : {"link of link.rad", "link.rad", "early.rad"})
    EXPECT_TRUE(fs::is_symlink(dir_ / link)) << link;
  EXPECT_FALSE(fs::is_symlink(dir_ / "real/a.rad"));
  EXPECT_EQ(get("real/a.rad"), "new");
  EXPECT_EQ(get("later.rad"), "new");
  fs::create_symlink("circle b", dir_ / "circle a");
  fs::create_symlink("circle a", dir_ / "circle b");
  EXPECT_FALSE(write_file_atomic(at("circle a"), "new"));
}

/// Sets an attribute; false: the file system keeps none.
bool set(const std::string& path, const char* name, std::string_view value) {
  return setxattr(path.c_str(), name, value.data(), value.size(), 0) == 0;
}
std::string get_attribute(const std::string& path, const char* name) {
  std::array<char, 256> value{};
  const ssize_t size = getxattr(path.c_str(), name, value.data(), value.size());
  return size < 0 ? "none" : std::string(value.data(), static_cast<std::size_t>(size));
}

/// An access list of the kernel's form: user 1234 may read and write, the owning group nothing.
std::string access_list() {
  struct Entry {
    std::uint16_t tag, bits;
    std::uint32_t id;
  };
  constexpr std::uint32_t nobody = 0xffffffff;
  const Entry entries[] = {
      {1, 6, nobody}, {2, 6, 1234}, {4, 0, nobody}, {16, 6, nobody}, {32, 0, nobody}};
  std::string out(4 + sizeof entries, '\0');
  out[0] = 2;
  std::memcpy(out.data() + 4, entries, sizeof entries);
  return out;
}

TEST_F(AtomicWriting, AReplacedFileKeepsItsAccessListAndItsAttributes) {
  put("a.rad", "old");
  if (!set(at("a.rad"), "user.deck.test", "kept") ||
      !set(at("a.rad"), "system.posix_acl_access", access_list()))
    GTEST_SKIP() << "this file system keeps no attributes";
  ASSERT_TRUE(write_file_atomic(at("a.rad"), "new"));
  EXPECT_EQ(get("a.rad"), "new");
  EXPECT_EQ(get_attribute(at("a.rad"), "user.deck.test"), "kept");
  EXPECT_EQ(get_attribute(at("a.rad"), "system.posix_acl_access"), access_list());
}

TEST_F(AtomicWriting, AReplacedFileGetsNoAccessListOfItsDirectory) {
  put("a.rad", "old");
  if (!set(dir_.string(), "system.posix_acl_default", access_list()))
    GTEST_SKIP() << "this file system keeps no access lists";
  ASSERT_TRUE(write_file_atomic(at("a.rad"), "new"));
  EXPECT_EQ(get_attribute(at("a.rad"), "system.posix_acl_access"), "none");
}

TEST_F(AtomicWriting, NoLinkBelowTheDirectoryLeadsElsewhere) {
  put("precious", "old");
  fs::create_directories(dir_ / "out");
  fs::create_directories(dir_ / "home");
  fs::create_symlink("../precious", dir_ / "out/mesh.inc");
  fs::create_symlink("../home", dir_ / "out/parts");
  WriteOptions options;
  options.make_directories = true;
  options.below = at("out");
  const auto link = write_file_atomic(at("out/mesh.inc"), "new", options);
  ASSERT_FALSE(link);
  EXPECT_NE(link.error().message.find("out/mesh.inc is a symbolic link"), std::string::npos)
      << link.error().message;
  EXPECT_FALSE(write_file_atomic(at("out/parts/a.inc"), "new", options));
  EXPECT_EQ(get("precious"), "old");
  EXPECT_TRUE(fs::is_empty(dir_ / "home"));
  EXPECT_TRUE(write_file_atomic(at("out/other/a.inc"), "new", options));
}

TEST_F(AtomicWriting, ABackupIsNeverReplacedAndTheNextOneGetsANumber) {
  const WriteOptions options{.backup_suffix = ".orig"};
  for (const char* text : {"first", "second", "third"}) {
    ASSERT_TRUE(write_file_atomic(at("a.rad"), text, options));
  }
  EXPECT_EQ(get("a.rad"), "third");
  EXPECT_EQ(get("a.rad.orig"), "first");
  EXPECT_EQ(get("a.rad.orig.2"), "second");
  EXPECT_EQ(entries(), 3u);
  // One with the same bytes is enough, also as another name of the file: what a kill between making
  // the backup and replacing the file leaves.
  put("b.rad", "old");
  fs::create_hard_link(dir_ / "b.rad", dir_ / "b.rad.orig");
  ASSERT_TRUE(write_file_atomic(at("b.rad"), "new", options));
  EXPECT_EQ(get("b.rad"), "new");
  EXPECT_EQ(get("b.rad.orig"), "old");
  EXPECT_EQ(entries(), 5u);
}

TEST_F(AtomicWriting, WithoutFollowingLinksTheLinkIsReplaced) {
  put("precious", "old");
  fs::create_symlink("precious", dir_ / "result.json");
  ASSERT_EQ(mkfifo(at("pipe.json").c_str(), 0600), 0);
  WriteOptions options;
  options.follow_links = false;
  ASSERT_TRUE(write_file_atomic(at("result.json"), "new", options));
  ASSERT_TRUE(write_file_atomic(at("pipe.json"), "new", options));
  EXPECT_EQ(get("precious"), "old");
  EXPECT_EQ(get("result.json"), "new");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(dir_ / "result.json")));
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(dir_ / "pipe.json")));
}

/// What a file was when it was read.
FileRead read_now(const std::string& path, std::string_view bytes) {
  struct stat status {};
  EXPECT_EQ(stat(path.c_str(), &status), 0);
  return {status.st_dev, status.st_ino, bytes};
}

TEST_F(AtomicWriting, FilesAreReplacedIfAllAreWhatWasRead) {
  put("a.rad", "old");
  put("b.inc", "old b");
  const FileRead a = read_now(at("a.rad"), "old"), b = read_now(at("b.inc"), "old b");
  const auto write = [&] {
    return write_files_atomic({{at("a.rad"), "new", a}, {at("b.inc"), "new b", b}});
  };
  put("b.inc", "EDITED");  // the same file with other bytes, as many editors save
  const auto done = write();
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("b.inc was changed"), std::string::npos);
  EXPECT_EQ(get("a.rad"), "old");
  EXPECT_EQ(get("b.inc"), "EDITED");
  put("b.inc", "old b");
  ASSERT_TRUE(write());
  EXPECT_EQ(get("a.rad"), "new");
  EXPECT_EQ(get("b.inc"), "new b");
  EXPECT_EQ(entries(), 2u) << "no note is left";
}

TEST_F(AtomicWriting, AFilePutInItsPlaceSinceItWasReadIsKept) {
  put("a.rad", "old");
  const FileRead a = read_now(at("a.rad"), "old");
  put("saved", "old");  // even with the same bytes: somebody means another file
  fs::rename(at("saved"), at("a.rad"));
  EXPECT_FALSE(write_files_atomic({{at("a.rad"), "new", a}}));
  EXPECT_EQ(get("a.rad"), "old");
  fs::remove(at("a.rad"));
  EXPECT_FALSE(write_files_atomic({{at("a.rad"), "new", a}}));
  EXPECT_EQ(entries(), 0u) << "what was deleted does not come back";
}

TEST_F(AtomicWriting, OfManyWhoReadTheSameFileOneReplacesIt) {
  put("a.rad", "0");
  // Every thread adds one to what it reads, as long as it takes: no addition may be lost.
  constexpr int each = 40;
  const auto count = [&] {
    for (int done = 0; done < each;) {
      const std::string text = get("a.rad");
      const auto written = write_files_atomic(
          {{at("a.rad"), std::to_string(std::stoi(text) + 1), read_now(at("a.rad"), text)}},
          {"", true, true, false});
      done += written.ok() ? 1 : 0;
    }
  };
  std::thread one(count), two(count), three(count);
  one.join();
  two.join();
  three.join();
  EXPECT_EQ(get("a.rad"), std::to_string(3 * each));
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicWriting, SetWithOneImpossibleFileChangesNothing) {
  put("a.rad", "old");
  fs::create_directories(dir_ / "c.rad");
  EXPECT_FALSE(write_files_atomic(
      {{at("a.rad"), "new"}, {at("sub/b.rad"), "new"}, {at("c.rad"), "a directory"}}));
  EXPECT_EQ(get("a.rad"), "old");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(AtomicWriting, AResultKnowsWhatItWasMadeFromUntilSomebodyChangesIt) {
  OutputFile file{at("out.rad"), "made"};
  file.origin = "/decks/car_0000.rad";
  ASSERT_TRUE(write_files_atomic({file}));
  if (!is_unchanged_output(file.path, file.origin)) GTEST_SKIP() << "no notes on this file system";
  EXPECT_FALSE(is_unchanged_output(file.path, "/decks/bus_0000.rad"));
  EXPECT_FALSE(is_unchanged_output(file.path, "car_0000.rad"));
  EXPECT_FALSE(is_unchanged_output(file.path, ""));
  put("out.rad", "MADE");
  EXPECT_FALSE(is_unchanged_output(file.path, file.origin));
}

TEST_F(AtomicWriting, PiecesBecomeOneFileOrLeaveTheOldOne) {
  const auto pieces = [&](bool fail) {
    return write_file_atomic(at("a"), [&](const WritePiece& write) -> Result<void> {
      for (const char* piece : {"one ", "", "two ", "three"})
        if (auto written = write(piece); !written) return written;
      if (fail) return Error{Error::Code::io, "no more"};
      return {};
    });
  };
  put("a", "old");
  const auto failed = pieces(true);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().message, "no more");
  EXPECT_EQ(get("a"), "old");
  ASSERT_TRUE(pieces(false));
  EXPECT_EQ(get("a"), "one two three");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicWriting, MissingDirectoryIsMadeOnlyWhenAskedFor) {
  EXPECT_FALSE(write_file_atomic(at("x/y/a.rad"), "a"));
  EXPECT_EQ(entries(), 0u);
  ASSERT_TRUE(write_files_atomic({{at("x/y/a.rad"), "a"}}));
  EXPECT_EQ(get("x/y/a.rad"), "a");
}

TEST_F(AtomicWriting, StrayFileOfAKilledProcessIsNoObstacle) {
  put(".a.rad." + std::to_string(getpid()) + "-0.tmp", "half");
  ASSERT_TRUE(write_file_atomic(at("a.rad"), "new"));
  EXPECT_EQ(get("a.rad"), "new");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(AtomicWriting, LongestFileNameIsWritten) {
  const std::string name(255, 'n');
  ASSERT_TRUE(write_file_atomic(at(name), "new"));
  EXPECT_EQ(get(name), "new");
}

/// Two files of a set as a kill between their renames leaves them: b.inc is new, a.rad, the main
/// file, is old and its new contents lie beside it, as does the note.
class InterruptedSet : public AtomicWriting {
 protected:
  InterruptedSet() {
    put("a.rad", "old a");
    put("b.inc", "new b");
    put(".a.rad.1-0.tmp", "new a");
    put("..b.inc.1-1.tmp.1-1.tmp", "old b");  // its other name
    note(step("1-0", "old a", "new a", at("a.rad")) + step("1-1", "old b", "new b", at("b.inc")));
  }
  /// One line of a note.
  static std::string step(const std::string& suffix, const std::string& was, const std::string& is,
                          const std::string& target) {
    return fmt::format("{}\t{:016x}\t{:016x}\t{}\n", suffix, content_hash(was), content_hash(is),
                       target);
  }
  void note(const std::string& steps) const {
    fs::remove(at(".a.rad.unfinished"));
    put(".a.rad.unfinished", "deck unfinished 3\n" + steps + "end\n");
    fs::permissions(at(".a.rad.unfinished"), fs::perms::owner_read | fs::perms::owner_write);
  }
  Result<std::size_t> finish() const {
    return complete_interrupted_write(at("a.rad"), {at("a.rad"), at("b.inc")});
  }
  std::size_t finished() const {
    const auto done = finish();
    EXPECT_TRUE(done) << done.error().message;
    return done ? *done : 0;
  }
  /// The note is not obeyed and stays where it is; empty: it is taken for none.
  void expect_left_alone(const std::string& why) const {
    const std::size_t before = entries();
    const auto done = finish();
    if (why.empty())
      EXPECT_TRUE(done && *done == 0);
    else
      EXPECT_TRUE(!done && done.error().message.find(why) != std::string::npos);
    EXPECT_EQ(entries(), before);
    EXPECT_EQ(get("a.rad"), "old a");
  }
};

TEST_F(InterruptedSet, IsOnlyLookedAtByWhoReads) {
  EXPECT_EQ(unfinished_note(at("a.rad")), at(".a.rad.unfinished"));
  EXPECT_EQ(unfinished_note(at("c.rad")), std::nullopt);
  EXPECT_EQ(get("a.rad"), "old a");
  EXPECT_EQ(entries(), 5u);
}

TEST_F(InterruptedSet, IsNotFinishedWithoutTheDecksOfAllItsFiles) {
  const auto done = complete_interrupted_write(at("a.rad"), {at("a.rad")});
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("b.inc, which is not a file of the given decks"),
            std::string::npos);
  EXPECT_EQ(get("a.rad"), "old a");
  EXPECT_EQ(entries(), 5u);
}

TEST_F(InterruptedSet, ANoteThatIsNoNoteIsNotBelieved) {
  fs::permissions(at(".a.rad.unfinished"), fs::perms(0644));  // as a checkout makes it
  expect_left_alone("");
  EXPECT_EQ(unfinished_note(at("a.rad")), std::nullopt);
  fs::permissions(at(".a.rad.unfinished"), fs::perms(0600));
  fs::resize_file(at(".a.rad.unfinished"), std::uintmax_t{1} << 40);  // not read whole
  expect_left_alone("not a whole note");
  fs::remove(at(".a.rad.unfinished"));
  ASSERT_EQ(mkfifo(at(".a.rad.unfinished").c_str(), 0600), 0);
  expect_left_alone("");
  fs::remove(at(".a.rad.unfinished"));
  fs::create_symlink("/dev/zero", at(".a.rad.unfinished"));
  expect_left_alone("");
}

TEST_F(InterruptedSet, ANoteThatLeadsOutOfTheDeckIsNotObeyed) {
  fs::create_directories(dir_ / "home");
  put("home/thesis.txt", "precious");
  note(step("1-0", "precious", "new a", at("home/thesis.txt")));
  expect_left_alone("not a file of the given decks");
  note(step("1-0", "old a", "new a", "a.rad"));
  expect_left_alone("not a file of the given decks");
  for (const char* suffix : {"../home/thesis.txt", "1-0/../x", "1", "-1", ""}) {
    note(step(suffix, "old a", "precious", at("a.rad")));
    expect_left_alone("not a whole note");
  }
  EXPECT_EQ(get("home/thesis.txt"), "precious");
}

TEST_F(InterruptedSet, ALinkInPlaceOfTheNewFileIsNotPutInPlace) {
  put("precious", "precious");
  fs::create_symlink("precious", at(".a.rad.7-7.tmp"));
  note(step("7-7", "old a", "precious", at("a.rad")));
  EXPECT_EQ(finished(), 0u);
  EXPECT_EQ(get("a.rad"), "old a");
  EXPECT_FALSE(fs::is_symlink(fs::symlink_status(at("a.rad"))));
  EXPECT_EQ(get("precious"), "precious");
}

TEST_F(InterruptedSet, IsFinishedFromItsMainFile) {
  EXPECT_EQ(finished(), 1u);
  EXPECT_EQ(get("a.rad"), "new a");
  EXPECT_EQ(get("b.inc"), "new b");
  EXPECT_EQ(entries(), 2u);
  EXPECT_EQ(finished(), 0u);
}

TEST_F(InterruptedSet, IsDroppedWhereAFileWasChangedSince) {
  put("b.inc", "old b, restored");
  EXPECT_EQ(finished(), 0u);
  EXPECT_EQ(get("a.rad"), "old a");
  EXPECT_EQ(get("b.inc"), "old b, restored");
  EXPECT_EQ(entries(), 2u);
}

TEST_F(InterruptedSet, IsLeftToAWriterThatLives) {
  int ready[2], leave[2];
  ASSERT_EQ(pipe(ready), 0);
  ASSERT_EQ(pipe(leave), 0);
  const pid_t writer = fork();
  if (writer == 0) {
    const int fd = open(at(".a.rad.unfinished").c_str(), O_RDWR);
    struct flock whole {};
    whole.l_type = F_WRLCK;
    char c = fcntl(fd, F_SETLK, &whole) == 0 ? 'y' : 'n';
    if (write(ready[1], &c, 1) != 1 || close(leave[1]) != 0 || read(leave[0], &c, 1) < 0) _exit(1);
    _exit(0);
  }
  char c = 0;
  ASSERT_EQ(read(ready[0], &c, 1), 1);
  ASSERT_EQ(c, 'y');
  EXPECT_EQ(finished(), 0u);
  EXPECT_EQ(get("a.rad"), "old a");
  close(leave[1]);
  waitpid(writer, nullptr, 0);
  EXPECT_EQ(finished(), 1u);
  EXPECT_EQ(get("a.rad"), "new a");
}

TEST(TemporaryName, BelongsToItsTargetOnly) {
  EXPECT_TRUE(is_temporary_of(".car.json.12-0.tmp", "car.json"));
  EXPECT_FALSE(is_temporary_of(".car.json.12-0.tmp", "car"));
  EXPECT_FALSE(is_temporary_of(".car.json.12-0.tmp", "car.json.12-0"));
  EXPECT_FALSE(is_temporary_of("car.json.12-0.tmp", "car.json"));
  EXPECT_FALSE(is_temporary_of(".car.json..tmp", "car.json"));
  EXPECT_FALSE(is_temporary_of(".tmp", ""));
  EXPECT_FALSE(is_temporary_of("..car.json.12-0.tmp.12-0.tmp", "car.json")) << "an old file";
  EXPECT_EQ(temporary_of(".car.json.12-0.tmp"), 12);
  for (const char* name : {".car.json.12.tmp", ".car.json.x-0.tmp", "car.json.12-0.tmp", ".tmp"})
    EXPECT_EQ(temporary_of(name), std::nullopt) << name;
}

}  // namespace
}  // namespace deck
