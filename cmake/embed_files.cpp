// Writes a C++ source that holds files under their paths: embed_files OUT.cpp FOLDER FILE.. defines shipped_files() of
// studio/shipped.h. (cmake/embed.cmake does so for a few small texts; a megabyte takes it minutes.)

#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

namespace {

/// As a literal of many lines; octal escapes end after three digits, whatever follows.
void write_literal(const std::string& bytes, std::ofstream& out) {
  constexpr std::size_t kLine = 64;
  for (std::size_t at = 0; at < bytes.size() || at == 0; at += kLine) {
    out << "\n    \"";
    for (const char c : bytes.substr(at, kLine)) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte >= ' ' && byte < 0x7f && c != '"' && c != '\\' && c != '?') {
        out << c;
        continue;
      }
      char escape[5];
      std::snprintf(escape, sizeof(escape), "\\%03o", byte);
      out << escape;
    }
    out << '"';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  std::ofstream out(argv[1]);
  out << "// Written by cmake/embed_files.cpp.\n#include \"studio/shipped.h\"\n\nnamespace espalier::studio {\nnamespace {\n\n";
  std::string rows;
  for (int i = 3; i < argc; ++i) {
    std::ifstream in(std::string(argv[2]) + "/" + argv[i], std::ios::binary);
    if (!in) {
      std::cerr << argv[i] << ": cannot be read\n";
      return 1;
    }
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const std::string name = "kFile" + std::to_string(i - 3);
    out << "constexpr char " << name << "[] =";
    write_literal(bytes, out);
    out << ";\n";
    rows += "    {\"" + std::string(argv[i]) + "\", {" + name + ", sizeof(" + name + ") - 1}},\n";
  }
  out << "\nconstexpr ShippedFile kFiles[] = {\n" << rows << "};\n\n}  // namespace\n\n"
      << "std::span<const ShippedFile> shipped_files() { return kFiles; }\n\n}  // namespace espalier::studio\n";
  return out.good() ? 0 : 1;
}
