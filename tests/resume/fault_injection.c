/* Loaded in front of the C library (LD_PRELOAD): counts the calls that change a file and, from the
   call number CLCA_FAULT_AT on, kills the process (CLCA_FAULT=kill) or answers as a full disk does
   (CLCA_FAULT=full). With CLCA_FAULT_LOG it adds to that file what is written, flushed to the disk
   and renamed, a line each. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

/* Returns whether the call shall fail; may not return at all. */
static int fault(void) {
  static atomic_long calls = 0;
  const char* at = getenv("CLCA_FAULT_AT");
  const char* what = getenv("CLCA_FAULT");
  if (at == NULL || what == NULL || atomic_fetch_add(&calls, 1) + 1 < atol(at)) {
    return 0;
  }
  if (strcmp(what, "kill") == 0) {
    kill(getpid(), SIGKILL);
    pause();
  }
  errno = ENOSPC;
  return 1;
}

static int is_file(int descriptor) {
  struct stat status;
  return descriptor > STDERR_FILENO && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static void note(const char* what, const char* path, const char* to) {
  const char* log = getenv("CLCA_FAULT_LOG");
  if (log == NULL) {
    return;
  }
  const int error = errno;
  char line[3 * 4096];
  const int length = snprintf(line, sizeof line, "%s %s %s\n", what, path, to);
  const int file = REAL(open)(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (REAL(write)(file, line, (size_t)length) != length) {
    abort();
  }
  close(file);
  errno = error;
}
static void note_file(const char* what, int descriptor) {
  char link[64];
  char path[4096];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  path[length < 0 ? 0 : length] = 0;
  note(what, path, "");
}
#define OPEN_AT(name)                                               \
  int name(int folder, const char* path, int flags, ...) {          \
    va_list more;                                                   \
    va_start(more, flags);                                          \
    const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0; \
    va_end(more);                                                   \
    if (flags & (O_CREAT | O_TRUNC) && fault()) {                   \
      return -1;                                                    \
    }                                                               \
    return REAL(name)(folder, path, flags, mode);                   \
  }
#define OPEN(name)                                                  \
  int name(const char* path, int flags, ...) {                      \
    va_list more;                                                   \
    va_start(more, flags);                                          \
    const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0; \
    va_end(more);                                                   \
    if (flags & (O_CREAT | O_TRUNC) && fault()) {                   \
      return -1;                                                    \
    }                                                               \
    return REAL(name)(path, flags, mode);                           \
  }
OPEN(open)
OPEN(open64)
OPEN_AT(openat)
OPEN_AT(openat64)

ssize_t write(int file, const void* bytes, size_t count) {
  if (is_file(file)) {
    note_file("write", file);
  }
  return is_file(file) && fault() ? -1 : REAL(write)(file, bytes, count);
}
ssize_t writev(int file, const struct iovec* parts, int count) {
  return is_file(file) && fault() ? -1 : REAL(writev)(file, parts, count);
}
ssize_t pwrite(int file, const void* bytes, size_t count, off_t at) {
  return is_file(file) && fault() ? -1 : REAL(pwrite)(file, bytes, count, at);
}
int fsync(int file) {
  note_file("flush", file);
  return fault() ? -1 : REAL(fsync)(file);
}
int fdatasync(int file) {
  note_file("flush", file);
  return fault() ? -1 : REAL(fdatasync)(file);
}
int ftruncate(int file, off_t size) {
  return fault() ? -1 : REAL(ftruncate)(file, size);
}
int truncate(const char* path, off_t size) {
  return fault() ? -1 : REAL(truncate)(path, size);
}
int mkdir(const char* path, mode_t mode) {
  struct stat there;
  return lstat(path, &there) != 0 && fault() ? -1 : REAL(mkdir)(path, mode);
}

/* A full disk does not keep anybody from these. */
static void pass(void) {
  const int error = errno;
  (void)fault();
  errno = error;
}
int rename(const char* from, const char* to) {
  pass();
  note("rename", from, to);
  return REAL(rename)(from, to);
}
int unlink(const char* path) {
  pass();
  return REAL(unlink)(path);
}
int rmdir(const char* path) {
  pass();
  return REAL(rmdir)(path);
}
int remove(const char* path) {
  pass();
  return REAL(remove)(path);
}
