// SPDX-License-Identifier: Apache-2.0
#include "semview/io/yaml_document.hpp"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace semview::io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

YamlNode parsed(const std::string& text) {
  Result<YamlNode> node = parse_yaml(text, "map.yaml");
  EXPECT_TRUE(node) << node.error().message;
  return *node;
}

std::string parse_error(const std::string& text) {
  const Result<YamlNode> node = parse_yaml(text, "map.yaml");
  return node ? "no error" : node.error().message;
}

TEST(YamlNodeTest, ReadsValuesOfEachType) {
  const YamlNode node = parsed(
      "name: Duplex, level 1\nresolution: 0.02\ncount: +7\nopen: true\norigin: [-0.6, -18.4, 0]\n"
      "classes: [wall, \"123\"]\nempty:\n");
  EXPECT_EQ(*node.at("name")->text(), "Duplex, level 1");
  EXPECT_EQ(*node.at("resolution")->number(), 0.02);
  EXPECT_EQ(*node.at("count")->integer(), 7);
  EXPECT_TRUE(*node.at("open")->boolean());
  EXPECT_THAT(*node.at("origin")->numbers(3), ElementsAre(-0.6, -18.4, 0.0));
  EXPECT_THAT(*node.at("classes")->texts(), ElementsAre("wall", "123"));
  EXPECT_TRUE(node.at("empty")->is_null());
  EXPECT_FALSE(node.find("missing"));
  EXPECT_EQ(node.entries().size(), 7U);
}

TEST(YamlNodeTest, KnowsItsLine) {
  const YamlNode node = parsed("# comment\na: 1\nlist:\n  - {x: 1}\n  - {x: 2,\n     y: 3}\n");
  EXPECT_EQ(node.line(), 2);
  EXPECT_EQ(node.at("a")->where(), "map.yaml:2");
  const std::vector<YamlNode> items = node.at("list")->items();
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[1].line(), 5);
  EXPECT_EQ(items[1].at("y")->line(), 6);
}

TEST(YamlNodeTest, AWrongValueIsShownWithItsPlaceAndWhatWasExpected) {
  const YamlNode node = parsed("a: 1\nresolution: two\nc: [1, x]\n");
  const Error error = node.at("resolution")->number().error();
  EXPECT_EQ(error.message, "map.yaml:2: resolution: 'two' is not a number");
  EXPECT_EQ(error.field, "resolution");
  EXPECT_EQ(node.at("c")->number().error().message, "map.yaml:3: c: a list of 2 is not a number");
  EXPECT_EQ(node.at("c")->numbers(2).error().message, "map.yaml:3: 'x' is not a number");
  EXPECT_THAT(node.at("c")->numbers(3).error().message, HasSubstr("not a list of 3 numbers"));
}

TEST(YamlNodeTest, NumbersAreWholeAndFinite) {
  const YamlNode node = parsed("a: .inf\nb: .nan\nc: 1e999\nd: 1.5m\ne: 1.5\nf: 0x10\n");
  for (const char* key : {"a", "b", "c", "d"}) EXPECT_FALSE(node.at(key)->number()) << key;
  EXPECT_TRUE(node.at("e")->number());
  EXPECT_FALSE(node.at("e")->integer());
  EXPECT_FALSE(node.at("f")->integer());
}

TEST(YamlNodeTest, DefaultsStandInOnlyForAbsentKeys) {
  const YamlNode node = parsed("a: 1\nb: x\nc:\n");
  EXPECT_EQ(*node.number_or("a", 9.0), 1.0);
  EXPECT_EQ(*node.number_or("z", 9.0), 9.0);
  EXPECT_FALSE(node.number_or("b", 9.0));
  EXPECT_FALSE(node.number_or("c", 9.0));
  EXPECT_EQ(*node.integer_or("z", 4), 4);
  EXPECT_EQ(*node.boolean_or("z", true), true);
  EXPECT_EQ(*node.text_or("z", "y"), "y");
}

TEST(YamlNodeTest, MissingAndUnknownKeysAreNamed) {
  const YamlNode node = parsed("a: 1\nmin_hight: 2\nb: 3\nc: 4\n");
  EXPECT_EQ(node.at("id").error().message, "map.yaml:1: key 'id' is missing");
  EXPECT_EQ(node.expect_keys({"a", "b", "min_height"}).error().message,
            "map.yaml:2: unknown key 'min_hight', expected one of a, b, min_height");
  constexpr std::array<std::string_view, 2> kKnown{"a", "b"};
  const std::vector<YamlNode::Entry> unknown = node.unknown_entries(kKnown);
  ASSERT_EQ(unknown.size(), 2U);
  EXPECT_EQ(unknown[1].key, "c");
  EXPECT_EQ(unknown[1].line, 4);
  EXPECT_TRUE(node.expect_keys({"a", "b", "c", "min_hight"}));
}

TEST(YamlNodeTest, AskingTheWrongKindIsAnError) {
  const YamlNode scalar = parsed("a: 1\n").at("a").value();
  EXPECT_FALSE(scalar.at("x"));
  EXPECT_FALSE(scalar.expect_keys({"x"}));
  EXPECT_TRUE(scalar.items().empty());
  EXPECT_TRUE(scalar.entries().empty());
  EXPECT_TRUE(parsed("").is_null());
}

TEST(ParseYamlTest, FaultsNameFileAndLine) {
  EXPECT_THAT(parse_error("a: 1\nb: [1, 2\nc: 3\n"), HasSubstr("map.yaml:3: not valid YAML"));
  EXPECT_EQ(parse_error("a: 1\nb: 2\na: 3\n"), "map.yaml:3: key 'a' was given in line 1");
  EXPECT_THAT(parse_error("? [1, 2]\n: 3\n"), HasSubstr("a key must be a plain name"));
  EXPECT_THAT(parse_error("a:\n\tb: 1\n"), HasSubstr("map.yaml:2: a tab indents this line"));
  EXPECT_THAT(parse_error("a: *nowhere\n"), HasSubstr("map.yaml:1: not valid YAML"));
}

TEST(ParseYamlTest, BombsAndDepthsStopAtTheLimits) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string last = std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) bomb += (k == 0 ? "*a" : ", *a") + last;
    bomb += "]\n";
  }
  EXPECT_THAT(parse_error(bomb), HasSubstr("more than 1000000 values"));
  EXPECT_THAT(parse_error(std::string(60, '[') + std::string(60, ']')), HasSubstr("50 levels"));
  EXPECT_NE(parse_error(std::string(100'000, '[')), "no error");
  EXPECT_THAT(parse_error("&a [*a]"), ::testing::Ne("no error"));
}

TEST(QuotedYamlTest, AnyTextComesBack) {
  for (const std::string& text : {std::string("plain"),
                                  std::string("a \"b\" \\ c: #d"),
                                  std::string("line\nbreak\ttab"),
                                  std::string("größe"),
                                  std::string()}) {
    EXPECT_EQ(*parsed("key: " + quoted_yaml(text)).at("key")->text(), text);
  }
}

}  // namespace
}  // namespace semview::io
