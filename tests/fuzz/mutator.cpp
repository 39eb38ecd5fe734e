#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace evenglow::tests {
namespace {

constexpr std::array kNumbers = {
    "0",      "-1",     "-0",    "1e308", "-1e308",     "1e-320",     "nan",
    "inf",    "-inf",   "1e9",   "0x10",  "4294967296", "2147483648", "9223372036854775808",
    "0.1",    "1e",     "1.2.3", ".",     "-",          "1,5",        "1000000",
    "999999", "1e-300", "90.0",  "360",   "180",        "65536",      "3"};
constexpr std::array kTokens = {",",          "\n",  "\r\n",      "\t",       "#",
                                "\"",         "'",   ":",         ": ",       "- ",
                                "{",          "}",   "[",         "]",        "&a ",
                                "*a",         "<<:", "!!x",       "|\n",      "~",
                                "null",       "\0",  "\xff",      "\xc3\xa9", "\xef\xbb\xbf",
                                "include: x", "../", "/dev/zero", "%s%n",     "<script>",
                                "\x1b[2J"};
constexpr std::array<std::int64_t, 12> kIntegers = {0,     1,     -1,         2147483647, -2147483648LL, 4294967295LL,
                                                    65535, 65536, 1073741824, 255,        INT64_MAX,     INT64_MIN};

bool is_numeric(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e';
}

}  // namespace

std::string Mutator::next(const std::vector<std::string>& seeds) {
  std::string bytes = seeds[below(seeds.size())];
  const std::size_t count = 1 + below(8);
  for (std::size_t i = 0; i < count; ++i) damage(bytes, seeds);
  if (bytes.size() > kMaxBytes) bytes.resize(kMaxBytes);
  return bytes;
}

void Mutator::damage(std::string& bytes, const std::vector<std::string>& seeds) {
  const std::size_t at = below(bytes.size());
  // Mostly short parts, now and then long ones.
  const std::size_t length = std::min(bytes.size() - at, std::size_t{1} << below(below(4) == 0 ? 14 : 6));
  switch (below(11)) {
    case 0:
      if (!bytes.empty()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
      return;
    case 1:
      if (!bytes.empty()) bytes[at] = static_cast<char>(below(256));
      return;
    case 2:
      bytes.erase(at, length);
      return;
    case 3:
      bytes.insert(below(bytes.size() + 1), std::string(bytes, at, length));
      return;
    case 4: {
      const std::string& other = seeds[below(seeds.size())];
      const std::size_t from = below(other.size());
      bytes.replace(at, length, other.substr(from, length));
      return;
    }
    case 5:
      insert_token(bytes);
      return;
    case 6:
      if (below(4) == 0) bytes.resize(at);
      return;
    case 7: {
      const std::string part = bytes.substr(at, std::min<std::size_t>(length, 64));
      const std::size_t times = below(200);
      for (std::size_t i = 0; i < times && bytes.size() < kMaxBytes; ++i) bytes.insert(at, part);
      return;
    }
    case 8:
      return replace_binary(bytes);
    default:
      return replace_number(bytes);
  }
}

void Mutator::replace_number(std::string& bytes) {
  if (bytes.empty()) return;
  const auto start = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
  const auto first = std::find_if(start, bytes.end(), is_numeric);
  const auto last = std::find_if_not(first, bytes.end(), is_numeric);
  bytes.replace(first, last, kNumbers[below(kNumbers.size())]);
}

void Mutator::replace_binary(std::string& bytes) {
  const std::size_t width = std::size_t{1} << below(4);
  if (bytes.size() < width) return;
  std::int64_t value = kIntegers[below(kIntegers.size())];
  if (below(4) == 0) value = static_cast<std::int64_t>(random_());
  // Headers are short and decide the most.
  const std::size_t span = below(2) == 0 ? std::min<std::size_t>(bytes.size(), 1024) : bytes.size();
  std::memcpy(bytes.data() + below(span - width + 1), &value, width);
}

void Mutator::insert_token(std::string& bytes) {
  const std::size_t token = below(kTokens.size() + 1);
  bytes.insert(below(bytes.size() + 1), token == kTokens.size() ? std::string(1, '\0') : std::string(kTokens[token]));
}

}  // namespace evenglow::tests
