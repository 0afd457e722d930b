#pragma once
// What the tests of reports share: reading a page without a browser.

#include <array>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "run/report.h"

namespace espalier::testing {

/// By a table, unlike the encoder.
inline std::string decode_base64(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<unsigned>(digits.find(c));
    bits += 6;
    if (bits >= 8) bytes += static_cast<char>(word >> (bits -= 8) & 255);
  }
  return bytes;
}

/// Runs of more than 100 digits of base64 are left out.
inline std::string without_base64(const std::string& page) {
  std::string kept, run;
  for (const char c : page + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '/' || c == '=') {
      run += c;
      continue;
    }
    if (run.size() <= 100) kept += run;
    run.clear();
    kept += c;
  }
  return kept;
}

/// What stands inside the element with this id.
inline std::string element_text(const std::string& page, const std::string& id) {
  const std::size_t at = page.find(" id=\"" + id + "\"");
  if (at == std::string::npos) return "";
  const std::size_t open = page.find('>', at) + 1, close = page.find("</", open);
  return page.substr(open, close - open);
}

/// The page's tags nest, attributes are quoted, and every script and style ends where it should.
inline void expect_well_formed(const std::string& page) {
  ASSERT_TRUE(page.starts_with("<!DOCTYPE html>\n"));
  std::vector<std::string> open;
  const auto is_void = [](const std::string& name) {
    return name == "meta" || name == "img" || name == "input" || name == "br";
  };
  for (std::size_t at = page.find('<', 1); at != std::string::npos; at = page.find('<', at)) {
    std::size_t end = at + 1;
    const bool closes = page[end] == '/';
    if (closes) ++end;
    std::string name;
    while (end < page.size() && std::isalnum(static_cast<unsigned char>(page[end]))) name += page[end++];
    ASSERT_FALSE(name.empty()) << page.substr(at, 60);
    for (bool quoted = false; quoted || page[end] != '>'; ++end) {
      ASSERT_LT(end + 1, page.size()) << name;
      if (page[end] == '"') quoted = !quoted;
      ASSERT_TRUE(quoted || page[end] != '<') << page.substr(at, 60);
    }
    at = end + 1;
    if (closes) {
      ASSERT_FALSE(open.empty()) << name;
      ASSERT_EQ(open.back(), name);
      open.pop_back();
    } else if (!is_void(name)) {
      open.push_back(name);
      if (name == "script" || name == "style") {
        at = page.find("</" + name + ">", at);
        ASSERT_NE(at, std::string::npos);
      }
    }
  }
  EXPECT_TRUE(open.empty()) << open.back();
}

/// The page without the lines that hold times.
inline std::string without_report_times(const std::string& page) {
  std::string kept;
  std::istringstream in(page);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with(kTimesLine) || line.starts_with(kSpeedClass)) continue;
    kept += line + "\n";
  }
  return kept;
}

}  // namespace espalier::testing
