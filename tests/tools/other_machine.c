/* Preloaded, makes a program see another file system or another time. Begun by one who tried grseg on the
   failures that users of HDF5 report from NFS, Lustre and FUSE. Environment:
   FLOCK=N        flock() fails with errno N
   NO_LINK=1      neither links nor renaming without replacing (sshfs, SMB, 9p)
   NO_RENAME=1    no renaming at all (object stores)
   OPEN=N READ=N  files named *.h5 cannot be opened, or read, with errno N
   SHIFT=S        the clock is S seconds ahead */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static long number(const char* name)
{
  const char* text = getenv(name);
  return text ? atol(text) : 0;
}

static int refuse(int error)
{
  errno = error;
  return -1;
}

int flock(int file, int operation)
{
  return number("FLOCK") ? refuse((int)number("FLOCK")) : (int)syscall(SYS_flock, file, operation);
}

int renameat2(int a, const char* from, int b, const char* to, unsigned flags)
{
  if (number("NO_LINK") && flags) return refuse(EINVAL);
  return number("NO_RENAME") ? refuse(ENOSYS) : (int)syscall(SYS_renameat2, a, from, b, to, flags);
}

int rename(const char* from, const char* to)
{
  return renameat2(AT_FDCWD, from, AT_FDCWD, to, 0);
}

int link(const char* from, const char* to)
{
  if (number("NO_LINK") || number("NO_RENAME")) return refuse(EPERM);
  return (int)syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0);
}

int open(const char* path, int flags, ...)
{
  va_list rest;
  va_start(rest, flags);
  const int mode = va_arg(rest, int);
  va_end(rest);
  const size_t length = strlen(path);
  if (number("OPEN") && length > 3 && !strcmp(path + length - 3, ".h5")) return refuse((int)number("OPEN"));
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}

int open64(const char* path, int flags, ...)
{
  va_list rest;
  va_start(rest, flags);
  const int mode = va_arg(rest, int);
  va_end(rest);
  return open(path, flags, mode);
}

ssize_t pread64(int file, void* to, size_t bytes, off64_t at)
{
  /* The superblock can still be read. */
  return number("READ") && at > 4096 ? refuse((int)number("READ")) : syscall(SYS_pread64, file, to, bytes, at);
}

ssize_t pread(int file, void* to, size_t bytes, off_t at)
{
  return pread64(file, to, bytes, at);
}

int clock_gettime(clockid_t clock, struct timespec* now)
{
  const int result = (int)syscall(SYS_clock_gettime, clock, now);
  if (clock == CLOCK_REALTIME) now->tv_sec += number("SHIFT");
  return result;
}

int gettimeofday(struct timeval* now, void* zone)
{
  (void)zone;
  struct timespec exact;
  clock_gettime(CLOCK_REALTIME, &exact);
  now->tv_sec = exact.tv_sec;
  now->tv_usec = exact.tv_nsec / 1000;
  return 0;
}

time_t time(time_t* to)
{
  struct timeval now;
  gettimeofday(&now, 0);
  if (to) *to = now.tv_sec;
  return now.tv_sec;
}
