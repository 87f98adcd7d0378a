#include "render/osmesa.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "core/error.hpp"

#ifdef __SANITIZE_ADDRESS__
// Mesa 22.3 itself loses some hundred bytes a context, destroyed properly or not: not ours to report.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa"; }
#endif

namespace ricochet::render {

void* osmesa_symbol(const char* name) {
  // Loaded alone: with libGL before it every pixel stays 0 without an error. Never unloaded: LLVM inside does not
  // survive that.
  static void* const library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
  if (!library)
    throw FileError(fmt::format(
        "the OSMesa library, which draws without a display, is missing ({}); apt-get install libosmesa6", dlerror()));
  void* const symbol = dlsym(library, name);
  if (!symbol) throw Error(fmt::format("OSMesa lacks {}", name));
  return symbol;
}

void* gl_symbol(const char* name) {
  static const auto address = osmesa<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
  void* const symbol = reinterpret_cast<void*>(address(name));
  if (!symbol) throw Error(fmt::format("OSMesa lacks {}", name));
  return symbol;
}

}  // namespace ricochet::render
