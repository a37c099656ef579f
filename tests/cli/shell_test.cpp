// What shells make of the program: completion and man pages.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "clca/process/program.hpp"
#include "support/missing.hpp"
#include "support/program.hpp"
#include "support/runs.hpp"

namespace clca::shell_test {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using ::testing::UnorderedElementsAre;
using Lines = std::vector<std::string>;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

/// What the program says, without what the candidates mean.
Lines completions(Lines words) {
  words.insert(words.begin(), "__complete");
  Lines lines = lines_of(testing::run_program(words).out);
  for (std::string& line : lines) {
    line = line.substr(0, line.find('\t'));
  }
  return lines;
}

const fs::path kShell = fs::path(CLCA_SOURCE_DIR) / "src/cli/completion";

TEST(Completion, NamesCommandsOptionsAndTheirWords) {
  EXPECT_THAT(completions({"re"}), ElementsAre("words", "resume", "render", "report"));
  EXPECT_THAT(completions({"help", "re"}), ElementsAre("words", "resume", "render", "report"));
  EXPECT_THAT(completions({"run", "--se"}), ElementsAre("words", "--set", "--seed"));
  EXPECT_THAT(completions({"export", "--format", ""}), AllOf(Contains("gsd"), Contains("xyz")));
  EXPECT_THAT(completions({"export", "--format=g"}), ElementsAre("words", "--format=gsd"));
  EXPECT_THAT(completions({"render", "--color-by", "sp"}),
              ElementsAre("words", "species", "speed", "spin"));
  EXPECT_THAT(completions({"no-command", ""}), ElementsAre("words"));
  EXPECT_THAT(completions({}), Contains("run"));
}

TEST(Completion, NamesScenesAndFilesWhereTheyMayStand) {
  EXPECT_THAT(completions({"run", "--quiet", "wall"}), ElementsAre("files", "wall-removal"));
  EXPECT_THAT(completions({"run", "--seed", "3", "wall"}), ElementsAre("files", "wall-removal"));
  EXPECT_THAT(completions({"run", "wall-removal", ""}), ElementsAre("words"));
  EXPECT_THAT(completions({"run", "-o", ""}), ElementsAre("files"));
  EXPECT_THAT(completions({"render", "a", "b", ""}), ElementsAre("files"));
  EXPECT_THAT(completions({"run", "--threads", ""}), ElementsAre("words"));
}

TEST(Completion, NamesKeysOfScenesAndTheirWords) {
  EXPECT_THAT(completions({"run", "--set", "rules.t"}), ElementsAre("words", "rules.ties="));
  EXPECT_THAT(completions({"run", "--set=ru"}), ElementsAre("words", "--set=rules."));
  EXPECT_THAT(completions({"check", "--set", "stages.flow.unt"}),
              ElementsAre("words", "stages.flow.until.", "stages.flow.until="));
  EXPECT_THAT(completions({"run", "--set", "stages."}), ElementsAre("words"));  // a name follows
  EXPECT_THAT(completions({"run", "--set", "boltzmann.ens"}),
              ElementsAre("words", "boltzmann.ensemble="));
  EXPECT_THAT(completions({"sweep", "--vary", "rules.ties=particle,d"}),
              ElementsAre("words", "rules.ties=particle,direction"));
  EXPECT_THAT(
      completions({"run", "--set", "output.trajectory.contacts="}),
      IsSupersetOf({"output.trajectory.contacts=true", "output.trajectory.contacts=false"}));
  EXPECT_THAT(completions({"explain", "rules.in"}), ElementsAre("words", "rules.inertia"));
}

/// Of `clca ARGUMENTS` in that shell, where `script` prints the candidates for $1.
Lines completions_in(const std::string& shell, const std::string& script,
                     const std::string& arguments) {
  const auto program = process::find_program(shell);
  const auto result = testing::run_program({"-c", script, shell, CLCA_PROGRAM " " + arguments},
                                           {.folder = kShell, .program = program->string()});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return lines_of(result.out);
}

/// A folder `my folder` and, of it, what is begun on a command line, with quotes or a backslash.
struct SpacedFolder {
  SpacedFolder() { fs::create_directory(path); }
  testing::ScratchFolder outside;
  fs::path path = outside.path() / "my folder";
  std::string before = outside.path().string() + "/my";
  Lines begun = {before + "\\ fo", '"' + before + " fo", '\'' + before + " fo"};
};

TEST(Completion, WorksInBash) {
  if (!process::find_program("bash")) {
    CLCA_SKIP_AS_MISSING("no bash");
  }
  const auto in_bash = [](const std::string& arguments) {
    return completions_in("bash", R"(
        source clca.bash; COMP_LINE=$1; COMP_POINT=${#1}; _clca
        printf '%s\n' "${COMPREPLY[@]}")",
                          arguments);
  };
  EXPECT_THAT(in_bash("rep"), ElementsAre("report"));
  EXPECT_THAT(in_bash("run --set rules.inertia=0 wall"), ElementsAre("wall-removal"));
  EXPECT_THAT(in_bash("run --set rules.in"), ElementsAre("rules.inertia="));
  EXPECT_THAT(in_bash("run --set model="), ElementsAre("automaton", "contact", "voids", "baxter"));
  EXPECT_THAT(in_bash("render "), IsSupersetOf({"_clca", "clca.fish"}));
  EXPECT_THAT(in_bash("run 'some scene' --set \"model=c"), ElementsAre("model=contact"));
  const SpacedFolder folder;
  for (const std::string& begun : folder.begun) {
    EXPECT_THAT(in_bash("plot " + begun), ElementsAre(folder.path)) << begun;
    EXPECT_THAT(in_bash("run --output=" + begun), ElementsAre(folder.path)) << begun;
  }
}

TEST(Completion, WorksInFish) {
  if (!process::find_program("fish")) {
    CLCA_SKIP_AS_MISSING("no fish");
  }
  const testing::ScratchFolder home;  // fish writes there
  const auto in_fish = [&](const std::string& arguments) {
    const std::string set = "set -x HOME " + home.path().string() + "; ";
    return completions_in("fish", set + "source clca.fish; complete -C $argv[2]", arguments);
  };
  EXPECT_THAT(
      in_fish("rep"),
      ElementsAre("report\tWrite a page about a run or a sweep: measures, figures, pictures"));
  EXPECT_THAT(in_fish("run --set model="), UnorderedElementsAre("model=automaton", "model=contact",
                                                                "model=voids", "model=baxter"));
  EXPECT_THAT(in_fish("render "), IsSupersetOf({"_clca", "clca.fish"}));
  EXPECT_THAT(in_fish("run 'some scene' --set \"model=c"), ElementsAre("model=contact"));
  const SpacedFolder folder;
  for (const std::string& begun : folder.begun) {
    EXPECT_THAT(in_fish("plot " + begun), ElementsAre(folder.path.string() + '/')) << begun;
    EXPECT_THAT(in_fish("run --output=" + begun),
                ElementsAre("--output=" + folder.path.string() + '/'))
        << begun;
  }
}

TEST(Completion, WorksInZsh) {
  if (!process::find_program("zsh")) {
    CLCA_SKIP_AS_MISSING("no zsh");
  }
  // In place of the functions of zsh that show candidates.
  const auto in_zsh = [](const std::string& arguments) {
    return completions_in("zsh", R"(
        _describe() { shift 3; print -l -- ${(P)1} ${(P)3} }
        _files() { print -l -- * }
        words=(${(z)1}); [[ $1 == *' ' ]] && words+=('')
        CURRENT=$#words; PREFIX=$words[-1]; complete() { source ./_clca }; complete)",
                          arguments);
  };
  EXPECT_THAT(in_zsh("run --set model="),
              ElementsAre("model=automaton", "model=contact", "model=voids", "model=baxter"));
  EXPECT_THAT(in_zsh("run --set rules.in"), ElementsAre(HasSubstr("rules.inertia=:probability")));
  EXPECT_THAT(in_zsh("render "), IsSupersetOf({"_clca", "clca.fish"}));
}

TEST(Man, HasPagesOfAllCommandsWithoutWarnings) {
  const auto man = process::find_program("man");
  if (!man) {
    CLCA_SKIP_AS_MISSING("no man");
  }
  const testing::ScratchFolder folder;
  EXPECT_EQ(testing::run_program({"__man", folder.path().string()}).code, 0);
  Lines names;
  for (const auto& file : fs::directory_iterator(folder.path())) {
    names.push_back(file.path().filename());
    const auto page = testing::run_program(
        {"--warnings", "-l", file.path().string()},
        {.environment = {{"MANWIDTH", "200"}, {"LC_ALL", "C.UTF-8"}}, .program = man->string()});
    EXPECT_EQ(page.code, 0);
    EXPECT_EQ(page.err, "") << file.path();
    EXPECT_THAT(page.out, AllOf(HasSubstr("SYNOPSIS"), HasSubstr("EXIT STATUS")));
  }
  EXPECT_THAT(names, IsSupersetOf({"clca.1", "clca-run.1", "clca-scenes.1"}));
  EXPECT_THAT(names, Not(Contains("clca-help.1")));
}

TEST(Scenes, AreListedWithTheirTitles) {
  EXPECT_THAT(testing::run_program({"scenes"}).out,
              AllOf(HasSubstr("wall-removal  "), HasSubstr("  Flow down a rough slope\n")));
  EXPECT_THAT(testing::run_program({"scenes", "--json"}).out,
              HasSubstr("\"title\": \"Flow down a rough slope\""));
}

TEST(Scenes, AreTakenFromTheNearestFolderThatOthersCannotWriteTo) {
  const testing::ScratchFolder folder;
  const fs::path prefix = folder.path() / "prefix";
  fs::create_directories(prefix / "bin");
  fs::create_directories(prefix / "share/clca/scenes");
  const fs::path program = prefix / "bin/clca";
  fs::copy_file(CLCA_PROGRAM, program);
  fs::copy_file(fs::path(CLCA_SOURCE_DIR) / "scenes/maze.png",
                prefix / "share/clca/scenes/maze.png");
  fs::copy_file(fs::path(CLCA_SOURCE_DIR) / "scenes/maze.yaml",
                prefix / "share/clca/scenes/planted.yaml");
  const auto scenes = [&] {
    return testing::run_program({"scenes"}, {.program = program.string()}).out;
  };
  EXPECT_EQ(scenes(), "planted  Through a maze\n");
  fs::permissions(prefix, fs::perms::others_write, fs::perm_options::add);
  EXPECT_THAT(scenes(), Not(HasSubstr("planted")));
}

}  // namespace
}  // namespace clca::shell_test
