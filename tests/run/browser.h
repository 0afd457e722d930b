#pragma once
// A real browser without a window, for tests of pages.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "run/fixtures.h"

namespace espalier::testing {

/// The path of Chromium, empty: there is none. script/setup test installs it.
inline std::string find_browser() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
    const std::string found = std::string("command -v ") + name + " > /dev/null 2>&1";
    if (std::system(found.c_str()) == 0) return name;
  }
  return "";
}

inline std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Opens a page and returns its document as HTML once `milliseconds` of the page's own time are over.
inline std::string document_of(const std::string& page, int milliseconds = 6000,
                               const std::string& options = "--use-gl=angle --use-angle=swiftshader "
                                                            "--enable-unsafe-swiftshader") {
  const TemporaryFolder profile;
  const std::string command =
      "timeout 120 " + find_browser() +
      " --headless --no-sandbox --disable-quic --no-first-run --disable-background-networking "
      "--disable-component-update --disable-sync --disable-dev-shm-usage --disk-cache-size=1 "
      "--window-size=1200,900 --user-data-dir=" + shell_quoted(profile / "profile") + " " + options +
      " --virtual-time-budget=" + std::to_string(milliseconds) + " --dump-dom " + shell_quoted("file://" + page) +
      " 2> " + shell_quoted(profile / "errors");
  std::string out;
  if (FILE* pipe = popen(command.c_str(), "r")) {
    char buffer[65536];
    for (std::size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) out.append(buffer, n);
    pclose(pipe);
  }
  return out;
}

/// A copy of a page with a script of the test at its end, which writes what it sees into <html data-seen>.
inline std::string driven(const std::string& page, const std::string& script) {
  std::string text = read_text(page);
  const std::string end = "</body>";
  text.replace(text.rfind(end), end.size(), "<script>addEventListener('load', () => { const seen = [];\n" + script +
                                                "\ndocument.documentElement.dataset.seen = seen.join(';'); });"
                                                "</script></body>");
  write_text(page + ".driven.html", text);
  return page + ".driven.html";
}

/// The value of an attribute of the first element of this kind; "?" where there is none.
inline std::string attribute(const std::string& document, const std::string& element, const std::string& name) {
  const std::size_t at = document.find(element), end = document.find('>', at);
  if (at == std::string::npos) return "?";
  const std::size_t begin = document.find(" " + name + "=\"", at);
  if (begin >= end) return "?";
  const std::size_t from = begin + name.size() + 3;
  return document.substr(from, document.find('"', from) - from);
}

}  // namespace espalier::testing
