#include "message.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace trajet {

void keep_standard_error() {
  if (fcntl(STDERR_FILENO, F_GETFD) != -1) return;
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere < 0 || nowhere == STDERR_FILENO) return;
  dup2(nowhere, STDERR_FILENO);
  close(nowhere);
}

}  // namespace trajet
