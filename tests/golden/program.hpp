#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "temporary_folder.hpp"

namespace trajet {

inline std::string read_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

struct ProgramResult {
  int exit_code = -1;  ///< 128 + signal if a signal ended it
  std::string out;
  std::string err;
  long peak_kilobytes = 0;  ///< of memory that it used at once
};

/// Runs the program `trajet`. If `interrupt_after_line` is given, sends `signal` once that file has more than one line.
inline ProgramResult run_trajet(const std::vector<std::string>& arguments, const std::string& interrupt_after_line = "",
                                int signal = SIGINT) {
  const TemporaryFolder folder;
  const std::string out = folder.file("out"), err = folder.file("err");
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), TRAJET_PROGRAM);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const pid_t child = fork();
  if (child == 0) {
    dup2(open(out.c_str(), O_CREAT | O_WRONLY, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_CREAT | O_WRONLY, 0600), STDERR_FILENO);
    ::signal(SIGHUP, SIG_DFL);  // whatever the tests themselves were started by
    execv(TRAJET_PROGRAM, argv.data());
    _exit(126);
  }
  int status = 0;
  struct rusage usage = {};
  if (!interrupt_after_line.empty()) {
    const auto started = [&] { return read_text(interrupt_after_line).find('\n') != std::string::npos; };
    bool ended = false;
    while (!started() && !(ended = wait4(child, &status, WNOHANG, &usage) == child))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!ended) kill(child, signal);
    if (!ended) wait4(child, &status, 0, &usage);
  } else {
    wait4(child, &status, 0, &usage);
  }
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_text(out), read_text(err), usage.ru_maxrss};
}

}  // namespace trajet
