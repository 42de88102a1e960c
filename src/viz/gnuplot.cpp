#include "trajet/viz/gnuplot.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "svg_names.hpp"
#include "trajet/error.hpp"

extern char** environ;

namespace trajet {

namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
/// A file without a name, which vanishes when it is closed: nothing is left behind, and no pipe can fill up.
using ScratchFile = std::unique_ptr<std::FILE, Close>;

ScratchFile make_scratch_file() {
  ScratchFile file(std::tmpfile());
  if (file == nullptr) throw FileError(std::string("cannot make a temporary file: ") + std::strerror(errno));
  return file;
}

std::string contents(std::FILE* file) {
  std::rewind(file);
  std::string text;
  char block[16384];
  for (std::size_t count; (count = std::fread(block, 1, sizeof block, file)) > 0;) text.append(block, count);
  return text;
}

/// The line that tells gnuplot what to write. Pictures go to standard output.
std::string terminal(FigureFormat format, const FigureSize& size) {
  switch (format) {
    case FigureFormat::svg:
      return fmt::format(
          "set terminal svg size {},{} font 'Helvetica,Arial,sans-serif,16' noenhanced background 'white'\n",
          size.width, size.height);
    case FigureFormat::png:
      return fmt::format(
          "set terminal pngcairo size {},{} font 'Sans,12' fontscale 2 linewidth 2 pointscale 2 noenhanced\n",
          2 * size.width, 2 * size.height);
    case FigureFormat::pdf:
      return fmt::format(
          "set terminal pdfcairo size {:.2f}in,{:.2f}in font 'Sans,12' fontscale 0.7 linewidth 1 noenhanced\n",
          size.width / 100.0, size.height / 100.0);
  }
  return {};
}

constexpr const char* kMissing = "gnuplot, which draws the figures, was not found (Debian: gnuplot-nox)";

}  // namespace

std::optional<FigureFormat> figure_format(std::string_view path) {
  if (path.ends_with(".svg")) return FigureFormat::svg;
  if (path.ends_with(".png")) return FigureFormat::png;
  if (path.ends_with(".pdf")) return FigureFormat::pdf;
  return std::nullopt;
}

void require_gnuplot() {
  const char* path = std::getenv("PATH");
  std::string_view folders = path == nullptr ? "" : path;
  while (!folders.empty()) {
    const std::size_t end = std::min(folders.find(':'), folders.size());
    if (access((std::string(folders.substr(0, end)) + "/gnuplot").c_str(), X_OK) == 0) return;
    folders.remove_prefix(std::min(end + 1, folders.size()));
  }
  throw FileError(kMissing);
}

std::string draw(const Figure& figure, FigureFormat format) {
  const ScratchFile in = make_scratch_file(), out = make_scratch_file(), err = make_scratch_file();
  const std::string text = "set encoding utf8\nset minussign\n" + terminal(format, figure.size) + figure.script;
  if (std::fwrite(text.data(), 1, text.size(), in.get()) != text.size() || std::fflush(in.get()) != 0)
    throw FileError(std::string("cannot write a temporary file: ") + std::strerror(errno));
  std::rewind(in.get());

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(err.get()), STDERR_FILENO);
  char name[] = "gnuplot", from_stdin[] = "-";
  char* arguments[] = {name, from_stdin, nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure == ENOENT) throw FileError(kMissing);
  if (failure != 0) throw FileError(std::string("cannot run gnuplot: ") + std::strerror(failure));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  std::string picture = contents(out.get());
  if (status != 0 || picture.empty()) throw FileError("gnuplot failed:\n" + contents(err.get()));
  return format == FigureFormat::svg ? detail::with_names(picture, figure.title) : picture;
}

namespace detail {

std::string quoted(std::string_view text) {
  std::string literal = "'";
  for (const char c : text) {
    if (c == '\'') literal += '\'';
    literal += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return literal + "'";
}

}  // namespace detail
}  // namespace trajet
