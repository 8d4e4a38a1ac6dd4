// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/weight_proposal.hpp"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/paths.hpp"

namespace semview::similarity {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

double weight(const WeightMatrix& matrix, std::string_view observed, std::string_view map) {
  const auto row = std::ranges::find(matrix.observed_names(), observed);
  const auto column = std::ranges::find(matrix.map_names(), map);
  EXPECT_NE(row, matrix.observed_names().end()) << observed;
  EXPECT_NE(column, matrix.map_names().end()) << map;
  return matrix.weight(0,
                       static_cast<std::size_t>(row - matrix.observed_names().begin()),
                       static_cast<std::size_t>(column - matrix.map_names().begin()));
}

TEST(SynonymTableTest, ScoresGroupsDegreesAndRelations) {
  const auto table = SynonymTable::parse(
      "# comment\n"
      "group\tseat\t1\tchair;stool=0.5\n"
      "group\tground\t0.25\tfloor\n"
      "group\tupright\t0.5\twall\n"
      "relate\tground\tupright\t-1\n"
      "relate\tseat\tupright\t0.5\n",
      "s.tsv");
  ASSERT_TRUE(table);
  EXPECT_EQ(table->score("chair", "chair"), 1.0);
  EXPECT_EQ(table->score("chair", "stool"), 0.5);
  EXPECT_EQ(table->score("stool", "wall"), 0.25);
  EXPECT_EQ(table->score("floor", "floor"), 0.25);
  EXPECT_EQ(table->score("floor", "wall"), -1.0);
  EXPECT_EQ(table->score("wall", "floor"), -1.0);
  EXPECT_EQ(table->score("floor", "chair"), 0.0);
  EXPECT_EQ(table->score("floor", "yacht"), 0.0);
  EXPECT_EQ(table->significance("wall"), 0.5);
  EXPECT_EQ(table->significance("yacht"), 1.0);
}

TEST(SynonymTableTest, MessagesNameTheLine) {
  const auto error_of = [](std::string_view text) {
    const auto table = SynonymTable::parse(text, "s.tsv");
    return table ? std::string("accepted") : table.error().message;
  };
  EXPECT_THAT(error_of("grop\ta\t1\tb"), HasSubstr("s.tsv:1: expected 'group' or 'relate'"));
  EXPECT_THAT(error_of("group\ta\t2\tb"), HasSubstr("significance '2'"));
  EXPECT_THAT(error_of("group\ta\t1\tb=0"), HasSubstr("member 'b=0'"));
  EXPECT_THAT(error_of("group\ta\t1\tb\ngroup\ta\t1\tc"), HasSubstr("s.tsv:2: group a"));
  EXPECT_THAT(error_of("group\ta\t1\tb\nrelate\ta\tx\t1"), HasSubstr("unknown group x"));
  EXPECT_THAT(error_of("group\ta\t1\tb\nrelate\ta\ta\t1"), HasSubstr("two different groups"));
}

TEST(VocabularyTest, Ade20kHas150DifferentNamesWithTheirBlanks) {
  const auto vocabulary = shipped_vocabulary("ade20k150");
  ASSERT_TRUE(vocabulary);
  ASSERT_EQ(vocabulary->size(), 150U);
  const ClassTable table = class_table(*vocabulary);
  EXPECT_EQ(table.id("wall"), ClassId{1});
  EXPECT_EQ(table.id("windowpane"), ClassId{9});
  EXPECT_EQ(table.id("coffee table"), ClassId{65});
  EXPECT_EQ(table.id("countertop"), ClassId{71});
  EXPECT_EQ(table.id("screen door"), ClassId{59});
  EXPECT_EQ(table.id("screen"), ClassId{131});
  EXPECT_EQ(table.id("flag"), ClassId{150});
}

TEST(VocabularyTest, NoNameOfAde20kMeansTwoClasses) {
  const Vocabulary vocabulary = shipped_vocabulary("ade20k150").value();
  std::vector<std::string> names;
  for (const NamedClass& named : vocabulary) {
    names.push_back(named.name);
    names.insert(names.end(), named.aliases.begin(), named.aliases.end());
  }
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
}

TEST(VocabularyTest, ReadsNamesWithAliasesAndNamesTheLineOfAnError) {
  const auto vocabulary = parse_vocabulary("# mine\nwall\nsofa\tcouch; lounge\n", "v.tsv");
  ASSERT_TRUE(vocabulary);
  EXPECT_THAT(*vocabulary,
              ElementsAre(NamedClass{"wall", {}}, NamedClass{"sofa", {"couch", "lounge"}}));
  EXPECT_EQ(parse_vocabulary("wall\nwall\n", "v").error().message, "v:2: class wall named twice");
  EXPECT_THAT(parse_vocabulary("\n", "v").error().message, HasSubstr("no classes"));
  EXPECT_EQ(load_vocabulary("nothing of that name").error().code, ErrorCode::kNotFound);
}

TEST(VocabularyTest, ATableOfAnotherKindOrABinaryFileIsNoVocabulary) {
  const auto message = [](std::string_view text) {
    return parse_vocabulary(text, "v").error().message;
  };
  EXPECT_THAT(message("wall\n1,0.1576,wall\n"), HasSubstr("v:2: ',' or ';' in a class name"));
  EXPECT_THAT(message(std::string_view("wall\0x\n", 7)), HasSubstr("expected a text file"));
  EXPECT_THAT(message(std::string(65, 'w')), HasSubstr("65 bytes, expected at most 64"));
}

TEST(WeightProposalTest, FollowsTheThreeConceptsOfThePaper) {
  const Vocabulary ade = shipped_vocabulary("ade20k150").value();
  const Vocabulary map{{"wall"}, {"floor"}, {"table"}, {"chair"}, {"window"}};
  const auto proposal = propose_weights(ade, map);
  ASSERT_TRUE(proposal);
  const WeightMatrix& w = proposal->matrix;
  // Soft class matching: desk and table in full, chair and sofa in part.
  EXPECT_EQ(weight(w, "desk", "table"), 1.0);
  EXPECT_EQ(weight(w, "windowpane", "window"), 1.0);
  EXPECT_GT(weight(w, "sofa", "chair"), 0.0);
  EXPECT_LT(weight(w, "sofa", "chair"), 1.0);
  EXPECT_EQ(weight(w, "chair", "chair"), 1.0);
  // Significance.
  EXPECT_EQ(weight(w, "wall", "wall"), 0.25);
  EXPECT_EQ(weight(w, "floor", "floor"), 0.25);
  // Penalty.
  EXPECT_EQ(weight(w, "wall", "floor"), -1.0);
  EXPECT_EQ(weight(w, "floor", "wall"), -1.0);
  EXPECT_EQ(weight(w, "airplane", "chair"), 0.0);
  EXPECT_THAT(proposal->unmatched_observed, Contains("airplane"));
  EXPECT_THAT(proposal->unmatched_map, IsEmpty());
}

TEST(WeightProposalTest, AnAliasOfTheMapMatchesInFull) {
  const auto proposal =
      propose_weights(Vocabulary{{"yacht"}, {"lorry"}}, Vocabulary{{"boat", {"yacht"}}, {"thing"}});
  ASSERT_TRUE(proposal);
  EXPECT_EQ(weight(proposal->matrix, "yacht", "boat"), 1.0);
  EXPECT_THAT(proposal->unmatched_observed, ElementsAre("lorry"));
  EXPECT_THAT(proposal->unmatched_map, ElementsAre("thing"));
}

TEST(WeightProposalTest, AClassThatOnlyTheMapNamesGetsARowByTheSameRules) {
  const Vocabulary map{{"wall"}, {"turret", {"spire"}}, {"floor"}, {"couch"}};
  const auto proposal = propose_weights(Vocabulary{{"wall"}, {"sofa", {"couch"}}}, map);
  ASSERT_TRUE(proposal);
  const WeightMatrix& w = proposal->matrix;
  EXPECT_THAT(w.observed_names(), ElementsAre("wall", "sofa", "turret", "floor", "couch"));
  EXPECT_EQ(weight(w, "turret", "turret"), 1.0);
  EXPECT_EQ(weight(w, "turret", "wall"), 0.0);
  EXPECT_EQ(weight(w, "floor", "floor"), 0.25);
  EXPECT_EQ(weight(w, "floor", "wall"), -1.0);
  EXPECT_EQ(weight(w, "couch", "couch"), 1.0);
  // Its own row is no reason to hide that the vocabulary knows nothing of it.
  EXPECT_THAT(proposal->unmatched_map, ElementsAre("turret", "floor"));
  EXPECT_THAT(proposal->unmatched_observed, IsEmpty());
}

TEST(ShippedWeightsTest, TheMatrixOfThe2017PaperHasItsStatedWeights) {
  const auto w = read_weight_matrix(SEMVIEW_SOURCE_DIR "/weights/paper2017_ade20k150.csv");
  ASSERT_TRUE(w);
  EXPECT_THAT(w->map_names(),
              ElementsAre("wall",
                          "dividing wall",
                          "floor",
                          "door",
                          "window",
                          "table",
                          "chair",
                          "cupboard",
                          "sideboard",
                          "sink",
                          "none"));
  EXPECT_TRUE(w->check(class_table(shipped_vocabulary("ade20k150").value()), ClassTable({"wall"})));
  EXPECT_EQ(w->bands().size(), 1U);
  EXPECT_EQ(w->max_abs_weight(), 1.0);
  EXPECT_EQ(weight(*w, "wall", "wall"), 0.25);
  EXPECT_EQ(weight(*w, "floor", "floor"), 0.25);
  for (const char* wall : {"wall", "dividing wall"}) {
    EXPECT_EQ(weight(*w, "floor", wall), -1.0);
  }
  EXPECT_EQ(weight(*w, "wall", "floor"), -1.0);
  EXPECT_EQ(weight(*w, "desk", "table"), 1.0);
  for (const char* seat : {"armchair", "seat", "swivel chair", "stool", "bench", "sofa"}) {
    EXPECT_GT(weight(*w, seat, "chair"), 0.0) << seat;
    EXPECT_LE(weight(*w, seat, "chair"), 1.0) << seat;
  }
  for (const char* furniture : {"door", "table", "chair", "sink"}) {
    EXPECT_EQ(weight(*w, furniture, furniture), 1.0) << furniture;
  }
}

}  // namespace
}  // namespace semview::similarity
