// SPDX-License-Identifier: Apache-2.0
#include "semview/protocol/envelope.hpp"

#include <gtest/gtest.h>

#include "semview/protocol/descriptions.hpp"

namespace semview::protocol {
namespace {

v1::RequestHeader good_header() {
  v1::RequestHeader header;
  header.set_protocol_version(kProtocolVersion);
  header.set_method("Hello");
  return header;
}

TEST(EnvelopeTest, EveryErrorCodeTravelsWithItsNumberAndParts) {
  for (int code = 1; code <= 16; ++code) {
    const Error sent{static_cast<ErrorCode>(code), "what", "field", "hint", 7};
    const v1::Error wire = to_wire(sent);
    EXPECT_EQ(static_cast<int>(wire.code()), code);
    const Error got = from_wire(wire);
    EXPECT_EQ(got.code, sent.code);
    EXPECT_EQ(got.message, "what");
    EXPECT_EQ(got.field, "field");
    EXPECT_EQ(got.hint, "hint");
    EXPECT_EQ(got.retry_after_ms, 7U);
  }
}

TEST(EnvelopeTest, ACodeOfANewerServerIsUnknown) {
  v1::Error wire;
  wire.set_code(static_cast<v1::ErrorCode>(99));
  EXPECT_EQ(from_wire(wire).code, ErrorCode::kUnknown);
}

TEST(EnvelopeTest, AnErrorThatQuotesBytesStaysReadable) {
  const Error sent{ErrorCode::kNotFound, "no map 'gr\xfc\xc3\xbcn\xe2\x82'"};
  v1::Error read;
  ASSERT_TRUE(read.ParseFromString(to_wire(sent).SerializeAsString()));
  EXPECT_EQ(read.message(),
            "no map 'gr?\xc3\xbcn?"
            "?'");
}

TEST(EnvelopeTest, AGoodHeaderPasses) { EXPECT_TRUE(validate(good_header())); }

TEST(EnvelopeTest, AnotherProtocolVersionIsUnimplemented) {
  v1::RequestHeader header = good_header();
  header.set_protocol_version(2);
  const Status status = validate(header);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kUnimplemented);
  EXPECT_EQ(status.error().field, "protocol_version");
}

TEST(EnvelopeTest, MethodAndClientNameHaveALength) {
  v1::RequestHeader header = good_header();
  header.set_method("");
  EXPECT_EQ(validate(header).error().field, "method");
  header.set_method(std::string(65, 'm'));
  EXPECT_EQ(validate(header).error().field, "method");
  header = good_header();
  header.set_client_name(std::string(65, 'c'));
  EXPECT_EQ(validate(header).error().field, "client_name");
}

TEST(EnvelopeTest, BytesThatAreNoMessageAreDataLoss) {
  const Result<v1::RequestHeader> parsed = parse<v1::RequestHeader>("\xff\xff\xff", "header");
  ASSERT_FALSE(parsed);
  EXPECT_EQ(parsed.error().code, ErrorCode::kDataLoss);
  EXPECT_EQ(parsed.error().field, "header");
}

}  // namespace
}  // namespace semview::protocol
