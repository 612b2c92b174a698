// Lets one system call of a program fail, for tests of what it leaves behind (LD_PRELOAD).
//   FAIL_FOLDER  calls on files below this folder are counted, and no others
//   FAIL_CALL    write, rename or fsync: the kind that is counted
//   FAIL_AT      the number of the call that fails, from 1 on; 0: none
//   FAIL_COUNT   file that takes the number of calls at the end of the program
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/uio.h>
#include <unistd.h>

static atomic_long calls;
static pid_t program;

__attribute__((constructor)) static void begin(void) { program = getpid(); }

__attribute__((destructor)) static void end(void) {
  const char* path = getenv("FAIL_COUNT");
  // Programs that this one starts (those of MPI) count nothing, and have nothing to say.
  const int is_ours = getpid() == program && atomic_load(&calls) > 0;
  FILE* file = path && is_ours ? fopen(path, "w") : NULL;
  if (!file) return;
  fprintf(file, "%ld\n", atomic_load(&calls));
  fclose(file);
}

static int is_below_folder(const char* path) {
  const char* folder = getenv("FAIL_FOLDER");
  const size_t length = folder ? strlen(folder) : 0;
  return length > 0 && strncmp(path, folder, length) == 0 &&
         (path[length] == '/' || path[length] == '\0');
}

static int is_file_below_folder(int descriptor) {
  char link[64], path[PATH_MAX];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = readlink(link, path, sizeof path - 1);
  if (length < 0) return 0;
  path[length] = '\0';
  return is_below_folder(path);
}

/// Counts a call of this kind; 1 where it is the one to fail.
static int is_due(const char* kind, int is_counted) {
  const char *wanted = getenv("FAIL_CALL"), *at = getenv("FAIL_AT");
  if (!is_counted || !wanted || !at || strcmp(kind, wanted) != 0) return 0;
  return atomic_fetch_add(&calls, 1) + 1 == atol(at);
}

#define NEXT(result, name, ...) ((result(*)(__VA_ARGS__))dlsym(RTLD_NEXT, name))

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (is_due("write", is_file_below_folder(descriptor))) {
    errno = ENOSPC;
    return -1;
  }
  return NEXT(ssize_t, "write", int, const void*, size_t)(descriptor, bytes, size);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  if (is_due("write", is_file_below_folder(descriptor))) {
    errno = ENOSPC;
    return -1;
  }
  return NEXT(ssize_t, "writev", int, const struct iovec*, int)(descriptor, parts, count);
}

int fsync(int descriptor) {
  if (is_due("fsync", is_file_below_folder(descriptor))) {
    errno = EIO;
    return -1;
  }
  return NEXT(int, "fsync", int)(descriptor);
}

int rename(const char* from, const char* to) {
  char path[PATH_MAX];
  const int is_counted = realpath(from, path) && is_below_folder(path);
  if (is_due("rename", is_counted)) {
    errno = EIO;
    return -1;
  }
  return NEXT(int, "rename", const char*, const char*)(from, to);
}
