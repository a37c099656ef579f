// Fewer threads than asked for: the same result. The limit is that of support/few_threads.cpp, as
// root has none of the system.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/program.hpp"
#include "support/run_folders.hpp"
#include "support/runs.hpp"

namespace clca::threads_test {
namespace {

using ::testing::HasSubstr;

/// Enough particles for steps on several threads, pictures, checkpoints.
constexpr const char* kFall = R"(clca: 1
box: {width: 200, height: 300}
species: {grain: {shape: {hexagon: 1}}}
stages: [{name: fall, fill: {region: [0, 0, 200, 300], counts: {grain: 4500}}, until: {steps: 25}}]
output: {frames: {every: 10, width: 128, height: 128, caption: false}, series: {every: 5}, checkpoint: {every: 5}}
)";

constexpr const char* kGas = R"(clca: 1
boltzmann: {particles: 20000, ensemble: 3, restitution: 0.9, friction: 0.3, until: 2}
)";

class FewThreads : public ::testing::Test {
 protected:
  FewThreads() {
    std::ofstream(scene("fall")) << kFall;
    std::ofstream(scene("gas")) << kGas;
  }

  std::string scene(const std::string& name) const {
    return (folder_.path() / (name + ".yaml")).string();
  }
  std::string at(const std::string& name) const { return (folder_.path() / name).string(); }

  static testing::ProgramResult run(const std::vector<std::string>& arguments,
                                    const std::map<std::string, std::string>& environment) {
    return testing::run_program(arguments, {.environment = environment});
  }
  static std::map<std::string, std::string> most(const std::string& threads) {
    return {{"LD_PRELOAD", CLCA_FEW_THREADS}, {"CLCA_MOST_THREADS", threads}};
  }

  testing::ScratchFolder folder_;
};

TEST_F(FewThreads, CarryOutARunWithOneWarningAndTheSameResult) {
  for (const std::string name : {"fall", "gas"}) {
    const std::string unlimited = at(name + "-unlimited");
    ASSERT_EQ(run({"run", scene(name), "-o", unlimited, "--quiet", "--threads", "8"}, {}).err, "");
    for (const auto& [threads, had] :
         {std::pair("0", "1"), std::pair("2", "3"), std::pair("6", "7")}) {
      const std::string out = at(name + threads);
      const auto result =
          run({"run", scene(name), "-o", out, "--quiet", "--threads", "8"}, most(threads));
      EXPECT_EQ(result.code, 0);
      EXPECT_EQ(result.err, std::string("warning: only ") + had + " of 8 threads can be started\n");
      EXPECT_EQ(testing::difference_of_runs(unlimited, out), "") << name << ", " << threads;
    }
  }
}

TEST_F(FewThreads, AreDividedAmongTheGasesOfAnEnsemble) {
  const std::vector<std::string> call = {"run", scene("gas"), "--quiet", "--threads", "8", "-o"};
  const auto into = [&](const std::string& folder) {
    auto whole = call;
    whole.push_back(at(folder));
    return whole;
  };
  ASSERT_EQ(run(into("unlimited"), {}).err, "");
  for (const char* threads : {"7", "8", "9", "10", "11", "12"}) {
    const auto result = run(into(threads), most(threads));
    EXPECT_EQ(result.code, 0) << threads;
    EXPECT_EQ(result.err, "") << threads;
    EXPECT_EQ(testing::difference_of_runs(at("unlimited"), at(threads)), "") << threads;
  }
}

TEST_F(FewThreads, LeaveOutCaptionsWithAWarning) {
  const std::string out = at("captions");
  const auto result = run({"run", scene("fall"), "-o", out, "--quiet", "--threads", "1", "--set",
                           "output.frames={every: 10, width: 400, height: 300}"},
                          most("0"));
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err,
            "warning: no captions and legends: their text needs two threads, and none can "
            "be started\n");
}

TEST_F(FewThreads, GoOnWithARun) {
  const std::string out = at("out");
  ASSERT_EQ(run({"run", scene("fall"), "-o", out, "--quiet"}, {}).code, 0);
  const auto result = run({"resume", out, "--until", "40", "--quiet", "--threads", "4"}, most("1"));
  EXPECT_EQ(result.code, 0);
  EXPECT_EQ(result.err, "warning: only 2 of 4 threads can be started\n");
}

TEST_F(FewThreads, CarryOutASweepWithAsManyJobs) {
  const std::vector<std::string> sweep = {"sweep",  scene("fall"), "--seeds", "1..4",
                                          "--jobs", "4",           "--quiet", "-o"};
  const auto into = [&](const std::string& out) {
    std::vector<std::string> arguments = sweep;
    arguments.push_back(out);
    return arguments;
  };
  ASSERT_EQ(run(into(at("unlimited")), {}).err, "");
  for (const auto& [threads, had] : {std::pair("0", "1"), std::pair("3", "3")}) {
    const std::string out = at(std::string("sweep") + threads);
    const auto result = run(into(out), most(threads));
    EXPECT_EQ(result.code, 0);
    EXPECT_EQ(result.err, std::string("warning: only ") + had +
                              " of 4 runs at a time, as no more threads can be started\n");
    for (const std::string seed : {"1", "4"}) {
      EXPECT_EQ(testing::difference_of_runs(at("unlimited") + "/runs/seed=" + seed,
                                            out + "/runs/seed=" + seed),
                "");
    }
  }
}

TEST_F(FewThreads, AsTheUserTellsOpenMpGiveTheSameResult) {
  for (const std::string name : {"fall", "gas"}) {
    const std::string plain = at(name);
    ASSERT_EQ(run({"run", scene(name), "-o", plain, "--quiet", "--threads", "4"}, {}).code, 0);
    const std::vector<std::map<std::string, std::string>> wishes = {
        {{"OMP_THREAD_LIMIT", "2"}},     {{"OMP_THREAD_LIMIT", "1"}}, {{"OMP_DYNAMIC", "true"}},
        {{"OMP_NUM_THREADS", "1"}},      {{"OMP_STACKSIZE", "256K"}}, {{"OMP_STACKSIZE", "2 m"}},
        {{"OMP_MAX_ACTIVE_LEVELS", "1"}}};
    for (const auto& wish : wishes) {
      const std::string out = at(name + wish.begin()->first + wish.begin()->second);
      const auto result = run({"run", scene(name), "-o", out, "--quiet", "--threads", "4"}, wish);
      EXPECT_EQ(result.code, 0) << result.err;
      EXPECT_EQ(testing::difference_of_runs(plain, out), "") << wish.begin()->first;
    }
  }
}

}  // namespace
}  // namespace clca::threads_test
