// SPDX-License-Identifier: MIT
// What is known of an algorithm's runs is of the version that made them.
#include "banyan/study/folder.hpp"

#include <gtest/gtest.h>

#include "banyan/controller/core/elsewhere.hpp"
#include "planned_study.hpp"

namespace banyan::study {
namespace {

// Convoy, as if users could change it.
class Changeable final : public AlgorithmElsewhere {
 public:
  explicit Changeable(std::string fingerprint)
      : AlgorithmElsewhere(*algorithms().find("convoy"),
                           [](std::unique_ptr<Swarm> swarm, const Setup&, std::span<const Member>) { return swarm; }),
        fingerprint_(std::move(fingerprint)) {}
  [[nodiscard]] std::string_view fingerprint() const noexcept override { return fingerprint_; }

 private:
  std::string fingerprint_;
};

class FolderTest : public PlannedStudy {
 protected:
  // Of convoy and inwards with two seeds each.
  [[nodiscard]] Plan plan_with(const std::string& fingerprint) {
    algorithms_.push_back(std::make_unique<Changeable>(fingerprint));
    lists_.push_back(
        std::make_unique<AlgorithmList>(AlgorithmList{algorithms_.back().get(), algorithms().find("inwards")}));
    const auto loaded =
        parse_study(path("s.toml"),
                    "scenario = \"w.toml\"\nseeds = [1, 2]\n[[axes]]\nkey = \"mission.algorithm\"\nname = \"a\"\n"
                    "values = [\"convoy\", \"inwards\"]\n");
    EXPECT_TRUE(loaded.ok());
    auto plan = make_plan(loaded.study, *lists_.back());
    EXPECT_TRUE(plan.ok());
    return plan;
  }
  std::vector<std::unique_ptr<Changeable>> algorithms_;
  std::vector<std::unique_ptr<AlgorithmList>> lists_;
};

TEST_F(FolderTest, RunsOfAnotherVersionAreOtherRuns) {
  const Plan none = plan_with(""), one = plan_with("1a"), two = plan_with("2b");
  EXPECT_EQ(plan_text(one), plan_text(none));
  EXPECT_EQ(plan_text(one), plan_text(two));
  ASSERT_EQ(one.runs.size(), 4U);
  for (std::size_t r = 0; r < 4; ++r) {
    const bool convoy = r < 2;
    EXPECT_EQ(none.runs[r].id.size(), 16U);
    EXPECT_EQ(none.runs[r].configured(), none.runs[r].id);
    EXPECT_EQ(one.runs[r].configured(), none.runs[r].id);
    EXPECT_EQ(one.runs[r].id, none.runs[r].id + (convoy ? "-1a" : ""));
    EXPECT_EQ(two.runs[r].id, none.runs[r].id + (convoy ? "-2b" : ""));
  }
  const std::vector<std::string> convoy{"convoy"};
  Outcomes known;
  EXPECT_TRUE(changed_algorithms(one, known).empty());
  known[one.runs[0].id] = known[one.runs[2].id] = {};
  EXPECT_TRUE(changed_algorithms(one, known).empty()) << "what is missing is missing";
  EXPECT_TRUE(changed_algorithms(none, known).empty());
  EXPECT_EQ(changed_algorithms(two, known), convoy);
  EXPECT_EQ(runs_to_do(two, {}, known, false), (std::vector<std::size_t>{0, 1, 3}));
  known[two.runs[0].id] = {};
  EXPECT_TRUE(changed_algorithms(two, known).empty());
  known[none.runs[1].id] = {};  // of a program that knew no fingerprints
  EXPECT_EQ(changed_algorithms(two, known), convoy);
}

}  // namespace
}  // namespace banyan::study
