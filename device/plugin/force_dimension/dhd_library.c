#include "dhd_library.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* Where a function of this name is stored, and whether the driver needs it. */
struct symbol {
  const char* name;
  size_t place;
  bool is_needed;
};

#define NEEDED(name) {#name, offsetof(struct dhd_library, name), true}
#define IF_THERE(name) {#name, offsetof(struct dhd_library, name), false}

static const struct symbol symbols[] = {
    NEEDED(dhdGetSDKVersion),
    NEEDED(dhdErrorGetLast),
    NEEDED(dhdErrorGetLastStr),
    NEEDED(dhdGetDeviceCount),
    NEEDED(dhdGetAvailableCount),
    NEEDED(dhdOpen),
    NEEDED(dhdOpenID),
    NEEDED(dhdOpenSerial),
    NEEDED(dhdClose),
    NEEDED(dhdGetSystemType),
    NEEDED(dhdGetSystemName),
    NEEDED(dhdGetSerialNumber),
    NEEDED(dhdGetVersion),
    NEEDED(dhdGetStatus),
    NEEDED(dhdHasWrist),
    NEEDED(dhdHasActiveWrist),
    NEEDED(dhdHasGripper),
    NEEDED(dhdHasActiveGripper),
    NEEDED(dhdWaitForReset),
    NEEDED(dhdSetGravityCompensation),
    NEEDED(dhdSetEffectorMass),
    NEEDED(dhdConfigLinearVelocity),
    NEEDED(dhdGetPosition),
    NEEDED(dhdGetLinearVelocity),
    NEEDED(dhdGetOrientationFrame),
    NEEDED(dhdGetGripperGap),
    NEEDED(dhdGetButtonMask),
    NEEDED(dhdEnableForce),
    NEEDED(dhdSetForce),
    NEEDED(dhdSetForceAndTorqueAndGripperForce),
    NEEDED(dhdSetBrakes),
    NEEDED(dhdStop),
    NEEDED(dhdEnableExpertMode),
    NEEDED(dhdDisableExpertMode),
    IF_THERE(dhdSetMaxForce),
    IF_THERE(dhdGetMaxForce),
    IF_THERE(dhdSetWatchdog),
    IF_THERE(dhdGetWatchdog),
    IF_THERE(dhdSetTimeGuard),
    IF_THERE(dhdGetComMode),
    IF_THERE(dhdEnableSimulator),
};

/* Versions whose declarations are those of the header. */
enum { OLDEST_MINOR = 7, KNOWN_MAJOR = 3 };

static struct dhd_library library;
static bool is_loaded = false;
static char loaded_path[1024];

static void* opened(const char* path, char* words, size_t words_size) {
  static const char* const names[] = {"libdhd.so", "libdrd.so", "libdhd.so.3", "libdrd.so.3"};
  if (path[0] != '\0') {
    void* handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    const char* reason = handle == NULL ? dlerror() : NULL;
    if (handle == NULL) {
      snprintf(words, words_size, "no library that loads behind library= (%.110s); give the file "
               "libdhd.so of your Force Dimension SDK", reason == NULL ? "" : reason);
    }
    return handle;
  }
  for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
    void* handle = dlopen(names[i], RTLD_NOW | RTLD_LOCAL);
    if (handle != NULL) return handle;
    /* If this file exists but does not load, the message is about another file. */
    const char* reason = dlerror();
    if (reason != NULL && strncmp(reason, names[i], strlen(names[i])) != 0) {
      snprintf(words, words_size, "%s, which does not load (%.100s); install what it needs",
               names[i], reason);
      return NULL;
    }
  }
  snprintf(words, words_size,
           "neither libdhd.so nor libdrd.so on this machine; install the Force Dimension SDK, "
           "or name the file by library=PATH");
  return NULL;
}

static bool look_up(void* handle, char* words, size_t words_size) {
  for (size_t i = 0; i < sizeof symbols / sizeof symbols[0]; ++i) {
    void* found = dlsym(handle, symbols[i].name);
    if (found == NULL && symbols[i].is_needed) {
      snprintf(words, words_size,
               "a library without the function %s; install version 3.7 or later of the Force "
               "Dimension SDK",
               symbols[i].name);
      return false;
    }
    /* In C a pointer to data is no pointer to a function, but POSIX gives both the same
     * representation. */
    memcpy((char*)&library + symbols[i].place, &found, sizeof found);
  }
  return true;
}

static bool is_known_version(char* words, size_t words_size) {
  int major = 0, minor = 0, release = 0, revision = 0;
  library.dhdGetSDKVersion(&major, &minor, &release, &revision);
  if (major == KNOWN_MAJOR && minor >= OLDEST_MINOR) return true;
  snprintf(words, words_size,
           "version %d.%d.%d of the Force Dimension SDK; this driver is for 3.7 and later of "
           "version 3: install one of these, or name its file by library=PATH",
           major, minor, release);
  return false;
}

const struct dhd_library* load_dhd_library(const char* path, char* words, size_t words_size) {
  if (is_loaded && strcmp(path, loaded_path) == 0) return &library;
  is_loaded = false;
  void* handle = opened(path, words, words_size);
  if (handle == NULL) return NULL;
  /* A refused library stays loaded as well, because it may have started threads, whose code
   * must not disappear. */
  if (!look_up(handle, words, words_size) || !is_known_version(words, words_size)) return NULL;
  snprintf(loaded_path, sizeof loaded_path, "%s", path);
  is_loaded = true;
  return &library;
}
