// SPDX-License-Identifier: Apache-2.0
#include "semview/similarity/weight_matrix.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "similarity/random_scene.hpp"

namespace semview::similarity {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(std::string_view text) {
  const auto matrix = parse_weight_matrix(text, "w.csv");
  return matrix ? "accepted" : matrix.error().message;
}

TEST(WeightMatrixTest, ReadsATableWithCommentsAndQuotes) {
  const auto matrix = parse_weight_matrix(
      "# by hand\r\n"
      "observed, wall ,\"table, round\",none\n"
      "\n"
      "wall,0.25,-1,0\n"
      "\"a \"\"desk\"\"\",0,1,-0.5",
      "w.csv");
  ASSERT_TRUE(matrix);
  EXPECT_THAT(matrix->observed_names(), ElementsAre("wall", "a \"desk\""));
  EXPECT_THAT(matrix->map_names(), ElementsAre("wall", "table, round", "none"));
  EXPECT_EQ(matrix->weight(0, 0, 1), -1.0);
  EXPECT_EQ(matrix->weight(0, 1, 2), -0.5);
  EXPECT_EQ(matrix->max_abs_weight(), 1.0);
  EXPECT_EQ(matrix->bands().front().elevation_min_deg, -90.0);
}

TEST(WeightMatrixTest, ReadsBandsInAnyOrder) {
  const auto matrix = parse_weight_matrix(
      "elevation_min_deg,elevation_max_deg,observed,wall,none\n"
      "0,90,wall,0.5,0\n"
      "-90,0,wall,0.25,0\n",
      "w.csv");
  ASSERT_TRUE(matrix);
  ASSERT_EQ(matrix->bands().size(), 2U);
  EXPECT_EQ(matrix->weight(0, 0, 0), 0.25);
  EXPECT_EQ(matrix->weight(1, 0, 0), 0.5);
}

TEST(WeightMatrixTest, MessagesNameTheLineAndWhatWouldBeRight) {
  EXPECT_EQ(error_of(""), "w.csv: no header line");
  EXPECT_EQ(error_of("observed,wall\n"), "w.csv: no rows below the header");
  EXPECT_EQ(error_of("observed\n"),
            "w.csv:1: expected a header: a name for the first column, then map class names");
  EXPECT_EQ(error_of("observed,wall,none\nwall,1\n"),
            "w.csv:2: 2 cells, expected 3 as in the header");
  EXPECT_EQ(error_of("observed,wall,none\nwall,1,x\n"),
            "w.csv:2: weight 'x' of wall for none: expected a finite number");
  EXPECT_EQ(error_of("observed,wall,none\nwall,1,inf\n"),
            "w.csv:2: weight 'inf' of wall for none: expected a finite number");
  EXPECT_EQ(error_of("observed,wall,none\nwall,1,\n"),
            "w.csv:2: weight '' of wall for none: expected a finite number");
  EXPECT_EQ(error_of("observed,wall,\"none\n"), "w.csv:1: a quote that does not end");
  EXPECT_THAT(error_of("observed,wall\nwall,1\nwall,1\n"), HasSubstr("wall named twice"));
  EXPECT_THAT(error_of("observed,wall,wall\nwall,1,1\n"), HasSubstr("wall named twice"));
  EXPECT_THAT(error_of("observed,wall,\nwall,1,1\n"), HasSubstr("empty name"));
  EXPECT_THAT(error_of("elevation_min_deg,elevation_max_deg,observed,wall\n"
                       "-90,10,wall,1\n0,90,wall,1\n"),
              HasSubstr("overlap"));
  EXPECT_THAT(error_of("elevation_min_deg,elevation_max_deg,observed,wall\n"
                       "-90,0,wall,1\n0,90,floor,1\n"),
              HasSubstr("other rows"));
  EXPECT_THAT(error_of("elevation_min_deg,elevation_max_deg,observed,wall\n10,-10,wall,1\n"),
              HasSubstr("must increase"));
}

TEST(WeightMatrixTest, AMissingFileSaysSo) {
  const auto matrix = read_weight_matrix("/nowhere/w.csv");
  ASSERT_FALSE(matrix);
  EXPECT_EQ(matrix.error().code, ErrorCode::kNotFound);
}

TEST(WeightMatrixTest, CheckListsEveryMissingRowAndColumn) {
  const auto matrix = parse_weight_matrix("observed,wall\nwall,1\n", "w.csv").value();
  const Status status =
      matrix.check(ClassTable({"wall", "sofa", "lamp"}), ClassTable({"door", "wall"}));
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kFailedPrecondition);
  EXPECT_EQ(status.error().message,
            "weights: no row for observed class sofa, lamp; no column for map class door, none");
  EXPECT_TRUE(WeightMatrix::identity(ClassTable({"a", "b"}))
                  .check(ClassTable({"b"}), ClassTable({"a", "b"})));
}

TEST(WeightMatrixTest, IdentityIsOneOnTheDiagonalOnly) {
  EXPECT_EQ(WeightMatrix::identity(ClassTable({"a", "b"})).to_csv(),
            "observed,a,b,none\na,1,0,0\nb,0,1,0\n");
}

TEST(WeightMatrixTest, IdentityOfTwoTablesIsOneWhereTheNamesAreEqual) {
  EXPECT_EQ(WeightMatrix::identity(ClassTable({"lamp", "b"}), ClassTable({"a", "b"})).to_csv(),
            "observed,a,b,none\nlamp,0,0,0\nb,0,1,0\n");
}

TEST(WeightMatrixTest, WrittenAndReadBackIsEqual) {
  const bool held = rc::check([] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>());
    const ClassTable observed = numbered_classes("a, \"b\" #", *rc::gen::inRange(1, 30));
    const ClassTable map = numbered_classes("m ", *rc::gen::inRange(1, 30));
    const WeightMatrix matrix = random_weights(rng, observed, map, *rc::gen::inRange(1, 6), 3.0);
    const auto again = parse_weight_matrix(matrix.to_csv(), "w.csv");
    RC_ASSERT(again.has_value());
    RC_ASSERT(*again == matrix);
  });
  ASSERT_TRUE(held);
}

TEST(WeightMatrixTest, AnyTextIsReadOrRefusedWithoutACrash) {
  const bool held = rc::check([] {
    const auto text = *rc::gen::container<std::string>(
        rc::gen::element('a', ',', '\n', '"', '1', '-', '#', ' ', '.', 'e'));
    const auto matrix = parse_weight_matrix(text, "w.csv");
    if (!matrix) RC_ASSERT(!matrix.error().message.empty());
  });
  ASSERT_TRUE(held);
}

}  // namespace
}  // namespace semview::similarity
