#pragma once
// Runs the program as a person would: in a process of its own, with its output caught.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace espalier::testing {

struct ChildResult {
  int exit_code = -1;  // 128 + signal when killed by one
  std::string out, err;
};

struct ChildOptions {
  std::string folder = ".";       // to run in
  rlim_t most_file_bytes = 0;     // 0 = no limit
  std::string interrupt_when = {}; // SIGINT as soon as this stands in its output
};

inline std::string slurp(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline pid_t start_child(const std::vector<std::string>& arguments, const ChildOptions& options,
                         const std::string& out_path, const std::string& err_path) {
  std::vector<char*> argv = {const_cast<char*>(ESPALIER_PROGRAM)};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child != 0) return child;
  if (!freopen(out_path.c_str(), "wb", stdout) || !freopen(err_path.c_str(), "wb", stderr)) _exit(126);
  if (chdir(options.folder.c_str()) != 0) _exit(126);
  if (options.most_file_bytes > 0) {
    const rlimit limit = {options.most_file_bytes, options.most_file_bytes};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  execv(argv[0], argv.data());
  _exit(127);
}

/// Runs `espalier ARGUMENTS` to its end. Its output is caught in files beside `scratch`.
inline ChildResult run_program(const std::vector<std::string>& arguments, const std::string& scratch,
                               const ChildOptions& options = {}) {
  const std::string out_path = scratch + ".stdout", err_path = scratch + ".stderr";
  const pid_t child = start_child(arguments, options, out_path, err_path);
  int status = 0;
  if (!options.interrupt_when.empty()) {
    while (slurp(out_path).find(options.interrupt_when) == std::string::npos) {
      if (waitpid(child, &status, WNOHANG) == child) {
        ADD_FAILURE() << "ended before it could be interrupted: " << slurp(err_path);
        return {};
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    kill(child, SIGINT);
  }
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), slurp(out_path), slurp(err_path)};
}

}  // namespace espalier::testing
