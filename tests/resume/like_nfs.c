/* Loaded in front of the C library (LD_PRELOAD): files as on NFS. flock locks exclusively only what
   is open for writing, renameat2 knows no flags, and an open file that is replaced is first moved
   out of the way, so that there is none of its name for CLCA_NFS_GAP milliseconds. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

int flock(int file, int operation) {
  if ((operation & LOCK_EX) != 0 && (fcntl(file, F_GETFL) & O_ACCMODE) == O_RDONLY) {
    errno = EBADF;
    return -1;
  }
  return REAL(flock)(file, operation);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (flags != 0) {
    errno = EINVAL;
    return -1;
  }
  return renameat(from_folder, from, to_folder, to);
}

/* Whether this process has the file open. */
static int is_open(int folder, const char* name) {
  struct stat named;
  struct stat held;
  if (fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) != 0) {
    return 0;
  }
  for (int file = 0; file < 256; ++file) {
    if (fstat(file, &held) == 0 && held.st_ino == named.st_ino && held.st_dev == named.st_dev) {
      return 1;
    }
  }
  return 0;
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  if (!is_open(to_folder, to)) {
    return REAL(renameat)(from_folder, from, to_folder, to);
  }
  char aside[32];
  snprintf(aside, sizeof aside, ".nfs%d", (int)getpid());
  if (REAL(renameat)(to_folder, to, to_folder, aside) != 0) {
    return -1;
  }
  const char* gap = getenv("CLCA_NFS_GAP");
  usleep(gap == NULL ? 0 : 1000U * (unsigned)atoi(gap));
  const int result = REAL(renameat)(from_folder, from, to_folder, to);
  unlinkat(to_folder, aside, 0);
  return result;
}
