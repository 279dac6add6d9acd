// Captures the output of a piece of code, also of its C functions.
#pragma once

#include <unistd.h>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace support {

/// Everything that went to stdout and stderr while `act` ran. `act` must not throw.
template <class Act>
std::string printed_by(Act act) {
  std::fflush(nullptr);
  std::FILE* file = std::tmpfile();
  const int out = dup(STDOUT_FILENO), err = dup(STDERR_FILENO);
  dup2(fileno(file), STDOUT_FILENO), dup2(fileno(file), STDERR_FILENO);
  act();
  std::fflush(nullptr);
  dup2(out, STDOUT_FILENO), dup2(err, STDERR_FILENO);
  close(out), close(err);
  std::string text(
      static_cast<std::size_t>(std::ftell(file) < 0 ? 0 : lseek(fileno(file), 0, SEEK_END)), '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  return text;
}

}  // namespace support
