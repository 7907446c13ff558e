// HDF5 opens plugins, shared libraries that decode what it cannot, when a file asks for one. The static command has no such file: what
// it hands to HDF5 it has computed. The C library's own dlopen() would look for the shared C library that it was linked beside, so
// the linker puts these in its place (--wrap), and HDF5 says that there is no plugin.

extern "C" {
void* __wrap_dlopen(const char*, int) {
  return nullptr;
}
void* __wrap_dlsym(void*, const char*) {
  return nullptr;
}
int __wrap_dlclose(void*) {
  return 0;
}
char* __wrap_dlerror() {
  static char text[] = "the static command loads no plugins";
  return text;
}
}
